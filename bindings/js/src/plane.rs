//! Sets of the plane.

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
    call(|context, progress| {
        if options.count > 0.0 {
            let (set, report) = kdrt::sample_count(context, &options.by_count(seed), progress)?;
            let report = vec![report.radius, f64::from(u8::from(report.is_maximal))];
            return Ok(Answer::default().and(set.positions).and(set.ranks).and(report));
        }
        let set = kdrt::sample(context, &options.by_radius(seed, given), progress)?;
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
    call(|context, progress| {
        let classes = Classes::new(radii.len().isqrt(), radii)?;
        let set = kdrt::sample(context, &options.by_classes(&classes, seed, given), progress)?;
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
    call(|context, progress| {
        let options = maximal::Options::new(radius).domain(domain(min_x, min_y, max_x, max_y, bounded)).seed(seed);
        Ok(Answer::default().and(maximal::sample(context, &options, progress)?.positions))
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
    call(|_, _| Ok(Answer::default().and(Classes::of_radii(own, factor)?.radii().to_vec())))
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
    call(|context, progress| {
        let plane = match radii {
            [] => Plane::new(context, &options.by_radius(seed, given), progress)?,
            _ => {
                let classes = Classes::new(radii.len().isqrt(), radii)?;
                Plane::new(context, &options.by_classes(&classes, seed, given), progress)?
            }
        };
        *out = Some(Box::new(plane));
        Ok(Answer::default())
    })
}

/// The samples in a window, their ranks and their classes.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_kdrt_window(plane: &Plane, min_x: f64, min_y: f64, max_x: f64, max_y: f64) -> i32 {
    call(|_, _| {
        let set = plane.window([min_x, min_y], [max_x, max_y])?;
        Ok(Answer::default().and(set.positions).and(set.ranks).and(set.classes))
    })
}

/// Frees a plane.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_kdrt_free(plane: Option<Box<Plane>>) {
    drop(plane);
}
