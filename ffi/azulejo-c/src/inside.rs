//! The inside of meshes: questions, and maximal sets.

use std::ffi::c_void;

use azulejo_core::volume::{self, Surface};
use azulejo_core::{Interior, Order};

use crate::boundary::{Out, call, check_pointer, check_reserved, check_unused, rows, write};
use crate::context::azulejo_context;
use crate::given::given;
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::order::{AZULEJO_ORDER_ANY, order};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Samples lie anywhere inside.
pub const AZULEJO_SURFACE_OPEN: u32 = 0;
/// A maximal set of the surface comes first, and the inside is filled around it.
pub const AZULEJO_SURFACE_FIRST: u32 = 1;

/// Options of azulejo_volume_sample_inside.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_inside_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_SURFACE_ constant; default open. `first` takes a radius, and any order.
    pub surface: u32,
    /// Above 0, and at least 64 float spacings; has no default. 0 with a `count`.
    pub radius: f64,
    /// Places inside may stay open that are nearer to the surface than sqrt(3) times this many
    /// radii: 1/256 to 1/2; default 0.0625. A smaller one takes longer.
    pub tolerance: f64,
    /// Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// The exact number of samples; default 0: as many as the radius gives.
    pub count: usize,
    /// An AZULEJO_ORDER_ constant; default any.
    pub order: u32,
    /// Always 0.
    pub reserved: u32,
    /// 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    pub quotient: f64,
    /// Default NULL: see "Given samples" in azulejo.h.
    pub given_positions: *const f32,
    /// The clearance of each; default NULL.
    pub given_clearances: *const f64,
    /// Their number; default 0.
    pub given_count: usize,
    /// Only places this near the surface, at least 1/256 radius; default 0: all.
    pub thickness: f64,
}

growing!(azulejo_volume_inside_options requires radius {
    surface: AZULEJO_SURFACE_OPEN,
    radius: 0.0,
    tolerance: 0.0625,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    count: 0,
    order: AZULEJO_ORDER_ANY,
    reserved: 0,
    quotient: 0.0,
    given_positions: std::ptr::null(),
    given_clearances: std::ptr::null(),
    given_count: 0,
    thickness: 0.0,
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_inside_options_init(
    options: *mut azulejo_volume_inside_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// The report of azulejo_volume_sample_inside.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_inside_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The number of samples.
    pub samples: u64,
    /// The number of samples of the surface, which come first.
    pub surface_samples: u64,
    /// No two samples are nearer: the radius, also that of the set of a count.
    pub radius: f64,
    /// No place inside that is deeper than `depth` is farther from all samples and outside of all
    /// given ones: the radius, with a count mostly up to 1.1 times it.
    pub covering_radius: f64,
    /// Places this near to the surface, or a shell's inner border, can be open.
    pub depth: f64,
    /// Wall time in seconds.
    pub seconds: f64,
}

growing!(azulejo_volume_inside_report requires samples {
    reserved: 0, samples: 0, surface_samples: 0, radius: 0.0, covering_radius: 0.0, depth: 0.0, seconds: 0.0,
});

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_inside_report_init(
    report: *mut azulejo_volume_inside_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

impl azulejo_volume_inside_options {
    /// # Safety
    /// As [`given`] for the given samples.
    unsafe fn request<'a>(&self) -> Result<volume::InsideOptions<'a>, Failure> {
        let surface = match self.surface {
            AZULEJO_SURFACE_OPEN => Surface::Open,
            AZULEJO_SURFACE_FIRST => Surface::First,
            other => return Err(Failure::invalid("surface", format!("{other} is no AZULEJO_SURFACE_ constant"))),
        };
        let order = order(self.order)?;
        if order == Order::Any {
            check_unused("quotient", self.quotient, 0.0, "in any order")?;
        }
        check_reserved(self.reserved)?;
        let options = match self.count {
            0 => volume::InsideOptions::new(self.radius),
            count => {
                check_unused("radius", self.radius, 0.0, "beside a count")?;
                volume::InsideOptions::by_count(count)
            }
        };
        // SAFETY: handed on from the caller.
        let given = unsafe { given(self.given_positions, self.given_clearances, self.given_count) }?;
        let quotient = if self.quotient == 0.0 { options.quotient } else { self.quotient };
        let options = options.surface(surface).tolerance(self.tolerance).thickness(self.thickness).seed(self.seed);
        Ok(options.order(order).quotient(quotient).given(given))
    }
}

/// Makes a maximal, conflict-free set of samples inside a mesh that encloses something, x y z each:
/// no place inside is farther from every sample than the radius and 7 float spacings, unless it is
/// nearer to the surface, or a shell's inner border, than the report's `depth`. Holes are closed by
/// caps, about where the winding number is 1/2, which count as surface. No sample is outside but
/// those of the surface without caps, which azulejo_psp_sample makes with the same radius and seed.
/// The result has positions only. Count, order, given samples: as in azulejo_volume_sample.
///
/// O(samples) time and memory, and O(triangles * log triangles) for the first call on a mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_sample_inside(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_volume_inside_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_volume_inside_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let (context, mesh) = unsafe { (handles::get("context", context)?, handles::get("mesh", mesh)?) };
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_volume_inside_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let request = unsafe { options.request() }?;
        let watch = Watch::new(options.progress, options.progress_user);
        let (samples, made) =
            context.run(watch, |context, progress| volume::sample_inside(context, &mesh.shared, &request, progress))?;
        if let Some(report) = report {
            report.write(azulejo_volume_inside_report {
                samples: samples.len() as u64,
                surface_samples: made.surface_samples as u64,
                radius: made.radius,
                covering_radius: made.covering_radius,
                depth: made.depth,
                seconds: made.seconds,
                ..azulejo_volume_inside_report::DEFAULT
            });
        }
        Ok(azulejo_points::space(samples))
    })
}

/// 1 if an even number of triangles shares each edge of the mesh, so that it has an inside, else 0.
/// The direction of triangles does not matter, nor do intersections; vertices at one place are one.
/// O(triangles) the first time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_is_closed(mesh: *const azulejo_mesh) -> u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.is_some_and(|mesh| mesh.shared.is_closed()).into()
}

/// Writes to `inside` for each of `count` points, x y z each, 1 if it is inside the mesh, else 0.
/// Inside of a closed mesh are the points whose ray along +x crosses an odd number of triangles,
/// without rounding: meshes that share a face share no point. In any other mesh the generalised
/// winding number is at least 1/2, or at most -1/2, up to .02 if the boundary has more than 2,048
/// edges. O(triangles * log triangles) the first time, then about O(log triangles) for a point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_contains(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    positions: *const f32,
    count: usize,
    inside: *mut u8,
) -> azulejo_status {
    call(|| {
        // SAFETY: handed on from the caller.
        let (context, mesh) = unsafe { (handles::get("context", context)?, handles::get("mesh", mesh)?) };
        // SAFETY: handed on from the caller.
        let positions = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        if count > 0 {
            check_pointer("inside", inside)?;
        }
        let interior = Interior::of(&mesh.shared);
        let watch = Watch::new(None, std::ptr::null_mut());
        let found = context.run(watch, |context, progress| interior.contains_each(context, positions, progress))?;
        let found: Vec<u8> = found.into_iter().map(u8::from).collect();
        if count > 0 {
            // SAFETY: the caller has room for `count` bytes.
            unsafe { write(inside, &found) };
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        let options = azulejo_volume_inside_options { radius: 0.3, ..azulejo_volume_inside_options::DEFAULT };
        // SAFETY: there are no given samples.
        assert_eq!(unsafe { options.request() }.unwrap(), volume::InsideOptions::new(0.3));
    }
}
