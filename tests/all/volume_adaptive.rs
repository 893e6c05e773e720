//! `volume::adaptive` against naive oracles.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use azulejo::mesh::Mesh;
use azulejo::volume::adaptive::{InsideOptions, Options, Radius, sample, sample_inside};
use azulejo::{Boundary, Context, Domain, Error, Interior, MAXIMAL_DENSITY_IN_SPACE, Points};

use crate::common::volume_oracle::{HARD_CUBOIDS, distance};
use crate::common::{BOUNDARIES, float_spacing};

type At<'a> = &'a (dyn Fn([f64; 3]) -> f64 + Sync);

/// A radius with its stated bounds.
#[derive(Clone, Copy)]
struct Stated<'a> {
    at: At<'a>,
    bounds: [f64; 2],
    slope: f64,
}

impl<'a> Stated<'a> {
    fn radius(&self) -> Radius<'a> {
        let Self { at, bounds: [smallest, largest], slope } = *self;
        Radius::Function { at, smallest, largest, slope }
    }
}

fn made(domain: Domain<3>, stated: Stated, seed: u64, threads: usize) -> Points<3> {
    let options = Options::new(stated.radius()).domain(domain).seed(seed);
    sample(&Context::new(threads).unwrap(), &options, None).unwrap().0
}

/// All pairs.
fn conflict(domain: &Domain<3>, samples: &Points<3>) -> Option<(usize, usize)> {
    let points: Vec<_> = samples.positions.iter().map(|position| position.map(f64::from)).collect();
    let is_near =
        |&(i, j): &(usize, usize)| distance(domain, points[i], points[j]) < 0.5 * (samples.radii[i] + samples.radii[j]);
    (0..points.len()).flat_map(|j| (0..j).map(move |i| (i, j))).find(is_near)
}

/// A place farther than the rule and the tolerance allow from all samples, by halving boxes, whose radii follow from the slope.
fn gap(domain: &Domain<3>, stated: Stated, samples: &Points<3>) -> Option<[f64; 3]> {
    let turns: &[f64] = if domain.boundary == Boundary::Periodic { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let mut balls = Vec::new();
    for (position, &radius) in samples.positions.iter().zip(&samples.radii) {
        for &z in turns {
            for (x, y) in turns.iter().flat_map(|&y| turns.iter().map(move |&x| (x, y))) {
                let turn = [x, y, z];
                let centre =
                    [0, 1, 2].map(|k: usize| f64::from(position[k]) + turn[k] * (domain.max[k] - domain.min[k]));
                balls.push((centre, radius));
            }
        }
    }
    let spacing = float_spacing(domain);
    let tolerance = 3.5 * spacing * (1.0 + stated.slope);
    gap_in(domain.min, domain.max, stated, tolerance, &balls, spacing / 16.0)
}

fn gap_in(
    min: [f64; 3],
    max: [f64; 3],
    stated: Stated,
    tolerance: f64,
    balls: &[([f64; 3], f64)],
    finest: f64,
) -> Option<[f64; 3]> {
    let length = |vector: [f64; 3]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let centre = [0, 1, 2].map(|k| 0.5 * (min[k] + max[k]));
    let half = length([0, 1, 2].map(|k| 0.5 * (max[k] - min[k])));
    let radius = (stated.at)(centre);
    let least = (radius - stated.slope * half).max(stated.bounds[0]);
    let most = (radius + stated.slope * half).min(stated.bounds[1]);
    let far = |ball: [f64; 3]| length([0, 1, 2].map(|k: usize| (ball[k] - min[k]).abs().max((ball[k] - max[k]).abs())));
    if balls.iter().any(|&(ball, of)| far(ball) <= 0.5 * (of + least) + tolerance) {
        return None;
    }
    let to = |ball: [f64; 3]| length([0, 1, 2].map(|k: usize| ball[k] - centre[k]));
    if balls.iter().all(|&(ball, of)| to(ball) > 0.5 * (of + radius) + tolerance) {
        return Some(centre);
    }
    let near = |ball: [f64; 3]| length([0, 1, 2].map(|k: usize| ball[k] - ball[k].clamp(min[k], max[k])));
    let near: Vec<_> =
        balls.iter().copied().filter(|&(ball, of)| near(ball) <= 0.5 * (of + most) + tolerance).collect();
    let axis = (0..3).max_by(|&a, &b| (max[a] - min[a]).total_cmp(&(max[b] - min[b]))).unwrap();
    if max[axis] - min[axis] < finest {
        return None;
    }
    let (mut lower, mut upper) = (max, min);
    (lower[axis], upper[axis]) = (centre[axis], centre[axis]);
    let next = |from, to| gap_in(from, to, stated, tolerance, &near, finest);
    next(min, lower).or_else(|| next(upper, max))
}

/// Everything that is promised of a set.
fn check(domain: &Domain<3>, stated: Stated, samples: &Points<3>) {
    assert_eq!(samples.radii.len(), samples.len());
    let limit = 4.0 * {
        let [x, y, z] = domain.extent();
        (x * x + y * y + z * z).sqrt()
    };
    for (position, &radius) in samples.positions.iter().zip(&samples.radii) {
        let place = position.map(f64::from);
        assert!((0..3).all(|k| domain.min[k] <= place[k] && place[k] < domain.max[k]), "{position:?} in {domain:?}");
        let expected = (stated.at)(place);
        assert!(radius == expected || expected > 0.9 * limit && radius > 0.9 * limit, "{radius} for {expected}");
    }
    assert_eq!(conflict(domain, samples), None, "{domain:?}");
    assert_eq!(gap(domain, stated, samples), None, "{domain:?}");
}

fn check_all(domain: Domain<3>, stated: Stated) {
    let samples = made(domain, stated, 3, 1);
    check(&domain, stated, &samples);
    let again = made(domain, stated, 3, 2);
    assert_eq!((&samples.positions, &samples.radii), (&again.positions, &again.radii));
}

#[test]
fn a_constant_radius_gives_sets_of_one_radius() {
    for boundary in BOUNDARIES {
        for (min, max, radius) in HARD_CUBOIDS {
            let at = |_| radius;
            let stated = Stated { at: &at, bounds: [radius; 2], slope: 0.0 };
            check_all(Domain { min, max, boundary }, stated);
        }
    }
    let at = |_| 0.03;
    let stated = Stated { at: &at, bounds: [0.03; 2], slope: 0.0 };
    let found = made(Domain::unit(Boundary::Periodic), stated, 1, 1).len() as f64 * 0.03f64.powi(3);
    assert!((found / MAXIMAL_DENSITY_IN_SPACE - 1.0).abs() < 0.01, "{found}");
}

#[test]
fn ramps_and_waves_have_no_conflict_and_no_gap() {
    for boundary in BOUNDARIES {
        for ratio in [4.0, 16.0, 64.0] {
            let least = 0.4 / ratio;
            let at = |[x, _, _]: [f64; 3]| least * (1.0 + (ratio - 1.0) * x.clamp(0.0, 1.0));
            let stated = Stated { at: &at, bounds: [least, ratio * least], slope: (ratio - 1.0) * least };
            check_all(Domain { min: [0.0; 3], max: [1.0, 0.3, 0.3], boundary }, stated);
        }
        for slope in [0.3, 1.0, 3.0] {
            let at = |[x, y, z]: [f64; 3]| 0.07 + slope * (0.1 * (3.0 * x + 2.0 * y - z)).sin().abs();
            let stated = Stated { at: &at, bounds: [0.07, 0.07 + slope], slope: 0.375 * slope };
            check_all(Domain::unit(boundary), stated);
        }
    }
}

/// A well whose walls are as steep as the slope, far from the axes of blocks.
#[test]
fn a_sharp_well_is_covered() {
    for boundary in BOUNDARIES {
        for slope in [0.5, 1.0, 2.0] {
            let at = |[x, y, z]: [f64; 3]| {
                let [x, y, z] = [x - 0.31, y - 0.67, z - 0.52];
                (0.02 + slope * (x * x + y * y + z * z).sqrt()).min(0.4)
            };
            check_all(Domain::unit(boundary), Stated { at: &at, bounds: [0.02, 0.4], slope });
        }
    }
}

#[test]
fn thin_and_small_domains_are_covered() {
    for boundary in BOUNDARIES {
        for max in [[4.0, 2e-3, 3.0], [4.0, 0.05, 0.02], [0.2, 0.3, 0.1], [1e-6; 3]] {
            let at = |[x, y, z]: [f64; 3]| 0.1 + 0.1 * (x + y + z).min(7.0);
            check_all(Domain { min: [0.0; 3], max, boundary }, Stated { at: &at, bounds: [0.1, 0.8], slope: 0.174 });
        }
        for least in [1.8, 1e3, 1e30] {
            let at = |[x, _, _]: [f64; 3]| least * (1.0 + x.clamp(0.0, 1.0));
            let stated = Stated { at: &at, bounds: [least, 2.0 * least], slope: least };
            let domain = Domain { min: [-0.3, 4.0, 0.0], max: [0.7, 4.1, 1e-5], boundary };
            let (slope, limit) = (stated.slope, least / 24.0 / float_spacing(&domain));
            assert!(slope < limit);
            assert_eq!(made(domain, stated, 4, 1).len(), 1);
        }
    }
}

#[test]
fn the_density_follows_the_radius() {
    for (ratio, tolerance) in [(4.0f64, 0.05), (16.0, 0.1)] {
        let mean = 0.5 * (1.0 - ratio.powi(-2)) / (ratio - 1.0);
        let least = (MAXIMAL_DENSITY_IN_SPACE * mean / 1e5).cbrt();
        let at = |[x, _, _]: [f64; 3]| least * (1.0 + (ratio - 1.0) * x);
        let stated = Stated { at: &at, bounds: [least, ratio * least], slope: (ratio - 1.0) * least };
        let found = made(Domain::unit(Boundary::Periodic), stated, 0, 2).len() as f64 / 1e5;
        assert!((found - 1.0).abs() < tolerance, "{ratio}: {found}");
    }
}

#[test]
fn values_on_a_grid_are_a_radius() {
    let size = [3, 2, 4];
    let values: Vec<f32> = (0..24).map(|number| 0.08 + 0.04 * (number * 7 % 5) as f32).collect();
    for boundary in BOUNDARIES {
        let options = Options::new(Radius::Grid { values: &values, size }).domain(Domain::unit(boundary)).seed(2);
        let points = sample(&Context::new(1).unwrap(), &options, None).unwrap().0;
        let at = |place: [f64; 3]| {
            let mut sum = 0.0;
            for (number, &value) in values.iter().enumerate() {
                let node = [number % 3, number / 3 % 2, number / 6];
                let weight = |k: usize| (1.0 - (place[k] * (size[k] - 1) as f64 - node[k] as f64).abs()).max(0.0);
                sum += weight(0) * weight(1) * weight(2) * f64::from(value);
            }
            sum
        };
        for (position, radius) in points.positions.iter().zip(&points.radii) {
            assert!((at(position.map(f64::from)) - radius).abs() < 1e-12);
        }
        // Steps of .16 along all axes are the steepest that there can be.
        let stated = Stated { at: &at, bounds: [0.08, 0.241], slope: 0.16 * 14f64.sqrt() };
        let domain = Domain::unit(boundary);
        assert_eq!((conflict(&domain, &points), gap(&domain, stated, &points)), (None, None));
    }
}

fn cube() -> Arc<Mesh> {
    let positions = (0..8).map(|k| [(k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32]).collect();
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = squares.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]).collect();
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// An octahedron and a cube, whose depth is known.
#[test]
fn the_inside_of_a_mesh_is_covered() {
    let corners =
        [[1.0f32, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let faces = (0..8u32).map(|k| {
        let [x, y, z] = [k & 1, 2 + (k >> 1 & 1), 4 + (k >> 2)];
        if (k.count_ones()) % 2 == 0 { [x, y, z] } else { [x, z, y] }
    });
    let octahedron = Arc::new(Mesh::new(corners.to_vec(), faces.collect()).unwrap());
    let of_octahedron = |p: [f64; 3]| (1.0 - p.iter().map(|x| x.abs()).sum::<f64>()) / 3f64.sqrt();
    let of_cube = |p: [f64; 3]| p.iter().map(|&x| x.min(1.0 - x)).fold(1.0, f64::min);
    let depths: [(Arc<Mesh>, At); 2] = [(octahedron, &of_octahedron), (cube(), &of_cube)];
    let at = |[x, y, _]: [f64; 3]| 0.05 + 0.2 * (x + 0.5 * y).abs().min(1.0);
    let stated = Stated { at: &at, bounds: [0.05, 0.25], slope: 0.224 };
    for (mesh, depth) in depths {
        let options = InsideOptions::new(stated.radius()).seed(5);
        let run = |threads: usize| sample_inside(&Context::new(threads).unwrap(), &mesh, &options, None).unwrap().0;
        let points = run(1);
        assert_eq!(points.positions, run(2).positions);
        let interior = Interior::of(&mesh);
        assert!(points.positions.iter().all(|&position| interior.contains(position)));
        let all = Domain { min: [-1.0; 3], max: [1.0; 3], boundary: Boundary::Bounded };
        assert_eq!(conflict(&all, &points), None);
        let mut probes = 0;
        for number in 0..60 * 60 * 60 {
            let probe = [number % 60, number / 60 % 60, number / 3600].map(|k| -1.0 + (f64::from(k) + 0.37) / 30.0);
            let radius = at(probe);
            if depth(probe) < 3f64.sqrt() / 16.0 * radius + 1e-5 {
                continue;
            }
            probes += 1;
            let is_covered = points
                .positions
                .iter()
                .zip(&points.radii)
                .any(|(position, of)| distance(&all, position.map(f64::from), probe) <= 0.5 * (of + radius) + 1e-6);
            assert!(is_covered, "{probe:?}");
        }
        assert!(probes > 10_000, "{probes}");
    }
}

/// The argument that an error names, and its reason.
/// One sample covers the mesh: its radius is more lattice units than a lattice takes.
#[test]
fn samples_of_radii_beyond_the_mesh_are_inside() {
    let octahedron = || {
        let positions =
            [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        let triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
        Arc::new(Mesh::new(positions.to_vec(), triangles.to_vec()).unwrap())
    };
    let (mesh, context) = (octahedron(), Context::new(1).unwrap());
    let interior = Interior::of(&mesh);
    for radius in [1.0, 6.46, 20.0, 1000.0] {
        for seed in 0..40 {
            let values = [radius];
            let options = InsideOptions::new(Radius::Grid { values: &values, size: [1; 3] }).seed(seed);
            let points = sample_inside(&context, &mesh, &options, None).unwrap().0;
            assert!(points.len() == 1 || radius < 2.0, "{radius}: {} samples", points.len());
            assert!(points.positions.iter().all(|&position| interior.contains(position)), "{radius}, seed {seed}");
        }
    }
}

fn refused(domain: Domain<3>, radius: Radius) -> (&'static str, String) {
    let options = Options::new(radius).domain(domain);
    let one = sample(&Context::new(1).unwrap(), &options, None).unwrap_err();
    let two = sample(&Context::new(2).unwrap(), &options, None).unwrap_err();
    assert_eq!(one.to_string(), two.to_string());
    match one {
        Error::InvalidArgument { argument, reason } | Error::TooLarge { argument, reason } => (argument, reason),
        other => panic!("{other}"),
    }
}

#[test]
fn radii_out_of_range_are_refused() {
    let unit = Domain::unit(Boundary::Periodic);
    let good: At = &|_| 0.1;
    let of = |at: At, smallest, largest, slope| refused(unit, Radius::Function { at, smallest, largest, slope });
    for bad in [f64::NAN, 0.0, -1.0, f64::INFINITY, 1e-9] {
        assert_eq!(of(good, bad, 0.1, 0.0).0, "smallest");
    }
    for bad in [f64::NAN, 0.05, f64::INFINITY] {
        assert_eq!(of(good, 0.1, bad, 0.0).0, "largest");
    }
    for bad in [f64::NAN, -1.0, f64::INFINITY, 1e6] {
        assert_eq!(of(good, 0.1, 0.1, bad).0, "slope");
    }
    for bad in [f64::NAN, 0.0, -0.1, f64::INFINITY, 0.04, 0.11, f64::NEG_INFINITY] {
        let at = move |[x, _, _]: [f64; 3]| if x > 0.7 { bad } else { 0.07 };
        let (argument, reason) = of(&at, 0.05, 0.1, 0.5);
        assert!(argument == "radius_function" && reason.contains("is not in 0.05..=0.1"), "{argument} {reason}");
    }
    let jump = |[x, _, _]: [f64; 3]| if x > 0.7 { 0.05 } else { 0.1 };
    let (argument, reason) = of(&jump, 0.05, 0.1, 0.1);
    assert!(argument == "radius_function" && reason.contains("slope"), "{reason}");
    assert_eq!(of(&|_| 1e-5, 1e-5, 1.0, 0.0).0, "radius_function");
    let domain = Domain { max: [0.0; 3], ..unit };
    assert_eq!(refused(domain, Radius::Function { at: good, smallest: 0.1, largest: 0.1, slope: 0.0 }).0, "domain_max");
    assert_eq!(refused(unit, Radius::Grid { values: &[0.1; 3], size: [2, 2, 1] }).0, "grid_size");
    assert_eq!(refused(unit, Radius::Grid { values: &[0.1, f32::NAN], size: [2, 1, 1] }).0, "grid_values");
    assert_eq!(refused(unit, Radius::Grid { values: &[0.1, 1e-7], size: [2, 1, 1] }).0, "grid_values");
    let context = Context::new(1).unwrap();
    let radius = Radius::Function { at: good, smallest: 0.1, largest: 0.1, slope: 0.0 };
    for bad in [0.0, 0.6, f64::NAN] {
        let error = sample_inside(&context, &cube(), &InsideOptions::new(radius).tolerance(bad), None).unwrap_err();
        assert!(error.to_string().starts_with("tolerance"), "{error}");
    }
    let open = Arc::new(Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap());
    assert!(
        sample_inside(&context, &open, &InsideOptions::new(radius), None).unwrap_err().to_string().starts_with("mesh")
    );
}

/// A function that answers at random within its bounds: an error, or a set without conflicts, and an end.
#[test]
fn inconsistent_answers_make_no_conflicts() {
    let unit = Domain::unit(Boundary::Bounded);
    for (slope, seed) in [(0.0, 0), (0.05, 1), (0.3, 2), (1.0, 3)] {
        let state = AtomicU64::new(seed);
        let at = move |_: [f64; 3]| {
            let bits = state.fetch_add(0x9e37_79b9_7f4a_7c15, Ordering::Relaxed).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            0.1 + 0.05 * (bits >> 11) as f64 / (1u64 << 53) as f64
        };
        let radius = Radius::Function { at: &at, smallest: 0.1, largest: 0.15, slope };
        let found = sample(&Context::new(1).unwrap(), &Options::new(radius).domain(unit), None);
        match found {
            Ok((points, _)) => assert_eq!(conflict(&unit, &points), None),
            Err(error) => assert!(error.to_string().starts_with("radius_function"), "{error}"),
        }
    }
}
