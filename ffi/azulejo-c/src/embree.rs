//! Meshes out of scenes that the caller has made with Embree.

use std::ffi::c_void;
use std::ptr::NonNull;
use std::sync::Arc;

use azulejo_core::mesh::Mesh;
use azulejo_core::trace::host_buffers;

use crate::boundary::{Out, check_pointer, check_size};
use crate::growing::elements;
use crate::handles;
use crate::mesh::{azulejo_mesh, collect};
use crate::status::{Failure, azulejo_status};

/// A geometry of triangles in a scene that the program has made with Embree, which keeps no sizes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_embree_geometry {
    /// Its number in the scene.
    pub geometry_id: u32,
    /// Bytes from one vertex to the next: a multiple of 4, at least 12.
    pub vertex_stride: u32,
    /// Bytes from one triangle to the next, likewise.
    pub index_stride: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Those in its buffer RTC_BUFFER_TYPE_VERTEX, slot 0, of format RTC_FORMAT_FLOAT3.
    pub vertex_count: usize,
    /// Those in its buffer RTC_BUFFER_TYPE_INDEX, of format RTC_FORMAT_UINT3.
    pub triangle_count: usize,
}

/// Makes a mesh from a copy of the triangles of a scene that the program has made with Embree,
/// which is not needed after the call: samples are traced in a scene and on a device of the
/// library's. Triangle i of the mesh is primitive i of the first geometry, those of the second
/// follow, and so on; vertices likewise.
///
/// scene: a committed RTCScene that no thread changes during the call, of the libembree that the
/// program has linked or, where it has linked none that all its libraries see, of the one that
/// libazulejo loads by its SONAME: otherwise, as for an Embree that is linked statically, the
/// behaviour is undefined. Instances are not followed: azulejo_psp_sample_instances takes them.
///
/// geometries: at least one, each attached to the scene as RTC_GEOMETRY_TYPE_TRIANGLE. If an id, a
/// size or a type is not that of the scene, the behaviour is undefined.
///
/// geometry_size: sizeof(azulejo_embree_geometry).
///
/// O(vertices + triangles).
///
/// Errors: those of azulejo_mesh_create; AZULEJO_ERROR_EMBREE if it is another version or missing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_create_from_embree(
    scene: *mut c_void,
    geometries: *const azulejo_embree_geometry,
    geometry_count: usize,
    geometry_size: usize,
    out: *mut *mut azulejo_mesh,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        check_pointer("scene", scene)?;
        // SAFETY: handed on from the caller.
        let geometries = unsafe {
            elements(["geometries", "geometry_count", "geometry_size"], geometries, geometry_count, geometry_size)
        }?;
        geometries.iter().enumerate().try_for_each(|(number, geometry)| geometry.check(number))?;
        let ids = collect("geometries", geometries.iter().map(|geometry| geometry.geometry_id))?;
        // SAFETY: the caller's word.
        let buffers = unsafe { host_buffers(scene, &ids) }?;
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for (geometry, buffers) in geometries.iter().zip(buffers) {
            let first = u32::try_from(positions.len()).unwrap_or(u32::MAX);
            // SAFETY: the caller's word for the sizes; Embree's for the places.
            let (vertices, indices) = unsafe {
                (
                    strided("vertex_count", buffers.vertices, geometry.vertex_count, geometry.vertex_stride)?,
                    strided("triangle_count", buffers.indices, geometry.triangle_count, geometry.index_stride)?,
                )
            };
            for (number, triangle) in indices.iter().enumerate() {
                if let Some(index) = triangle.iter().find(|&&index| index as usize >= vertices.len()) {
                    let (id, count) = (geometry.geometry_id, vertices.len());
                    let reason = format!("geometry {id}: triangle {number} names vertex {index} of {count}");
                    return Err(Failure::invalid("geometries", reason));
                }
            }
            positions.extend(vertices);
            // Where the sum leaves its range there are more vertices than a mesh may have, and it is refused.
            triangles.extend(indices.iter().map(|triangle| triangle.map(|index| first.saturating_add(index))));
        }
        Ok(azulejo_mesh { shared: Arc::new(Mesh::new(positions, triangles)?) })
    })
}

impl azulejo_embree_geometry {
    /// Checks all that can be checked; `number` is the index in the caller's array.
    fn check(&self, number: usize) -> Result<(), Failure> {
        let refuse = |reason: String| Err(Failure::invalid("geometries", format!("[{number}]: {reason}")));
        for (name, stride) in [("vertex_stride", self.vertex_stride), ("index_stride", self.index_stride)] {
            if stride < 12 || !stride.is_multiple_of(4) {
                return refuse(format!("{name} is {stride}, not a multiple of 4 from 12 on"));
            }
        }
        if self.reserved != 0 { refuse(format!("reserved is {}, not 0", self.reserved)) } else { Ok(()) }
    }
}

/// Rows of three numbers, packed.
///
/// # Safety
/// Unless the check fails, there are `count` rows, `stride` bytes apart, which are not
/// changed during the call.
unsafe fn strided<T: Copy>(
    argument: &str,
    start: NonNull<T>,
    count: usize,
    stride: u32,
) -> Result<Vec<[T; 3]>, Failure> {
    let stride = stride as usize;
    check_size(argument, count, count.checked_mul(stride))?;
    // SAFETY: by the contract; the offsets lie inside the buffer, whose size an object can have.
    let row = |number| unsafe { start.byte_add(number * stride).cast::<[T; 3]>().read() };
    collect(argument, (0..count).map(row))
}
