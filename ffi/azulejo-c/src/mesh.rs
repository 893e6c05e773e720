//! Triangle meshes: the surfaces to sample.

use std::ffi::{CStr, OsStr, c_char};
use std::mem::MaybeUninit;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::sync::Arc;

use azulejo_core::mesh::Mesh;

use crate::boundary::{self, array, check_pointer, check_size, rows};
use crate::status::{AZULEJO_ERROR_OUT_OF_MEMORY, Failure, azulejo_status};

/// A checked triangle mesh: immutable, may be used by several threads at once. Any soup of triangles will do: open,
/// non-manifold, of many parts and mixed winding.
pub struct azulejo_mesh {
    pub(crate) shared: Arc<Mesh>,
}

const POSITION_SIZE: usize = size_of::<[f32; 3]>();

/// Copies a mesh of the caller's.
///
/// positions: the vertices; the x y z of each begin `stride_bytes` after those of the one before.
///
/// stride_bytes: at least 12, a multiple of 4. What lies between the positions is not read.
///
/// indices: three for each triangle, below `vertex_count`; triangles keep their order. Triangles without area are
/// allowed and get no samples.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for positions that are not finite, indices out of range, no triangle at all
/// and triangles without any area; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 vertices or triangles or more, and for sizes
/// that overflow; AZULEJO_ERROR_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_create(
    positions: *const f32,
    vertex_count: usize,
    stride_bytes: usize,
    indices: *const u32,
    triangle_count: usize,
    out: Option<&mut MaybeUninit<Box<azulejo_mesh>>>,
) -> azulejo_status {
    boundary::create(out, || {
        // SAFETY: handed on from the caller.
        let (vertices, triangles) = unsafe {
            (
                strided_positions(positions, vertex_count, stride_bytes)?,
                rows::<u32, 3>("indices", indices, "triangle_count", triangle_count)?,
            )
        };
        let triangles = collect("indices", triangles.iter().copied())?;
        Ok(azulejo_mesh { shared: Arc::new(Mesh::new(vertices, triangles)?) })
    })
}

/// Loads a mesh from a file: Wavefront OBJ or PLY (text and binary), told apart by the extension .obj or .ply, otherwise
/// by what the file begins with. Polygons become fans of triangles, in the order of the faces; points, lines, materials,
/// texture coordinates and normals are left aside.
///
/// path: the name of the file as the operating system wants it.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// Errors: AZULEJO_ERROR_IO if the file cannot be read, AZULEJO_ERROR_FORMAT if it is broken, or what it holds would be
/// refused by azulejo_mesh_create.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_load(
    path: *const c_char,
    out: Option<&mut MaybeUninit<Box<azulejo_mesh>>>,
) -> azulejo_status {
    boundary::create(out, || {
        check_pointer("path", path)?;
        // SAFETY: not NULL; the caller ends the string with a NUL.
        let path = unsafe { CStr::from_ptr(path) };
        Ok(azulejo_mesh { shared: Arc::new(Mesh::load(Path::new(OsStr::from_bytes(path.to_bytes())))?) })
    })
}

/// The number of vertices; 0 for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_vertex_count(mesh: Option<&azulejo_mesh>) -> usize {
    mesh.map_or(0, |mesh| mesh.shared.positions().len())
}

/// The number of triangles; 0 for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_triangle_count(mesh: Option<&azulejo_mesh>) -> usize {
    mesh.map_or(0, |mesh| mesh.shared.triangles().len())
}

/// The vertices, x y z each, packed; they live until azulejo_mesh_free. NULL for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_positions(mesh: Option<&azulejo_mesh>) -> *const f32 {
    mesh.map_or(std::ptr::null(), |mesh| array(mesh.shared.positions()))
}

/// The three vertices of each triangle, counter-clockwise seen from the front; they live until azulejo_mesh_free. NULL for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_indices(mesh: Option<&azulejo_mesh>) -> *const u32 {
    mesh.map_or(std::ptr::null(), |mesh| array(mesh.shared.triangles()))
}

/// The area of all triangles together, in squared units of the positions; 0 for NULL. A maximal set of N samples has a
/// radius of about sqrt(0.69656 * area / N), as long as that is small against the features of the surface.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_area(mesh: Option<&azulejo_mesh>) -> f64 {
    mesh.map_or(0.0, |mesh| mesh.shared.area())
}

/// Frees the mesh, once no psp handle uses it any more. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_free(mesh: Option<Box<azulejo_mesh>>) {
    boundary::free(mesh);
}

/// The caller's vertices, packed.
///
/// # Safety
/// Unless the checks fail, `positions` leads to as many vertices, so far apart.
unsafe fn strided_positions(positions: *const f32, count: usize, stride: usize) -> Result<Vec<[f32; 3]>, Failure> {
    if stride < POSITION_SIZE || !stride.is_multiple_of(align_of::<f32>()) {
        let reason = format!("{stride} is not a multiple of 4 from {POSITION_SIZE} on");
        return Err(Failure::invalid("stride_bytes", reason));
    }
    if count > 0 {
        check_pointer("positions", positions)?;
    }
    check_size("vertex_count", count, count.checked_mul(stride))?;
    // SAFETY: the offsets lie inside the caller's array, whose size an object can have.
    let position = |vertex| unsafe { positions.byte_add(vertex * stride).cast::<[f32; 3]>().read() };
    collect("positions", (0..count).map(position))
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
