//! Densities on meshes: samples that are denser here than there.

use std::ffi::c_void;

use azulejo_core::psp::adaptive::{self, Density, Radius, Scale, Texture};

use crate::adaptive::azulejo_psp_adaptive_options;
use crate::boundary::{Out, check_pointer, check_reserved, check_unused, flag, rows};
use crate::classes::{azulejo_classes, azulejo_classes_report};
use crate::context::azulejo_context;
use crate::growing::{self, Output, growing};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::of_position::OfPosition;
use crate::points::azulejo_points;
use crate::psp::azulejo_psp_options;
use crate::psp_classes::ClassCall;
use crate::psp_report::azulejo_psp_report;
use crate::status::{Failure, azulejo_status};

/// Gives the density at a position of a mesh, at least 0. See "Callbacks" in azulejo.h; with
/// `at_vertices` it is called once for each vertex, on the thread that made the call.
///
/// user: the `function_user` of the azulejo_mesh_density.
///
/// position: x y z of a place on the mesh.
pub type azulejo_mesh_density_fn = Option<unsafe extern "C-unwind" fn(user: *mut c_void, position: *const f64) -> f64>;

/// The number of samples of a mesh per unit of area, from place to place: at least 0, and not 0
/// everywhere. One of `vertex_values`, `function` and `image` must be set, and one of `radius` and
/// `count`, but neither in a relaxation; what is not set has its default, NULL or 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_mesh_density {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// 1: `function` is called at the vertices only, and interpolated on the triangles. Default 0.
    pub at_vertices: u32,
    /// A density for each vertex of the mesh, interpolated on the triangles.
    pub vertex_values: *const f32,
    /// The number of vertices.
    pub vertex_count: usize,
    /// Gives the density at a position.
    pub function: azulejo_mesh_density_fn,
    /// Passed to `function`.
    pub function_user: *mut c_void,
    /// The largest value of `function`, above 0. Must be 0 with `at_vertices`.
    pub largest: f64,
    /// The most by which `function` changes per unit of distance between two places of a triangle,
    /// at least 0, as in azulejo_psp_adaptive_options. Where the density is 0, or nearly so, over
    /// many times the radius beside it, the call is refused as too much: use `at_vertices` there.
    /// Must be 0 where `largest` must.
    pub slope: f64,
    /// An image that is laid on the mesh by texture coordinates, linear between the centres of its
    /// pixels, and repeated: `height` rows of `width` densities, the first along v = 0.
    pub image: *const f32,
    /// The number of pixels in a row, from u = 0 to 1.
    pub width: usize,
    /// The number of rows.
    pub height: usize,
    /// Texture coordinates of an image, u v each, at most 1e6 in absolute value: one for each
    /// vertex, or one for each corner of each triangle.
    pub texture: *const f32,
    /// That of the vertices or of the corners.
    pub texture_count: usize,
    /// 1: by corners, so that those along a seam differ. Default 0.
    pub by_corners: u32,
    /// Must be 0.
    pub reserved: u32,
    /// The radius at density 1, above 0: that of a maximal set. At d it is this over sqrt(d).
    pub radius: f64,
    /// About how many samples the whole set has, above 0: fewer where parts of the surface are
    /// nearer to each other than the radius, and some more along boundaries. In progressive order
    /// there are exactly so many, and it must be a whole number.
    pub count: f64,
}

growing!(azulejo_mesh_density requires count {
    at_vertices: 0,
    vertex_values: std::ptr::null(),
    vertex_count: 0,
    function: None,
    function_user: std::ptr::null_mut(),
    largest: 0.0,
    slope: 0.0,
    image: std::ptr::null(),
    width: 0,
    height: 0,
    texture: std::ptr::null(),
    texture_count: 0,
    by_corners: 0,
    reserved: 0,
    radius: 0.0,
    count: 0.0,
});

impl azulejo_mesh_density {
    /// Hands the density, as what a radius follows from, to `body`.
    ///
    /// # Safety
    /// Unless the checks fail, the arrays have the lengths that are said of them and are not changed during the call.
    unsafe fn with<T>(&self, body: impl FnOnce(Radius) -> Result<T, Failure>) -> Result<T, Failure> {
        let scale = match (self.radius == 0.0, self.count == 0.0) {
            (true, true) => return Err(Failure::invalid("radius", "is 0, and count too; one of them is needed")),
            (false, false) => return Err(Failure::invalid("count", "is set, and radius too; one of them must be 0")),
            (false, true) => Scale::Radius(self.radius),
            (true, false) => Scale::Count(self.count),
        };
        // SAFETY: handed on from the caller.
        unsafe { self.with_density(|density| body(Radius::Density { density, scale })) }
    }

    /// Hands the density to `body`, where neither radius nor count is asked for.
    ///
    /// # Safety
    /// As for [`with`](Self::with).
    pub(crate) unsafe fn without_scale<T>(
        &self,
        body: impl FnOnce(Density) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        for (field, value) in [("radius", self.radius), ("count", self.count)] {
            check_unused(field, value, 0.0, "in a relaxation")?;
        }
        // SAFETY: handed on from the caller.
        unsafe { self.with_density(body) }
    }

    /// # Safety
    /// As for [`with`](Self::with).
    unsafe fn with_density<T>(&self, body: impl FnOnce(Density) -> Result<T, Failure>) -> Result<T, Failure> {
        check_reserved(self.reserved)?;
        let (at_vertices, by_corners) = (flag("at_vertices", self.at_vertices)?, flag("by_corners", self.by_corners)?);
        let sources = [!self.vertex_values.is_null(), self.function.is_some(), !self.image.is_null()];
        if sources.into_iter().filter(|&is_set| is_set).count() != 1 {
            let which = "one of vertex_values, function and image is needed, and not more than one";
            return Err(Failure::invalid("vertex_values", which));
        }
        if !sources[0] {
            check_unused("vertex_count", self.vertex_count, 0, "without vertex_values")?;
        }
        let has_slope = sources[1] && !at_vertices;
        if !has_slope {
            let reason = if at_vertices { "with at_vertices" } else { "without function" };
            check_unused("largest", self.largest, 0.0, reason)?;
            check_unused("slope", self.slope, 0.0, reason)?;
        }
        if !sources[1] {
            check_unused("at_vertices", self.at_vertices, 0, "without function")?;
        }
        if !sources[2] {
            for (field, value) in
                [("width", self.width), ("height", self.height), ("texture_count", self.texture_count)]
            {
                check_unused(field, value, 0, "without image")?;
            }
            check_unused("by_corners", self.by_corners, 0, "without image")?;
        }
        if let Some(function) = self.function {
            // SAFETY: the caller's word.
            let function = unsafe { OfPosition::new(function, self.function_user) };
            let at = |position| function.call(position);
            return body(if at_vertices {
                Density::AtVertices(&at)
            } else {
                Density::Function { at: &at, largest: self.largest, slope: self.slope }
            });
        }
        if sources[0] {
            // SAFETY: the caller's word.
            let values =
                unsafe { rows::<f32, 1>("vertex_values", self.vertex_values, "vertex_count", self.vertex_count)? };
            return body(Density::PerVertex(values.as_flattened()));
        }
        let (width, height, count) = (self.width, self.height, self.texture_count);
        let too_large = || Failure::too_large("width", format!("{width} by {height} pixels exceed the address space"));
        let pixels = width.checked_mul(height).ok_or_else(too_large)?;
        check_pointer("texture", self.texture)?;
        // SAFETY: the caller's word.
        let (values, places) = unsafe {
            (
                rows::<f32, 1>("image", self.image, "width", pixels)?.as_flattened(),
                rows::<f32, 2>("texture", self.texture, "texture_count", count)?,
            )
        };
        let texture = if by_corners {
            let (triangles, rest) = places.as_chunks::<3>();
            if !rest.is_empty() {
                return Err(Failure::invalid("texture_count", format!("{count} is not a multiple of 3")));
            }
            Texture::PerCorner(triangles)
        } else {
            Texture::PerVertex(places)
        };
        body(Density::Image { values, width, height, texture })
    }
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_density_init(
    density: *mut azulejo_mesh_density,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("density", density, struct_size) }
}

/// Makes a maximal set of samples on a mesh with a density: azulejo_psp_adaptive_sample, where the
/// radius at a density d is that at density 1 over sqrt(d). What is said there holds for the radii
/// that are returned. Where the density falls to 0 within a few radii, radii are limited to four
/// times the least one on a piece of the surface of about that length.
///
/// In progressive order ranks are radii at density 1, and so are both radii of the report. Sets of
/// smaller counts are prefixes, bit for bit but for the radii, which are those of each set. A set
/// with a radius shares all samples with ranks of at least `quotient` times that radius, of the
/// first 100 those of at least 2.25 times it.
///
/// options: vertex_radii and radius_function must be NULL, and what belongs to them 0.
///
/// out: the samples with normals, triangles, barycentrics and radii.
///
/// O(samples + triangles) time for densities that change slowly.
///
/// Errors: as of azulejo_psp_adaptive_sample, for densities and `largest`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_adaptive_with_density(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_adaptive_options,
    density: *const azulejo_mesh_density,
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
        let (options, density): (azulejo_psp_adaptive_options, azulejo_mesh_density) =
            unsafe { (growing::read("options", options)?, growing::read("density", density)?) };
        // SAFETY: likewise.
        let report = unsafe { Output::optional("report", report)? };
        options.check_without_radii()?;
        let sample = |radius: Radius| {
            // SAFETY: handed on from the caller.
            let request = unsafe { options.request(radius) }?;
            context.run(options.watch(), |context, progress| adaptive::sample(context, &mesh, &request, progress))
        };
        // SAFETY: handed on from the caller.
        let (set, done) = unsafe { density.with(sample) }?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(set))
    })
}

/// Samples a mesh with several classes and a density: azulejo_psp_sample_classes, where the radii
/// of the classes are multiples of the local radius of azulejo_psp_adaptive_with_density. Two
/// samples of classes i and j are at least r_ij times the mean of their local radii apart, and for
/// each class every place is nearer than that to some sample. So all classes follow the density,
/// with the shares that they have without one. Where it jumps, larger classes, which come first,
/// leave fewer samples of smaller ones.
///
/// options: as in azulejo_psp_sample_classes; given samples need clearances, which are lengths. In
/// progressive order ranks, over the own radius of the class, are factors of all local radii.
///
/// density: with `radius` 1 the radii of the classes are those at density 1; a `count` is about
/// that of a class of radius 1 by itself, in any order.
///
/// out: as of azulejo_psp_sample_classes, and with the local radii.
///
/// Errors: those of both calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_classes_with_density(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_options,
    classes: *const azulejo_classes,
    density: *const azulejo_mesh_density,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_classes_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let call = unsafe { ClassCall::read(context, mesh, options, classes, report) }?;
        // SAFETY: likewise.
        let density: azulejo_mesh_density = unsafe { growing::read("density", density) }?;
        // SAFETY: likewise.
        unsafe { density.with(|unit| call.sample(Some(unit))) }
    })
}
