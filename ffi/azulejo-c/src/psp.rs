//! PSP: Poisson-disk samples on triangle meshes.

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr::NonNull;
use std::sync::{RwLock, TryLockError};

use azulejo_core::psp::{self, Engine, Priority, Psp, Report};
use azulejo_core::{Context, Progress};

use crate::boundary::{self, flag, required};
use crate::context::azulejo_context;
use crate::mesh::azulejo_mesh;
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::{AZULEJO_ERROR_INTERNAL, Failure, azulejo_status};

/// A set of samples on a mesh that grows. It keeps its context and its mesh, which may be freed before it.
///
/// One call at a time may change it; a call that comes in between, from another thread or from the progress callback,
/// is refused. Several threads at once may take its points.
pub struct azulejo_psp {
    context: azulejo_context,
    watch: Watch,
    state: RwLock<Psp>,
}

/// Where two candidates of an iteration are too close, that one comes first that its projector faces more squarely: the
/// default, which finds more samples. Existing samples come before all candidates.
pub const AZULEJO_ORDER_SQUARENESS: i32 = 0;
/// The candidate of the earlier projector comes first, as in the thesis (§3.3.2). Existing samples come before all.
pub const AZULEJO_ORDER_PROJECTOR: i32 = 1;

/// Embree's ray packets find where patterns meet the mesh: the default.
pub const AZULEJO_ENGINE_EMBREE: i32 = 0;
/// Triangles are drawn over the patterns in exact integer arithmetic (thesis §3.4.3): other machines and other Embrees
/// find the same. The hits are those of Embree but for rounding, which moves points and edges against each other by up
/// to 2e-7 of the mesh's diagonal: a point that near to an edge may hit the triangle on its other side.
pub const AZULEJO_ENGINE_RASTERISER: i32 = 1;

/// Options of azulejo_psp_create and azulejo_psp_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_psp_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// How often azulejo_psp_sample projects its patterns before it fills the gaps, 3 directions each time. More
    /// iterations leave less to the filling, which costs more per sample. The default is the fastest.
    pub iterations: u32,
    /// The smallest straight distance between two samples, in the units of the mesh. Above 0; there is no default.
    pub radius: f64,
    /// Any number; another seed gives another set.
    pub seed: u64,
    /// 1, the default: azulejo_psp_sample fills all gaps. 0: it stops after the iterations, as the thesis does, with
    /// some per cent of the surface uncovered.
    pub maximal: i32,
    /// Must be 0.
    pub reserved: u32,
    /// Called during the calls, unless NULL, which is the default. A psp handle keeps it for all its calls.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
    /// An AZULEJO_ORDER_ constant; by squareness by default.
    pub order: i32,
    /// An AZULEJO_ENGINE_ constant; Embree by default.
    pub engine: i32,
}

options!(azulejo_psp_options requires radius {
    iterations: psp::DEFAULT_ITERATIONS,
    radius: 0.0,
    seed: 0,
    maximal: 1,
    reserved: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    order: AZULEJO_ORDER_SQUARENESS,
    engine: AZULEJO_ENGINE_EMBREE,
});

impl azulejo_psp_options {
    fn request(&self) -> Result<psp::Options, Failure> {
        if self.reserved != 0 {
            return Err(Failure::invalid("reserved", format!("{} is not 0", self.reserved)));
        }
        Ok(psp::Options::new(self.radius)
            .iterations(self.iterations)
            .maximal(flag("maximal", self.maximal)?)
            .seed(self.seed)
            .priority(priority(self.order)?)
            .engine(engine(self.engine)?))
    }

    fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }
}

fn priority(value: i32) -> Result<Priority, Failure> {
    match value {
        AZULEJO_ORDER_SQUARENESS => Ok(Priority::Squareness),
        AZULEJO_ORDER_PROJECTOR => Ok(Priority::Projector),
        other => Err(Failure::invalid("order", format!("{other} is no AZULEJO_ORDER_ constant"))),
    }
}

fn engine(value: i32) -> Result<Engine, Failure> {
    match value {
        AZULEJO_ENGINE_EMBREE => Ok(Engine::Embree),
        AZULEJO_ENGINE_RASTERISER => Ok(Engine::Rasteriser),
        other => Err(Failure::invalid("engine", format!("{other} is no AZULEJO_ENGINE_ constant"))),
    }
}

/// What a call did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_psp_report {
    /// The samples of the set after the call.
    pub samples: u64,
    /// The samples that the call added.
    pub accepted: u64,
    /// The rays that it traced: those that meet the mesh's box. With the rasteriser, the points of its tiles (at most 48
    /// radii wide) that have triangles near them.
    pub rays: u64,
    /// The places where they met the mesh.
    pub hits: u64,
    /// The hits that were lost to an earlier one on the same ray.
    pub restart_conflicts: u64,
    /// The darts that it threw into uncovered surface.
    pub darts: u64,
    /// The hits and darts that were lost to other samples.
    pub conflicts: u64,
    /// Wall time.
    pub seconds: f64,
    /// The iterations of projection that it made.
    pub iterations: u32,
    /// Zero, for later versions.
    pub reserved: u32,
    /// The part of the time in which patterns and, for Embree, the scene were made: in the first iteration of a set.
    pub prepare_seconds: f64,
    /// The part of the time in which the hits were found.
    pub project_seconds: f64,
    /// The part of the time in which samples were chosen among the hits.
    pub merge_seconds: f64,
    /// The part of the time in which uncovered surface was searched and filled.
    pub fill_seconds: f64,
    /// The relative radius of the set after the call, radius / d_max: d_max = sqrt(2 A / (sqrt(3) N)) would be the distance
    /// of N neighbours in hexagonal order on the area A. 0.78 for a maximal set; 0 for no samples. The smallest distance
    /// is taken to be the radius; that of a large set is less than a millionth above.
    pub rho: f64,
    /// If the call filled, the share of the area that was uncovered before, else -1. It is an estimate from above, two or
    /// three times too large: the area of the small fragments that no single sample covers when the search comes to them.
    pub uncovered_before: f64,
    /// If the call filled, the share of the area that is uncovered after, which is 0, else -1.
    pub uncovered_after: f64,
}

impl From<Report> for azulejo_psp_report {
    fn from(report: Report) -> Self {
        Self {
            samples: report.samples,
            accepted: report.accepted,
            rays: report.rays,
            hits: report.hits,
            restart_conflicts: report.restart_conflicts,
            darts: report.darts,
            conflicts: report.conflicts,
            seconds: report.seconds,
            iterations: report.iterations,
            reserved: 0,
            prepare_seconds: report.prepare_seconds,
            project_seconds: report.project_seconds,
            merge_seconds: report.merge_seconds,
            fill_seconds: report.fill_seconds,
            rho: report.rho,
            uncovered_before: report.uncovered_before.unwrap_or(-1.0),
            uncovered_after: report.uncovered_after.unwrap_or(-1.0),
        }
    }
}

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_options_init(
    options: *mut azulejo_psp_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// Makes an empty set on a mesh.
///
/// options: `iterations` and `maximal` play no part here, but are checked.
///
/// out: the handle, to be freed with azulejo_psp_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also where floats are too coarse to carry the radius (their spacing at the
/// largest coordinate is above radius / 64); AZULEJO_ERROR_TOO_LARGE with the estimated count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_create(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
    options: *const azulejo_psp_options,
    out: Option<&mut MaybeUninit<Box<azulejo_psp>>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?.clone();
        let mesh = &required("mesh", mesh)?.shared;
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
        let state = RwLock::new(Psp::new(mesh, &options.request()?)?);
        Ok(azulejo_psp { context, watch: options.watch(), state })
    })
}

/// Adds samples: projects patterns of samples onto the mesh, each iteration in three orthogonal directions of a random
/// frame, and keeps what is in no conflict with the set (thesis chapter 3). Samples are only ever added, in time that
/// grows with the hits and with the squared diagonal of the mesh over the squared radius. The first call prepares the
/// mesh for the engine. Two calls add what one call with the sum of their iterations adds.
///
/// Where the box of the mesh is out of all proportion to its surface, as for small parts far apart (more than 20 rays
/// for each sample that there is room for, and 10 million rays at all), the call does nothing and reports no iteration:
/// azulejo_psp_fill is much faster there.
///
/// The same calls give the same bytes on one machine; with another version of Embree or another instruction set the last
/// bits of a hit may differ, and with them which of two candidates is taken.
///
/// iterations: how often; 0 does nothing.
///
/// report: what this call did, or NULL.
///
/// Errors: AZULEJO_ERROR_EMBREE; AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can grow on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_advance(
    psp: Option<NonNull<azulejo_psp>>,
    iterations: u32,
    report: Option<&mut MaybeUninit<azulejo_psp_report>>,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { change(psp, report, |state, context, progress| state.advance(context, iterations, progress)) }
}

/// Makes the set maximal: finds the parts of the surface that are farther than the radius from every sample and throws
/// darts into them until none is left.
///
/// report: what this call did, or NULL.
///
/// Errors: AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can grow on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_fill(
    psp: Option<NonNull<azulejo_psp>>,
    report: Option<&mut MaybeUninit<azulejo_psp_report>>,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { change(psp, report, Psp::fill) }
}

/// Copies the set as it is now.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_psp_points(
    psp: Option<&azulejo_psp>,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
) -> azulejo_status {
    boundary::create(out, || {
        let state = required("psp", psp)?.state.try_read().map_err(|error| locked(&error))?;
        Ok(azulejo_points::surface(state.samples()))
    })
}

/// Frees the set, but not the points taken from it. Not to be called from its own progress callback. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_psp_free(psp: Option<Box<azulejo_psp>>) {
    boundary::free(psp);
}

/// Samples a mesh in one call: azulejo_psp_create, azulejo_psp_advance by `iterations` and, if `maximal` is 1,
/// azulejo_psp_fill, with one progress for all.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: those of the three.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
    options: *const azulejo_psp_options,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: Option<&mut MaybeUninit<azulejo_psp_report>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        let mesh = required("mesh", mesh)?.shared.clone();
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
        let request = options.request()?;
        let (samples, done) =
            context.run(options.watch(), |context, progress| psp::sample(context, &mesh, &request, progress))?;
        report.map(|report| report.write(done.into()));
        Ok(azulejo_points::surface(samples))
    })
}

/// A call that adds samples to the set.
///
/// # Safety
/// `psp` is NULL or a handle that lives as long as the call.
unsafe fn change(
    psp: Option<NonNull<azulejo_psp>>,
    report: Option<&mut MaybeUninit<azulejo_psp_report>>,
    step: impl FnOnce(&mut Psp, &Context, Option<&Progress>) -> azulejo_core::Result<Report>,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: the caller's word. A shared reference, because two calls may meet; the lock parts them.
        let psp = unsafe { required("psp", psp)?.as_ref() };
        let mut state = psp.state.try_write().map_err(|error| locked(&error))?;
        let done = psp.context.run(psp.watch, |context, progress| step(&mut state, context, progress))?;
        report.map(|report| report.write(done.into()));
        Ok(())
    })
}

fn locked<T>(error: &TryLockError<T>) -> Failure {
    match error {
        TryLockError::WouldBlock => Failure::invalid("psp", "is in use by another call"),
        TryLockError::Poisoned(_) => {
            Failure::new(AZULEJO_ERROR_INTERNAL, "psp: an internal error broke the set off; it can only be freed")
        }
    }
}
