//! PSP: Poisson-disk samples on triangle meshes.

use std::ffi::c_void;
use std::sync::{RwLock, RwLockWriteGuard, TryLockError};

use azulejo_core::psp::{
    ClassOptions, DEFAULT_QUOTIENT, EditableSet, Engine, FlatOptions, Priority, ProjectionOptions, Projectors, Psp,
    RegionOptions, Report,
};
use azulejo_core::{Context, Given, Order, Points, Progress};

use crate::boundary::{self, Out, check_reserved, check_unused, flag};
use crate::context::azulejo_context;
use crate::given::given;
use crate::growing::{self, Growing, Output, growing};
use crate::handles::{self, handle};
use crate::mesh::azulejo_mesh;
use crate::order::{AZULEJO_ORDER_ANY, order};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::psp_report::azulejo_psp_report;
use crate::status::{Failure, azulejo_status};

/// A set of samples on a mesh that can grow. It keeps its context and mesh.
pub struct azulejo_psp {
    context: azulejo_context,
    watch: Watch,
    state: RwLock<State>,
}

/// The set of a handle: one that grows, until its first edit.
pub(crate) enum State {
    Growing(Psp),
    Edited(EditableSet),
    /// While one becomes the other.
    Between,
}

impl State {
    /// The set, to be edited.
    pub(crate) fn editable(&mut self) -> &mut EditableSet {
        *self = match std::mem::replace(self, Self::Between) {
            Self::Growing(psp) => Self::Edited(psp.into_editable()),
            other => other,
        };
        match self {
            Self::Edited(set) => set,
            _ => unreachable!("a panic between the two poisons the lock"),
        }
    }

    fn samples(&self) -> Points<3> {
        match self {
            Self::Growing(psp) => psp.samples(),
            Self::Edited(set) => set.samples(),
            Self::Between => unreachable!("a panic between the two poisons the lock"),
        }
    }
}

impl azulejo_psp {
    /// The set, for a call that changes it.
    pub(crate) fn lock(&self) -> Result<RwLockWriteGuard<'_, State>, Failure> {
        self.state.try_write().map_err(|error| locked(&error))
    }

    /// Runs work on the threads of the handle's context, under its watch.
    pub(crate) fn run<T>(
        &self,
        work: impl FnOnce(&Context, Option<&Progress>) -> azulejo_core::Result<T>,
    ) -> Result<T, Failure> {
        self.context.run(self.watch, work)
    }
}

handle!(azulejo_psp);

/// If two candidates of an iteration are too close, the one that its projector faces more squarely
/// is kept: the default, which finds more samples. Existing samples are always kept.
pub const AZULEJO_PRIORITY_SQUARENESS: u32 = 0;
/// The candidate of the earlier projector is kept, as in the thesis (section 3.3.2).
pub const AZULEJO_PRIORITY_PROJECTOR: u32 = 1;

/// A projector for every part of the mesh in a cube of 48 radii that faces about one direction.
pub const AZULEJO_PROJECTORS_LOCAL: u32 = 0;
/// Three orthogonal projectors for the whole mesh in each iteration (thesis section 3.3.1).
pub const AZULEJO_PROJECTORS_GLOBAL: u32 = 1;

/// Ray packets of Embree find where patterns meet the mesh.
pub const AZULEJO_ENGINE_EMBREE: u32 = 0;
/// Triangles are rasterised over the patterns (thesis section 3.4.3). With local projectors the
/// samples are Embree's, to the bit; with global ones hits differ by 2e-7 of its diagonal at most.
pub const AZULEJO_ENGINE_RASTERISER: u32 = 1;
/// The default: the rasteriser for local projectors, which took the least time on every mesh
/// measured, and for global ones Embree where there is one.
pub const AZULEJO_ENGINE_AUTO: u32 = 2;

/// The `iterations` of azulejo_psp_options that stand for a rule.
pub const AZULEJO_ITERATIONS_DEFAULT: u32 = 0xffff_ffff;

/// Options of azulejo_psp_create and azulejo_psp_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_psp_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The number of projections of patterns onto the whole mesh by azulejo_psp_sample, before it
    /// fills the gaps. AZULEJO_ITERATIONS_DEFAULT, the default: 1 where the set is made sooner with
    /// it, by a rule of mesh, radius and given samples, or if `maximal` is 0, else 0. 0 with a
    /// `maximal` of 0 is refused. azulejo_psp_create refuses any value but the default.
    pub iterations: u32,
    /// The smallest straight distance between two samples: above 0, and at least 64 float spacings;
    /// it has no default. With a `count` it must be 0.
    pub radius: f64,
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// 1, the default: azulejo_psp_sample fills all gaps. 0: it stops after the iterations, as the
    /// thesis does, and leaves some per cent of the surface uncovered; not in azulejo_psp_create.
    pub maximal: u32,
    /// An AZULEJO_PRIORITY_ constant; default squareness.
    pub priority: u32,
    /// An AZULEJO_ENGINE_ constant; default auto.
    pub engine: u32,
    /// An AZULEJO_ORDER_ constant; default any. Progressive order refuses `iterations` above 0 and
    /// a `maximal` of 0. Must be any in azulejo_psp_create.
    pub order: u32,
    /// Default NULL: the callback of the context. A psp handle keeps it for all its calls.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// The exact number of samples; default 0: as many as the radius gives. As in progressive order
    /// there are no iterations. Must be 0 in azulejo_psp_create.
    pub count: usize,
    /// 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    pub quotient: f64,
    /// Default NULL: see "Given samples" in azulejo.h.
    pub given_positions: *const f32,
    /// The clearance of each; default NULL.
    pub given_clearances: *const f64,
    /// The number of given samples; default 0.
    pub given_count: usize,
    /// Samples on triangles whose normals have a smaller cosine than this ignore each other, so
    /// that the two sides of a thin wall are sampled as if far apart; triangles must be wound
    /// consistently. From -1, the default, which turns it off, to 1, with which only samples with
    /// the same normal see each other. Given samples act on all sides. Above -1 no iterations.
    pub cosine: f64,
    /// An AZULEJO_PROJECTORS_ constant; default local.
    pub projectors: u32,
    /// Must be 0.
    pub reserved: u32,
}

growing!(azulejo_psp_options requires radius {
    iterations: AZULEJO_ITERATIONS_DEFAULT,
    radius: 0.0,
    seed: 0,
    maximal: 1,
    priority: AZULEJO_PRIORITY_SQUARENESS,
    engine: AZULEJO_ENGINE_AUTO,
    order: AZULEJO_ORDER_ANY,
    progress: None,
    progress_user: std::ptr::null_mut(),
    count: 0,
    quotient: 0.0,
    given_positions: std::ptr::null(),
    given_clearances: std::ptr::null(),
    given_count: 0,
    cosine: -1.0,
    projectors: AZULEJO_PROJECTORS_LOCAL,
    reserved: 0,
});

impl azulejo_psp_options {
    /// The request of azulejo_psp_sample.
    ///
    /// # Safety
    /// As [`given`] for the given samples.
    unsafe fn request<'a>(&self) -> Result<FlatOptions<'a>, Failure> {
        // SAFETY: handed on from the caller.
        let given = unsafe { given(self.given_positions, self.given_clearances, self.given_count) }?;
        check_reserved(self.reserved)?;
        let (order, quotient) = self.ordered()?;
        Ok(FlatOptions::new(self.radius)
            .count(self.count)
            .order(order)
            .quotient(quotient)
            .iterations(Some(self.iterations).filter(|&count| count != AZULEJO_ITERATIONS_DEFAULT))
            .maximal(flag("maximal", self.maximal)?)
            .seed(self.seed)
            .projectors(projectors(self.projectors)?)
            .priority(priority(self.priority)?)
            .engine(engine(self.engine)?)
            .given(given)
            .cosine(self.cosine))
    }

    /// The order, and its quotient, which must not be set in any order.
    fn ordered(&self) -> Result<(Order, f64), Failure> {
        let order = order(self.order)?;
        if order == Order::Any {
            check_unused("quotient", self.quotient, 0.0, "in any order")?;
        }
        Ok((order, if self.quotient == 0.0 { DEFAULT_QUOTIENT } else { self.quotient }))
    }

    /// The request of a handle, whose calls determine the iterations and the filling.
    ///
    /// # Safety
    /// As [`given`] for the given samples.
    unsafe fn request_of_handle<'a>(&self) -> Result<ProjectionOptions<'a>, Failure> {
        let (default, call) = (Self::DEFAULT, "in azulejo_psp_create");
        check_reserved(self.reserved)?;
        check_unused("iterations", self.iterations, default.iterations, call)?;
        check_unused("maximal", self.maximal, default.maximal, call)?;
        check_unused("count", self.count, default.count, call)?;
        check_unused("order", self.order, default.order, call)?;
        check_unused("quotient", self.quotient, default.quotient, "in any order")?;
        // SAFETY: handed on from the caller.
        let given = unsafe { given(self.given_positions, self.given_clearances, self.given_count) }?;
        Ok(ProjectionOptions::new(self.radius)
            .seed(self.seed)
            .projectors(projectors(self.projectors)?)
            .priority(priority(self.priority)?)
            .engine(engine(self.engine)?)
            .given(given)
            .cosine(self.cosine))
    }

    /// The request of azulejo_psp_sample_region and of azulejo_psp_sample_instances, which is the `call`.
    ///
    /// # Safety
    /// As [`given`] for the given samples.
    pub(crate) unsafe fn request_of_region<'a>(&self, call: &str) -> Result<RegionOptions<'a>, Failure> {
        self.check_filled_only(call)?;
        check_unused("order", self.order, Self::DEFAULT.order, call)?;
        check_unused("quotient", self.quotient, Self::DEFAULT.quotient, call)?;
        // SAFETY: handed on from the caller.
        let given = unsafe { given(self.given_positions, self.given_clearances, self.given_count) }?;
        Ok(RegionOptions::new(self.radius).seed(self.seed).given(given).cosine(self.cosine))
    }

    /// Refuses what has no effect in calls that fill by radius.
    fn check_filled_only(&self, call: &str) -> Result<(), Failure> {
        let default = Self::DEFAULT;
        check_unused("count", self.count, default.count, call)?;
        if self.iterations != 0 {
            check_unused("iterations", self.iterations, default.iterations, call)?;
        }
        check_unused("maximal", self.maximal, default.maximal, call)?;
        check_reserved(self.reserved)?;
        check_unused("projectors", self.projectors, default.projectors, call)?;
        check_unused("priority", self.priority, default.priority, call)?;
        check_unused("engine", self.engine, default.engine, call)
    }

    /// The request of azulejo_psp_sample_classes, with given samples that have a clearance for each class.
    pub(crate) fn request_of_classes<'a>(&self, given: Given<'a, 3>) -> Result<ClassOptions<'a>, Failure> {
        check_unused("radius", self.radius, 0.0, "beside those of the classes")?;
        self.check_filled_only("with classes")?;
        let (order, quotient) = self.ordered()?;
        Ok(ClassOptions::default().seed(self.seed).given(given).cosine(self.cosine).order(order).quotient(quotient))
    }

    pub(crate) fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }
}

fn projectors(value: u32) -> Result<Projectors, Failure> {
    match value {
        AZULEJO_PROJECTORS_LOCAL => Ok(Projectors::Local),
        AZULEJO_PROJECTORS_GLOBAL => Ok(Projectors::Global),
        other => Err(Failure::invalid("projectors", format!("{other} is no AZULEJO_PROJECTORS_ constant"))),
    }
}

fn priority(value: u32) -> Result<Priority, Failure> {
    match value {
        AZULEJO_PRIORITY_SQUARENESS => Ok(Priority::Squareness),
        AZULEJO_PRIORITY_PROJECTOR => Ok(Priority::Projector),
        other => Err(Failure::invalid("priority", format!("{other} is no AZULEJO_PRIORITY_ constant"))),
    }
}

fn engine(value: u32) -> Result<Engine, Failure> {
    match value {
        AZULEJO_ENGINE_EMBREE => Ok(Engine::Embree),
        AZULEJO_ENGINE_RASTERISER => Ok(Engine::Rasteriser),
        AZULEJO_ENGINE_AUTO => Ok(Engine::Auto),
        other => Err(Failure::invalid("engine", format!("{other} is no AZULEJO_ENGINE_ constant"))),
    }
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_options_init(
    options: *mut azulejo_psp_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Makes an empty set on a mesh. It does not report progress.
///
/// options: `iterations`, `maximal`, `count` and `order` must have their defaults.
///
/// O(triangles + given samples) time at most.
///
/// Errors: AZULEJO_ERROR_TOO_LARGE has the estimated number of samples without given ones.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_create(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_options,
    out: *mut *mut azulejo_psp,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?.clone();
        // SAFETY: handed on from the caller.
        let mesh = &unsafe { handles::get("mesh", mesh) }?.shared;
        // SAFETY: handed on from the caller.
        let options = unsafe { growing::read("options", options) }?;
        // SAFETY: handed on from the caller.
        let request = unsafe { options.request_of_handle() }?;
        let state = RwLock::new(State::Growing(Psp::new(mesh, &request)?));
        Ok(azulejo_psp { context, watch: options.watch(), state })
    })
}

/// Adds samples: projects patterns of samples onto the mesh, in each iteration along three
/// orthogonal directions of a random frame, and keeps what does not conflict with the set (thesis
/// chapter 3). Two calls add what one call with the sum of their iterations adds.
///
/// iterations: how many, 0 or more. A set that has been edited makes none. None is made, nor
/// reported, where the box of the mesh is out of all proportion to its surface: above 20 rays per
/// sample that there is room for and 10 million in all.
///
/// O((diagonal of the mesh / radius)^2 + hits) time for each iteration, and for the first one
/// O(triangles * log triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a `cosine` above -1; AZULEJO_ERROR_EMBREE;
/// AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can still grow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_advance(
    psp: *mut azulejo_psp,
    iterations: u32,
    report: *mut azulejo_psp_report,
) -> azulejo_status {
    let advance = |state: &mut State, psp: &azulejo_psp| match state {
        State::Growing(growing) => psp.run(|context, progress| growing.advance(context, iterations, progress)),
        _ => Err(Failure::invalid("psp", "has been edited, and makes no more iterations")),
    };
    // SAFETY: handed on from the caller.
    unsafe { change(psp, report, advance) }
}

/// Makes the set maximal: finds the parts of the surface that are farther than the radius from
/// every sample and throws darts into them until there is none. A set that has been edited is
/// filled as by azulejo_psp_refill, with the seed of its options.
///
/// O(samples + triangles) time, more for parts that darts hit rarely.
///
/// Errors: AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can still grow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_fill(psp: *mut azulejo_psp, report: *mut azulejo_psp_report) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let fill = |state: &mut State, psp: &azulejo_psp| match state {
        State::Growing(growing) => psp.run(|context, progress| growing.fill(context, progress)),
        _ => {
            let set = state.editable();
            psp.run(|context, progress| set.refill(context, set.seed(), progress)).map(|(_, report)| report)
        }
    };
    // SAFETY: handed on from the caller.
    unsafe { change(psp, report, fill) }
}

/// Copies the set with normals, triangles and barycentrics, an edited one by ids. O(samples).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_points(psp: *const azulejo_psp, out: *mut *mut azulejo_points) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let state = unsafe { handles::get("psp", psp) }?.state.try_read().map_err(|error| locked(&error))?;
        Ok(azulejo_points::space(state.samples()))
    })
}

/// Frees the handle. Not from its own progress callback.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_free(psp: *mut azulejo_psp) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("psp", psp) };
}

/// Samples a mesh in one call: azulejo_psp_create, azulejo_psp_advance by `iterations` and, if
/// `maximal` is 1, azulejo_psp_fill, whose complexity and errors it has.
///
/// With a `count` the set has exactly so many samples: no two are closer than `radius` in the
/// report, and every place is within its `covering_radius` of one, mostly less than 1.1 times that
/// radius. It takes about twice the time of a set of known radius.
///
/// In progressive order the samples are sorted coarse to fine, from a single one on. A set with a
/// smaller count is a prefix of one with a larger count, bit for bit, for the same mesh, quotient
/// and seed: levels of detail nest. Sets of two radii share all samples with ranks of at least
/// `quotient` times the larger radius, of the first 100 those of at least 2.25 times it. It takes
/// several times as long as a set in any order, more with many triangles per sample: each of the
/// log(diagonal / radius) / log(quotient) levels visits all.
///
/// out: the samples with normals, triangles and barycentrics.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a `count` that is more than floats can carry.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_psp_report,
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
        // SAFETY: handed on from the caller.
        let request = unsafe { options.request() }?;
        let (samples, done) =
            context.run(options.watch(), |context, progress| request.sample(context, &mesh, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(samples))
    })
}

/// A call that adds samples to the set.
///
/// # Safety
/// As [`handles::get`] for `psp` and [`Output::optional`] for `report`.
unsafe fn change(
    psp: *mut azulejo_psp,
    report: *mut azulejo_psp_report,
    step: impl FnOnce(&mut State, &azulejo_psp) -> Result<Report, Failure>,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller. A shared reference, because two calls may meet; the lock parts them.
        let (psp, report) = unsafe { (handles::get("psp", psp.cast_const())?, Output::optional("report", report)?) };
        let done = step(&mut *psp.lock()?, psp)?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(())
    })
}

fn locked<T>(error: &TryLockError<T>) -> Failure {
    handles::locked("psp", error)
}
