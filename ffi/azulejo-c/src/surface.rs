//! DCR on surfaces: relaxation of the samples of a mesh.

use std::ffi::c_void;
use std::mem::MaybeUninit;

use azulejo_core::dcr::surface::{self, Options, Report};

use crate::boundary::{self, required, rows};
use crate::context::azulejo_context;
use crate::dcr::reason;
use crate::mesh::azulejo_mesh;
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::azulejo_status;

/// Options of azulejo_dcr_relax_surface. d_max = sqrt(2 * area / (sqrt(3) * count)) is the distance of neighbours if the
/// samples stood in hexagonal arrangement on a plane of the mesh's area.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_surface_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// The largest number of steps, 100 by default. 0 returns the samples as they are, those that rounding has put outside
    /// their triangle on its edge. Fewer are made where the motion ends before.
    pub max_iterations: u32,
    /// The motion (see the report) at which the set has converged. 0 makes all steps; a negative number, the default,
    /// takes 0.0005.
    pub tolerance: f64,
    /// Parts samples that coincide, or lie on the edges of triangles; used for nothing else.
    pub seed: u64,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
}

options!(azulejo_dcr_surface_options requires max_iterations {
    max_iterations: 100,
    tolerance: -1.0,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

impl azulejo_dcr_surface_options {
    fn request(&self) -> Options {
        let default = Options::default();
        let tolerance = if self.tolerance < 0.0 { default.tolerance } else { self.tolerance };
        Options::default().max_iterations(self.max_iterations).tolerance(tolerance).seed(self.seed)
    }
}

/// What a relaxation on a surface did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_surface_report {
    /// The steps made.
    pub iterations: u32,
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    pub stopped: i32,
    /// Half of how far samples got over the last 10 steps, root mean square, in units of d_max.
    pub motion: f64,
    /// The smallest straight distance between two of the samples, whether or not they are near on the surface, which is no
    /// less than it was; infinite for less than two samples.
    pub smallest_distance: f64,
    /// The smallest distance in units of d_max: 0.77 for a maximal set; for a relaxed one 0.85 on the bunny, 0.84 on the dragon,
    /// and less, 0.75, where there are thin blades: parts nearer to each other than samples are.
    pub rho: f64,
    /// Zeros, for later versions.
    pub reserved: [u32; 6],
}

impl From<Report> for azulejo_dcr_surface_report {
    fn from(Report { iterations, stopped, motion, smallest_distance, rho, .. }: Report) -> Self {
        Self { iterations, stopped: reason(stopped), motion, smallest_distance, rho, reserved: [0; 6] }
    }
}

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_surface_options_init(
    options: *mut azulejo_dcr_surface_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// Relaxes samples of a mesh: they walk on the surface, away from neighbours that are too close and into holes, until the
/// motion ends or the steps do (the future work of thesis chapter 4). Neighbours are near on the surface, not on the other
/// side of a thin wall. Triangles are connected by edges between the same places; any other edge is a border, which samples
/// do not cross. O(count) time for each step, and O(triangles * log triangles) once.
///
/// No two samples get nearer to each other than the nearest two were, on whatever sides of walls and borders: straight
/// distances, in double arithmetic on the positions, without tolerance, after any number of steps. Barycentrics outside
/// their triangle count as brought into it.
///
/// A call that its progress callback cancels succeeds: it returns the samples after the last whole step, and
/// AZULEJO_STOPPED_CANCELLED in the report.
///
/// triangles, barycentrics: a triangle and the barycentrics u v of each of `count` samples, as azulejo_points_triangles and
/// azulejo_points_barycentrics give them.
///
/// out: the samples after the last step, in the same order, with normals, triangles and barycentrics, to be freed with
/// azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for triangles that the mesh does not have, without area, or left out by
/// its mask, and for barycentrics outside the triangle by more than 1e-6; AZULEJO_ERROR_TOO_LARGE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_surface(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
    options: *const azulejo_dcr_surface_options,
    triangles: *const u32,
    barycentrics: *const f32,
    count: usize,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: Option<&mut MaybeUninit<azulejo_dcr_surface_report>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        let mesh = required("mesh", mesh)?.shared.clone();
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
        // SAFETY: likewise.
        let triangles = unsafe { rows::<u32, 1>("triangles", triangles, "count", count) }?.as_flattened();
        // SAFETY: likewise.
        let barycentrics = unsafe { rows::<f32, 2>("barycentrics", barycentrics, "count", count) }?;
        let watch = Watch::new(options.progress, options.progress_user);
        let (relaxed, done) = context.run(watch, |context, progress| {
            surface::relax(context, &mesh, triangles, barycentrics, &options.request(), progress)
        })?;
        report.map(|report| report.write(done.into()));
        Ok(azulejo_points::surface(relaxed))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Options as _;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        assert_eq!(azulejo_dcr_surface_options::DEFAULT.request(), Options::default());
    }
}
