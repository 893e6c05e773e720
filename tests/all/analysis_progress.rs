//! Every call of the analysis reports its progress, can be cancelled at each report, and finds the same when it is watched.

use std::cell::{Cell, RefCell};
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::thread::{self, ThreadId};

use azulejo::analysis::bonds::bond_order;
use azulejo::analysis::coverage::{
    coverage_2d, covering_radius_2d, surface_coverage, surface_covering_radius, surface_uncovered_fraction,
};
use azulejo::analysis::differential::{plane_differences, surface_differences};
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::spacing::{nearest_distances_2d, smallest_distance_3d};
use azulejo::analysis::spectrum::periodogram;
use azulejo::analysis::triangles::{delaunay_triangles, triangle_statistics};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, Error, Progress, Result};

use crate::common::meshes;
use crate::common::sets::{random_points, unit_square};

/// A call with everything but its context and its progress callback.
type Call<'a, T> = &'a dyn Fn(&Context, Option<&Progress>) -> Result<T>;

/// Checks a call that reports at least `least` times on one thread.
fn check<T: PartialEq + Debug>(name: &str, least: usize, call: Call<T>) {
    let expected = call(&Context::new(1).unwrap(), None).unwrap();
    for threads in [1, 3] {
        let context = Context::new(threads).unwrap();
        assert_eq!(call(&context, None).unwrap(), expected, "{name}, {threads} threads");
        let told: RefCell<Vec<(f64, ThreadId)>> = RefCell::default();
        let tell = |share| {
            told.borrow_mut().push((share, thread::current().id()));
            ControlFlow::Continue(())
        };
        assert_eq!(call(&context, Some(&tell)).unwrap(), expected, "{name}, {threads} threads, watched");
        let told = told.into_inner();
        assert!(told.iter().all(|&(_, id)| id == thread::current().id()), "{name}");
        assert!(told.windows(2).all(|pair| pair[0].0 <= pair[1].0), "{name}: {told:?}");
        assert_eq!((told[0].0, told[told.len() - 1].0), (0.0, 1.0), "{name}");
        if threads == 1 {
            assert!(told.len() >= least, "{name} reports {} times", told.len());
            // At every call, or at a hundred of them from the first to the last.
            (1..=told.len()).step_by(told.len().div_ceil(100)).for_each(|limit| stops_at(name, limit, &context, call));
            stops_at(name, told.len(), &context, call);
        } else {
            stops_at(name, 1, &context, call);
            stops_at(name, 2, &context, call);
        }
    }
}

/// Cancels a call at a certain call of its callback, which is the last then.
fn stops_at<T: Debug>(name: &str, limit: usize, context: &Context, call: Call<T>) {
    let calls = Cell::new(0);
    let stop = |_| {
        calls.set(calls.get() + 1);
        if calls.get() == limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let stopped = call(context, Some(&stop));
    assert!(matches!(stopped, Err(Error::Cancelled)), "{name}, cancelled at call {limit}: {stopped:?}");
    assert_eq!(calls.get(), limit, "{name} reports after it was cancelled");
}

#[test]
fn calls_of_the_plane_are_watched_and_cancelled() {
    let points = random_points(3000, 1);
    for boundary in [Boundary::Periodic, Boundary::Bounded] {
        let domain: &Domain = &unit_square(boundary);
        let points = &points[..];
        check("nearest", 10, &|c, p| nearest_distances_2d(c, domain, points, p));
        check("covering radius", 10, &|c, p| covering_radius_2d(c, domain, points, p));
        check("coverage", 20, &|c, p| coverage_2d(c, domain, points, 0.03, p));
        check("bond order", 5, &|c, p| bond_order(c, domain, points, p));
        check("triangles", 5, &|c, p| delaunay_triangles(c, domain, points, p));
        check("triangle statistics", 5, &|c, p| triangle_statistics(c, domain, points, p));
        check("figures", 25, &|c, p| figures_2d(c, domain, points, p));
        check("distribution", 10, &|c, p| radial_distribution(c, domain, points, 5.0, 50, p));
        check("differences", 5, &|c, p| plane_differences(c, domain, points, p));
        check("spectrum", 10, &|c, p| periodogram(c, domain, points, 100, p));
    }
}

#[test]
fn calls_of_surfaces_are_watched_and_cancelled() {
    let (positions, triangles) = meshes::torus();
    let mesh = &Mesh::new(positions, triangles).unwrap();
    let positions: Vec<_> = mesh.positions().iter().step_by(3).copied().collect();
    let positions = &positions[..];
    let normals = &vec![[0.0, 0.0, 1.0]; positions.len()];
    check("smallest distance", 3, &|c, p| smallest_distance_3d(c, positions, p));
    check("covering radius", 50, &|c, p| surface_covering_radius(c, mesh, positions, p));
    check("coverage", 100, &|c, p| surface_coverage(c, mesh, positions, 0.1, p));
    check("uncovered", 5, &|c, p| surface_uncovered_fraction(c, mesh, positions, 0.1, 10_000, 1, p));
    let east = [1.0, 0.0, 0.0];
    check("differences", 5, &|c, p| surface_differences(c, mesh, positions, normals, east, 1, p));
}

#[test]
fn probes_without_end_take_no_memory_and_can_be_cancelled() {
    let (positions, triangles) = meshes::torus();
    let mesh = Mesh::new(positions, triangles).unwrap();
    for threads in [1, 3] {
        let context = Context::new(threads).unwrap();
        let call = |_: &Context, progress: Option<&Progress>| {
            surface_uncovered_fraction(&context, &mesh, mesh.positions(), 0.1, u64::MAX, 1, progress)
        };
        stops_at("probes", 20, &context, &call);
    }
}

/// What several calls find is what each finds alone.
#[test]
fn figures_are_those_of_the_calls_that_find_one() {
    let context = &Context::new(2).unwrap();
    for (count, boundary) in
        [(0, Boundary::Bounded), (1, Boundary::Periodic), (2, Boundary::Bounded), (500, Boundary::Periodic)]
    {
        let (points, domain) = (&random_points(count, 7)[..], &unit_square(boundary));
        let figures = figures_2d(context, domain, points, None).unwrap();
        assert_eq!(figures.nearest, nearest_distances_2d(context, domain, points, None).unwrap());
        assert_eq!(figures.covering_radius, covering_radius_2d(context, domain, points, None).unwrap());
        assert_eq!(figures.bond_order, bond_order(context, domain, points, None).unwrap());
        assert_eq!(figures.triangles, triangle_statistics(context, domain, points, None).unwrap());
    }
}
