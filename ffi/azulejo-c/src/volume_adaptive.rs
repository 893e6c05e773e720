//! Adaptive sampling of volumes: sets of cuboids and of the inside of meshes whose radius varies.

use std::ffi::c_void;

use azulejo_core::volume::adaptive::{self, InsideOptions, Options, Radius};

use crate::boundary::{Out, check_unused, rows};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::of_position::{OfPosition, azulejo_radius_fn};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};
use crate::volume::azulejo_volume_report;

/// Options of azulejo_volume_adaptive_sample, which requires `grid_values` or `radius_function`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_adaptive_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic. Not inside a mesh.
    pub boundary: u32,
    /// The lower corner, x y z; default 0 0 0. Not inside a mesh.
    pub domain_min: [f64; 3],
    /// The upper corner; default 1 1 1. Not inside a mesh.
    pub domain_max: [f64; 3],
    /// Radii above 0, x fastest, then y. Default NULL.
    pub grid_values: *const f32,
    /// Their number along x, y, z: at least 1 1 1. Default 0 0 0: no grid.
    pub grid_size: [usize; 3],
    /// Instead of a grid. Default NULL.
    pub radius_function: azulejo_radius_fn,
    /// Passed to `radius_function`.
    pub radius_function_user: *mut c_void,
    /// The smallest value of `radius_function`, above 0. Default 0: no function.
    pub smallest: f64,
    /// Its largest value. Default 0.
    pub largest: f64,
    /// As in azulejo_psp_adaptive_options; default 0.
    pub slope: f64,
    /// Of the inside of a mesh, in radii: 1/256 to 1/2; default 0.0625.
    pub tolerance: f64,
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
}

growing!(azulejo_volume_adaptive_options requires slope {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    domain_min: [0.0; 3],
    domain_max: [1.0; 3],
    grid_values: std::ptr::null(),
    grid_size: [0; 3],
    radius_function: None,
    radius_function_user: std::ptr::null_mut(),
    smallest: 0.0,
    largest: 0.0,
    slope: 0.0,
    tolerance: 0.0625,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_adaptive_options_init(
    options: *mut azulejo_volume_adaptive_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Makes a maximal set of samples, each with a radius of its own (azulejo_points_radii), of a
/// cuboid or, unless `mesh` is NULL, inside a mesh. Rule and errors are those of
/// azulejo_psp_adaptive_sample, the tolerance that of azulejo_volume_sample, inside a mesh with
/// the radius of the place, and the change of the radius over it. A grid lies over the cuboid or
/// the box around the mesh, its first and last radii on the faces, linear along each axis. A
/// function is called some 60 times a sample; its slope need not hold across the seam of a torus.
/// The report has the least radius of a sample, and the largest that there can be. O(samples) time
/// and memory for slopes below about 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_adaptive_sample(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_volume_adaptive_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_volume_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let mesh = if mesh.is_null() { None } else { Some(unsafe { handles::get("mesh", mesh) }?) };
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_volume_adaptive_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let user = options.radius_function_user;
        // SAFETY: handed on from the caller.
        let function = options.radius_function.map(|function| unsafe { OfPosition::new(function, user) });
        let at = function.as_ref().map(|function| |position| function.call(position));
        let azulejo_volume_adaptive_options { smallest, largest, slope, seed, tolerance, grid_size: size, .. } =
            options;
        // SAFETY: handed on from the caller.
        let values = unsafe { options.grid_values() }?;
        let radius = match &at {
            Some(at) => Radius::Function { at, smallest, largest, slope },
            None => Radius::Grid { values, size },
        };
        let watch = Watch::new(options.progress, options.progress_user);
        let (samples, made) = match mesh {
            None => {
                check_unused(
                    "tolerance",
                    tolerance,
                    azulejo_volume_adaptive_options::DEFAULT.tolerance,
                    "without a mesh",
                )?;
                let domain = domain(options.domain_min, options.domain_max, options.boundary)?;
                let request = Options::new(radius).domain(domain).seed(seed);
                context.run(watch, |context, progress| adaptive::sample(context, &request, progress))?
            }
            Some(mesh) => {
                check_unused("domain_min", options.domain_min, [0.0; 3], "inside a mesh")?;
                check_unused("domain_max", options.domain_max, [1.0; 3], "inside a mesh")?;
                check_unused("boundary", options.boundary, AZULEJO_BOUNDARY_PERIODIC, "inside a mesh")?;
                let request = InsideOptions::new(radius).tolerance(tolerance).seed(seed);
                context.run(watch, |context, progress| {
                    adaptive::sample_inside(context, &mesh.shared, &request, progress)
                })?
            }
        };
        if let Some(report) = report {
            report.write(azulejo_volume_report {
                samples: samples.len() as u64,
                radius: made.radius,
                seconds: made.seconds,
                covering_radius: made.covering_radius,
                ..azulejo_volume_report::DEFAULT
            });
        }
        Ok(azulejo_points::space(samples))
    })
}

impl azulejo_volume_adaptive_options {
    /// The values on the grid; none where `radius_function` is set.
    ///
    /// # Safety
    /// Unless the checks fail, `grid_values` leads to as many numbers as `grid_size` says, which are not changed during
    /// `'a`.
    unsafe fn grid_values<'a>(&self) -> Result<&'a [f32], Failure> {
        match (self.radius_function.is_some(), self.grid_values.is_null()) {
            (true, true) => {
                check_unused("grid_size", self.grid_size, [0; 3], "with radius_function").map(|()| [].as_slice())
            }
            (true, false) => {
                Err(Failure::invalid("radius_function", "is set, and grid_values too; one of them must be NULL"))
            }
            (false, true) => {
                Err(Failure::invalid("radius_function", "is NULL, and grid_values too; one of them is needed"))
            }
            (false, false) => {
                for (field, value) in [("smallest", self.smallest), ("largest", self.largest), ("slope", self.slope)] {
                    check_unused(field, value, 0.0, "with grid_values")?;
                }
                let count = self.grid_size.iter().try_fold(1usize, |count, &along| count.checked_mul(along));
                let Some(count) = count.filter(|&count| count > 0) else {
                    return Err(Failure::invalid("grid_size", format!("{:?} is no size of a grid", self.grid_size)));
                };
                // SAFETY: the caller's word.
                Ok(unsafe { rows::<f32, 1>("grid_values", self.grid_values, "grid_size", count) }?.as_flattened())
            }
        }
    }
}
