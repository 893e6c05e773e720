//! The guarantees of sets of the plane: distances, ranks, and coverage by cutting the domain into pieces.

use azulejo_c::kdrt::{azulejo_kdrt_options, azulejo_kdrt_options_init};
use azulejo_c::points::azulejo_points;
use azulejo_core::{Boundary, Domain};

use crate::calls::{Arrays, Owned, Patience, check_distances, report};
use crate::disks::find_gap;
use crate::input::Input;

/// A domain of any place and shape with a radius that suits it, and a seed. `None` for hostile numbers that leave room for
/// more samples than can be checked.
pub fn any_options(input: &mut Input, patience: &Patience) -> Option<azulejo_kdrt_options> {
    let min = [input.coordinate(), input.coordinate()].map(f64::from);
    let sides = [input.number(), input.number()];
    let radius = sides[0].min(sides[1]) * input.number() / 16.0;
    if (sides[0] / radius + 2.0) * (sides[1] / radius + 2.0) > 1000.0 {
        return None;
    }
    Some(azulejo_kdrt_options {
        boundary: u32::from(input.one_in(2)),
        radius,
        domain_min: min,
        domain_max: [min[0] + sides[0], min[1] + sides[1]],
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        ..report(azulejo_kdrt_options_init)
    })
}

fn domain(options: &azulejo_kdrt_options) -> Domain {
    let boundary = if options.boundary == 0 { Boundary::Periodic } else { Boundary::Bounded };
    Domain { min: options.domain_min, max: options.domain_max, boundary }
}

/// Samples that stand already, with clearances if they have any.
#[derive(Default)]
pub struct Given {
    pub positions: Vec<[f32; 2]>,
    pub clearances: Option<Vec<f64>>,
}

impl Given {
    /// In the domain and around it, at times anywhere; with clearances about the radius, at times any.
    pub fn any(options: &azulejo_kdrt_options, input: &mut Input) -> Self {
        let count = if input.one_in(2) { input.below(20) } else { 0 };
        let hostile = input.one_in(16);
        let position = |input: &mut Input| -> [f32; 2] {
            std::array::from_fn(|axis| {
                let [min, max] = [options.domain_min[axis], options.domain_max[axis]];
                if hostile {
                    return input.coordinate();
                }
                (min + (max - min) * (f64::from(input.any::<u8>()) / 128.0 - 0.5)) as f32
            })
        };
        let positions = (0..count).map(|_| position(input)).collect();
        let clearance = |input: &mut Input| match input.below(8) {
            0 if hostile => input.number(),
            1 => 0.0,
            kind => options.radius * 2f64.powi(3 - kind as i32),
        };
        let clearances = (!input.one_in(4)).then(|| (0..count).map(|_| clearance(input)).collect());
        Self { positions, clearances }
    }

    pub fn in_options(&self, options: &azulejo_kdrt_options) -> azulejo_kdrt_options {
        azulejo_kdrt_options {
            given_positions: self.positions.as_ptr().cast(),
            given_clearances: self.clearances.as_ref().map_or(std::ptr::null(), |clearances| clearances.as_ptr()),
            given_count: self.positions.len(),
            ..*options
        }
    }

    /// True if their positions can be decided here: far from a torus, its turns are only counted to rounding.
    fn are_near(&self, options: &azulejo_kdrt_options) -> bool {
        let sides = [0, 1].map(|axis| options.domain_max[axis] - options.domain_min[axis]);
        let is_near = |position: &[f32; 2]| (0..2).all(|axis| f64::from(position[axis]).abs() < 1e3 * sides[axis]);
        options.boundary == 1 || self.positions.iter().all(is_near)
    }

    /// The radius, unless it has one of its own.
    pub fn clearance(&self, options: &azulejo_kdrt_options, index: usize) -> f64 {
        self.clearances.as_ref().map_or(options.radius, |clearances| clearances[index])
    }

    /// True if `is` holds for all of them, of the distance of a position and the clearance.
    fn all(&self, options: &azulejo_kdrt_options, place: [f64; 2], is: impl Fn(f64, f64) -> bool) -> bool {
        self.positions.iter().enumerate().all(|(i, position)| {
            is(length(wrapped_offset(options, position.map(f64::from), place)), self.clearance(options, i))
        })
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// The shortest offset of two places; on a torus wherever they are.
fn wrapped_offset(options: &azulejo_kdrt_options, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|axis| {
        let (offset, side) = (a[axis] - b[axis], options.domain_max[axis] - options.domain_min[axis]);
        if options.boundary == 0 { offset - side * (offset / side).round() } else { offset }
    })
}

/// Six float spacings at the largest coordinate.
fn tolerance(options: &azulejo_kdrt_options) -> f64 {
    let corners = options.domain_min.iter().chain(&options.domain_max);
    6.0 * f64::from(f32::EPSILON) * corners.fold(0.0, |most: f64, x| x.abs().max(most))
}

/// Positions, and ranks where they are in progressive order.
#[derive(Debug, PartialEq)]
pub struct Set {
    pub positions: Vec<[f32; 2]>,
    pub ranks: Vec<f32>,
}

impl Set {
    pub fn of(points: Owned<azulejo_points>) -> Self {
        let ranks = Arrays::of(&points).ranks.to_vec();
        Self { positions: owned(points), ranks }
    }

    pub fn keep(&mut self, is_kept: impl Fn(&[f32; 2]) -> bool) {
        let kept: Vec<bool> = self.positions.iter().map(is_kept).collect();
        let mut of_ranks = kept.iter();
        self.ranks.retain(|_| *of_ranks.next().expect("a rank for each sample"));
        let mut of_positions = kept.iter();
        self.positions.retain(|_| *of_positions.next().expect("one for each"));
    }
}

/// Distances of samples and to given ones; ranks that fall, and distances of every prefix by its last rank.
pub fn check_set(options: &azulejo_kdrt_options, given: &Given, set: &Set) {
    check(options, &set.positions);
    let slack = if options.boundary == 0 { tolerance(options) } else { 0.0 }; // of wrapping given samples
    for sample in set.positions.iter().filter(|_| given.are_near(options)) {
        let is_clear = given.all(options, sample.map(f64::from), |distance, clearance| distance >= clearance - slack);
        assert!(is_clear, "{sample:?} is too close to a given sample");
    }
    assert_eq!(set.ranks.len(), if options.order == 1 { set.positions.len() } else { 0 });
    assert!(set.ranks.is_sorted_by(|a, b| a >= b), "ranks rise");
    if options.order == 1 {
        let domain = domain(options);
        check_distances(&set.positions, |a, b| domain.offset(a, b), |i, _| set.ranks[i].into());
    }
}

/// A place that neither the first `count` samples cover within a radius nor what is given; radii are that much longer.
fn gap(
    options: &azulejo_kdrt_options,
    given: &Given,
    samples: &[[f32; 2]],
    radius: f64,
    longer: f64,
) -> Option<[f64; 2]> {
    let samples = samples.iter().map(|&sample| (sample, radius));
    let given = given.positions.iter().enumerate().map(|(i, &position)| (position, given.clearance(options, i)));
    find_gap(&domain(options), samples.chain(given), longer, tolerance(options) / 64.0)
}

/// Every place is covered; if the set is ordered, by each of some prefixes, too.
pub fn check_covered(options: &azulejo_kdrt_options, given: &Given, set: &Set) {
    if !given.are_near(options) {
        return;
    }
    let quotient = if options.quotient > 0.0 { options.quotient } else { 2f64.powf(0.125) };
    let coarsest = set.ranks.iter().take_while(|&&rank| rank == set.ranks[0]).count();
    // Of less than 100 samples the quotient is larger.
    let quotient_of = |count: usize| if count < 100 { 2f64.max(quotient * quotient) } else { quotient };
    let of_prefix = |count: usize| (count, quotient_of(count) * f64::from(set.ranks[count - 1]));
    let counts = std::iter::successors(Some(coarsest.max(1)), |count| Some(count + 1 + count / 3));
    let prefixes = counts.take_while(|&count| count < set.ranks.len()).map(of_prefix);
    for (count, radius) in prefixes.chain([(set.positions.len(), options.radius)]) {
        let gap = gap(options, given, &set.positions[..count], radius, tolerance(options));
        assert_eq!(gap, None, "not covered by the first {count} within {radius}");
    }
}

/// The covering radius is as reported: that much covers, and a little less does not.
pub fn check_coverage(options: &azulejo_kdrt_options, samples: &[[f32; 2]], covering_radius: f64) {
    let slack = tolerance(options) + 1e-6 * covering_radius;
    let gap = |radius: f64| gap(options, &Given::default(), samples, radius, 0.0);
    assert_eq!(gap(covering_radius + slack), None, "farther than {covering_radius}");
    assert!(
        covering_radius <= slack || gap(covering_radius - slack).is_some(),
        "covered by less than {covering_radius}"
    );
}

/// No two samples are too close, and all are in the domain.
pub fn check(options: &azulejo_kdrt_options, samples: &[[f32; 2]]) {
    let domain = domain(options);
    check_distances(samples, |a, b| domain.offset(a, b), |_, _| options.radius);
    let inside = |x: f32, axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(x));
    assert!(samples.iter().all(|&[x, y]| inside(x, 0) && inside(y, 1)));
}

pub fn owned(points: Owned<azulejo_points>) -> Vec<[f32; 2]> {
    Arrays::of(&points).positions.as_chunks::<2>().0.to_vec()
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};

    use azulejo_c::kdrt::azulejo_kdrt_options_init;

    use super::*;
    use crate::calls::report;

    fn is_refused(check: impl Fn()) -> bool {
        catch_unwind(AssertUnwindSafe(check)).is_err()
    }

    /// Samples of a square lattice that just cover the unit torus or square.
    fn case(boundary: u32) -> (azulejo_kdrt_options, Vec<[f32; 2]>) {
        let options = azulejo_kdrt_options { radius: 0.1011, boundary, ..report(azulejo_kdrt_options_init) };
        let at = |i: usize| (i as f32 + 0.5) / 7.0;
        (options, (0..49).map(|i| [at(i % 7), at(i / 7)]).collect())
    }

    #[test]
    fn a_sample_that_is_missing_moved_or_outside_is_noticed() {
        for boundary in [0, 1] {
            let (options, samples) = case(boundary);
            let covered = |positions: Vec<[f32; 2]>| {
                let set = Set { positions, ranks: Vec::new() };
                !is_refused(|| check_covered(&options, &Given::default(), &set))
            };
            assert!(covered(samples.clone()));
            check(&options, &samples);
            for index in 0..samples.len() {
                let (mut fewer, mut moved) = (samples.clone(), samples.clone());
                fewer.remove(index);
                moved[index][0] += 0.08;
                assert!(!covered(fewer) && !covered(moved.clone()), "{index}");
                assert!(is_refused(|| check(&options, &moved)), "{index}");
            }
            let mut outside = samples.clone();
            outside[0][0] += 1.0;
            assert!(is_refused(|| check(&options, &outside)));
        }
    }

    #[test]
    fn a_covering_radius_that_is_not_true_is_noticed() {
        for boundary in [0, 1] {
            let (options, samples) = case(boundary);
            let coverage = 0.5f64.sqrt() / 7.0;
            check_coverage(&options, &samples, coverage);
            for wrong in [0.999 * coverage, 1.001 * coverage] {
                assert!(is_refused(|| check_coverage(&options, &samples, wrong)));
            }
            assert!(is_refused(|| check_coverage(&options, &samples[1..], coverage)));
        }
    }

    /// The ranks of the last two levels of a lattice, and one that is too high, rises, or covers too little.
    #[test]
    fn ranks_that_are_not_true_are_noticed() {
        let (options, samples) = case(0);
        let options = azulejo_kdrt_options { order: 1, ..options };
        let ranks = vec![1.0 / 7.001; 49];
        let kept = |ranks: Vec<f32>| {
            let set = Set { positions: samples.clone(), ranks };
            !is_refused(|| check_set(&options, &Given::default(), &set))
        };
        assert!(kept(ranks.clone()));
        let with = |index: usize, rank: f32| {
            let mut ranks = ranks.clone();
            ranks[index] = rank;
            ranks
        };
        assert!(!kept(with(20, 0.16)) && !kept(with(20, 0.13)) && !kept(vec![0.15; 49]));
    }

    #[test]
    fn a_sample_in_a_clearance_and_a_clearance_that_covers_are_noticed() {
        let (options, samples) = case(0);
        let given = |clearance| Given { positions: vec![[0.5 / 7.0, 1.0]], clearances: Some(vec![clearance]) };
        let set = Set { positions: samples.clone(), ranks: Vec::new() };
        check_set(&options, &given(0.07), &set);
        assert!(is_refused(|| check_set(&options, &given(0.08), &set)));
        let fewer = Set { positions: samples[1..].to_vec(), ranks: Vec::new() };
        assert!(is_refused(|| check_covered(&options, &given(0.1), &fewer)));
        check_covered(&options, &given(0.2), &fewer);
    }
}
