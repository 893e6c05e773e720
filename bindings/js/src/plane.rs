//! Sets of the plane, and their relaxation.

use azulejo::dcr::{self, Neighbourhood};
use azulejo::kdrt::{self, CountOptions, Options, Plane};
use azulejo::{Boundary, Classes, Domain, Given, Order};

use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;

/// What to sample, as JavaScript writes it.
#[repr(C)]
pub struct PlaneOptions {
    radius: f64,
    count: f64,
    min: [f64; 2],
    max: [f64; 2],
    bounded: f64,
    leaf_size: f64,
    progressive: f64,
    quotient: f64,
    coarsest: f64,
}

impl PlaneOptions {
    fn domain(&self) -> Domain {
        let boundary = if self.bounded == 0.0 { Boundary::Periodic } else { Boundary::Bounded };
        Domain { min: self.min, max: self.max, boundary }
    }

    fn order(&self) -> Order {
        if self.progressive == 0.0 { Order::Any } else { Order::Progressive }
    }

    fn by_radius<'a>(&self, seed: u64, given: Given<'a, 2>) -> Options<'a> {
        Options::new(self.radius)
            .domain(self.domain())
            .leaf_size(self.leaf_size)
            .seed(seed)
            .order(self.order())
            .quotient(self.quotient)
            .coarsest(self.coarsest)
            .given(given)
    }

    fn by_count(&self, seed: u64) -> CountOptions {
        let mut options = CountOptions::new(self.count as u64);
        options.domain = self.domain();
        options.leaf_size = self.leaf_size;
        options.seed = seed;
        options.order = self.order();
        options.quotient = self.quotient;
        options.coarsest = self.coarsest;
        options
    }
}

/// Samples that stand already; without clearances all have the radius.
///
/// # Safety
/// As [`rows`] of both.
unsafe fn given<'a>(
    positions: *const [f32; 2],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> Given<'a, 2> {
    // SAFETY: as the caller says.
    let (positions, clearances) = unsafe { (rows(positions, count), rows(clearances, clearance_count)) };
    if clearances.is_empty() { Given::at(positions) } else { Given::with_clearances(positions, clearances) }
}

/// Samples, their ranks, and the radius, whether the set is maximal.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample(
    options: &PlaneOptions,
    seed: u64,
    positions: *const [f32; 2],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> i32 {
    // SAFETY: as the caller says.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    call(|context| {
        if options.count > 0.0 {
            let counted = kdrt::sample_count(context, &options.by_count(seed), None)?;
            let report = vec![counted.report.radius, f64::from(u8::from(counted.report.is_maximal))];
            return Ok(Answer::default().and(counted.samples).and(counted.ranks).and(report));
        }
        let set = kdrt::sample_ranked(context, &options.by_radius(seed, given), None)?;
        Ok(Answer::default().and(set.samples).and(set.ranks).and(vec![options.radius, 1.0]))
    })
}

/// Samples of several classes, and the class of each.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample_classes(
    options: &PlaneOptions,
    seed: u64,
    radii: *const f64,
    radius_count: usize,
) -> i32 {
    // SAFETY: as the caller says.
    let radii = unsafe { rows(radii, radius_count) };
    call(|context| {
        let classes = Classes::new(radii.len().isqrt(), radii)?;
        let set = kdrt::sample_classes(context, &options.by_radius(seed, Given::default()), &classes, None)?;
        Ok(Answer::default().and(set.samples).and(set.classes))
    })
}

/// Keeps what all windows of a plane have in common; the answer is empty, the handle in `out`.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_create(
    options: &PlaneOptions,
    seed: u64,
    positions: *const [f32; 2],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    out: &mut Option<Box<Plane>>,
) -> i32 {
    // SAFETY: as the caller says.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    call(|context| {
        *out = Some(Box::new(Plane::new(context, &options.by_radius(seed, given), None)?));
        Ok(Answer::default())
    })
}

/// The samples in a window, and their ranks.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_plane_window(plane: &Plane, min_x: f64, min_y: f64, max_x: f64, max_y: f64) -> i32 {
    call(|_| {
        let set = plane.window_ranked([min_x, min_y], [max_x, max_y])?;
        Ok(Answer::default().and(set.samples).and(set.ranks))
    })
}

/// Frees a plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_plane_free(plane: Option<Box<Plane>>) {
    drop(plane);
}

/// The relaxed points; iterations, why it stopped, motion, smallest distance, rho and coverage.
///
/// # Safety
/// `points` leads to `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    nearest: i32,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    points: *const [f32; 2],
    count: usize,
) -> i32 {
    // SAFETY: as the caller says.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let neighbourhood = if nearest == 0 { Neighbourhood::Delaunay } else { Neighbourhood::Nearest };
        let options = dcr::Options::new(domain(min_x, min_y, max_x, max_y, bounded), neighbourhood)
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let (relaxed, report) = dcr::relax(context, &options, points, None)?;
        let (iterations, stopped) = (report.iterations.into(), f64::from(report.stopped as u8));
        let report = vec![iterations, stopped, report.motion, report.smallest_distance, report.rho, report.coverage];
        Ok(Answer::default().and(relaxed).and(report))
    })
}
