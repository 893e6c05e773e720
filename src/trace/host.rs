//! Triangles out of a scene of the host's: where Embree keeps its buffers.

use std::ffi::c_void;
use std::ptr::NonNull;

use embree4_sys::*;

use crate::error::{Error, Result};

/// The buffers of a triangle geometry in a scene.
#[derive(Clone, Copy, Debug)]
pub struct HostBuffers {
    /// The vertices.
    pub vertices: NonNull<f32>,
    /// The indices.
    pub indices: NonNull<u32>,
}

/// Finds the buffers of geometries in a scene that another part of the program made, an `RTCScene`. Nothing of the scene
/// or of its device is changed.
///
/// # Safety
/// `scene` is a committed scene of the libembree that this crate is linked with, and stays so as long as the buffers are
/// used; `geometries` are attached to it as triangles, of one time step. None of this can be asked of Embree, except for
/// the version, which is compared.
///
/// # Errors
/// [`Error::InvalidArgument`] for a `scene` that is null and for geometries without buffers; [`Error::Embree`] if the
/// scene's library is of another version than the one that this crate was built for.
pub unsafe fn host_buffers(scene: *mut c_void, geometries: &[u32]) -> Result<Vec<HostBuffers>> {
    let scene: RTCScene = scene.cast();
    if scene.is_null() {
        return Err(Error::invalid("scene", "is NULL"));
    }
    // SAFETY: by the contract; the reference to the device that Embree hands out is given back.
    unsafe {
        let device = rtcGetSceneDevice(scene);
        let verdict = check(device);
        rtcReleaseDevice(device);
        verdict.map_err(|mismatch| Error::Embree(mismatch.to_string()))?;
    }
    let buffers = |&id: &u32| {
        // SAFETY: by the contract there is such a geometry, which stays the scene's.
        let (vertices, indices) = unsafe {
            let geometry = rtcGetGeometry(scene, id);
            let buffer = |kind| rtcGetGeometryBufferData(geometry, kind, 0);
            (buffer(RTC_BUFFER_TYPE_VERTEX), buffer(RTC_BUFFER_TYPE_INDEX))
        };
        match (NonNull::new(vertices.cast()), NonNull::new(indices.cast())) {
            (Some(vertices), Some(indices)) => Ok(HostBuffers { vertices, indices }),
            _ => Err(Error::invalid("geometries", format!("geometry {id} has no vertices or no indices"))),
        }
    };
    geometries.iter().map(buffers).collect()
}
