//! Adaptive sampling: Poisson-disk samples on triangle meshes whose radius varies.

use std::ffi::c_void;
use std::mem::MaybeUninit;

use azulejo_core::psp::adaptive::{self, Radius};

use crate::boundary::{self, required, rows};
use crate::context::azulejo_context;
use crate::mesh::azulejo_mesh;
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::psp::azulejo_psp_report;
use crate::status::{Failure, azulejo_status};

/// Gives the radius at a place.
///
/// It is called from several threads at once, the library's own; only where the context has one thread it is called on
/// the thread that made the call. It must give the same radius for the same place, must return (an exception
/// that leaves it ends the process, a longjmp is undefined), and must not call the library with the same context.
///
/// user: the radius_user of the options.
///
/// position: x y z of a place on the mesh; for a sample, the floats that are returned.
///
/// Returns the radius, from `smallest` to `largest`.
pub type azulejo_radius_fn = Option<unsafe extern "C-unwind" fn(user: *mut c_void, position: *const f64) -> f64>;

/// Options of azulejo_psp_sample_adaptive. Either `vertex_radii` or `radius` is to be set.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_adaptive_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved: u32,
    /// A radius for each vertex of the mesh, above 0. At the barycentrics u v of a sample on the triangle (a, b, c) the
    /// radius is (1 - u - v) * a + u * b + v * c, in double arithmetic. It may change as steeply as it likes. NULL, the
    /// default, where `radius` is set.
    pub vertex_radii: *const f32,
    /// How many vertex_radii there are: as many as vertices of the mesh.
    pub vertex_count: usize,
    /// Gives the radius at a place, unless NULL, which is the default.
    pub radius: azulejo_radius_fn,
    /// Handed to `radius`.
    pub radius_user: *mut c_void,
    /// The least that `radius` gives, above 0. There is no default; not used with vertex_radii.
    pub smallest: f64,
    /// The largest that `radius` gives. There is no default; not used with vertex_radii.
    pub largest: f64,
    /// How much `radius` changes at most per unit of distance between two places of a triangle; 0, the default, says
    /// that it is constant there. What is covered is proved with it, so it must hold: a violation that is seen makes the
    /// call fail, one that is not can leave gaps. From about 1 on the work grows with its square; vertex_radii, which
    /// carry their own slopes, are the better choice for images and other data with edges. From about 30 on it may be too
    /// much, which is refused. At most `smallest` / 24 per float spacing at the largest coordinate of the mesh. Not used
    /// with vertex_radii.
    pub slope: f64,
    /// Samples on triangles whose normals have a smaller cosine than this ignore each other, so that the two sides of a
    /// thin wall are sampled as if they were far apart; the triangles must be wound consistently. From -1, the default,
    /// which is off, to 1, where only samples with the same normal see each other.
    pub cosine: f64,
    /// Any number; another seed gives another set.
    pub seed: u64,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
}

options!(azulejo_adaptive_options requires slope {
    reserved: 0,
    vertex_radii: std::ptr::null(),
    vertex_count: 0,
    radius: None,
    radius_user: std::ptr::null_mut(),
    smallest: 0.0,
    largest: 0.0,
    slope: 0.0,
    cosine: -1.0,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// The caller's function with what it is given, where the core can call it.
struct Callback {
    function: unsafe extern "C-unwind" fn(*mut c_void, *const f64) -> f64,
    user: *mut c_void,
}

// SAFETY: the caller's word, as the type of the function says: it may be called from several threads at once.
unsafe impl Sync for Callback {}

impl Callback {
    fn call(&self, position: [f64; 3]) -> f64 {
        // SAFETY: the caller gave the two for each other, to be called during this call.
        unsafe { (self.function)(self.user, position.as_ptr()) }
    }
}

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_adaptive_options_init(
    options: *mut azulejo_adaptive_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// Makes a maximal set of samples on a mesh, each with a radius of its own (thesis section 3.4.4).
///
/// Conflict-free: two samples are no closer than the mean of their radii, in double arithmetic on the returned positions
/// and radii. Maximal: no place of the surface is farther from every sample than the mean of the two radii, up to 6
/// times the spacing of floats at the largest coordinate and what the radius changes on that way; with vertex_radii also
/// 2^-22 of the largest difference of two radii on a triangle. Where the radius changes little from sample to sample
/// there are 0.6966 / radius^2 samples on an area of 1. Radii above four times the diagonal of the mesh's box are taken
/// as that, those of vertices before they are interpolated.
///
/// The same options give the same bytes. Embree is not used. Time grows with samples and triangles.
///
/// out: the samples with normals, triangles, barycentrics and radii, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL; iterations, rays and hits are 0.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for radii that are not positive and finite or below 64 times the spacing
/// of floats at the largest coordinate, and where `radius` gives what is not in `smallest` to `largest` or changes
/// faster than `slope`; AZULEJO_ERROR_TOO_LARGE with the estimated count, or for radii that change so fast that it takes
/// thousands of looks per sample to find out what is covered; AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample_adaptive(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
    options: *const azulejo_adaptive_options,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: Option<&mut MaybeUninit<azulejo_psp_report>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        let mesh = required("mesh", mesh)?.shared.clone();
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
        let callback = options.radius.map(|function| Callback { function, user: options.radius_user });
        let at = callback.as_ref().map(|callback| |position| callback.call(position));
        // SAFETY: handed on from the caller.
        let radii = unsafe { options.vertex_radii() }?;
        let azulejo_adaptive_options { smallest, largest, slope, cosine, seed, .. } = options;
        let radius = match &at {
            Some(at) => Radius::Function { at, smallest, largest, slope },
            None => Radius::PerVertex(radii),
        };
        let request = adaptive::Options::new(radius).cosine(cosine).seed(seed);
        let watch = Watch::new(options.progress, options.progress_user);
        let (set, done) =
            context.run(watch, |context, progress| adaptive::sample(context, &mesh, &request, progress))?;
        report.map(|report| report.write(done.into()));
        Ok(azulejo_points::adaptive(set))
    })
}

impl azulejo_adaptive_options {
    /// The radii of the vertices; none where `radius` is set.
    ///
    /// # Safety
    /// Unless the checks fail, `vertex_radii` leads to `vertex_count` numbers that nobody changes during `'a`.
    unsafe fn vertex_radii<'a>(&self) -> Result<&'a [f32], Failure> {
        if self.reserved != 0 {
            return Err(Failure::invalid("reserved", format!("{} is not 0", self.reserved)));
        }
        match (self.radius.is_some(), self.vertex_radii.is_null()) {
            (true, true) => Ok(&[]),
            (true, false) => Err(Failure::invalid("radius", "is set, and vertex_radii too; one of them must be NULL")),
            (false, true) => Err(Failure::invalid("radius", "is NULL, and vertex_radii too; one of them is needed")),
            // SAFETY: the caller's word.
            (false, false) => unsafe {
                Ok(rows::<f32, 1>("vertex_radii", self.vertex_radii, "vertex_count", self.vertex_count)?.as_flattened())
            },
        }
    }
}
