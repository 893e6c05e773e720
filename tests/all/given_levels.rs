//! Exact counts and progressive order on meshes around given samples, held against the definitions by plain checkers.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, Report};
use azulejo::{Context, Error, Given, Order, Points};

use crate::common::adaptive_oracle as oracle;
use crate::common::adaptive_oracle::{Ball, Field};
use crate::common::meshes;

/// More than the documented tolerance, on the meshes below.
const TOLERANCE: f64 = 1e-5;

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

fn balls(given: Given<3>, radius: f64) -> Vec<Ball> {
    let ball = |(i, position): (usize, &[f32; 3])| (position.map(f64::from), given.clearance(i, radius));
    given.positions.iter().enumerate().map(ball).collect()
}

/// A set on one thread and on three.
fn sample(mesh: &Arc<Mesh>, options: &Options) -> (Points<3>, Report) {
    let [(samples, report), (again, _)] =
        [1, 3].map(|threads| psp::sample(&Context::new(threads).unwrap(), mesh, options, None).unwrap());
    assert_eq!(samples, again, "depends on the number of threads");
    (samples, report)
}

/// The first samples of a set keep their distances, and cover the surface within a radius.
fn check(mesh: &Mesh, samples: &Points<3>, [apart, cover]: [f64; 2], cosine: f64, balls: &[Ball]) {
    assert_eq!(oracle::conflict(samples, &vec![apart; samples.len()], cosine), None);
    assert_eq!(oracle::too_near(samples, balls), None);
    let at = |_: [f64; 3]| cover;
    let field = Field::Function(&at, 0.0);
    let radii = vec![cover; samples.len()];
    assert_eq!(oracle::gap_around(mesh, &field, samples, &radii, cosine, TOLERANCE, balls), None);
}

/// The first samples of a set.
fn prefix(samples: &Points<3>, count: usize) -> Points<3> {
    let mut first = samples.clone();
    first.positions.truncate(count);
    first.normals.truncate(count);
    first.triangles.truncate(count);
    first.barycentrics.truncate(count);
    first.ranks.truncate(count);
    first
}

/// Vertices of the mesh as given samples, with clearances over two orders of magnitude.
fn given_on(mesh: &Mesh, radius: f64) -> (Vec<[f32; 3]>, Vec<f64>) {
    let positions: Vec<_> = mesh.positions().iter().step_by(5).copied().collect();
    let clearances = (0..positions.len()).map(|i| radius * [0.05, 0.4, 1.0, 3.0][i % 4]).collect();
    (positions, clearances)
}

#[test]
fn every_prefix_is_well_spread_around_given_samples() {
    for (soup, radius) in [(meshes::torus(), 0.15), (meshes::plane(), 0.05), (meshes::needles(50.0), 0.1)] {
        let mesh = mesh(soup);
        let (positions, clearances) = given_on(&mesh, radius);
        for given in [Given::with_clearances(&positions, &clearances), Given::at(&positions)] {
            for cosine in [-1.0, 0.5] {
                let options = Options::new(radius).order(Order::Progressive).given(given).cosine(cosine);
                let (samples, report) = sample(&mesh, &options);
                assert!(samples.len() > 10, "{}", samples.len());
                let balls = balls(given, radius);
                check(&mesh, &samples, [radius, radius], cosine, &balls);
                assert!(samples.ranks.is_sorted_by(|a, b| a >= b) && report.covering_radius == Some(radius));
                for count in [1, 2, 5, samples.len() / 3, samples.len() - 1] {
                    let rank = f64::from(samples.ranks[count - 1]);
                    if rank.is_finite() {
                        let quotient = if count < Order::FIRST_COUNT { 2.0 } else { psp::DEFAULT_QUOTIENT };
                        let bounds = [rank, quotient * rank];
                        check(&mesh, &prefix(&samples, count), bounds, cosine, &balls);
                    }
                }
            }
        }
    }
}

#[test]
fn counts_are_exact_around_given_samples() {
    for soup in [meshes::torus(), meshes::plane()] {
        let mesh = mesh(soup);
        let (positions, clearances) = given_on(&mesh, 0.1);
        let given = Given::with_clearances(&positions, &clearances);
        for count in [1, 2, 7, 100, 700] {
            for order in [Order::Any, Order::Progressive] {
                let (samples, report) = sample(&mesh, &Options::by_count(count).order(order).given(given));
                assert_eq!(samples.len(), count);
                let bounds = [report.radius, report.covering_radius.unwrap()];
                check(&mesh, &samples, bounds, -1.0, &balls(given, f64::NAN));
                assert_eq!(samples.ranks.len(), if order == Order::Any { 0 } else { count });
            }
        }
    }
}

#[test]
fn what_leaves_no_place_or_says_no_clearance_is_refused() {
    let mesh = mesh(meshes::torus());
    let positions = [[0.0; 3]];
    for order in [Order::Any, Order::Progressive] {
        let options = Options::by_count(5).order(order);
        let refused = |given| match psp::sample(&Context::new(1).unwrap(), &mesh, &options.given(given), None) {
            Err(Error::InvalidArgument { argument, .. }) => argument,
            other => panic!("{other:?}"),
        };
        assert_eq!(refused(Given::at(&positions)), "given_clearances");
        assert_eq!(refused(Given::with_clearances(&positions, &[100.0])), "count", "all is covered");
        let (samples, _) = psp::sample(
            &Context::new(1).unwrap(),
            &mesh,
            &Options::new(0.2).order(Order::Progressive).given(Given::with_clearances(&positions, &[100.0])),
            None,
        )
        .unwrap();
        assert!(samples.is_empty());
    }
}
