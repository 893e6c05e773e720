//! Elimination of samples: where no maximal set has the wanted number.

use crate::math::hypot;
use crate::points::Domain;

/// Drops those samples that have the nearest neighbours, one after the other, until `count` are left. For a handful of
/// samples: O(n²) for each.
pub fn thin(domain: &Domain, mut samples: Vec<[f32; 2]>, count: usize) -> Vec<[f32; 2]> {
    let distance = |a: [f32; 2], b: [f32; 2]| {
        let [dx, dy] = domain.offset(a.map(f64::from), b.map(f64::from));
        hypot(dx, dy)
    };
    while samples.len() > count {
        let others = |i: usize| (0..samples.len()).filter(move |&j| j != i);
        let nearest = |i: usize| others(i).map(|j| distance(samples[i], samples[j])).fold(f64::INFINITY, f64::min);
        let crowded = (0..samples.len()).min_by(|&a, &b| nearest(a).total_cmp(&nearest(b))).unwrap_or(0);
        samples.remove(crowded);
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Boundary;

    #[test]
    fn the_most_crowded_samples_go_also_across_the_seam() {
        let samples = vec![[0.02, 0.5], [0.3, 0.5], [0.55, 0.5], [0.99, 0.5]];
        let rest = |boundary, count| thin(&Domain::unit(boundary), samples.clone(), count);
        assert_eq!(rest(Boundary::Bounded, 4), samples);
        assert_eq!(rest(Boundary::Bounded, 3), [samples[0], samples[2], samples[3]]);
        assert_eq!(rest(Boundary::Periodic, 3), [samples[1], samples[2], samples[3]]);
        assert_eq!(rest(Boundary::Periodic, 2).len(), 2);
    }
}
