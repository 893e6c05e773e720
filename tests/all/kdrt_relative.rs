//! Windows of `kdrt` relative to their corner, anywhere on the images of a torus, against images of the whole set.

use azulejo::kdrt::{Options, Plane, Progressive, sample};
use azulejo::{Boundary, Classes, Context, Domain, Error, Points};

use crate::common::sets::Random;
use crate::common::windows::{Rect, between};
use crate::common::{BOUNDARIES, domain, find_conflict, find_gap};

/// A domain whose floats have a spacing of 2^-21, and a period of 4 by 2.
fn torus() -> Domain {
    domain([-1.0, 2.0], [3.0, 4.0], Boundary::Periodic)
}

fn kept(options: &Options) -> (Plane, Points<2>) {
    let context = Context::new(1).unwrap();
    (Plane::new(&context, options, None).unwrap(), sample(&context, options, None).unwrap())
}

/// All that is known of a sample, in bits that can be sorted.
type Sample = ([u32; 2], u32, u32);

fn sorted(positions: &[[f32; 2]], ranks: &[f32], classes: &[u32]) -> Vec<Sample> {
    let rank = |index| ranks.get(index).map_or(0, |rank: &f32| rank.to_bits());
    let class = |index| classes.get(index).copied().unwrap_or_default();
    let mut samples: Vec<Sample> =
        (0..positions.len()).map(|index| (positions[index].map(f32::to_bits), rank(index), class(index))).collect();
    samples.sort_unstable();
    samples
}

fn all_of(points: &Points<2>) -> Vec<Sample> {
    sorted(&points.positions, &points.ranks, &points.classes)
}

/// The promise of a window: every image of every sample that lies in it, seen from its corner. All sums are exact.
fn images(whole: &Points<2>, domain: &Domain, (min, max): Rect) -> Vec<Sample> {
    let (mut positions, mut ranks, mut classes) = (Vec::new(), Vec::new(), Vec::new());
    let turns = |axis: usize| {
        let (from, period) = (domain.min[axis], domain.extent()[axis]);
        let turn =
            |x: f64| if domain.boundary == Boundary::Periodic { ((x - from) / period).floor() as i64 } else { 0 };
        turn(min[axis])..=turn(max[axis])
    };
    for (x, y) in turns(1).flat_map(|y| turns(0).map(move |x| (x, y))) {
        for (index, sample) in whole.positions.iter().enumerate() {
            let at = [0, 1].map(|axis| f64::from(sample[axis]) + [x, y][axis] as f64 * domain.extent()[axis]);
            if (0..2).all(|axis| min[axis] <= at[axis] && at[axis] < max[axis]) {
                positions.push([0, 1].map(|axis| (at[axis] - min[axis]) as f32));
                ranks.extend(whole.ranks.get(index));
                classes.extend(whole.classes.get(index));
            }
        }
    }
    sorted(&positions, &ranks, &classes)
}

/// A corner on the lattice, some periods away.
fn corner(random: &mut Random, domain: &Domain, periods: f64) -> [f64; 2] {
    domain.extent().map(|period| (between(random, -periods, periods) * period * 1024.0).round() / 1024.0)
}

fn check_windows(random: &mut Random, options: &Options, longest: f64, windows: usize) {
    let ((plane, whole), domain) = (kept(options), options.domain);
    for step in 0..windows {
        let min = corner(random, &domain, [1.5, 1e3, 1e8][step % 3]);
        let max = [0, 1].map(|axis| {
            let side = (between(random, 0.0, longest.min(domain.extent()[axis])) * 4096.0).round().max(1.0) / 4096.0;
            min[axis] + side
        });
        let window = plane.relative_window(min, max).unwrap();
        assert!(all_of(&window) == images(&whole, &domain, (min, max)), "{min:?} {max:?}");
        assert!(window.ranks.is_sorted_by(|a, b| a >= b) || !window.classes.is_empty());
        let extent = [0, 1].map(|axis| max[axis] - min[axis]);
        assert!(window.len() <= plane.most_samples(extent).unwrap());
    }
}

#[test]
fn windows_are_images_of_the_whole_seen_from_their_corner() {
    let mut random = Random::new(1);
    let classes = Classes::new(2, &[0.05, 0.03, 0.03, 0.04]).unwrap();
    for radius in [0.012, 0.1] {
        check_windows(&mut random, &Options::new(radius).domain(torus()).seed(2), 4.0, 20);
        let levels = Progressive::new().quotient(1.4);
        check_windows(&mut random, &Options::progressive(radius, levels).domain(torus()).seed(3), 4.0, 12);
        let levels = levels.coarsest(1.5 * radius);
        check_windows(&mut random, &Options::progressive(radius, levels).domain(torus()).seed(4), 0.5, 12);
    }
    check_windows(&mut random, &Options::classes(&classes).domain(torus()).seed(5), 4.0, 9);
}

#[test]
fn windows_of_a_whole_period_have_every_sample() {
    let (plane, whole) = kept(&Options::new(0.02).domain(torus()));
    for min in [[-1.0, 2.0], [0.25, 1e6], [-5e8, 3.5]] {
        let window = plane.relative_window(min, [min[0] + 4.0, min[1] + 2.0]).unwrap();
        assert_eq!(window.len(), whole.len());
    }
}

/// Tiles far from the domain, put together: without conflict, in exact numbers, and without gap.
#[test]
fn tiles_far_away_fit_together() {
    let radius = 0.01;
    let (plane, _) = kept(&Options::new(radius).domain(torus()).seed(6));
    for far in [[0.0; 2], [-3e6, 7e6], [4e8, 1e9 + 0.375]] {
        let (side, tiles) = (0.375, 10);
        let mut samples = Vec::new();
        for (x, y) in (0..tiles).flat_map(|y| (0..tiles).map(move |x| (f64::from(x) * side, f64::from(y) * side))) {
            let min = [far[0] + x, far[1] + y];
            let tile = plane.relative_window(min, [far[0] + (x + side), far[1] + (y + side)]).unwrap();
            samples.extend(
                tile.positions.iter().map(|&[dx, dy]| [(x + f64::from(dx)) as f32, (y + f64::from(dy)) as f32]),
            );
        }
        let all = domain([0.0; 2], [f64::from(tiles) * side; 2], Boundary::Bounded);
        assert_eq!(find_conflict(&all, radius, &samples), None);
        let inner = domain([2.0 * radius; 2], all.max.map(|x| x - 2.0 * radius), Boundary::Bounded);
        assert_eq!(find_gap(&inner, radius + 3.0 * plane.unit(), &samples), None);
    }
}

/// Periods and corners that are no multiples of the unit: every sample is in one window of a period cut in windows, and
/// positions lie in the window.
#[test]
fn a_period_cut_anywhere_has_every_sample_once() {
    let mut random = Random::new(7);
    for domain in
        [domain([0.1; 2], [0.83, 1.4], Boundary::Periodic), domain([-7.3, 0.2], [-6.1, 0.9], Boundary::Periodic)]
    {
        let (plane, whole) = kept(&Options::new(0.006).domain(domain).seed(8));
        for periods in [2.0, 1e4] {
            let start = corner(&mut random, &domain, periods).map(|x| x + 0.1);
            let cuts = [0, 1].map(|axis| {
                let ends = [start[axis], start[axis] + domain.extent()[axis]];
                let mut cuts: Vec<f64> = (0..6).map(|_| between(&mut random, ends[0], ends[1])).chain(ends).collect();
                cuts.sort_unstable_by(f64::total_cmp);
                cuts
            });
            let mut count = 0;
            for (x, y) in cuts[1].windows(2).flat_map(|y| cuts[0].windows(2).map(move |x| (x, y))) {
                let window = plane.relative_window([x[0], y[0]], [x[1], y[1]]).unwrap();
                let extent = [x[1] - x[0], y[1] - y[0]];
                let is_inside =
                    |sample: &[f32; 2]| (0..2).all(|axis| (0.0..extent[axis] + 1e-9).contains(&sample[axis].into()));
                assert!(window.positions.iter().all(is_inside), "{extent:?}");
                count += window.len();
            }
            assert!(count.abs_diff(whole.len()) <= usize::from(periods > 2.0), "{count} of {}", whole.len());
        }
    }
}

#[test]
fn bounded_planes_have_relative_windows_too() {
    let domain = domain([-1.0, 2.0], [3.0, 4.0], Boundary::Bounded);
    let (plane, whole) = kept(&Options::new(0.015).domain(domain));
    for rect in [(domain.min, domain.max), ([0.25, 2.5], [0.5, 3.0]), ([2.5, 3.75], [3.0, 4.0])] {
        assert!(all_of(&plane.relative_window(rect.0, rect.1).unwrap()) == images(&whole, &domain, rect));
    }
    let error = plane.relative_window([2.5, 3.0], [3.5, 4.0]).unwrap_err();
    assert_eq!(error.to_string(), "window_max: [0] is 3.5, outside the domain -1 to 3");
}

#[test]
fn a_window_never_has_more_samples_than_there_may_be() {
    let mut random = Random::new(9);
    for boundary in BOUNDARIES {
        let domain = Domain { boundary, ..torus() };
        let (plane, _) = kept(&Options::new(0.0625).domain(domain));
        for _ in 0..200 {
            let side = [0, 1].map(|_| 10f64.powf(between(&mut random, -3.0, 0.0)));
            let min = [0, 1].map(|axis| between(&mut random, domain.min[axis], domain.max[axis] - side[axis]));
            let max = [0, 1].map(|axis| min[axis] + side[axis]);
            let count = plane.relative_window(min, max).unwrap().len();
            assert!(count <= plane.most_samples(side).unwrap());
        }
        // Room for the hexagonal arrangement, and no more than the formula.
        assert_eq!(plane.most_samples([1e-9; 2]).unwrap(), 1);
        assert_eq!(plane.most_samples([1.0; 2]).unwrap(), (256.0 * 2.0 / 3f64.sqrt() + 33.0) as usize);
        for (extent, reason) in [([0.0, 1.0], "extent: [0] is 0"), ([1.0, f64::NAN], "extent: [1] is NaN")] {
            assert!(plane.most_samples(extent).unwrap_err().to_string().starts_with(reason));
        }
        assert!(matches!(plane.most_samples([1e9; 2]), Err(Error::TooLarge { argument: "extent", .. })));
    }
}

/// A plane of 10^12 radii² in which windows are as exact at the far end, and beyond it, as in the middle.
#[test]
fn wide_planes_are_a_million_radii_wide() {
    let mut random = Random::new(10);
    let context = Context::new(1).unwrap();
    for boundary in BOUNDARIES {
        for radius in [1.0, 0.6] {
            let wide = domain([-17.25, 3e5], [1e6 * radius, 3e5 + 1.04e6 * radius], boundary);
            let options = Options::new(radius).domain(wide).seed(11);
            assert!(Plane::new(&context, &options, None).is_err());
            let plane = Plane::wide(&context, &options, None).unwrap();
            assert!((256.0..512.0).contains(&(radius / plane.unit())));
            let (side, tiles) = (16.0, 4);
            for step in 0..6 {
                // Anywhere, and over the corner where periods meet; beginning at multiples of the unit.
                let place = |axis: usize, share: f64| {
                    let end = if boundary == Boundary::Bounded { f64::from(tiles) * side } else { 0.0 };
                    (wide.min[axis] + (wide.extent()[axis] - end) * share).floor()
                };
                let far = match step {
                    0 => [0, 1].map(|axis| place(axis, 1.0)),
                    1 if boundary == Boundary::Periodic => [0, 1].map(|axis| place(axis, 3.0) - 20.0),
                    _ => [0, 1].map(|axis| place(axis, between(&mut random, 0.1, 0.9))),
                };
                let mut samples = Vec::new();
                for (x, y) in
                    (0..tiles).flat_map(|y| (0..tiles).map(move |x| (f64::from(x) * side, f64::from(y) * side)))
                {
                    let min = [far[0] + x, far[1] + y];
                    let tile = plane.relative_window(min, min.map(|x| x + side)).unwrap();
                    let moved = |&[dx, dy]: &[f32; 2]| [(x + f64::from(dx)) as f32, (y + f64::from(dy)) as f32];
                    samples.extend(tile.positions.iter().map(moved));
                }
                let whole = plane.relative_window(far, far.map(|x| x + f64::from(tiles) * side)).unwrap();
                // The period of a torus is no multiple of the unit: windows beyond the seam begin between lattice points.
                let slack = if step == 1 { 2.0 * plane.unit() } else { 0.0 };
                if step != 1 {
                    assert!(sorted(&samples, &[], &[]) == all_of(&whole));
                }
                assert_eq!(samples.len(), whole.len());
                let all = domain([0.0; 2], [f64::from(tiles) * side; 2], Boundary::Bounded);
                assert_eq!(find_conflict(&all, radius - slack, &samples), None);
                let inner = domain([2.0 * radius; 2], all.max.map(|x| x - 2.0 * radius), Boundary::Bounded);
                assert_eq!(find_gap(&inner, radius + 3.0 * plane.unit() + slack, &samples), None);
            }
            let refusal = plane.window(wide.min, wide.max).unwrap_err().to_string();
            assert!(refusal.starts_with("plane: is wide"), "{refusal}");
            assert_eq!(plane.whole(&context, None).unwrap_err().to_string(), refusal);
            let visit = |_: &[[f32; 2]]| std::ops::ControlFlow::Continue(());
            assert_eq!(plane.stream(&context, visit, None).unwrap_err().to_string(), refusal);
        }
    }
}

#[test]
fn what_is_no_wide_plane_is_refused_by_name() {
    let context = Context::new(1).unwrap();
    let refuse = |options: &Options| Plane::wide(&context, options, None).err().unwrap().to_string();
    let good = Options::new(1.0).domain(domain([0.0; 2], [1e5; 2], Boundary::Periodic));
    assert!(
        refuse(&good.domain(domain([0.0; 2], [3e6; 2], Boundary::Periodic))).starts_with("domain_max: [0] is 3000000")
    );
    assert!(refuse(&good.domain(domain([1e13; 2], [2e13; 2], Boundary::Periodic))).starts_with("domain_max: [0] is"));
    assert!(refuse(&good.domain(domain([0.0; 2], [90.0; 2], Boundary::Periodic))).starts_with("domain_max: 90 by 90"));
    assert!(refuse(&good.leaf_size(5.0)).starts_with("leaf_size"));
    assert!(refuse(&Options::new(0.0).domain(good.domain)).starts_with("radius"));
    assert!(refuse(&Options::progressive(1.0, Progressive::new()).domain(good.domain)).starts_with("order"));
    let classes = Classes::new(1, &[1.0]).unwrap();
    assert!(refuse(&Options::classes(&classes).domain(good.domain)).starts_with("classes"));
}
