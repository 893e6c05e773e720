//! Relaxation in the plane.

use azulejo::dcr::{
    self, Convergence, CorrelationOptions, Distribution, Method, Neighbourhood, PairCorrelation, Thesis, Visits,
};
use azulejo::{Boundary, Domain};

use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;

/// The options of a relaxation, as JavaScript lays them out. Those from the conflict radius on are of the thesis's method.
#[repr(C)]
pub struct RelaxOptions {
    min: [f64; 2],
    max: [f64; 2],
    bounded: f64,
    nearest: f64,
    thesis: f64,
    max_iterations: f64,
    /// Below 0 that of the method.
    tolerance: f64,
    conflict_radius: f64,
    attraction_radius: f64,
    step: f64,
    decay: f64,
    neighbours: f64,
    distribution: f64,
    one_end: f64,
    variance: f64,
}

impl RelaxOptions {
    fn options(&self, seed: u64) -> dcr::Options {
        let boundary = if self.bounded == 0.0 { Boundary::Periodic } else { Boundary::Bounded };
        let domain = Domain { min: self.min, max: self.max, boundary };
        let neighbourhood = if self.nearest == 0.0 { Neighbourhood::Delaunay } else { Neighbourhood::Nearest };
        let options = match self.thesis {
            0.0 => dcr::Options::new(domain, neighbourhood),
            _ => dcr::Options::thesis(domain, neighbourhood).method(Method::Thesis(self.by_thesis())),
        };
        let tolerance = if self.tolerance < 0.0 { options.tolerance } else { self.tolerance };
        options.max_iterations(self.max_iterations as u32).tolerance(tolerance).seed(seed)
    }

    fn by_thesis(&self) -> Thesis {
        let mut thesis = Thesis::default();
        thesis.conflict_radius = self.conflict_radius;
        thesis.attraction_radius = self.attraction_radius;
        thesis.step = self.step;
        thesis.decay = self.decay;
        thesis.neighbours = self.neighbours as u32;
        // In the order of index.js.
        thesis.distribution = match self.distribution as u32 {
            0 => Distribution::Activeness,
            1 => Distribution::Average,
            2 => Distribution::Dominant,
            3 => Distribution::Zero,
            _ => Distribution::EightyTwenty,
        };
        thesis.visits = if self.one_end == 0.0 { Visits::BothEnds } else { Visits::OneEnd };
        thesis.convergence = if self.variance == 0.0 { Convergence::Motion } else { Convergence::Variance };
        thesis
    }
}

/// The relaxed points, and the numbers of [`relaxation`].
///
/// # Safety
/// `points` is valid for reads of `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax(
    options: &RelaxOptions,
    seed: u64,
    points: *const [f32; 2],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context, progress| {
        let (relaxed, report) = dcr::relax(context, &options.options(seed), points, progress)?;
        Ok(Answer::default().and(relaxed).and(relaxation(&report)))
    })
}

/// The relaxed points of several classes, the numbers of [`relaxation`], rho of each class, and the relative covering radius of
/// each.
///
/// # Safety
/// The pointers are valid for reads of so many points and classes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_classes(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    points: *const [f32; 2],
    count: usize,
    classes: *const u32,
    class_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (points, classes) = unsafe { (rows(points, count), rows(classes, class_count)) };
    call(|context, progress| {
        let options = dcr::DelaunayOptions::new(domain(min_x, min_y, max_x, max_y, bounded))
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let (relaxed, report, each) = dcr::relax_classes(context, &options, points, classes, progress)?;
        let rho: Vec<f64> = each.iter().map(|class| class.rho).collect();
        let covering: Vec<f64> = each.iter().map(|class| class.relative_covering_radius).collect();
        Ok(Answer::default().and(relaxed).and(relaxation(&report)).and(rho).and(covering))
    })
}

/// The relaxed points, the numbers of [`relaxation`], and the residual.
///
/// # Safety
/// The pointers are valid for reads of so many points and bins.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_to_correlation(
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    points: *const [f32; 2],
    count: usize,
    reach: f64,
    correlation: *const f64,
    bins: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (points, correlation) = unsafe { (rows(points, count), rows(correlation, bins)) };
    call(|context, progress| {
        let target = PairCorrelation::new(reach, correlation)?;
        let options = CorrelationOptions::new(domain(min_x, min_y, max_x, max_y, bounded))
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let (relaxed, report) = dcr::relax_to_correlation(context, &options, points, &target, progress)?;
        Ok(Answer::default().and(relaxed).and(relaxation(&report.set)).and(vec![report.residual]))
    })
}

/// The pair correlation of a radial power.
///
/// # Safety
/// `power` is valid for reads of `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_correlation_of_power(
    highest: f64,
    reach: f64,
    bins: u32,
    power: *const f64,
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let power = unsafe { rows(power, count) };
    call(|_, _| {
        let correlation = PairCorrelation::of_power(highest, power, reach, bins as usize)?;
        Ok(Answer::default().and(correlation.values().to_vec()))
    })
}

/// The number of iterations, the reason for stopping, motion, smallest distance, rho and relative covering radius.
pub(crate) fn relaxation(report: &dcr::Report) -> Vec<f64> {
    let dcr::Report { motion, smallest_distance, rho, relative_covering_radius, .. } = *report;
    let (iterations, stopped) = (report.iterations.into(), f64::from(report.stopped as u8));
    vec![iterations, stopped, motion, smallest_distance, rho, relative_covering_radius]
}
