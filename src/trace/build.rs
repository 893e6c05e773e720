//! From triangles to a committed scene: Embree's device and objects, asked for errors and released.

use std::ffi::{CStr, CString, c_char, c_void};
use std::mem::size_of;
use std::ptr;
use std::sync::{Arc, Mutex, PoisonError};

use embree4_sys::*;
use glam::DVec3;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::trace::watch::Watch;

/// A scene that has been committed, with its device.
pub(super) struct Built {
    /// Before the device: fields are dropped in their order.
    scene: Handle<RTCScene>,
    device: Device,
}

// SAFETY: a scene that has been committed is only read, and Embree allows that from any thread; its objects may be
// released on any thread.
unsafe impl Send for Built {}
// SAFETY: as above; the complaints have a mutex of their own.
unsafe impl Sync for Built {}

impl Built {
    /// A scene of triangles that have been checked, built with `num_threads` threads (0: one per core).
    pub(super) fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]], num_threads: usize, job: &Job) -> Result<Self> {
        let device = Device::new(num_threads)?;
        // SAFETY: the device is alive.
        let scene = device.own(unsafe { rtcNewScene(device.raw) }, rtcReleaseScene)?;
        // SAFETY: the scene is alive.
        unsafe {
            rtcSetSceneFlags(scene.raw, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
            // HIGH would split triangles, and report some of them twice; LOW is slower to trace.
            rtcSetSceneBuildQuality(scene.raw, RTC_BUILD_QUALITY_MEDIUM);
        }
        if !triangles.is_empty() {
            let geometry = device.geometry(positions, triangles)?;
            // SAFETY: both are alive; the scene keeps a reference of its own to the geometry.
            unsafe { rtcAttachGeometry(scene.raw, geometry.raw) };
        }
        // SAFETY: the scene is alive, and no other thread knows it yet.
        Watch::new(job).during(scene.raw, || unsafe { rtcCommitScene(scene.raw) })?;
        device.verdict()?;
        Ok(Self { scene, device })
    }

    /// The scene, for as long as `self` lives.
    pub(super) fn scene(&self) -> RTCScene {
        self.scene.raw
    }

    /// How many rays the device traces at once.
    pub(super) fn packet_width(&self) -> usize {
        let widths = [(16, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED), (8, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)];
        // SAFETY: the device is alive.
        let native = |property| unsafe { rtcGetDeviceProperty(self.device.raw, property) } != 0;
        widths.into_iter().find(|&(_, property)| native(property)).map_or(4, |(width, _)| width)
    }
}

/// A reference to one of Embree's objects, released on drop.
struct Handle<T: Copy> {
    raw: T,
    release: unsafe extern "C" fn(T),
}

impl<T: Copy> Drop for Handle<T> {
    fn drop(&mut self) {
        // SAFETY: the reference was owned, and is given back once.
        unsafe { (self.release)(self.raw) };
    }
}

/// What Embree had to say against the calls so far.
type Complaints = Mutex<Vec<String>>;

/// A device that notes the text of each error.
struct Device {
    raw: RTCDevice,
    complaints: Arc<Complaints>,
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: the reference was owned, and is given back once. The complaints are dropped after it.
        unsafe { rtcReleaseDevice(self.raw) };
    }
}

/// Embree's error function.
///
/// # Safety
/// `complaints` is the device's, and `text` ends with a NUL.
unsafe extern "C" fn complain(complaints: *mut c_void, _code: RTCError, text: *const c_char) {
    // SAFETY: by the contract.
    let (complaints, text) = unsafe { (&*complaints.cast::<Complaints>().cast_const(), CStr::from_ptr(text)) };
    complaints.lock().unwrap_or_else(PoisonError::into_inner).push(text.to_string_lossy().into_owned());
}

impl Device {
    fn new(num_threads: usize) -> Result<Self> {
        let config = CString::new(format!("threads={num_threads}")).expect("a number has no NUL");
        // SAFETY: the string ends with a NUL and is copied.
        let raw = unsafe { rtcNewDevice(config.as_ptr()) };
        if raw.is_null() {
            // SAFETY: without a device, this is the code of the calling thread's last error.
            let code = unsafe { rtcGetDeviceError(ptr::null_mut()) };
            return Err(Error::Embree(format!("cannot make a device with {num_threads} threads (RTCError {code})")));
        }
        let device = Self { raw, complaints: Arc::default() };
        // SAFETY: the device is alive.
        unsafe { check(raw) }.map_err(|mismatch| Error::Embree(mismatch.to_string()))?;
        let complaints = Arc::as_ptr(&device.complaints).cast_mut().cast();
        // SAFETY: the device is released before the complaints.
        unsafe { rtcSetDeviceErrorFunction(raw, Some(complain), complaints) };
        Ok(device)
    }

    /// An error if Embree has complained.
    fn verdict(&self) -> Result<()> {
        let complaints = self.complaints.lock().unwrap_or_else(PoisonError::into_inner);
        if complaints.is_empty() { Ok(()) } else { Err(Error::Embree(complaints.join("; "))) }
    }

    /// Takes charge of a new object of this device, or says why there is none.
    fn own<T>(&self, raw: *mut T, release: unsafe extern "C" fn(*mut T)) -> Result<Handle<*mut T>> {
        self.verdict()?;
        Ok(Handle { raw, release })
    }

    /// A geometry of triangles that have been checked.
    fn geometry(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Handle<RTCGeometry>> {
        // SAFETY: the device is alive.
        let geometry = self.own(unsafe { rtcNewGeometry(self.raw, RTC_GEOMETRY_TYPE_TRIANGLE) }, rtcReleaseGeometry)?;
        self.fill(&geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions)?;
        let triangles: Vec<_> = triangles.iter().map(|&triangle| collapse_without_area(positions, triangle)).collect();
        self.fill(&geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, &triangles)?;
        // SAFETY: the geometry is alive, and no other thread knows it.
        unsafe { rtcCommitGeometry(geometry.raw) };
        self.verdict()?;
        Ok(geometry)
    }

    /// Copies items, which `format` describes, into a buffer of Embree's own: those are padded for wide loads, which
    /// read four bytes beyond the last vertex.
    fn fill<T: Copy>(
        &self,
        geometry: &Handle<RTCGeometry>,
        buffer: RTCBufferType,
        format: RTCFormat,
        items: &[T],
    ) -> Result<()> {
        // SAFETY: the geometry is alive.
        let data =
            unsafe { rtcSetNewGeometryBuffer(geometry.raw, buffer, 0, format, size_of::<T>(), items.len()) }.cast();
        self.verdict()?;
        // SAFETY: Embree made the buffer, without complaint, for as many items of this size, aligned to 16 bytes.
        unsafe { ptr::copy_nonoverlapping(items.as_ptr(), data, items.len()) };
        Ok(())
    }
}

/// The triangle, or one of its corners if it has no area: Embree's rounding can give one to a triangle on a line, and
/// then hits it with barycentrics that mean nothing. It never hits a point.
fn collapse_without_area(positions: &[[f32; 3]], triangle: [u32; 3]) -> [u32; 3] {
    let [a, b, c] = triangle.map(|vertex| DVec3::from_array(positions[vertex as usize].map(f64::from)));
    if (b - a).cross(c - a) == DVec3::ZERO { [triangle[0]; 3] } else { triangle }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_complaint_of_embree_becomes_an_error_with_its_text() {
        let device = Device::new(1).unwrap();
        // SAFETY: the device is alive; Embree refuses a geometry of a type that does not exist.
        let raw = unsafe { rtcNewGeometry(device.raw, RTCGeometryType::MAX) };
        let Err(Error::Embree(text)) = device.own(raw, rtcReleaseGeometry) else { panic!("no complaint") };
        assert!(!text.is_empty());
    }

    #[test]
    fn a_buffer_that_embree_refuses_is_an_error() {
        let device = Device::new(1).unwrap();
        // SAFETY: the device is alive.
        let raw = unsafe { rtcNewGeometry(device.raw, RTC_GEOMETRY_TYPE_TRIANGLE) };
        let geometry = device.own(raw, rtcReleaseGeometry).unwrap();
        let items_of_three_bytes = [[0u8; 3]; 4];
        let refused = device.fill(&geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, &items_of_three_bytes);
        assert!(matches!(refused, Err(Error::Embree(_))));
    }
}
