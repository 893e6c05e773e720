//! The substitute for Embree where the feature `embree` is off: calls that refuse, and a scene that cannot exist.

use std::convert::Infallible;
use std::ffi::c_void;
use std::ptr::NonNull;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::trace::{Hit, Ray};

fn refusal() -> Error {
    Error::Unsupported("Embree: this build has none (feature embree, AZULEJO_EMBREE)")
}

/// Triangles to be traced: there is no way to make one in a build without Embree.
pub struct Scene {
    never: Infallible,
}

impl Scene {
    /// # Errors
    /// [`Error::Unsupported`], always.
    pub fn new(_positions: &[[f32; 3]], _triangles: &[[u32; 3]], _num_threads: usize) -> Result<Self> {
        Err(refusal())
    }

    pub(crate) fn build(
        _: &Job,
        _positions: &[[f32; 3]],
        _triangles: &[[u32; 3]],
        _num_threads: usize,
    ) -> Result<Self> {
        Err(refusal())
    }

    /// The number of rays that are traced at once.
    pub fn packet_width(&self) -> usize {
        match self.never {}
    }

    /// Appends every hit on every ray.
    pub fn all_hits(&self, _rays: &[Ray], _hits: &mut Vec<Hit>) {
        match self.never {}
    }

    /// Appends every hit on every ray, traced in packets of a width.
    #[doc(hidden)]
    pub fn all_hits_in_packets(&self, _width: usize, _rays: &[Ray], _hits: &mut Vec<Hit>) {
        match self.never {}
    }

    /// The first hit of each ray.
    pub fn closest_hits(&self, _rays: &[Ray]) -> Vec<Option<Hit>> {
        match self.never {}
    }
}

/// The buffers of a triangle geometry in a scene.
#[derive(Clone, Copy, Debug)]
pub struct HostBuffers {
    /// The vertices.
    pub vertices: NonNull<f32>,
    /// The indices.
    pub indices: NonNull<u32>,
}

/// Refuses.
///
/// # Safety
/// None is needed here: nothing is read.
///
/// # Errors
/// [`Error::Unsupported`], always.
pub unsafe fn host_buffers(_scene: *mut c_void, _geometries: &[u32]) -> Result<Vec<HostBuffers>> {
    Err(refusal())
}
