//! `kdrt::merge` refuses what it cannot merge, by name and index, and can be cancelled.

use azulejo::kdrt::{MergeOptions, MergeReport, Piece, merge};
use azulejo::{Boundary, Context, Domain, Error};

fn good() -> MergeOptions {
    MergeOptions::new(0.1)
}

/// Samples of the left half of the unit square.
const SAMPLES: [[f32; 2]; 4] = [[0.1, 0.1], [0.3, 0.1], [0.0, 0.5], [0.4, 0.9]];

/// A piece of the left half of the unit square.
fn left(samples: &[[f32; 2]]) -> Piece<'_> {
    Piece { samples, min: [0.0; 2], max: [0.5, 1.0] }
}

fn empty(min: [f64; 2], max: [f64; 2]) -> Piece<'static> {
    Piece { samples: &[], min, max }
}

fn merged(options: MergeOptions, pieces: &[Piece], fixed: &[[f32; 2]]) -> Result<(Vec<[f32; 2]>, MergeReport), Error> {
    merge(&Context::new(1)?, &options, pieces, fixed, None).map(|(points, report)| (points.positions, report))
}

fn refusal(options: MergeOptions, pieces: &[Piece], fixed: &[[f32; 2]]) -> String {
    let error = merged(options, pieces, fixed).unwrap_err();
    assert!(matches!(error, Error::InvalidArgument { .. }), "{error}");
    error.to_string()
}

#[test]
fn bad_options_are_refused_by_name() {
    for radius in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        assert!(refusal(good().radius(radius), &[], &[]).starts_with("radius: "));
    }
    let swapped = Domain { max: [-1.0; 2], ..good().domain };
    assert!(refusal(good().domain(swapped), &[], &[]).starts_with("domain_max: "));
    let error = merged(good().radius(8.346e-7), &[], &[]).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }), "{error}");
}

#[test]
fn bad_fixed_points_are_refused_by_index() {
    for boundary in [Boundary::Periodic, Boundary::Bounded] {
        let options = good().domain(Domain::unit(boundary));
        for bad in [[f32::NAN, 0.5], [0.5, f32::INFINITY], [-1e-45, 0.5], [0.5, 1.0], [0.5, -f32::MAX]] {
            let message = refusal(options, &[], &[[0.2, 0.2], bad]);
            assert!(message.starts_with("fixed: point 1 is ("), "{message}");
        }
        let message = refusal(options, &[], &[[0.2, 0.2], [0.7, 0.7], [0.25, 0.25]]);
        assert!(message.starts_with("fixed: points 0 and 2 are 0.0707"), "{message}");
        let message = refusal(options, &[], &[[0.3, 0.3], [0.3, 0.3]]);
        assert_eq!(message, "fixed: points 0 and 1 are 0.0 apart, closer than the radius 0.1");
        // A million points that all conflict are refused without looking at all pairs.
        assert!(refusal(options, &[], &[[0.3; 2]; 1 << 20]).starts_with("fixed: points 0 and 1 are 0.0 apart"));
    }
    // Over the seam of a torus, points that must stay have no way out.
    let message = refusal(good(), &[], &[[0.5, 0.01], [0.5, 0.95]]);
    assert!(message.starts_with("fixed: points 0 and 1 are 0.06"), "{message}");
    let bounded = good().domain(Domain::unit(Boundary::Bounded));
    assert!(merged(bounded, &[], &[[0.5, 0.01], [0.5, 0.95]]).is_ok());
}

#[test]
fn bad_rectangles_are_refused_by_index() {
    assert!(merged(good(), &[left(&SAMPLES), empty([0.5, 0.0], [1.0, 1.0])], &[]).is_ok());
    for (min, max) in [
        ([0.5, 0.0], [0.5, 1.0]),
        ([0.6, 0.9], [0.7, 0.8]),
        ([0.6, -1e-300], [0.7, 0.8]),
        ([0.6, 0.0], [1.0f64.next_up(), 0.8]),
        ([f64::NAN, 0.0], [0.7, 0.8]),
        ([0.6, 0.0], [0.7, f64::NAN]),
        ([0.6, f64::NEG_INFINITY], [0.7, 1.0]),
    ] {
        let message = refusal(good(), &[left(&SAMPLES), empty(min, max)], &[]);
        assert!(message.starts_with("pieces: [1] reaches on axis "), "{message}");
    }
    for (min, max) in [([0.4, 0.4], [0.6, 0.6]), ([0.1; 2], [0.2; 2]), ([0.0; 2], [0.5, 1.0]), ([0.0; 2], [0.6, 0.9])] {
        let message = refusal(good(), &[left(&SAMPLES), empty([0.6, 0.0], [0.7, 0.2]), empty(min, max)], &[]);
        assert_eq!(message, "pieces: the rectangles of [0] and [2] overlap");
    }
}

#[test]
fn bad_samples_of_pieces_are_refused_by_index() {
    let right = empty([0.5, 0.0], [1.0, 1.0]);
    for bad in [[0.5, 0.5], [0.2, 1.0], [f32::NAN, 0.1], [-0.1, 0.1]] {
        let mut samples = SAMPLES;
        samples[3] = bad;
        let message = refusal(good(), &[right, left(&samples)], &[]);
        assert!(message.starts_with("pieces: [1]: sample 3 is ("), "{message}");
    }
    let mut samples = SAMPLES;
    samples[2] = [0.375, 0.84375];
    let message = refusal(good(), &[right, left(&samples)], &[]);
    assert!(message.starts_with("pieces: [1]: samples 2 and 3 are 0.0615"), "{message}");
}
