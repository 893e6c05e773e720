//! DCR on surfaces: relaxation of the samples of a mesh.

use std::ffi::c_void;

use azulejo_core::dcr::surface::{self, Options, Report};
use azulejo_core::psp::adaptive::Density;

use crate::boundary::{Out, rows};
use crate::context::azulejo_context;
use crate::dcr::reason;
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::mesh_density::azulejo_mesh_density;
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::azulejo_status;

/// Options of azulejo_dcr_surface_relax.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_surface_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The largest number of steps; default 100. 0: none moves, except into its triangle.
    pub max_iterations: u32,
    /// The motion (see the report) at which the set has converged; 0 makes all steps. Any negative
    /// number, such as the default -1, selects 0.0005.
    pub tolerance: f64,
    /// It parts samples that coincide or lie on edges of triangles, and draws the points onto which
    /// clustered samples are redistributed; default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// The density that samples shall have, without `radius` and `count`. Default NULL: constant.
    pub density: *const azulejo_mesh_density,
}

growing!(azulejo_dcr_surface_options requires max_iterations {
    max_iterations: 100,
    tolerance: -1.0,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    density: std::ptr::null(),
});

impl azulejo_dcr_surface_options {
    fn request(&self) -> Options {
        let default = Options::default();
        let tolerance = if self.tolerance < 0.0 { default.tolerance } else { self.tolerance };
        Options::default().max_iterations(self.max_iterations).tolerance(tolerance).seed(self.seed)
    }
}

/// The report of azulejo_dcr_surface_relax. Its d_max is that of a plane of the mesh's area.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_surface_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The steps made.
    pub iterations: u32,
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    pub stopped: u32,
    /// Always 0.
    pub reserved: u32,
    /// Half of the distance that samples moved over the last 10 steps, root mean square, in d_max.
    pub motion: f64,
    /// The smallest straight distance between two samples: never less than before the call.
    pub smallest_distance: f64,
    /// In units of d_max, with a density of its mean at both samples: about 0.77 for a maximal set,
    /// more for a relaxed one, except where parts of the mesh are nearer to each other.
    pub rho: f64,
}

growing!(azulejo_dcr_surface_report requires iterations {
    iterations: 0,
    stopped: 0,
    reserved: 0,
    motion: 0.0,
    smallest_distance: 0.0,
    rho: 0.0,
});

impl From<Report> for azulejo_dcr_surface_report {
    fn from(Report { iterations, stopped, motion, smallest_distance, rho, .. }: Report) -> Self {
        Self { iterations, stopped: reason(stopped), motion, smallest_distance, rho, ..Self::DEFAULT }
    }
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_surface_options_init(
    options: *mut azulejo_dcr_surface_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_surface_report_init(
    report: *mut azulejo_dcr_surface_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Relaxes samples on a mesh: they move on the surface, away from neighbours that are too close and
/// into holes (the future work of thesis chapter 4). Neighbours are near on the surface, not on the
/// other side of a thin wall. Triangles are connected by edges between the same two positions; any
/// other edge is a boundary, which samples do not cross.
///
/// No two samples get nearer to each other than the nearest two were before: straight distances, in
/// double arithmetic, without tolerance. More than 64 samples that are clustered are redistributed
/// before the first step, by the area of each connected part, where the same distance allows it.
/// With a density, distances are judged in the mean of its d_max at both samples, and no sample
/// ends where it is 0; they may shrink, and sets of other densities are redistributed.
///
/// triangles, barycentrics: one triangle and u v for each sample. Barycentrics outside their
/// triangle by at most 1e-6 are moved onto it; those farther outside, and triangles that have no
/// area or are left out by the mask, are refused.
///
/// out: after the last whole step, in the same order, with normals, triangles and barycentrics.
///
/// O(triangles) time once, and O(count) for each step. O(count + triangles) memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_surface_relax(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_dcr_surface_options,
    triangles: *const u32,
    barycentrics: *const f32,
    count: usize,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_dcr_surface_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let mesh = unsafe { handles::get("mesh", mesh) }?.shared.clone();
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: likewise.
        let triangles = unsafe { rows::<u32, 1>("triangles", triangles, "count", count) }?.as_flattened();
        // SAFETY: likewise.
        let barycentrics = unsafe { rows::<f32, 2>("barycentrics", barycentrics, "count", count) }?;
        let watch = Watch::new(options.progress, options.progress_user);
        let request = options.request();
        let (relaxed, done) = if options.density.is_null() {
            context.run(watch, |context, progress| {
                surface::relax(context, &mesh, triangles, barycentrics, &request, progress)
            })
        } else {
            // SAFETY: handed on from the caller.
            let density: azulejo_mesh_density = unsafe { growing::read("density", options.density) }?;
            let relax = |density: Density| {
                context.run(watch, |context, progress| {
                    surface::relax_with_density(context, &mesh, triangles, barycentrics, density, &request, progress)
                })
            };
            // SAFETY: likewise.
            unsafe { density.without_scale(relax) }
        }?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(relaxed))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        assert_eq!(azulejo_dcr_surface_options::DEFAULT.request(), Options::default());
    }
}
