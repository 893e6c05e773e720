//! Every long call of the crate, in a table, and what is promised of all of them: the same result for any number of
//! threads and when it is watched, progress that grows from 0 to 1 on the calling thread, an end at each report, and
//! arguments that are refused by name before any work.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::fmt::Debug;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::slice;
use std::sync::{Arc, LazyLock};
use std::thread::{self, ThreadId};

use azulejo::analysis::bonds::bond_order;
use azulejo::analysis::coverage::{
    coverage_2d, coverage_3d, covering_radius_2d, covering_radius_3d, surface_coverage, surface_covering_radius,
    surface_uncovered_fraction,
};
use azulejo::analysis::differential::{plane_differences, surface_differences};
use azulejo::analysis::distribution::{radial_distribution, radial_distribution_3d};
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::space::figures_3d;
use azulejo::analysis::spacing::{nearest_distances_2d, rho, smallest_distance_2d, smallest_distance_3d};
use azulejo::analysis::spectrum::{axis_power, periodogram, periodogram_3d, radial_power_3d, sparse_periodogram};
use azulejo::analysis::triangles::{delaunay_triangles, triangle_statistics};
use azulejo::dcr::{self, CorrelationOptions, DelaunayOptions, Neighbourhood, PairCorrelation, Stopped};
use azulejo::kdrt::{self, CountOptions, MergeOptions, Piece, Plane, Progressive};
use azulejo::mask;
use azulejo::maximal;
use azulejo::mesh::Mesh;
use azulejo::psp::{
    self, ClassOptions, FlatOptions, Instance, InstanceOptions, ProjectionOptions, Psp, RegionOptions, adaptive,
};
use azulejo::thin::{self, thin};
use azulejo::volume;
use azulejo::{Boundary, Classes, Context, Domain, Error, Given, Order, Points, Progress, Region, Result};

use crate::common::meshes;
use crate::common::sets::random_points;
use volumes::VOLUME;

mod volumes;

/// A call with all arguments but its context and its progress callback; the result as text, in which floats are exact.
type Run = fn(&Context, Option<&Progress>) -> Result<String>;

/// A long call.
struct Call {
    /// Its folder in `src/` and its name.
    name: &'static str,
    /// The least number of reports on one thread.
    reports: usize,
    run: Run,
    /// Wrong arguments, by the beginning of what is said of them.
    refused: &'static [(&'static str, Run)],
}

fn said<T: Debug>(result: Result<T>) -> Result<String> {
    result.map(|found| format!("{found:?}"))
}

/// Samples without the report beside them, which has the time of the call.
fn samples<T: Debug, R>(result: Result<(T, R)>) -> Result<String> {
    said(result.map(|(samples, _)| samples))
}

/// The result of a relaxation, which returns its last state where it is cancelled.
fn relaxed<T: Debug, R: Debug>(result: Result<(T, R)>, stopped: fn(&R) -> Stopped) -> Result<String> {
    let (points, report) = result?;
    if stopped(&report) == Stopped::Cancelled { Err(Error::Cancelled) } else { said(Ok((points, report))) }
}

const fn moved(x: f64) -> Instance {
    Instance { prototype: 0, transform: [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] }
}

/// The mesh twice, which overlaps itself.
const TWICE: [Instance; 2] = [moved(0.0), moved(0.3)];

const UNIT: Domain = Domain { min: [0.0; 2], max: [1.0; 2], boundary: Boundary::Bounded };
const TORUS: Domain = Domain { boundary: Boundary::Periodic, ..UNIT };
const CUBE: Domain<3> = Domain { min: [0.0; 3], max: [1.0; 3], boundary: Boundary::Bounded };
const SWAPPED: Domain = Domain { min: [1.0; 2], max: [0.0; 2], boundary: Boundary::Bounded };
const OUTSIDE: [[f32; 2]; 2] = [[0.5; 2], [1.5, 0.5]];

static POINTS: LazyLock<Vec<[f32; 2]>> = LazyLock::new(|| random_points(3000, 1));
static IN_CUBE: LazyLock<Vec<[f32; 3]>> = LazyLock::new(|| {
    let points = random_points(1500, 2);
    std::iter::zip(&points, points.iter().rev()).map(|(&[x, y], &[z, _])| [x, y, z]).collect()
});
/// A set for the left half of the unit square.
static PIECE: LazyLock<Vec<[f32; 2]>> = LazyLock::new(|| {
    let options = maximal::Options::new(0.003).domain(Domain { max: [0.5, 1.0], ..UNIT });
    maximal::sample(&Context::new(1).unwrap(), &options, None).unwrap().positions
});
static MESH: LazyLock<Arc<Mesh>> = LazyLock::new(|| mesh(meshes::fine_torus(60, 30)));
static SHEET: LazyLock<Arc<Mesh>> = LazyLock::new(|| mesh(meshes::plane()));
static SOLID: LazyLock<Arc<Mesh>> = LazyLock::new(|| mesh(meshes::welded(meshes::fine_torus(60, 30))));
static IN_SOLID: LazyLock<Vec<[f32; 3]>> = LazyLock::new(|| {
    let options = volume::InsideOptions::by_count(1500);
    volume::sample_inside(&Context::new(1).unwrap(), &SOLID, &options, None).unwrap().0.positions
});
static RADII: LazyLock<Vec<f32>> = LazyLock::new(|| MESH.positions().iter().map(|[x, ..]| 0.07 + 0.03 * x).collect());
static CLASSES: LazyLock<Classes> = LazyLock::new(|| Classes::of_radii(&[0.06, 0.03], 1.0).unwrap());
static MULTIPLES: LazyLock<Classes> = LazyLock::new(|| Classes::of_radii(&[1.0, 0.5], 1.0).unwrap());
/// Samples of the mesh.
static ON_MESH: LazyLock<Points<3>> =
    LazyLock::new(|| psp::sample(&Context::new(1).unwrap(), &MESH, &psp::Options::new(0.08), None).unwrap().0);

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// A ramp from left to right.
fn ramp([x, _]: [f64; 2]) -> f64 {
    1.0 + 3.0 * x
}

const RAMP: dcr::Density = dcr::Density::Function(&ramp);
const NOTHING: dcr::Density = dcr::Density::Function(&|_| 0.0);

/// A plane with all samples near some given ones left out.
fn around(kind: kdrt::Kind<'static>) -> kdrt::Options<'static> {
    kdrt::Options::of(kind).domain(UNIT).given(Given::at(&[[0.5; 2], [0.1, 0.9]]))
}

fn progressive(radius: f64) -> kdrt::Options<'static> {
    kdrt::Options::progressive(radius, Progressive::new()).domain(TORUS)
}

fn stream(options: &kdrt::Options, context: &Context, progress: Option<&Progress>) -> Result<String> {
    let (plane, mut parts) = (Plane::new(context, options, None)?, Vec::new());
    let caller = thread::current().id();
    let visit = |samples: &[[f32; 2]]| {
        assert_eq!(thread::current().id(), caller);
        parts.push(samples.to_vec());
        ControlFlow::Continue(())
    };
    plane.stream(context, visit, progress)?;
    said(Ok(parts))
}

fn delaunay() -> DelaunayOptions {
    DelaunayOptions::new(UNIT).max_iterations(12)
}

fn correlation() -> CorrelationOptions {
    CorrelationOptions::new(TORUS).max_iterations(4)
}

fn classes_of_points() -> Vec<u32> {
    (0..POINTS.len() as u32).map(|i| i % 3).collect()
}

fn surface_relaxed(options: &dcr::surface::Options, context: &Context, progress: Option<&Progress>) -> Result<String> {
    let set = dcr::surface::relax(context, &MESH, &ON_MESH.triangles, &ON_MESH.barycentrics, options, progress);
    relaxed(set, |report| report.stopped)
}

fn surface_relaxed_to(density: &[f32], context: &Context, progress: Option<&Progress>) -> Result<String> {
    let (density, options) =
        (psp::adaptive::Density::PerVertex(density), dcr::surface::Options::default().max_iterations(8));
    let (triangles, barycentrics) = (&ON_MESH.triangles, &ON_MESH.barycentrics);
    let set = dcr::surface::relax_with_density(context, &MESH, triangles, barycentrics, density, &options, progress);
    relaxed(set, |report| report.stopped)
}

const PLANE: &[Call] = &[
    Call {
        name: "kdrt::sample",
        reports: 5,
        run: |c, p| said(kdrt::sample(c, &kdrt::Options::new(0.002).domain(TORUS), p)),
        refused: &[
            ("radius: ", |c, p| said(kdrt::sample(c, &kdrt::Options::new(0.0), p))),
            ("radius: ", |c, p| said(kdrt::sample(c, &kdrt::Options::new(f64::NAN), p))),
            ("leaf_size: ", |c, p| said(kdrt::sample(c, &kdrt::Options::new(0.01).leaf_size(5.9), p))),
            ("domain_max: ", |c, p| said(kdrt::sample(c, &kdrt::Options::new(0.01).domain(SWAPPED), p))),
            ("quotient: ", |c, p| {
                said(kdrt::sample(c, &kdrt::Options::progressive(0.01, Progressive::new().quotient(1.0)), p))
            }),
        ],
    },
    Call {
        name: "kdrt::sample",
        reports: 2,
        run: |c, p| said(kdrt::sample(c, &around(kdrt::Kind::Plain(0.03)), p)),
        refused: &[("given_clearances: [0] is -1.0", |c, p| {
            let given = Given::with_clearances(&[[0.5; 2]], &[-1.0]);
            said(kdrt::sample(c, &kdrt::Options::new(0.01).given(given), p))
        })],
    },
    Call {
        name: "kdrt::sample",
        reports: 20,
        run: |c, p| said(kdrt::sample(c, &progressive(0.008), p)),
        refused: &[("radius: ", |c, p| said(kdrt::sample(c, &progressive(-1.0), p)))],
    },
    Call {
        name: "kdrt::sample",
        reports: 10,
        run: |c, p| said(kdrt::sample(c, &around(kdrt::Kind::Classes(&CLASSES)), p)),
        refused: &[("radii: ", |c, p| {
            let far = Domain { min: [1e9; 2], max: [1e9 + 1e4; 2], boundary: Boundary::Bounded };
            said(kdrt::sample(c, &kdrt::Options::classes(&CLASSES).domain(far), p))
        })],
    },
    Call {
        name: "kdrt::sample_window",
        reports: 5,
        run: |c, p| said(kdrt::sample_window(c, &kdrt::Options::new(0.002), [0.1, 0.2], [0.9, 0.97], p)),
        refused: &[
            ("window_max: ", |c, p| said(kdrt::sample_window(c, &kdrt::Options::new(0.01), [0.5; 2], [0.4, 0.6], p))),
            ("window_min: ", |c, p| said(kdrt::sample_window(c, &kdrt::Options::new(0.01), [-0.1; 2], [0.4; 2], p))),
        ],
    },
    Call {
        name: "kdrt::Plane::new",
        reports: 3,
        run: |c, p| {
            let plane = Plane::new(c, &kdrt::Options::new(0.002).domain(TORUS), p)?;
            said(plane.window([0.3; 2], [0.4; 2]))
        },
        refused: &[("leaf_size: ", |c, p| {
            Plane::new(c, &kdrt::Options::new(0.01).leaf_size(f64::NAN), p).map(|_| String::new())
        })],
    },
    Call {
        name: "kdrt::Plane::new",
        reports: 3,
        run: |c, p| said(Plane::new(c, &around(kdrt::Kind::Plain(0.01)), p)?.window([0.3; 2], [0.6; 2])),
        refused: &[],
    },
    Call {
        name: "kdrt::Plane::wide",
        reports: 3,
        run: |c, p| said(Plane::wide(c, &kdrt::Options::new(0.002), p)?.relative_window([-9.1; 2], [-9.0; 2])),
        refused: &[
            ("order: ", |c, p| Plane::wide(c, &progressive(0.002), p).map(|_| String::new())),
            ("classes: ", |c, p| Plane::wide(c, &kdrt::Options::classes(&CLASSES), p).map(|_| String::new())),
            ("domain_max: ", |c, p| Plane::wide(c, &kdrt::Options::new(0.2), p).map(|_| String::new())),
        ],
    },
    Call {
        name: "kdrt::Plane::whole",
        reports: 5,
        run: |c, p| said(Plane::new(c, &kdrt::Options::new(0.002).domain(TORUS), None)?.whole(c, p)),
        refused: &[("radius: ", |c, p| {
            said(Plane::new(c, &kdrt::Options::new(3e-6).domain(TORUS), None)?.whole(c, p))
        })],
    },
    Call {
        name: "kdrt::Plane::stream",
        reports: 5,
        run: |c, p| stream(&kdrt::Options::new(0.0011).domain(TORUS), c, p),
        refused: &[
            ("order: ", |c, p| stream(&progressive(0.02), c, p)),
            ("classes: ", |c, p| stream(&kdrt::Options::classes(&CLASSES), c, p)),
        ],
    },
    Call {
        name: "kdrt::EditableSet::sample",
        reports: 3,
        run: |c, p| said(kdrt::EditableSet::sample(c, &kdrt::Options::new(0.003), p).map(|set| set.samples())),
        refused: &[
            ("order: ", |c, p| kdrt::EditableSet::sample(c, &progressive(0.02), p).map(|_| String::new())),
            ("classes: ", |c, p| {
                kdrt::EditableSet::sample(c, &kdrt::Options::classes(&CLASSES), p).map(|_| String::new())
            }),
        ],
    },
    Call {
        name: "editable::EditableSet::refill",
        reports: 3,
        run: |c, p| {
            let mut set = kdrt::EditableSet::sample(c, &kdrt::Options::new(0.003), None)?;
            set.erase(&Region::ball([0.9, 0.1, 0.0], 0.2))?;
            said(set.refill(c, 7, p))
        },
        refused: &[],
    },
    Call {
        name: "kdrt::sample_count",
        reports: 5,
        run: |c, p| said(kdrt::sample_count(c, &CountOptions::new(60_000), p)),
        refused: &[("count: ", |c, p| said(kdrt::sample_count(c, &CountOptions::new(0), p)))],
    },
    Call {
        name: "kdrt::sample_count",
        reports: 20,
        run: |c, p| said(kdrt::sample_count(c, &CountOptions::new(9000).levels(Some(Progressive::new())), p)),
        refused: &[("quotient: ", |c, p| {
            let levels = Progressive::new().quotient(2.0);
            said(kdrt::sample_count(c, &CountOptions::new(9000).levels(Some(levels)), p))
        })],
    },
    Call {
        name: "kdrt::merge",
        reports: 10,
        run: |c, p| {
            let piece = Piece { samples: &PIECE, min: [0.0; 2], max: [0.5, 1.0] };
            said(kdrt::merge(c, &MergeOptions::new(0.003).domain(UNIT), &[piece], &[[0.5; 2]], p))
        },
        refused: &[
            ("fixed: point 1 ", |c, p| said(kdrt::merge(c, &MergeOptions::new(0.003).domain(UNIT), &[], &OUTSIDE, p))),
            ("radius: ", |c, p| said(kdrt::merge(c, &MergeOptions::new(-0.003), &[], &[], p))),
        ],
    },
    Call {
        name: "maximal::sample",
        reports: 10,
        run: |c, p| said(maximal::sample(c, &maximal::Options::new(0.003).domain(UNIT), p)),
        refused: &[
            ("radius: ", |c, p| said(maximal::sample(c, &maximal::Options::new(f64::INFINITY), p))),
            ("domain_max: ", |c, p| said(maximal::sample(c, &maximal::Options::new(0.1).domain(SWAPPED), p))),
        ],
    },
    Call {
        name: "mask::create",
        reports: 4,
        run: |c, p| samples(mask::create(c, &mask::Options::new(70, 66).channels(3), p)),
        refused: &[
            ("width: 1 ", |c, p| samples(mask::create(c, &mask::Options::new(1, 64), p))),
            ("height: 1025 ", |c, p| samples(mask::create(c, &mask::Options::new(2, 1025), p))),
            ("width: 65 ", |c, p| samples(mask::create(c, &mask::Options::new(65, 64).depth(2), p))),
            ("depth: 0 ", |c, p| samples(mask::create(c, &mask::Options::new(8, 8).depth(0), p))),
            ("channels: 0 ", |c, p| samples(mask::create(c, &mask::Options::new(8, 8).channels(0), p))),
            ("sigma: NaN ", |c, p| samples(mask::create(c, &mask::Options::new(8, 8).sigma(f64::NAN), p))),
            ("sigma: inf ", |c, p| samples(mask::create(c, &mask::Options::new(8, 8).sigma(f64::INFINITY), p))),
        ],
    },
    Call {
        name: "thin::thin",
        reports: 5,
        run: |c, p| said(thin(c, &thin::Options::by_radius(0.02), &POINTS, p)),
        refused: &[
            ("positions: point 1 ", |c, p| {
                said(thin(c, &thin::Options::by_radius(0.02), &[[0.0; 3], [0.0, f32::NAN, 0.0]], p))
            }),
            ("radius: ", |c, p| said(thin(c, &thin::Options::by_radius(-0.02), &POINTS, p))),
        ],
    },
    Call {
        name: "thin::thin",
        reports: 5,
        run: |c, p| said(thin(c, &thin::Options::by_count(900), &POINTS, p)),
        refused: &[],
    },
    Call {
        name: "thin::thin",
        reports: 5,
        run: |c, p| said(thin(c, &thin::Options::progressive(), &POINTS, p)),
        refused: &[("positions: ", |c, p| said(thin(c, &thin::Options::progressive(), &[[f32::INFINITY; 2]], p)))],
    },
];

const SURFACE: &[Call] = &[
    Call {
        name: "psp::sample",
        reports: 10,
        run: |c, p| samples(psp::sample(c, &MESH, &psp::Options::new(0.03), p)),
        refused: &[
            ("radius: ", |c, p| samples(psp::sample(c, &MESH, &psp::Options::new(0.0), p))),
            ("radius: ", |c, p| samples(psp::sample(c, &MESH, &psp::Options::new(1e-9), p))),
            ("cosine: ", |c, p| samples(psp::sample(c, &MESH, &psp::Options::new(0.1).cosine(1.5), p))),
        ],
    },
    Call {
        name: "psp::sample",
        reports: 10,
        run: |c, p| samples(psp::sample(c, &MESH, &psp::Options::by_count(3000), p)),
        refused: &[("count: ", |c, p| samples(psp::sample(c, &MESH, &psp::Options::by_count(0), p)))],
    },
    Call {
        name: "psp::sample",
        reports: 10,
        run: |c, p| samples(psp::sample(c, &MESH, &psp::Options::new(0.05).order(Order::Progressive), p)),
        refused: &[("quotient: ", |c, p| {
            samples(psp::sample(c, &MESH, &psp::Options::new(0.05).order(Order::Progressive).quotient(2.0), p))
        })],
    },
    Call {
        name: "psp::project",
        reports: 10,
        run: |c, p| samples(psp::project(c, &MESH, &rasterised(), 2, true, p)),
        refused: &[("radius: ", |c, p| samples(psp::project(c, &MESH, &ProjectionOptions::new(-1.0), 2, true, p)))],
    },
    Call {
        name: "psp::Psp::advance",
        reports: 5,
        run: |c, p| {
            let mut psp = Psp::new(&MESH, &rasterised())?;
            psp.advance(c, 1, p)?;
            said(Ok(psp.samples()))
        },
        refused: &[("cosine: ", |c, p| {
            Psp::new(&MESH, &rasterised().cosine(0.5))?.advance(c, 1, p).map(|_| String::new())
        })],
    },
    Call {
        name: "psp::Psp::fill",
        reports: 10,
        run: |c, p| {
            let mut psp = Psp::new(&MESH, &rasterised())?;
            psp.fill(c, p)?;
            said(Ok(psp.samples()))
        },
        refused: &[],
    },
    Call {
        name: "psp::FlatOptions::sample",
        reports: 10,
        run: |c, p| samples(FlatOptions::new(0.05).sample(c, &MESH, p)),
        refused: &[("iterations: ", |c, p| {
            samples(FlatOptions::new(0.05).iterations(Some(1)).order(Order::Progressive).sample(c, &MESH, p))
        })],
    },
    Call {
        name: "editable::EditableSet::refill",
        reports: 3,
        run: |c, p| {
            let mut psp = Psp::new(&MESH, &ProjectionOptions::new(0.05))?;
            psp.fill(c, None)?;
            let mut set = psp.into_editable();
            set.erase(&Region::ball([1.0, 0.0, 0.0], 0.5))?;
            samples(set.refill(c, 7, p))
        },
        refused: &[],
    },
    Call {
        name: "psp::sample_region",
        reports: 3,
        run: |c, p| {
            let region = Region::ball([1.0, 0.0, 0.0], 0.5);
            samples(psp::sample_region(c, &MESH, &region, &RegionOptions::new(0.05), p))
        },
        refused: &[("radius: ", |c, p| {
            samples(psp::sample_region(c, &MESH, &Region::EVERYWHERE, &RegionOptions::new(0.0), p))
        })],
    },
    Call {
        name: "psp::instances::sample_instances",
        reports: 4,
        run: |c, p| samples(psp::sample_instances(c, slice::from_ref(&MESH), &TWICE, &InstanceOptions::new(0.05), p)),
        refused: &[("instances: [0]: ", |c, p| {
            samples(psp::sample_instances(c, &[], &TWICE, &InstanceOptions::new(0.05), p))
        })],
    },
    Call {
        name: "psp::classes::sample_classes",
        reports: 10,
        run: |c, p| samples(psp::sample_classes(c, &MESH, &ClassOptions::default(), &CLASSES, None, p)),
        refused: &[("mask_count: ", |c, p| {
            samples(psp::sample_classes(c, &MESH, &ClassOptions::default(), &CLASSES, Some(&[1]), p))
        })],
    },
    Call {
        name: "psp::classes::sample_classes",
        reports: 10,
        run: |c, p| samples(psp::sample_classes(c, &MESH, &multiples_of(&RADII), &MULTIPLES, None, p)),
        refused: &[("vertex_count: ", |c, p| {
            samples(psp::sample_classes(c, &MESH, &multiples_of(&[0.1; 4]), &MULTIPLES, None, p))
        })],
    },
    Call {
        name: "psp::adaptive::sample",
        reports: 10,
        run: |c, p| samples(adaptive::sample(c, &MESH, &by_vertex(&RADII), p)),
        refused: &[
            ("vertex_count: ", |c, p| samples(adaptive::sample(c, &MESH, &by_vertex(&[0.1; 4]), p))),
            ("cosine: ", |c, p| samples(adaptive::sample(c, &MESH, &by_vertex(&RADII).cosine(f64::NAN), p))),
        ],
    },
    Call {
        name: "psp::adaptive::sample",
        reports: 10,
        run: |c, p| samples(adaptive::sample(c, &MESH, &by_vertex(&RADII).order(Order::Progressive), p)),
        refused: &[],
    },
];

fn rasterised() -> ProjectionOptions<'static> {
    ProjectionOptions::new(0.05).engine(psp::Engine::Rasteriser)
}

fn multiples_of(radii: &[f32]) -> ClassOptions<'_> {
    ClassOptions::default().unit(Some(adaptive::Radius::PerVertex(radii)))
}

fn by_vertex(radii: &[f32]) -> adaptive::Options<'_> {
    adaptive::Options::new(adaptive::Radius::PerVertex(radii))
}

const RELAXATION: &[Call] = &[
    Call {
        name: "dcr::volume::relax",
        reports: 5,
        run: |c, p| {
            let options = dcr::volume::Options::new(CUBE).max_iterations(30);
            relaxed(dcr::volume::relax(c, &options, &IN_CUBE, p), |report| report.stopped)
        },
        refused: &[
            ("positions: ", |c, p| {
                said(dcr::volume::relax(c, &dcr::volume::Options::new(CUBE), &[[0.5, 1.5, 0.5]], p))
            }),
            ("tolerance: ", |c, p| {
                said(dcr::volume::relax(c, &dcr::volume::Options::new(CUBE).tolerance(-1.0), &IN_CUBE, p))
            }),
        ],
    },
    Call {
        name: "dcr::volume::relax_inside",
        reports: 5,
        run: |c, p| {
            let options = dcr::volume::InsideOptions::default().max_iterations(30);
            relaxed(dcr::volume::relax_inside(c, &SOLID, &options, &IN_SOLID, p), |report| report.stopped)
        },
        refused: &[
            ("positions: ", |c, p| {
                said(dcr::volume::relax_inside(c, &SOLID, &Default::default(), &[[0.5, 9.5, 0.5]], p))
            }),
            ("positions: ", |c, p| said(dcr::volume::relax_inside(c, &SHEET, &Default::default(), &[[0.5; 3]], p))),
            ("sliding: ", |c, p| {
                let options = dcr::volume::InsideOptions::default().sliding(&[true]);
                said(dcr::volume::relax_inside(c, &SOLID, &options, &IN_SOLID, p))
            }),
            ("fixed: ", |c, p| {
                let options = dcr::volume::InsideOptions::default().fixed(&[true]);
                said(dcr::volume::relax_inside(c, &SOLID, &options, &IN_SOLID, p))
            }),
        ],
    },
    Call {
        name: "dcr::relax",
        reports: 5,
        run: |c, p| relaxed(dcr::relax(c, &delaunay().into(), &POINTS, p), |report| report.stopped),
        refused: &[
            ("positions: ", |c, p| said(dcr::relax(c, &delaunay().into(), &OUTSIDE, p))),
            ("tolerance: ", |c, p| said(dcr::relax(c, &delaunay().tolerance(-1.0).into(), &POINTS, p))),
        ],
    },
    Call {
        name: "dcr::relax",
        reports: 5,
        run: |c, p| {
            let options = dcr::Options::thesis(TORUS, Neighbourhood::Nearest).max_iterations(5);
            relaxed(dcr::relax(c, &options, &POINTS, p), |report| report.stopped)
        },
        refused: &[],
    },
    Call {
        name: "dcr::relax_observed",
        reports: 5,
        run: |c, p| {
            let mut steps = 0;
            let mut observe = |_: &[[f32; 2]]| steps += 1;
            let options = dcr::Options::new(TORUS, Neighbourhood::Nearest).max_iterations(5);
            let set = dcr::relax_observed(c, &options, &POINTS, p, Some(&mut observe));
            Ok(relaxed(set, |report| report.stopped)? + &format!("{steps} steps"))
        },
        refused: &[("domain_max: ", |c, p| {
            said(dcr::relax_observed(c, &delaunay().domain(SWAPPED).into(), &POINTS, p, None))
        })],
    },
    Call {
        name: "dcr::uniform::relax_classes",
        reports: 5,
        run: |c, p| {
            let set = dcr::relax_classes(c, &delaunay(), &POINTS, &classes_of_points(), p);
            relaxed(set.map(|(points, report, each)| ((points, each), report)), |report| report.stopped)
        },
        refused: &[
            ("classes: ", |c, p| said(dcr::relax_classes(c, &delaunay(), &POINTS, &[0, 1], p))),
            ("classes: [1] is 16", |c, p| said(dcr::relax_classes(c, &delaunay(), &[[0.5; 2]; 2], &[0, 16], p))),
        ],
    },
    Call {
        name: "dcr::correlation::relax_to_correlation",
        reports: 5,
        run: |c, p| {
            let target = PairCorrelation::step(0.5).unwrap();
            let set = dcr::relax_to_correlation(c, &correlation(), &POINTS, &target, p);
            relaxed(set.map(|(points, report)| ((points, report.residual), report.set)), |report| report.stopped)
        },
        refused: &[
            ("boundary: ", |c, p| {
                let bounded = correlation().domain(Domain { boundary: Boundary::Bounded, ..TORUS });
                said(dcr::relax_to_correlation(c, &bounded, &POINTS, &PairCorrelation::step(0.5).unwrap(), p))
            }),
            ("positions: ", |c, p| {
                said(dcr::relax_to_correlation(c, &correlation(), &[[2.0; 2]], &PairCorrelation::step(0.5).unwrap(), p))
            }),
        ],
    },
    Call {
        name: "dcr::density::relax_with_density",
        reports: 5,
        run: |c, p| relaxed(dcr::relax_with_density(c, &delaunay(), &RAMP, &POINTS, p), |report| report.stopped),
        refused: &[("density: ", |c, p| said(dcr::relax_with_density(c, &delaunay(), &NOTHING, &POINTS, p)))],
    },
    Call {
        name: "dcr::density::scatter",
        reports: 3,
        run: |c, p| said(dcr::scatter(c, &UNIT, &RAMP, 20_000, 3, p)),
        refused: &[
            ("domain_max: ", |c, p| said(dcr::scatter(c, &SWAPPED, &RAMP, 20, 3, p))),
            ("width: ", |c, p| {
                said(dcr::scatter(c, &UNIT, &dcr::Density::Image { values: &[], width: 0, height: 3 }, 20, 3, p))
            }),
        ],
    },
    Call {
        name: "dcr::surface::relax",
        reports: 5,
        run: |c, p| surface_relaxed(&dcr::surface::Options::default().max_iterations(8), c, p),
        refused: &[
            ("tolerance: ", |c, p| surface_relaxed(&dcr::surface::Options::default().tolerance(f64::NAN), c, p)),
            ("barycentrics: ", |c, p| {
                said(dcr::surface::relax(c, &MESH, &[0], &[], &dcr::surface::Options::default(), p))
            }),
        ],
    },
    Call {
        name: "dcr::surface::relax_with_density",
        reports: 5,
        run: |c, p| surface_relaxed_to(&RADII, c, p),
        refused: &[
            ("density: ", |c, p| surface_relaxed_to(&vec![0.0; RADII.len()], c, p)),
            ("vertex_count: ", |c, p| surface_relaxed_to(&[], c, p)),
        ],
    },
    Call {
        name: "dcr::surface::remesh",
        reports: 3,
        run: |c, p| {
            let made = dcr::surface::remesh(c, &MESH, &ON_MESH.triangles, &ON_MESH.barycentrics, p);
            said(made.map(|(mesh, report)| (mesh.triangles().to_vec(), report)))
        },
        refused: &[("triangles: ", |c, p| {
            samples(dcr::surface::remesh(c, &MESH, &[u32::MAX], &[[0.2; 2]], p).map(|(_, report)| (report, ())))
        })],
    },
    Call {
        name: "dcr::surface::triangulate",
        reports: 3,
        run: |c, p| said(dcr::surface::triangulate(c, &MESH, &ON_MESH.triangles, &ON_MESH.barycentrics, p)),
        refused: &[("barycentrics: ", |c, p| said(dcr::surface::triangulate(c, &MESH, &[0], &[], p)))],
    },
];

const ANALYSIS: &[Call] = &[
    Call {
        name: "analysis::nearest_distances_2d",
        reports: 10,
        run: |c, p| said(nearest_distances_2d(c, &TORUS, &POINTS, p)),
        refused: &[("positions: ", |c, p| said(nearest_distances_2d(c, &TORUS, &OUTSIDE, p)))],
    },
    Call {
        name: "analysis::smallest_distance_2d",
        reports: 10,
        run: |c, p| said(smallest_distance_2d(c, &UNIT, &POINTS, p)),
        refused: &[("domain_max: ", |c, p| said(smallest_distance_2d(c, &SWAPPED, &POINTS, p)))],
    },
    Call {
        name: "analysis::rho",
        reports: 10,
        run: |c, p| said(rho(c, &UNIT, &POINTS, p)),
        refused: &[("positions: ", |c, p| said(rho(c, &UNIT, &OUTSIDE, p)))],
    },
    Call {
        name: "analysis::smallest_distance_3d",
        reports: 3,
        run: |c, p| said(smallest_distance_3d(c, MESH.positions(), p)),
        refused: &[("positions: ", |c, p| said(smallest_distance_3d(c, &[[f32::NAN; 3]], p)))],
    },
    Call {
        name: "analysis::bond_order",
        reports: 5,
        run: |c, p| said(bond_order(c, &TORUS, &POINTS, p)),
        refused: &[("positions: ", |c, p| said(bond_order(c, &TORUS, &OUTSIDE, p)))],
    },
    Call {
        name: "analysis::figures_2d",
        reports: 25,
        run: |c, p| said(figures_2d(c, &UNIT, &POINTS, p)),
        refused: &[("positions: ", |c, p| said(figures_2d(c, &UNIT, &OUTSIDE, p)))],
    },
    Call {
        name: "analysis::delaunay_triangles",
        reports: 5,
        run: |c, p| said(delaunay_triangles(c, &TORUS, &POINTS, p)),
        refused: &[("positions: ", |c, p| said(delaunay_triangles(c, &TORUS, &OUTSIDE, p)))],
    },
    Call {
        name: "analysis::triangle_statistics",
        reports: 5,
        run: |c, p| said(triangle_statistics(c, &UNIT, &POINTS, p)),
        refused: &[("domain_max: ", |c, p| said(triangle_statistics(c, &SWAPPED, &POINTS, p)))],
    },
    Call {
        name: "analysis::plane_differences",
        reports: 5,
        run: |c, p| said(plane_differences(c, &UNIT, &POINTS, p)),
        refused: &[("domain: ", |c, p| said(plane_differences(c, &UNIT, &POINTS[..50], p)))],
    },
    Call {
        name: "analysis::surface_differences",
        reports: 5,
        run: |c, p| said(surface_differences(c, &MESH, &ON_MESH.positions, &ON_MESH.normals, [1.0, 0.0, 0.0], 1, p)),
        refused: &[("direction: ", |c, p| {
            said(surface_differences(c, &MESH, &ON_MESH.positions, &ON_MESH.normals, [0.0; 3], 1, p))
        })],
    },
    Call {
        name: "analysis::coverage::coverage_2d",
        reports: 20,
        run: |c, p| said(coverage_2d(c, &TORUS, &POINTS, 0.03, p)),
        refused: &[("radius: ", |c, p| said(coverage_2d(c, &TORUS, &POINTS, -0.03, p)))],
    },
    Call {
        name: "analysis::coverage::covering_radius_2d",
        reports: 10,
        run: |c, p| said(covering_radius_2d(c, &UNIT, &POINTS, p)),
        refused: &[("positions: ", |c, p| said(covering_radius_2d(c, &UNIT, &OUTSIDE, p)))],
    },
    Call {
        name: "analysis::coverage::coverage_3d",
        reports: 20,
        run: |c, p| said(coverage_3d(c, &CUBE, &IN_CUBE, 0.12, p)),
        refused: &[("radius: ", |c, p| said(coverage_3d(c, &CUBE, &IN_CUBE, -0.05, p)))],
    },
    Call {
        name: "analysis::coverage::covering_radius_3d",
        reports: 10,
        run: |c, p| said(covering_radius_3d(c, &CUBE, &IN_CUBE, p)),
        refused: &[("positions: ", |c, p| said(covering_radius_3d(c, &CUBE, &[[1.0; 3]], p)))],
    },
    Call {
        name: "analysis::figures_3d",
        reports: 20,
        run: |c, p| said(figures_3d(c, &CUBE, &IN_CUBE, 0.1, p)),
        refused: &[
            ("positions: ", |c, p| said(figures_3d(c, &CUBE, &[[1.0; 3]], 0.1, p))),
            ("radius: ", |c, p| said(figures_3d(c, &CUBE, &IN_CUBE, -0.1, p))),
        ],
    },
    Call {
        name: "analysis::coverage::surface_covering_radius",
        reports: 50,
        run: |c, p| said(surface_covering_radius(c, &MESH, &ON_MESH.positions, p)),
        refused: &[("positions: ", |c, p| said(surface_covering_radius(c, &MESH, &[[f32::NAN; 3]], p)))],
    },
    Call {
        name: "analysis::coverage::surface_coverage",
        reports: 50,
        run: |c, p| said(surface_coverage(c, &MESH, &ON_MESH.positions, 0.1, p)),
        refused: &[("radius: ", |c, p| said(surface_coverage(c, &MESH, &ON_MESH.positions, f64::NAN, p)))],
    },
    Call {
        name: "analysis::coverage::surface_uncovered_fraction",
        reports: 5,
        run: |c, p| said(surface_uncovered_fraction(c, &MESH, &ON_MESH.positions, 0.07, 10_000, 1, p)),
        refused: &[("radius: ", |c, p| said(surface_uncovered_fraction(c, &MESH, &[], 0.0, 10, 1, p)))],
    },
    Call {
        name: "analysis::spectrum::periodogram",
        reports: 10,
        run: |c, p| said(periodogram(c, &UNIT, &POINTS, 100, p)),
        refused: &[("size: ", |c, p| said(periodogram(c, &UNIT, &POINTS, 1, p)))],
    },
    Call {
        name: "analysis::spectrum::sparse_periodogram",
        reports: 10,
        run: |c, p| said(sparse_periodogram(c, &TORUS, &POINTS, 64, 4, p)),
        refused: &[("frequency_stride: ", |c, p| said(sparse_periodogram(c, &TORUS, &POINTS, 64, 0, p)))],
    },
    Call {
        name: "analysis::spectrum::periodogram_3d",
        reports: 10,
        run: |c, p| said(periodogram_3d(c, &CUBE, &IN_CUBE, 1.5, 1, p)),
        refused: &[
            ("frequency_reach: ", |c, p| said(periodogram_3d(c, &CUBE, &IN_CUBE, 0.0, 1, p))),
            ("frequency_stride: ", |c, p| said(periodogram_3d(c, &CUBE, &IN_CUBE, 1.5, 0, p))),
        ],
    },
    Call {
        name: "analysis::spectrum::radial_power_3d",
        reports: 10,
        run: |c, p| said(radial_power_3d(c, &CUBE, &IN_CUBE, 1.5, 1, 0.1, p)),
        refused: &[("width: ", |c, p| said(radial_power_3d(c, &CUBE, &IN_CUBE, 1.5, 1, 0.0, p)))],
    },
    Call {
        name: "analysis::spectrum::axis_power",
        reports: 3,
        run: |c, p| said(axis_power(c, &CUBE, &IN_CUBE, 2, 100, p)),
        refused: &[
            ("axis: ", |c, p| said(axis_power(c, &CUBE, &IN_CUBE, 3, 100, p))),
            ("count: ", |c, p| said(axis_power(c, &CUBE, &IN_CUBE, 2, 0, p))),
        ],
    },
    Call {
        name: "analysis::radial_distribution_3d",
        reports: 3,
        run: |c, p| said(radial_distribution_3d(c, &CUBE, &IN_CUBE, 2.0, 50, p)),
        refused: &[("reach: ", |c, p| said(radial_distribution_3d(c, &CUBE, &IN_CUBE, 60.0, 50, p)))],
    },
    Call {
        name: "analysis::radial_distribution",
        reports: 10,
        run: |c, p| said(radial_distribution(c, &TORUS, &POINTS, 5.0, 50, p)),
        refused: &[("reach: ", |c, p| said(radial_distribution(c, &TORUS, &POINTS, 60.0, 50, p)))],
    },
];

/// The reports of a call to its callback, and their threads.
type Reports = Vec<(f64, ThreadId)>;

/// A run that is watched to its end.
fn watched(run: Run, context: &Context) -> (Result<String>, Reports) {
    let told: RefCell<Reports> = RefCell::default();
    let tell = |share| {
        told.borrow_mut().push((share, thread::current().id()));
        ControlFlow::Continue(())
    };
    (run(context, Some(&tell)), told.into_inner())
}

/// Cancels a run at a certain call of its callback, which is the last one then.
fn stops_at<T: Debug>(name: &str, at: usize, run: impl FnOnce(&Progress) -> Result<T>) {
    let calls = Cell::new(0);
    let stop = |_| {
        calls.set(calls.get() + 1);
        if calls.get() == at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let stopped = run(&stop);
    assert!(matches!(stopped, Err(Error::Cancelled)), "{name}, cancelled at call {at}: {stopped:?}");
    assert_eq!(calls.get(), at, "{name} reports after it was cancelled");
}

fn check(calls: &[Call]) {
    for &Call { name, reports, run, .. } in calls {
        let (expected, cold) = watched(run, &Context::new(1).unwrap());
        let expected = expected.unwrap();
        // Where the context keeps what was made, there may be hardly any work left.
        assert!(cold.len() >= reports, "{name} reports {} times", cold.len());
        for threads in [1, 3] {
            let context = Context::new(threads).unwrap();
            // Also makes what the context keeps, so that all calls below report as often.
            assert!(run(&context, None).unwrap() == expected, "{name} depends on the number of threads");
            let (found, told) = watched(run, &context);
            assert!(found.unwrap() == expected, "{name} depends on its callback");
            assert!(told.iter().all(|&(_, id)| id == thread::current().id()), "{name} reports on another thread");
            assert!(told.windows(2).all(|pair| pair[0].0 <= pair[1].0), "{name}: {told:?}");
            assert_eq!((told[0].0, told[told.len() - 1].0), (0.0, 1.0), "{name}");
            let mut limits = vec![1, 2];
            if threads == 1 {
                // At six calls from the first to the last.
                limits = (0..6).map(|i| 1 + i * (told.len() - 1) / 5).collect();
                limits.dedup();
            }
            for at in limits {
                stops_at(name, at, |progress| run(&context, Some(progress)));
            }
        }
    }
}

#[test]
fn calls_of_the_plane_are_watched_and_cancelled() {
    check(PLANE);
}

#[test]
fn calls_of_meshes_are_watched_and_cancelled() {
    check(SURFACE);
}

#[test]
fn calls_of_volumes_are_watched_and_cancelled() {
    check(VOLUME);
}

#[test]
fn relaxations_are_watched_and_cancelled() {
    check(RELAXATION);
}

#[test]
fn calls_of_the_analysis_are_watched_and_cancelled() {
    check(ANALYSIS);
}

fn all() -> impl Iterator<Item = &'static Call> {
    [PLANE, SURFACE, VOLUME, RELAXATION, ANALYSIS].into_iter().flatten()
}

#[test]
fn wrong_arguments_are_refused_by_name_before_any_work() {
    let mut faults = Vec::new();
    for threads in [1, 3] {
        let context = Context::new(threads).unwrap();
        for (call, &(expected, run)) in all().flat_map(|call| call.refused.iter().map(move |refused| (call, refused))) {
            let (refused, told) = watched(run, &context);
            let Err(error) = refused else {
                faults.push(format!("{}, {expected:?}: not refused", call.name));
                continue;
            };
            let is_refusal = matches!(error, Error::InvalidArgument { .. } | Error::TooLarge { .. });
            if !is_refusal || !error.to_string().starts_with(expected) || !told.is_empty() {
                faults.push(format!("{}, {expected:?}: {error}, after {} reports", call.name, told.len()));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// A panic of a callback passes through every call, and the context can be used on.
#[test]
fn a_panic_of_a_callback_is_handed_on() {
    for threads in [1, 3] {
        let context = Context::new(threads).unwrap();
        for &Call { name, run, .. } in all() {
            let panic = |share: f64| {
                // Without the report of the hook.
                if share > 0.0 { std::panic::resume_unwind(Box::new(share)) } else { ControlFlow::Continue(()) }
            };
            let call = std::panic::AssertUnwindSafe(|| run(&context, Some(&panic)));
            let caught: Box<dyn Any + Send> = std::panic::catch_unwind(call).expect_err(name);
            assert!(caught.is::<f64>(), "{name}: another panic");
        }
    }
}

#[test]
fn probes_without_end_take_no_memory_and_can_be_cancelled() {
    for threads in [1, 3] {
        let context = Context::new(threads).unwrap();
        stops_at("probes", 20, |progress| {
            surface_uncovered_fraction(&context, &MESH, MESH.positions(), 0.1, u64::MAX, 1, Some(progress))
        });
    }
}

/// Functions with a progress callback that other files of the crate share.
const INTERNAL: &[&str] = &[
    "dcr::run",
    "dcr::relax_set",
    "dcr::surface::found_corners",
    "dcr::surface::relaxed",
    "volume::adaptive::complete",
];

/// The public functions of a source with a progress callback: folder, type and name.
fn long_calls(folder: &str, source: &str) -> Vec<String> {
    let (mut calls, mut of_type, mut name) = (Vec::new(), String::new(), None);
    for line in source.lines() {
        if line == "}" {
            of_type.clear();
        }
        if let Some(rest) = line.strip_prefix("impl") {
            let rest = if rest.starts_with('<') { rest.split_once("> ").unwrap().1 } else { &rest[1..] };
            of_type = rest.split(|c: char| !c.is_alphanumeric()).next().unwrap().to_owned() + "::";
        }
        if let Some((_, rest)) = line.split_once("pub fn ") {
            name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next();
        } else if line.contains("fn ") {
            name = None;
        }
        if line.contains("progress: Option<&Progress>")
            && let Some(name) = name.take()
        {
            calls.push(format!("{folder}::{of_type}{name}"));
        }
    }
    calls
}

#[test]
fn the_table_has_every_long_call() {
    fn collect(folder: &Path, root: &Path, calls: &mut BTreeSet<String>) {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                collect(&path, root, calls);
                continue;
            }
            let inside = if folder == root { path.with_extension("") } else { folder.to_owned() };
            let inside = inside.strip_prefix(root).unwrap().to_str().unwrap().replace(['/', '\\'], "::");
            calls.extend(long_calls(&inside, &fs::read_to_string(path).unwrap()));
        }
    }
    let (root, mut calls) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), BTreeSet::new());
    collect(&root, &root, &mut calls);
    let known: BTreeSet<_> = all().map(|call| call.name).chain(INTERNAL.iter().copied()).map(String::from).collect();
    assert_eq!(calls, known);
}
