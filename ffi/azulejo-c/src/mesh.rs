//! Triangle meshes: the surfaces to sample.

use std::ffi::{CStr, c_char};
use std::path::Path;
use std::sync::Arc;

use azulejo_core::mesh::Mesh;
use azulejo_core::{Context, Progress};

use crate::boundary::{Out, array, check_pointer, check_size, rows};
use crate::context::azulejo_context;
use crate::handles::{self, handle};
use crate::points::azulejo_points;
use crate::progress::Watch;
use crate::status::{AZULEJO_ERROR_OUT_OF_MEMORY, Failure, azulejo_status};

/// A checked triangle mesh: any soup, open, non-manifold, of many parts and mixed winding. It may
/// carry normals and a mask. Meshes made from one another share what they have in common.
pub struct azulejo_mesh {
    pub(crate) shared: Arc<Mesh>,
}

handle!(azulejo_mesh);

const VECTOR_SIZE: usize = size_of::<[f32; 3]>();

/// Makes a mesh from a copy of the caller's arrays.
///
/// positions: the vertices, x y z each, `stride_bytes` from one to the next.
///
/// indices: three per triangle, below `vertex_count`; triangles keep their order. Triangles without
/// area are allowed and get no samples, but at least one must have area.
///
/// O(vertices + triangles) time, and 12 bytes per vertex and per triangle. Later calls keep with
/// it, for all threads, about a byte per triangle for sets, 12 bytes per triangle and 4 per vertex
/// for relaxation and remeshing, 100 per triangle for iterations of AZULEJO_ENGINE_EMBREE.
///
/// Errors: AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 vertices or triangles or more;
/// AZULEJO_ERROR_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_create(
    positions: *const f32,
    vertex_count: usize,
    stride_bytes: usize,
    indices: *const u32,
    triangle_count: usize,
    out: *mut *mut azulejo_mesh,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let (vertices, triangles) = unsafe {
            (
                strided("positions", positions, "vertex_count", vertex_count, stride_bytes)?,
                rows::<u32, 3>("indices", indices, "triangle_count", triangle_count)?,
            )
        };
        let triangles = collect("indices", triangles.iter().copied())?;
        Ok(azulejo_mesh { shared: Arc::new(Mesh::new(vertices, triangles)?) })
    })
}

/// Loads a mesh from a file: Wavefront OBJ, PLY, STL, OFF (text) or binary glTF, by the extension
/// .obj, .ply, .stl, .off or .glb, otherwise by the first bytes. Polygons become fans of triangles,
/// in the order of the faces. Vertices keep the order of the file; STL facets have three each. Of
/// glTF the meshes of all nodes of the scene are read, placed as the nodes say. Normals of corners
/// (OBJ vn) and vertices (PLY nx ny nz, NOFF, glTF) are read, zero where there is none.
///
/// Coordinates in text or doubles, so far from the origin that floats would displace them by more
/// than a millionth of the mesh's size, are relative to azulejo_mesh_origin.
///
/// path: terminated by a NUL, in the encoding of the system, on Windows in UTF-8.
///
/// O(size of the file), on the calling thread.
///
/// Errors: AZULEJO_ERROR_IO if the file cannot be read; AZULEJO_ERROR_FORMAT if it is invalid, or
/// has a mesh that azulejo_mesh_create would refuse.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_load(path: *const c_char, out: *mut *mut azulejo_mesh) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        check_pointer("path", path)?;
        // SAFETY: not NULL; the caller ends the string with a NUL.
        let path = unsafe { CStr::from_ptr(path) };
        Ok(azulejo_mesh { shared: Arc::new(Mesh::load(system_path(path)?)?) })
    })
}

/// The path that the caller's bytes name.
#[cfg(unix)]
fn system_path(bytes: &CStr) -> Result<&Path, Failure> {
    use std::os::unix::ffi::OsStrExt;
    Ok(Path::new(std::ffi::OsStr::from_bytes(bytes.to_bytes())))
}

/// The path that the caller's UTF-8 names.
#[cfg(not(unix))]
fn system_path(utf8: &CStr) -> Result<&Path, Failure> {
    utf8.to_str().map(Path::new).map_err(|error| Failure::invalid("path", error))
}

/// Makes a mesh with the caller's normals in place of any that it has, such as those of a shaded
/// surface, for azulejo_points_interpolated_normals. They do not affect samples.
///
/// normals: of any length, x y z each, `stride_bytes` from one to the next. Where the three normals
/// of a triangle add up to zero at a sample, the sample gets the normal of the triangle.
///
/// normal_count: the number of vertices, if there are no indices.
///
/// normal_indices: three per triangle, below `normal_count`, for corners that share a vertex but
/// not its normal; NULL for one normal per vertex.
///
/// triangle_count: the number of triangles of the mesh; 0 if `normal_indices` is NULL.
///
/// O(normals + triangles).
///
/// Errors: AZULEJO_ERROR_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_with_normals(
    mesh: *const azulejo_mesh,
    normals: *const f32,
    normal_count: usize,
    stride_bytes: usize,
    normal_indices: *const u32,
    triangle_count: usize,
    out: *mut *mut azulejo_mesh,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let mesh = &unsafe { handles::get("mesh", mesh) }?.shared;
        // SAFETY: handed on from the caller.
        let vectors = unsafe { strided("normals", normals, "normal_count", normal_count, stride_bytes)? };
        let indices = if normal_indices.is_null() && triangle_count == 0 {
            None
        } else {
            check_triangle_count(mesh, triangle_count)?;
            // SAFETY: handed on from the caller.
            let indices =
                unsafe { rows::<u32, 3>("normal_indices", normal_indices, "triangle_count", triangle_count)? };
            Some(collect("normal_indices", indices.iter().copied())?)
        };
        Ok(azulejo_mesh { shared: Arc::new(Mesh::clone(mesh).with_normals(vectors, indices)?) })
    })
}

/// Makes a mesh with a mask, in place of any that it has: triangles whose entry is 0 are left out
/// but keep their numbers. The rest is sampled, bit for bit, as if they did not exist. A mask may
/// leave out everything; then a maximal set is empty.
///
/// mask: one byte per triangle: 0 leaves it out, any other value keeps it.
///
/// triangle_count: the number of triangles of the mesh.
///
/// O(triangles).
///
/// Errors: AZULEJO_ERROR_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_with_mask(
    mesh: *const azulejo_mesh,
    mask: *const u8,
    triangle_count: usize,
    out: *mut *mut azulejo_mesh,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let mesh = &unsafe { handles::get("mesh", mesh) }?.shared;
        check_triangle_count(mesh, triangle_count)?;
        // SAFETY: handed on from the caller.
        let mask = unsafe { rows::<u8, 1>("mask", mask, "triangle_count", triangle_count)? };
        let mask = collect("mask", mask.iter().map(|&[entry]| entry != 0))?;
        Ok(azulejo_mesh { shared: Arc::new(Mesh::clone(mesh).with_mask(mask)?) })
    })
}

/// Makes a mesh with its vertices moved, such as for the next frame of an animation. Triangles and
/// mask stay; normals go. With azulejo_mesh_points samples follow from one mesh to the other.
///
/// positions: the vertices, x y z each, `stride_bytes` from one to the next.
///
/// vertex_count: that of the mesh.
///
/// O(vertices + triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also if no area is left; AZULEJO_ERROR_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_deform(
    mesh: *const azulejo_mesh,
    positions: *const f32,
    vertex_count: usize,
    stride_bytes: usize,
    out: *mut *mut azulejo_mesh,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let mesh = &unsafe { handles::get("mesh", mesh) }?.shared;
        // SAFETY: handed on from the caller.
        let vertices = unsafe { strided("positions", positions, "vertex_count", vertex_count, stride_bytes)? };
        Ok(azulejo_mesh { shared: Arc::new(mesh.deformed(vertices)?) })
    })
}

/// Evaluates places of a mesh with the rounding of every sampler: places of samples of this mesh
/// give the samples, bit for bit, and on a mesh of azulejo_mesh_deform each sample goes with its
/// triangle. The result has normals, triangles and barycentrics, in the same order. O(count).
///
/// triangles, barycentrics: of each place; masked triangles, and those without area, too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_points(
    mesh: *const azulejo_mesh,
    triangles: *const u32,
    barycentrics: *const f32,
    count: usize,
    out: *mut *mut azulejo_points,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let mesh = &unsafe { handles::get("mesh", mesh) }?.shared;
        // SAFETY: handed on from the caller.
        let (triangles, barycentrics) = unsafe {
            (
                rows::<u32, 1>("triangles", triangles, "count", count)?.as_flattened(),
                rows::<f32, 2>("barycentrics", barycentrics, "count", count)?,
            )
        };
        Ok(azulejo_points::space(mesh.samples_at(triangles, barycentrics)?))
    })
}

/// 1 if the mesh carries normals besides those of its triangles, else 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_has_normals(mesh: *const azulejo_mesh) -> u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.is_some_and(|mesh| mesh.shared.has_normals()).into()
}

/// The number of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_vertex_count(mesh: *const azulejo_mesh) -> usize {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.map_or(0, |mesh| mesh.shared.positions().len())
}

/// The number of triangles, including masked ones.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_triangle_count(mesh: *const azulejo_mesh) -> usize {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.map_or(0, |mesh| mesh.shared.triangles().len())
}

/// The vertices, x y z each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_positions(mesh: *const azulejo_mesh) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.map_or(std::ptr::null(), |mesh| array(mesh.shared.positions()))
}

/// The three vertices of each triangle, counter-clockwise seen from the front.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_indices(mesh: *const azulejo_mesh) -> *const u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.map_or(std::ptr::null(), |mesh| array(mesh.shared.triangles()))
}

/// The area of all triangles that no mask leaves out. A maximal set of n samples has a radius of
/// about sqrt(0.69656 * area / n) where that is small beside the features of the surface.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_area(mesh: *const azulejo_mesh) -> f64 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mesh", mesh) }.map_or(0.0, |mesh| mesh.shared.area())
}

/// Writes to `origin`, x y z, what positions of the mesh and of its samples are relative to in the
/// frame of its file: see azulejo_mesh_load. Zero for others, and NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_origin(mesh: *const azulejo_mesh, origin: *mut f64) {
    // SAFETY: handed on from the caller.
    let found = unsafe { handles::peek("mesh", mesh) }.map_or([0.0; 3], |mesh| mesh.shared.origin());
    if !origin.is_null() {
        // SAFETY: the caller has room for three numbers there, if it is not NULL.
        unsafe { std::ptr::copy_nonoverlapping(found.as_ptr(), origin, found.len()) };
    }
}

/// Frees the mesh; its memory is released once no psp handle uses it any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_free(mesh: *mut azulejo_mesh) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("mesh", mesh) };
}

/// Refuses an array that is not as long as a mesh has triangles.
fn check_triangle_count(mesh: &Mesh, count: usize) -> Result<(), Failure> {
    let expected = mesh.triangles().len();
    if count == expected {
        Ok(())
    } else {
        Err(Failure::invalid("triangle_count", format!("{count}, but the mesh has {expected} triangles")))
    }
}

/// Vectors of the caller's, packed.
///
/// # Safety
/// Unless the checks fail, `vectors` leads to `count` of them, `stride` bytes apart.
unsafe fn strided(
    argument: &str,
    vectors: *const f32,
    count_argument: &str,
    count: usize,
    stride: usize,
) -> Result<Vec<[f32; 3]>, Failure> {
    if stride < VECTOR_SIZE || !stride.is_multiple_of(align_of::<f32>()) {
        let reason = format!("{stride} is not a multiple of 4 from {VECTOR_SIZE} on");
        return Err(Failure::invalid("stride_bytes", reason));
    }
    if count > 0 {
        check_pointer(argument, vectors)?;
    }
    check_size(count_argument, count, count.checked_mul(stride))?;
    // SAFETY: the offsets lie inside the caller's array, whose size an object can have.
    let vector = |index| unsafe { vectors.byte_add(index * stride).cast::<[f32; 3]>().read() };
    collect(argument, (0..count).map(vector))
}

/// A vector of the caller's data, for whose size the caller's word has to be taken.
pub(crate) fn collect<T>(argument: &str, rows: impl ExactSizeIterator<Item = T>) -> Result<Vec<T>, Failure> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(rows.len()).map_err(|_| {
        Failure::new(AZULEJO_ERROR_OUT_OF_MEMORY, format!("{argument}: no memory for {} elements", rows.len()))
    })?;
    vector.extend(rows);
    Ok(vector)
}

/// Samples of a mesh that are to be measured, and the context that does it.
pub(crate) struct SurfaceSet<'a> {
    context: &'a azulejo_context,
    mesh: Arc<Mesh>,
    positions: &'a [[f32; 3]],
}

impl<'a> SurfaceSet<'a> {
    /// The set of the caller's arguments, `count` samples at `positions`.
    ///
    /// # Safety
    /// Unless the checks fail, `positions` leads to `count` triples of numbers; the handles are those of the caller, as
    /// in [`handles::get`].
    pub(crate) unsafe fn read(
        context: *const azulejo_context,
        mesh: *const azulejo_mesh,
        positions: *const f32,
        count: usize,
    ) -> Result<Self, Failure> {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: likewise.
        let mesh = unsafe { handles::get("mesh", mesh) }?.shared.clone();
        // SAFETY: likewise.
        let positions = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        Ok(Self { context, mesh, positions })
    }

    /// Runs a call of the core.
    pub(crate) fn run<T>(
        &self,
        call: impl FnOnce(&Context, &Mesh, &[[f32; 3]], Option<&Progress>) -> azulejo_core::Result<T>,
    ) -> Result<T, Failure> {
        self.context.run(Watch::NONE, |context, progress| call(context, &self.mesh, self.positions, progress))
    }
}
