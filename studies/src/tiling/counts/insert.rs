//! Samples in the largest empty circles (Kanamori et al. 2011, "Deterministic blue noise sampling by solving largest
//! empty circle problems"), one after another.

use glam::DVec2;

use crate::dcr::others::torus::Torus;

/// Samples of the unit torus with new ones behind them, `count` in all. No fewer come back than go in.
pub fn insert(samples: &[[f32; 2]], count: usize) -> Vec<[f32; 2]> {
    let mut all = samples.to_vec();
    all.resize(count.max(samples.len()), [0.0; 2]);
    let mut torus = Torus::new(&all);
    (samples.len()..all.len()).for_each(|index| torus.remove(index));
    // The farthest corner of each Voronoi cell. The largest empty circle is about one of them.
    let mut corners: Vec<_> = (0..samples.len()).map(|index| torus.cell(index).farthest()).collect();
    for index in samples.len()..all.len() {
        let by_reach = |&a: &usize, &b: &usize| corners[a].length_squared().total_cmp(&corners[b].length_squared());
        let widest = (0..index).max_by(by_reach).unwrap_or_default();
        torus.insert(index, torus.point(widest) + corners.get(widest).copied().unwrap_or(DVec2::ZERO));
        let cell = torus.cell(index);
        cell.0.iter().filter(|side| (side.neighbour as usize) < index).for_each(|side| {
            corners[side.neighbour as usize] = torus.cell(side.neighbour as usize).farthest();
        });
        corners.push(cell.farthest());
    }
    all[samples.len()..].copy_from_slice(&torus.to_unit()[samples.len()..]);
    all
}

#[cfg(test)]
mod tests {
    use azulejo::analysis::coverage::covering_radius_2d;
    use azulejo::analysis::spacing::nearest_distances_2d;
    use azulejo::{Boundary, Context, Domain};

    use super::*;
    use crate::reference::random;

    #[test]
    fn each_sample_goes_where_the_largest_empty_circle_is() {
        let (context, torus) = (Context::new(1).unwrap(), Domain::unit(Boundary::Periodic));
        let all = insert(&random(60, 3), 80);
        assert_eq!((all.len(), &all[..60]), (80, &random(60, 3)[..]));
        for count in 60..80 {
            let largest = covering_radius_2d(&context, &torus, &all[..count], None).unwrap();
            let distance = nearest_distances_2d(&context, &torus, &all[..=count], None).unwrap()[count];
            assert!((distance / largest - 1.0).abs() < 1e-5, "{count}: {distance} {largest}");
        }
        assert_eq!(insert(&all, 70).len(), 80);
    }
}
