//! What fuzzing found (scripts/fuzz.sh): input that took memory or time without end, each as small as can be.

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::triangles::triangle_statistics;
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Options, Radius};
use azulejo::{Boundary, Context, Domain, Error};

/// The number of samples was estimated on pieces as small as a needle's area, which was 10^17 of them.
#[test]
fn samples_of_a_needle_are_estimated_on_few_pieces() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1e-30, 0.0]], vec![[0, 1, 2]]).unwrap();
    let options = Options::new(Radius::PerVertex(&[0.01; 3]));
    let (set, _) = adaptive::sample(&Context::new(1).unwrap(), &mesh, &options, None).unwrap();
    assert!((50..=101).contains(&set.samples.len()), "{} samples on a line of 100 radii", set.samples.len());
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
