//! Relaxation of points of a cuboid, and of points inside a mesh.

use std::ffi::c_void;

use azulejo_core::dcr::volume::{self, InsideOptions, Options, Report};

use crate::boundary::{Out, check_reserved, rows};
use crate::context::azulejo_context;
use crate::dcr::reason;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::{azulejo_mesh, collect};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_volume_relax.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_relax_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// The lower corner of the domain, x y z; default 0 0 0.
    pub domain_min: [f64; 3],
    /// The upper corner, as in azulejo_space_set; default 1 1 1.
    pub domain_max: [f64; 3],
    /// The most steps; default 100. 0 returns the points as they are. Forces depend on it.
    pub max_iterations: u32,
    /// Must be 0.
    pub reserved: u32,
    /// It parts coincident points and moves clustered ones; default 0.
    pub seed: u64,
    /// The motion (see the report) at which the set has converged; 0 makes all steps. Any negative
    /// number, such as the default -1, selects 0.001.
    pub tolerance: f64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
}

growing!(azulejo_volume_relax_options requires domain_max {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    domain_min: [0.0; 3],
    domain_max: [1.0; 3],
    max_iterations: 100,
    reserved: 0,
    seed: 0,
    tolerance: -1.0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

impl azulejo_volume_relax_options {
    fn request(&self) -> Result<Options, Failure> {
        let options = Options::new(domain(self.domain_min, self.domain_max, self.boundary)?);
        check_reserved(self.reserved)?;
        let tolerance = if self.tolerance < 0.0 { options.tolerance } else { self.tolerance };
        Ok(options.max_iterations(self.max_iterations).tolerance(tolerance).seed(self.seed))
    }
}

/// Options of azulejo_volume_relax_inside; as those of azulejo_volume_relax.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_relax_inside_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Default 100.
    pub max_iterations: u32,
    /// Default 0.
    pub seed: u64,
    /// Default -1: 0.001.
    pub tolerance: f64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// One byte per point: any value but 0 keeps it where it is. Default NULL: none stays.
    pub fixed: *const u8,
    /// 0, the default, for none, or the number of points.
    pub fixed_count: usize,
    /// Likewise: it stays on the surface. Default NULL: none.
    pub sliding: *const u8,
    /// Default 0, as fixed_count.
    pub sliding_count: usize,
}

growing!(azulejo_relax_inside_options requires fixed_count {
    max_iterations: 100,
    seed: 0,
    tolerance: -1.0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    fixed: std::ptr::null(),
    fixed_count: 0,
    sliding: std::ptr::null(),
    sliding_count: 0,
});

impl azulejo_relax_inside_options {
    fn request<'a>(&self, [fixed, sliding]: [&'a [bool]; 2]) -> InsideOptions<'a> {
        let options = InsideOptions::default();
        let tolerance = if self.tolerance < 0.0 { options.tolerance } else { self.tolerance };
        let options = options.max_iterations(self.max_iterations).tolerance(tolerance).seed(self.seed);
        options.fixed(fixed).sliding(sliding)
    }
}

/// The report of both relaxations. d_fcc is the distance of neighbours in the densest packing,
/// the face-centred cubic one, of as many points in the volume: (sqrt(2) volume / count)^(1/3).
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_relax_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The steps made.
    pub iterations: u32,
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    pub stopped: u32,
    /// Always 0.
    pub reserved: u32,
    /// Half of the distance that points moved over the last 10 steps, root mean square, in d_fcc.
    pub motion: f64,
    /// The smallest distance; infinite for fewer than two points.
    pub smallest_distance: f64,
    /// The same in d_fcc: about 0.80 for a maximal set, 0.94 for a relaxed one.
    pub rho: f64,
}

growing!(azulejo_volume_relax_report requires iterations {
    iterations: 0,
    stopped: 0,
    reserved: 0,
    motion: 0.0,
    smallest_distance: 0.0,
    rho: 0.0,
});

impl From<Report> for azulejo_volume_relax_report {
    fn from(Report { iterations, stopped, motion, smallest_distance, rho, .. }: Report) -> Self {
        Self { iterations, stopped: reason(stopped), motion, smallest_distance, rho, ..Self::DEFAULT }
    }
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_relax_options_init(
    options: *mut azulejo_volume_relax_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_relax_report_init(
    report: *mut azulejo_volume_relax_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Relaxes points of a cuboid: they push each other away until the set has converged or all steps
/// are made, with which the call succeeds as well. From random points 100 steps end at a rho of
/// about 0.94. Lattices do not stay. Points that are clustered are redistributed over the cuboid
/// before the first step. A periodic domain wraps, a bounded one has walls.
///
/// positions: the points, x y z each, in domain_min <= x < domain_max.
///
/// out: after the last whole step, in the same order; positions only.
///
/// O(count) time for each step, and O(count) memory. Source: thesis chapter 4, in space.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_relax(
    context: *const azulejo_context,
    options: *const azulejo_volume_relax_options,
    positions: *const f32,
    count: usize,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_volume_relax_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_volume_relax_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        let request = options.request()?;
        let watch = Watch::new(options.progress, options.progress_user);
        let (relaxed, done) =
            context.run(watch, |context, progress| volume::relax(context, &request, points, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(relaxed.into()))
    })
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_relax_inside_options_init(
    options: *mut azulejo_relax_inside_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Relaxes points inside a mesh, as azulejo_volume_relax does in a bounded domain. None leaves the
/// inside (azulejo_volume_sample_inside). Clustered ones are not redistributed.
/// positions: those that are fixed in the box around the mesh, those that slide on its surface.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_relax_inside(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_relax_inside_options,
    positions: *const f32,
    count: usize,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_volume_relax_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let (context, mesh) = unsafe { (handles::get("context", context)?, handles::get("mesh", mesh)?) };
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_relax_inside_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let (points, fixed, sliding) = unsafe {
            let points = rows::<f32, 3>("positions", positions, "count", count)?;
            let fixed = rows::<u8, 1>("fixed", options.fixed, "fixed_count", options.fixed_count)?;
            (points, fixed, rows::<u8, 1>("sliding", options.sliding, "sliding_count", options.sliding_count)?)
        };
        let fixed = collect("fixed", fixed.iter().map(|&[entry]| entry != 0))?;
        let sliding = collect("sliding", sliding.iter().map(|&[entry]| entry != 0))?;
        let request = options.request([&fixed, &sliding]);
        let watch = Watch::new(options.progress, options.progress_user);
        let (relaxed, done) = context
            .run(watch, |context, progress| volume::relax_inside(context, &mesh.shared, &request, points, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(relaxed.into()))
    })
}

#[cfg(test)]
mod tests {
    use azulejo_core::{Boundary, Domain};

    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        let request = azulejo_volume_relax_options::DEFAULT.request().unwrap();
        assert_eq!(request, Options::new(Domain::unit(Boundary::Periodic)));
        assert_eq!(azulejo_relax_inside_options::DEFAULT.request([&[]; 2]), InsideOptions::default());
    }
}
