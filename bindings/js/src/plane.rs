//! Sets of the plane, and their relaxation.

use azulejo::dcr::{self, CorrelationOptions, Neighbourhood, PairCorrelation};
use azulejo::kdrt::{self, CountOptions, Kind, Options, Plane, Progressive};
use azulejo::{Boundary, Classes, Domain, Given, maximal};

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::{domain, given};

/// The options of a set, as JavaScript lays them out.
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

    /// The levels of a progressive order.
    fn levels(&self) -> Option<Progressive> {
        (self.progressive != 0.0).then(|| Progressive::new().quotient(self.quotient).coarsest(self.coarsest))
    }

    pub(crate) fn by_radius<'a>(&self, seed: u64, given: Given<'a, 2>) -> Options<'a> {
        let kind = match self.levels() {
            None => Kind::Plain(self.radius),
            Some(levels) => Kind::Progressive(self.radius, levels),
        };
        self.of(kind, seed).given(given)
    }

    fn by_classes<'a>(&self, classes: &'a Classes, seed: u64, given: Given<'a, 2>) -> Options<'a> {
        let kind = match self.levels() {
            None => Kind::Classes(classes),
            Some(levels) => Kind::ProgressiveClasses(classes, levels),
        };
        self.of(kind, seed).given(given)
    }

    fn of<'a>(&self, kind: Kind<'a>, seed: u64) -> Options<'a> {
        Options::of(kind).domain(self.domain()).leaf_size(self.leaf_size).seed(seed)
    }

    fn by_count(&self, seed: u64) -> CountOptions {
        let options = CountOptions::new(self.count as u64).domain(self.domain()).leaf_size(self.leaf_size);
        options.seed(seed).levels(self.levels())
    }
}

/// The samples, their ranks, the radius, and whether the set is maximal.
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
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    call(|context| {
        if options.count > 0.0 {
            let (set, report) = kdrt::sample_count(context, &options.by_count(seed), None)?;
            let report = vec![report.radius, f64::from(u8::from(report.is_maximal))];
            return Ok(Answer::default().and(set.positions).and(set.ranks).and(report));
        }
        let set = kdrt::sample(context, &options.by_radius(seed, given), None)?;
        Ok(Answer::default().and(set.positions).and(set.ranks).and(vec![options.radius, 1.0]))
    })
}

/// The samples of several classes, the class of each, and their ranks.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample_classes(
    options: &PlaneOptions,
    seed: u64,
    positions: *const [f32; 2],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    radii: *const f64,
    radius_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (given, radii) = unsafe { (given(positions, count, clearances, clearance_count), rows(radii, radius_count)) };
    call(|context| {
        let classes = Classes::new(radii.len().isqrt(), radii)?;
        let set = kdrt::sample(context, &options.by_classes(&classes, seed, given), None)?;
        Ok(Answer::default().and(set.positions).and(set.classes).and(set.ranks))
    })
}

/// The samples of the unbiased reference.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_maximal_sample(
    radius: f64,
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    seed: u64,
) -> i32 {
    call(|context| {
        let options = maximal::Options::new(radius).domain(domain(min_x, min_y, max_x, max_y, bounded)).seed(seed);
        Ok(Answer::default().and(maximal::sample(context, &options, None)?.positions))
    })
}

/// The matrix of classes of own radii.
///
/// # Safety
/// `own` is valid for reads of `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_classes_radii(own: *const f64, count: usize, factor: f64) -> i32 {
    // SAFETY: guaranteed by the caller.
    let own = unsafe { rows(own, count) };
    call(|_| Ok(Answer::default().and(Classes::of_radii(own, factor)?.radii().to_vec())))
}

/// Keeps the state that all windows of a plane share, of several classes if there are radii of theirs; the answer is empty, the handle is in `out`.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_create(
    options: &PlaneOptions,
    seed: u64,
    positions: *const [f32; 2],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    radii: *const f64,
    radius_count: usize,
    out: &mut Option<Box<Plane>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (given, radii) = unsafe { (given(positions, count, clearances, clearance_count), rows(radii, radius_count)) };
    call(|context| {
        let plane = match radii {
            [] => Plane::new(context, &options.by_radius(seed, given), None)?,
            _ => {
                let classes = Classes::new(radii.len().isqrt(), radii)?;
                Plane::new(context, &options.by_classes(&classes, seed, given), None)?
            }
        };
        *out = Some(Box::new(plane));
        Ok(Answer::default())
    })
}

/// The samples in a window, their ranks and their classes.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_kdrt_window(plane: &Plane, min_x: f64, min_y: f64, max_x: f64, max_y: f64) -> i32 {
    call(|_| {
        let set = plane.window([min_x, min_y], [max_x, max_y])?;
        Ok(Answer::default().and(set.positions).and(set.ranks).and(set.classes))
    })
}

/// Frees a plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_kdrt_free(plane: Option<Box<Plane>>) {
    drop(plane);
}

/// The relaxed points; the number of iterations, the reason for stopping, motion, smallest distance, rho and relative covering radius.
///
/// # Safety
/// `points` is valid for reads of `count` points.
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
    // SAFETY: guaranteed by the caller.
    let points = unsafe { rows(points, count) };
    call(|context| {
        let neighbourhood = if nearest == 0 { Neighbourhood::Delaunay } else { Neighbourhood::Nearest };
        let options = dcr::Options::new(domain(min_x, min_y, max_x, max_y, bounded), neighbourhood)
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let (relaxed, report) = dcr::relax(context, &options, points, None)?;
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
    call(|context| {
        let options = dcr::DelaunayOptions::new(domain(min_x, min_y, max_x, max_y, bounded))
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let (relaxed, report, each) = dcr::relax_classes(context, &options, points, classes, None)?;
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
    call(|context| {
        let target = PairCorrelation::new(reach, correlation)?;
        let options = CorrelationOptions::new(domain(min_x, min_y, max_x, max_y, bounded))
            .max_iterations(max_iterations)
            .tolerance(tolerance)
            .seed(seed);
        let (relaxed, report) = dcr::relax_to_correlation(context, &options, points, &target, None)?;
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
    call(|_| {
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
