//! Findings of fuzzing (scripts/fuzz.sh): input that took memory or time without end, each as small as can be.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use azulejo::analysis::coverage::{covering_radius_2d, surface_coverage};
use azulejo::analysis::triangles::triangle_statistics;
use azulejo::dcr::{self, Density, surface};
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Options, Radius};
use azulejo::{Boundary, Context, Domain, Error};

/// The number of samples was estimated on pieces as small as a needle's area, which was 10^17 of them.
#[test]
fn samples_of_a_needle_are_estimated_on_few_pieces() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1e-30, 0.0]], vec![[0, 1, 2]]).unwrap();
    let options = Options::new(Radius::PerVertex(&[0.01; 3]));
    let (set, _) = adaptive::sample(&Context::new(1).unwrap(), &mesh, &options, None).unwrap();
    assert!((50..=101).contains(&set.len()), "{} samples on a line of 100 radii", set.len());
}

/// Cells as thin as the domain were halved along both sides, until they were a billion along the short one.
#[test]
fn the_covering_radius_of_a_corner_of_a_thin_domain() {
    for boundary in [Boundary::Bounded, Boundary::Periodic] {
        let domain = Domain { min: [-0.8125, 1.4375], max: [-0.79407, 163.0808], boundary };
        let [width, height] = domain.extent();
        let farthest = if boundary == Boundary::Bounded { 1.0 } else { 0.5 } * width.hypot(height);
        let found = covering_radius_2d(&Context::new(1).unwrap(), &domain, &[[-0.8125, 1.4375]], None).unwrap();
        assert!((found / farthest - 1.0).abs() < 1e-8, "{found} instead of {farthest}");
    }
}

/// Where doubles are 16 apart cells kept their centre, and were divided into all that memory holds.
#[test]
fn the_covering_radius_where_doubles_are_coarse() {
    for boundary in [Boundary::Bounded, Boundary::Periodic] {
        let domain = Domain { min: [0.0625, -8.766626110583603e16], max: [0.08578724, -8.7666261105836e16], boundary };
        let points = [[0.08051123, -8.766626e16], [0.0625, -8.766626e16], [0.07068692, -8.766626e16]];
        let context = Context::new(1).unwrap();
        let found = covering_radius_2d(&context, &domain, &points, None).unwrap();
        assert!(found <= domain.extent()[1] + 16.0, "{found} in {domain:?}");
    }
}

/// Spade has a largest coordinate; a triangulation panicked beyond it.
#[test]
fn a_domain_that_is_a_line_for_all_floats_is_refused() {
    let context = Context::new(1).unwrap();
    for thin in [1e-279, 1e-32] {
        let domain = Domain { min: [0.0; 2], max: [thin, 1.0], boundary: Boundary::Periodic };
        let refused = triangle_statistics(&context, &domain, &[[0.0, 0.5]], None);
        assert!(matches!(refused, Err(Error::InvalidArgument { argument: "domain_max", .. })));
    }
    // Nor may the area be 0.
    let domain = Domain { min: [0.0; 2], max: [1e-200; 2], boundary: Boundary::Bounded };
    let refused = triangle_statistics(&context, &domain, &[[0.0; 2]; 3], None);
    assert!(matches!(refused, Err(Error::InvalidArgument { argument: "domain_max", .. })));
    let domain = Domain { min: [0.0; 2], max: [1e-29, 1.0], boundary: Boundary::Periodic };
    assert!(triangle_statistics(&context, &domain, &[[0.0, 0.5]], None).is_ok());
}

/// Results of functions that are not what their callers say of them, on one thread and on three.
fn refused(mesh: &Mesh, radius: Radius) -> String {
    let sample = |threads| adaptive::sample(&Context::new(threads).unwrap(), mesh, &Options::new(radius), None);
    let [said, again] = [1, 3].map(|threads| sample(threads).unwrap_err().to_string());
    assert_eq!(said, again, "depends on the number of threads");
    said
}

fn square() -> Mesh {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    Mesh::new(positions, vec![[0, 1, 2], [2, 1, 3]]).unwrap()
}

/// Bounds of a steep radius say next to nothing: patches were cut up to the last float, a billion of them for each sample.
#[test]
fn a_slope_that_nothing_can_be_proved_with_is_refused() {
    let radius = Radius::Function { at: &|_| 0.4, smallest: 0.04, largest: 0.8, slope: 5000.0 };
    let said = refused(&square(), radius);
    assert!(said.starts_with("slope: 5000.0: radii of this slope"), "{said}");
}

/// A radius that is steeper than is said is found out before more than a few samples are made of it, and always in the
/// same place.
#[test]
fn a_function_that_is_steeper_than_its_slope_is_refused() {
    let steep = |[x, ..]: [f64; 3]| (0.02 + (4.0 * (x - 0.3).abs()).min(0.02)).min(0.04);
    let noise = |[x, y, _]: [f64; 3]| 0.02 + 0.02 * (1e5 * (x + 2.0 * y)).sin().abs();
    let step = |[x, ..]: [f64; 3]| if x < 0.4142 { 0.02 } else { 0.04 };
    let functions: [&(dyn Fn([f64; 3]) -> f64 + Sync); 3] = [&steep, &noise, &step];
    for at in functions {
        for slope in [0.0, 1e-3, 0.25, 1.0] {
            let calls = AtomicU64::new(0);
            let at = |position: [f64; 3]| {
                calls.fetch_add(1, Ordering::Relaxed);
                at(position)
            };
            let said = refused(&square(), Radius::Function { at: &at, smallest: 0.02, largest: 0.04, slope });
            assert!(said.starts_with("radius_function: 0.0") && said.contains("slope"), "{said}");
            assert!(calls.load(Ordering::Relaxed) < 400_000, "{calls:?} calls");
        }
    }
}

/// Radii that fall when the samples have been estimated: no memory would hold their pieces.
#[test]
fn a_function_that_changes_its_mind_does_not_get_all_memory() {
    let is_small = AtomicBool::new(false);
    let at = |_: [f64; 3]| if is_small.load(Ordering::Relaxed) { 1e-5 } else { 1.0 };
    let radius = Radius::Function { at: &at, smallest: 1e-5, largest: 1.0, slope: 0.0 };
    let watch = |done: f64| {
        is_small.store(done > 0.04, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let refused = adaptive::sample(&Context::new(1).unwrap(), &square(), &Options::new(radius), Some(&watch));
    let refused = refused.map(|(set, _)| set.radii.len());
    assert!(matches!(refused, Err(Error::TooLarge { argument: "radius_function", .. })), "{refused:?}");
}

/// The estimate was made on a hundred thousand pieces and more, of a surface that holds a few samples.
#[test]
fn few_samples_are_estimated_on_few_pieces() {
    let calls = AtomicU64::new(0);
    let at = |_: [f64; 3]| {
        calls.fetch_add(1, Ordering::Relaxed);
        0.25
    };
    let radius = Radius::Function { at: &at, smallest: 0.25, largest: 0.25, slope: 0.0 };
    let (set, _) = adaptive::sample(&Context::new(1).unwrap(), &square(), &Options::new(radius), None).unwrap();
    assert!(set.radii.len() > 8 && calls.load(Ordering::Relaxed) < 5000, "{calls:?} calls");
}

/// Uncovered fragments were compared in pairs: an hour for a hundred thousand triangles in one place, minutes for what
/// three triangles were cut into.
#[test]
fn many_uncovered_triangles_in_one_place_are_one_gap() {
    let corners = |i: u32| {
        let x = i as f32 * 1e-6;
        [[x, 0.0, 0.0], [x + 0.01, 0.0, 0.0], [x, 0.01, 0.0]]
    };
    let near = (0..100_000).flat_map(corners);
    let far = [[3.0, 0.0, 0.0], [3.01, 0.0, 0.0], [3.0, 0.01, 0.0]];
    let positions: Vec<_> = near.chain(far).collect();
    let triangles = (0..positions.len() as u32).collect::<Vec<_>>().as_chunks::<3>().0.to_vec();
    let mesh = Mesh::new(positions, triangles).unwrap();
    let coverage = surface_coverage(&Context::new(1).unwrap(), &mesh, &[[50.0, 0.0, 0.0]], 1.0, None).unwrap();
    assert_eq!(coverage.gaps, 2);
}

/// A raster of a hundred cells for each point was made before it was known whether memory holds it.
#[test]
fn more_points_of_a_density_than_memory_holds_are_refused() {
    let context = Context::new(1).unwrap();
    let density = Density::Image { values: &[1.0], width: 1, height: 1 };
    let domain = Domain::unit(Boundary::Bounded);
    let refused = dcr::scatter(&context, &domain, &density, u32::MAX as usize, 0, None).map(|points| points.len());
    assert!(matches!(refused, Err(Error::TooLarge { argument: "count", .. })), "{refused:?}");
}

/// The chain of fragments of a needle was followed for minutes before there were too many.
#[test]
fn a_needle_of_a_billion_radii_is_refused_at_once() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1e-20, 0.0]], vec![[0, 1, 2]]).unwrap();
    let refused = surface_coverage(&Context::new(1).unwrap(), &mesh, &[[2.0, 0.0, 0.0]], 1e-9, None);
    assert!(matches!(refused, Err(Error::TooLarge { argument: "radius", .. })), "{refused:?}");
}

/// Samples that rounding had put outside their triangle came back as they were where no step was made.
#[test]
fn samples_are_returned_on_their_triangles_without_a_step_too() {
    let outside = [0.5294118f32, 0.47058824];
    let options = surface::Options::default().max_iterations(0);
    let context = Context::new(1).unwrap();
    let (samples, _) = surface::relax(&context, &square(), &[0, 1], &[outside, [0.25, 0.5]], &options, None).unwrap();
    let [[u, v], same] = samples.barycentrics[..] else { panic!("{samples:?}") };
    assert!(f64::from(u) + f64::from(v) <= 1.0 && (u - outside[0]).abs() < 1e-7 && v == outside[1], "{u} {v}");
    assert_eq!(same, [0.25, 0.5]);
}
