//! DCR from any start: heaps, lines, single places and other sets that are far from even reach what random sets reach.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use azulejo::dcr::{
    DelaunayOptions, Density, Neighbourhood, Options, Report, Stopped, relax, relax_with_density, scatter, surface,
};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, Points};

use crate::common::meshes;
use crate::common::relaxed;
use crate::common::sets::{self, Random, unit_square};
use crate::common::surface_oracle as oracle;
use crate::common::triangle::distance;

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];
const NEIGHBOURHOODS: [Neighbourhood; 2] = [Neighbourhood::Delaunay, Neighbourhood::Nearest];

/// A start: where point `i` of `count` is in the unit square, given two random numbers.
type Start = fn(usize, usize, [f64; 2]) -> [f64; 2];

const STARTS: [(&str, Start); 15] = [
    ("corner", |_, _, [x, y]| [0.05 * x, 0.05 * y]),
    ("row", |_, _, [x, _]| [x, 0.5]),
    ("column", |_, _, [x, _]| [0.3, x]),
    ("diagonal", |i, count, _| [i as f64 / count as f64; 2]),
    ("ring", |_, _, [x, _]| [0.5 + 0.3 * (TAU * x).cos(), 0.5 + 0.3 * (TAU * x).sin()]),
    ("heaps", |i, _, [x, y]| [0.13 * (i % 7) as f64 + 0.02 * x, 0.29 * (i % 3) as f64 + 0.02 * y]),
    ("one place", |_, _, _| [0.5, 0.5]),
    ("lower corner", |_, _, _| [0.0, 0.0]),
    ("spot", |_, _, [x, y]| [0.4 + 1e-6 * x, 0.6 + 1e-6 * y]),
    ("Gaussian", |_, _, [x, y]| {
        let length = 0.05 * (-2.0 * (1.0 - x).ln()).sqrt();
        [0.5 + length * (TAU * y).cos(), 0.5 + length * (TAU * y).sin()]
    }),
    ("lattice", |i, count, _| {
        let side = (count as f64).sqrt().ceil() as usize;
        [i % side, i / side].map(|index| index as f64 / side as f64)
    }),
    ("two far heaps", |i, _, [x, y]| if i % 10 == 0 { [0.01 * x, 0.1] } else { [0.6 + 0.01 * x, 0.7 + 0.01 * y] }),
    ("half empty", |_, _, [x, y]| [0.5 * x, y]),
    ("all but one", |i, _, [x, y]| if i == 0 { [0.9, 0.9] } else { [0.01 * x, 0.01 * y] }),
    ("uniform but for a heap", |i, _, [x, y]| if i < 60 { [0.3, 0.7] } else { [x, y] }),
];

/// The points of a start on a domain.
fn points(start: Start, domain: &Domain, count: usize) -> Vec<[f32; 2]> {
    let mut random = Random::new(5);
    let place = |i| {
        let place = start(i, count, [random.unit(), random.unit()].map(f64::from));
        std::array::from_fn(|axis| {
            let (min, max) = (domain.min[axis], domain.max[axis]);
            ((min + place[axis] * (max - min)) as f32).min((max as f32).next_down())
        })
    };
    (0..count).map(place).collect()
}

/// Relaxes a set and checks its report by all pairs and by cutting the domain into pieces.
fn run(options: &Options, points: &[[f32; 2]]) -> Report {
    let (relaxed, report) = relax(&Context::new(1).unwrap(), options, points, None).unwrap();
    assert_eq!(relaxed.len(), points.len());
    assert_eq!(relaxed::fault(&options.domain, &relaxed, &report), None, "{options:?}");
    report
}

#[test]
fn the_oracle_of_reports_notices_points_that_are_missing_or_moved_and_figures_that_are_not_true() {
    for boundary in BOUNDARIES {
        let options = Options::new(unit_square(boundary), Neighbourhood::Delaunay);
        let start = points(|_, _, place| place, &options.domain, 300);
        let (relaxed, report) = relax(&Context::new(1).unwrap(), &options, &start, None).unwrap();
        let fault = |points: &[[f32; 2]], report: &Report| relaxed::fault(&options.domain, points, report);
        assert_eq!(fault(&relaxed, &report), None);
        for index in 0..relaxed.len() {
            let mut fewer = relaxed.clone();
            fewer.remove(index);
            let mut moved = relaxed.clone();
            moved[index] = relaxed[(index + 1) % relaxed.len()].map(|x| 0.5 * (x + 0.5));
            assert!(fault(&fewer, &report).is_some() && fault(&moved, &report).is_some(), "{boundary:?}, {index}");
        }
        for factor in [0.99999, 1.00001] {
            let scaled = |change: &dyn Fn(&mut Report)| {
                let mut report = report;
                change(&mut report);
                fault(&relaxed, &report)
            };
            assert!(scaled(&|report| report.rho *= factor).is_some());
            assert!(scaled(&|report| report.smallest_distance *= factor).is_some());
            assert!(scaled(&|report| report.relative_covering_radius *= factor).is_some());
        }
    }
}

#[test]
fn any_start_reaches_what_a_random_one_does() {
    for boundary in BOUNDARIES {
        for neighbourhood in NEIGHBOURHOODS {
            let (rho, coverage) = match (neighbourhood, boundary) {
                (Neighbourhood::Delaunay, Boundary::Periodic) => (0.855, 0.67),
                (Neighbourhood::Delaunay, Boundary::Bounded) => (0.845, 0.68),
                (Neighbourhood::Nearest, _) => (0.905, 0.9),
            };
            let options = Options::new(unit_square(boundary), neighbourhood);
            for (name, start) in STARTS {
                let report = run(&options, &points(start, &options.domain, 1500));
                assert!(
                    report.rho >= rho && report.relative_covering_radius <= coverage,
                    "{name}, {options:?}: {report:?}"
                );
            }
        }
    }
}

#[test]
fn long_domains_are_filled_from_any_start() {
    for (boundary, rho, coverage) in [(Boundary::Periodic, 0.85, 0.68), (Boundary::Bounded, 0.83, 0.71)] {
        let options = Options::new(Domain { max: [10.0, 0.1], ..unit_square(boundary) }, Neighbourhood::Delaunay);
        for (name, start) in STARTS.into_iter().step_by(2) {
            let report = run(&options, &points(start, &options.domain, 4000));
            assert!(
                report.rho >= rho && report.relative_covering_radius <= coverage,
                "{name}, {boundary:?}: {report:?}"
            );
        }
    }
    // Three spacings wide: no set has the figures of a plane here, but all have about the same.
    for neighbourhood in NEIGHBOURHOODS {
        let domain = Domain { max: [100.0, 0.1], ..unit_square(Boundary::Periodic) };
        for (name, start) in STARTS.into_iter().step_by(2) {
            let report = run(&Options::new(domain, neighbourhood), &points(start, &domain, 900));
            assert!(
                report.rho >= 0.7 && report.relative_covering_radius <= 1.1,
                "{name}, {neighbourhood:?}: {report:?}"
            );
        }
    }
}

#[test]
fn small_sets_are_spread_too() {
    for boundary in BOUNDARIES {
        for neighbourhood in NEIGHBOURHOODS {
            let options = Options::new(unit_square(boundary), neighbourhood);
            for ((name, start), count) in STARTS.iter().flat_map(|start| [10, 30, 100].map(|count| (start, count))) {
                let report = run(&options, &points(*start, &options.domain, count));
                assert!(
                    report.rho >= 0.7 && report.relative_covering_radius <= 1.1,
                    "{count} from {name}, {options:?}: {report:?}"
                );
            }
        }
    }
}

#[test]
fn few_coincident_points_do_not_stay_together() {
    for count in [2, 3, 4, 6, 9, 14, 25] {
        for boundary in BOUNDARIES {
            let options = Options::new(unit_square(boundary), Neighbourhood::Delaunay);
            let mut set = sets::random_points(1000, 60);
            set[..count].fill([0.33, 0.61]);
            let report = run(&options, &set);
            assert!(
                report.rho >= 0.845 && report.relative_covering_radius <= 0.68,
                "{count}, {boundary:?}: {report:?}"
            );
        }
    }
}

/// Five points all but on a line are in triangles so flat that none of them may move far, and too far apart to count as
/// coincident.
#[test]
fn chains_of_points_do_not_jam() {
    for (chains, seed) in [(1, 0), (1, 1), (3, 2), (8, 3)] {
        for boundary in BOUNDARIES {
            let options = Options::new(unit_square(boundary), Neighbourhood::Delaunay);
            let mut set = sets::random_points(1000, 61 + seed);
            let link = 0.006 * options.domain.hexagonal_distance(set.len());
            for (point, place) in set[..5 * chains].iter_mut().enumerate() {
                let (chain, along) = ((point / 5) as f64, (point % 5) as f64 * link);
                *place = [0.1 + 0.1 * chain + along, 0.3 + 0.07 * chain + 0.1 * chain * along].map(|x| x as f32);
            }
            let report = run(&options, &set);
            assert!(
                report.rho >= 0.845 && report.relative_covering_radius <= 0.68,
                "{chains}, {boundary:?}: {report:?}"
            );
        }
    }
}

#[test]
fn the_threads_do_not_matter() {
    for boundary in BOUNDARIES {
        for neighbourhood in NEIGHBOURHOODS {
            let options = Options::new(unit_square(boundary), neighbourhood).max_iterations(7);
            for (_, start) in STARTS[..9].iter().step_by(2) {
                let set = points(*start, &options.domain, 9000);
                let [one, three] =
                    [1, 3].map(|threads| relax(&Context::new(threads).unwrap(), &options, &set, None).unwrap());
                assert_eq!(one, three);
            }
        }
    }
}

/// A call that is cancelled before the first step returns the points as they came, and reports what they are.
#[test]
fn a_heap_that_is_cancelled_at_once_stays() {
    for boundary in BOUNDARIES {
        let options = DelaunayOptions::new(unit_square(boundary));
        let set = points(STARTS[0].1, &options.domain, 500);
        let density = Density::Function(&|_| 1.0);
        let context = Context::new(1).unwrap();
        let still = options.max_iterations(0);
        let expected = [
            relax(&context, &still.into(), &set, None).unwrap(),
            relax_with_density(&context, &still, &density, &set, None).unwrap(),
        ];
        for limit in [0.0, 0.001, 0.005, 0.0098, 0.01] {
            let cancel = |done: f64| if done >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
            let found = [
                relax(&context, &options.into(), &set, Some(&cancel)).unwrap(),
                relax_with_density(&context, &options, &density, &set, Some(&cancel)).unwrap(),
            ];
            for ((relaxed, report), (points, still)) in found.iter().zip(&expected) {
                assert_eq!(report.stopped, Stopped::Cancelled);
                if report.iterations == 0 {
                    assert!(relaxed == points && report.rho == still.rho);
                    // Up to the displacements by which a triangulation is made unique.
                    assert!(
                        (report.relative_covering_radius / still.relative_covering_radius - 1.0).abs() < 1e-5,
                        "{report:?} {still:?}"
                    );
                }
            }
            assert!(limit > 0.0 || found.iter().all(|(_, report)| report.iterations == 0));
        }
    }
}

/// With a density, starts end as one that has the density already.
#[test]
fn any_start_takes_on_a_density() {
    let ramp = |[x, _]: [f64; 2]| 0.2 + x;
    let disk = |[x, y]: [f64; 2]| if (x - 0.5).hypot(y - 0.4) < 0.3 { 1.0 } else { 0.0 };
    let context = Context::new(1).unwrap();
    for boundary in BOUNDARIES {
        let options = DelaunayOptions::new(unit_square(boundary));
        for (number, function) in [&ramp as &(dyn Fn([f64; 2]) -> f64 + Sync), &disk].into_iter().enumerate() {
            let density = Density::Function(function);
            let scattered = scatter(&context, &options.domain, &density, 1500, 4, None).unwrap();
            let (expected, _) = relax_with_density(&context, &options, &density, &scattered, None).unwrap();
            let shares = |points: &[[f32; 2]]| {
                let mut shares = [0.0; 9];
                points.iter().for_each(|&[x, y]| shares[(3.0 * x) as usize + 3 * (3.0 * y) as usize] += 1.0 / 1500.0);
                shares
            };
            for (name, start) in STARTS.iter().filter(|(name, _)| !["lattice", "uniform but for a heap"].contains(name))
            {
                let set = points(*start, &options.domain, 1500);
                let (relaxed, report) = relax_with_density(&context, &options, &density, &set, None).unwrap();
                assert!(
                    report.rho > 0.7 && report.relative_covering_radius < 0.8,
                    "{name}, {number}, {boundary:?}: {report:?}"
                );
                let differences =
                    shares(&relaxed).into_iter().zip(shares(&expected)).map(|(a, b): (f64, f64)| (a - b).abs());
                let farthest = differences.fold(0.0, f64::max);
                assert!(farthest < 0.012, "{name}, {number}, {boundary:?}: {farthest}");
            }
        }
    }
}

/// Samples on one triangle, at one place of it, and half of them there.
fn heaps(mesh: &Mesh, count: usize) -> Vec<(Vec<u32>, Vec<[f32; 2]>)> {
    let mut random = Random::new(8);
    let mut uv = || {
        let [u, v] = [random.unit(), random.unit()];
        if u + v <= 1.0 { [u, v] } else { [1.0 - u, 1.0 - v] }
    };
    let uvs: Vec<[f32; 2]> = (0..count).map(|_| uv()).collect();
    let sampled: Vec<u32> = (0..mesh.triangles().len() as u32).filter(|&t| mesh.triangle_area(t) > 0.0).collect();
    let one = sampled[sampled.len() / 3];
    let half = (0..count).map(|i| if i % 2 == 0 { one } else { sampled[i * 7919 % sampled.len()] }).collect();
    vec![(vec![one; count], uvs.clone()), (vec![one; count], vec![[0.3, 0.4]; count]), (half, uvs)]
}

fn relax_on(mesh: &Mesh, triangles: &[u32], uvs: &[[f32; 2]], threads: usize) -> (Points<3>, surface::Report) {
    let context = Context::new(threads).unwrap();
    surface::relax(&context, mesh, triangles, uvs, &surface::Options::default(), None).unwrap()
}

fn smallest(samples: &[[f32; 3]]) -> f64 {
    let nearest = |i: usize| samples[..i].iter().map(move |&other| distance(samples[i], other));
    (0..samples.len()).flat_map(nearest).fold(f64::INFINITY, f64::min)
}

#[test]
fn heaps_on_meshes_are_spread_over_all_parts() {
    for (positions, triangles) in
        [meshes::sphere(), meshes::torus(), meshes::join([meshes::sphere(), meshes::placed(meshes::torus(), 1.0, 9.0)])]
    {
        let mesh = Mesh::new(positions, triangles).unwrap();
        let count = 1200;
        let d_max = (2.0 * mesh.area() / (3f64.sqrt() * f64::from(count))).sqrt();
        for (triangles, uvs) in heaps(&mesh, count as usize) {
            let (relaxed, report) = relax_on(&mesh, &triangles, &uvs, 1);
            assert_eq!(oracle::misplaced(&mesh, &relaxed), None);
            let positions: Vec<[f32; 3]> = triangles.iter().zip(&uvs).map(|(&t, &uv)| mesh.point(t, uv)).collect();
            let found = smallest(&relaxed.positions);
            assert!(found >= smallest(&positions) && (report.rho - found / d_max).abs() < 1e-9, "{report:?}");
            assert!(report.rho > 0.8, "{report:?}");
            assert_eq!(oracle::gap(&mesh, &relaxed, 0.9 * d_max, 0.02 * d_max), None);
            assert_eq!(relax_on(&mesh, &triangles, &uvs, 3).0.positions, relaxed.positions);
        }
    }
}

#[test]
fn heaps_stay_off_what_a_mask_leaves_out() {
    let (positions, triangles) = meshes::torus();
    let masked: Vec<bool> = (0..triangles.len()).map(|t| t % 800 < 500).collect();
    let mesh = Mesh::new(positions, triangles).unwrap().with_mask(masked).unwrap();
    for (triangles, uvs) in heaps(&mesh, 600) {
        let (relaxed, report) = relax_on(&mesh, &triangles, &uvs, 1);
        assert!(relaxed.triangles.iter().all(|&triangle| mesh.is_sampled(triangle)));
        assert!(report.rho > 0.75, "{report:?}");
    }
}
