//! A scene of triangles, and every hit on every ray that is sent through it.

use std::ffi::{CStr, c_char, c_void};
use std::mem::size_of;
use std::ptr;
use std::ptr::NonNull;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use embree4_sys::{RTCRayHit, RTCRayHit4, RTCRayHit8, RTCRayHit16, *};
use glam::DVec3;

use crate::error::{Error, Result};
use crate::job::{Context, Job};
use crate::trace::packet::{Packet, RayHits};
use crate::trace::recorder::Recorder;
use crate::trace::watch::Watch;
use crate::trace::{Hit, LARGEST_COORDINATE, Ray};

/// The number of packets that are filled before they are traced: Embree reads whole vectors, and the processor stalls
/// on one whose lanes were stored one by one just before.
const PACKETS_AHEAD: usize = 4;

/// Triangles in Embree's bounding volume hierarchy, ready to be traced.
///
/// Any number of threads may trace one scene at once. The same rays give the same hits in each call on one machine; on
/// another one, or with another Embree, the last bits of `uv` and `t` may differ, and which of two triangles is hit
/// where a ray passes through their common edge.
pub struct Scene {
    built: Built,
    packet_width: usize,
}

impl Scene {
    /// Copies the triangles into Embree and builds the hierarchy with `num_threads` threads (0: one per core; 1: none
    /// but the caller's), but not more than there are cores, in O(n log n). None of TBB's threads takes part.
    ///
    /// Embree is loaded by the first scene of a process.
    ///
    /// A bound that the program sets for TBB is left alone. Embree, however, knows one bound for all its devices, the
    /// largest, and this scene's device has none: one that another device of the program has set (`threads=`) is
    /// suspended while this scene lives.
    ///
    /// Embree calculates in `f32` with fixed thresholds: scale a mesh to about the unit box before.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `positions` that are not finite or above 1e18, and for `triangles` with an index
    /// beyond the positions; [`Error::Embree`] if the library cannot be loaded or is not the version that this crate
    /// was built for, or if Embree refuses, for want of memory or another reason that it gives.
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]], num_threads: usize) -> Result<Self> {
        Context::new(1)?.run(None, |job| Self::build(job, positions, triangles, num_threads))
    }

    /// [`Scene::new`] as a part of a job, which can be cancelled.
    pub(crate) fn build(job: &Job, positions: &[[f32; 3]], triangles: &[[u32; 3]], num_threads: usize) -> Result<Self> {
        check_triangles(positions, triangles)?;
        let built = Built::new(positions, triangles, num_threads, job)?;
        let packet_width = built.packet_width();
        Ok(Self { built, packet_width })
    }

    /// The number of rays that this machine traces at once: 16, 8 or 4.
    ///
    /// Rays pay off when those of a packet, that is of each run of as many rays, stay close together.
    pub fn packet_width(&self) -> usize {
        self.packet_width
    }

    /// Appends every hit with `t > 0` on every ray, sorted by ray, `t` and triangle; no triangle comes twice on a ray.
    ///
    /// The rays, fewer than 2^32, are traced in packets of [`packet_width`](Self::packet_width), in their order. A ray
    /// that has no direction, is not finite or starts beyond 1e18 hits nothing. A triangle without area is never hit.
    ///
    /// A ray through an edge hits one of the triangles that share it, or several. Which ones, and whether a ray that
    /// only touches a triangle hits it, may depend on the other rays of its packet; nothing else does.
    pub fn all_hits(&self, rays: &[Ray], hits: &mut Vec<Hit>) {
        self.all_hits_in_packets(self.packet_width, rays, hits);
    }

    /// The first hit with `t > 0` of each ray, if any, traced one by one. Bad rays are treated as in
    /// [`all_hits`](Self::all_hits).
    pub fn closest_hits(&self, rays: &[Ray]) -> Vec<Option<Hit>> {
        self.closest_hits_in_packets(1, rays)
    }

    /// [`all_hits`](Self::all_hits) in packets of another width: 1, 4, 8 or 16. For tests and measurements.
    #[doc(hidden)]
    pub fn all_hits_in_packets(&self, width: usize, rays: &[Ray], hits: &mut Vec<Hit>) {
        match width {
            1 => self.all::<RTCRayHit>(rays, hits),
            4 => self.all::<RTCRayHit4>(rays, hits),
            8 => self.all::<RTCRayHit8>(rays, hits),
            16 => self.all::<RTCRayHit16>(rays, hits),
            _ => panic!("Embree has no packets of {width} rays"),
        }
    }

    /// [`closest_hits`](Self::closest_hits) in packets of 1, 4, 8 or 16. For tests and measurements.
    #[doc(hidden)]
    pub fn closest_hits_in_packets(&self, width: usize, rays: &[Ray]) -> Vec<Option<Hit>> {
        match width {
            1 => self.closest::<RTCRayHit>(rays),
            4 => self.closest::<RTCRayHit4>(rays),
            8 => self.closest::<RTCRayHit8>(rays),
            16 => self.closest::<RTCRayHit16>(rays),
            _ => panic!("Embree has no packets of {width} rays"),
        }
    }

    fn all<P: RayHits>(&self, rays: &[Ray], hits: &mut Vec<Hit>) {
        let mut recorder = Recorder::new();
        let mut packets: [Packet<P>; PACKETS_AHEAD] = std::array::from_fn(|_| Packet::new());
        for (first, rays) in chunks(rays, PACKETS_AHEAD * P::WIDTH) {
            let packets = &mut packets[..rays.len().div_ceil(P::WIDTH)];
            packets.iter_mut().zip(rays.chunks(P::WIDTH)).for_each(|(packet, rays)| packet.load(rays));
            for (packet, first) in packets.iter_mut().zip((first..).step_by(P::WIDTH)) {
                packet.all_hits(&self.built, &mut recorder, first, hits);
            }
        }
    }

    fn closest<P: RayHits>(&self, rays: &[Ray]) -> Vec<Option<Hit>> {
        let mut closest = Vec::with_capacity(rays.len());
        let mut packet = Packet::<P>::new();
        for (first, rays) in chunks(rays, P::WIDTH) {
            packet.load(rays);
            let hits = packet.closest_hits(&self.built).take(rays.len());
            closest.extend(hits.map(|hit| hit.map(|hit| Hit { ray: first + hit.ray, ..hit })));
        }
        closest
    }
}

/// Runs of `width` rays, each with the index of its first one.
fn chunks(rays: &[Ray], width: usize) -> impl Iterator<Item = (u32, &[Ray])> {
    (0..).step_by(width).zip(rays.chunks(width))
}

/// Embree drops bad triangles silently; here they are refused.
fn check_triangles(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
    let usable = |position: &[f32; 3]| position.iter().all(|x| x.abs() <= LARGEST_COORDINATE);
    if let Some(index) = positions.iter().position(|position| !usable(position)) {
        let position = positions[index];
        return Err(Error::invalid("positions", format!("[{index}] is {position:?}, not finite and within 1e18")));
    }
    let count = positions.len();
    let inside = |triangle: &[u32; 3]| triangle.iter().all(|&vertex| (vertex as usize) < count);
    match triangles.iter().position(|triangle| !inside(triangle)) {
        Some(index) => {
            let triangle = triangles[index];
            Err(Error::invalid("triangles", format!("[{index}] is {triangle:?}, but there are {count} positions")))
        }
        None => Ok(()),
    }
}

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
        let device = Device::new()?;
        let embree = device.embree;
        // SAFETY: the device is alive.
        let scene = device.own(unsafe { embree.rtcNewScene(device.raw) }, embree.rtcReleaseScene)?;
        // SAFETY: the scene is alive.
        unsafe {
            embree.rtcSetSceneFlags(scene.raw, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
            // HIGH would split triangles, and report some of them twice; LOW is slower to trace.
            embree.rtcSetSceneBuildQuality(scene.raw, RTC_BUILD_QUALITY_MEDIUM);
        }
        if !triangles.is_empty() {
            let geometry = device.geometry(positions, triangles)?;
            // SAFETY: both are alive; the scene keeps a reference of its own to the geometry.
            unsafe { embree.rtcAttachGeometry(scene.raw, geometry.raw) };
        }
        let joining = joining_threads(num_threads, triangles.len());
        Watch::new(job).during(embree, scene.raw, || device.commit(&scene, joining))?;
        device.verdict()?;
        Ok(Self { scene, device })
    }

    /// The library that the scene belongs to.
    pub(super) fn embree(&self) -> &'static Embree {
        self.device.embree
    }

    /// The scene, for as long as `self` lives.
    pub(super) fn scene(&self) -> RTCScene {
        self.scene.raw
    }

    /// The number of rays that the device traces at once.
    pub(super) fn packet_width(&self) -> usize {
        let widths = [(16, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED), (8, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)];
        // SAFETY: the device is alive.
        let native = |property| unsafe { self.embree().rtcGetDeviceProperty(self.device.raw, property) } != 0;
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

/// The number of threads that help the calling one to build a scene, where `num_threads` (0: one per core) may work.
fn joining_threads(num_threads: usize, triangles: usize) -> usize {
    /// For fewer a thread takes longer to start than to build.
    const TRIANGLES_PER_THREAD: usize = 4096;
    // Embree has a place for each core; others would only wait for one.
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let threads = if num_threads == 0 { cores } else { num_threads.min(cores) };
    (threads - 1).min(triangles / TRIANGLES_PER_THREAD)
}

/// The texts of Embree's errors in the calls so far.
type Complaints = Mutex<Vec<String>>;

/// A device that notes the text of each error.
struct Device {
    embree: &'static Embree,
    raw: RTCDevice,
    complaints: Arc<Complaints>,
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: the reference was owned, and is given back once. The complaints are dropped after it.
        unsafe { self.embree.rtcReleaseDevice(self.raw) };
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
    /// A device without a bound of threads, which Embree would set for all that uses TBB in the process; all places in
    /// its builds are for threads that join them, so that none of TBB's takes part (see [`Device::commit`]).
    fn new() -> Result<Self> {
        let embree = Embree::load().map_err(|missing| Error::Embree(missing.to_string()))?;
        // SAFETY: the string ends with a NUL and is copied.
        let raw = unsafe { embree.rtcNewDevice(c"threads=0,user_threads=1000000".as_ptr()) };
        if raw.is_null() {
            // SAFETY: without a device, this is the code of the calling thread's last error.
            let code = unsafe { embree.rtcGetDeviceError(ptr::null_mut()) };
            return Err(Error::Embree(format!("cannot make a device (RTCError {code})")));
        }
        let device = Self { embree, raw, complaints: Arc::default() };
        // SAFETY: the device is alive.
        unsafe { embree.check(raw) }.map_err(|mismatch| Error::Embree(mismatch.to_string()))?;
        let complaints = Arc::as_ptr(&device.complaints).cast_mut().cast();
        // SAFETY: the device is released before the complaints.
        unsafe { embree.rtcSetDeviceErrorFunction(raw, Some(complain), complaints) };
        Ok(device)
    }

    /// Commits a scene on the calling thread and on `joining` threads that are started for it; fewer if the system has no
    /// more.
    fn commit(&self, scene: &Handle<RTCScene>, joining: usize) {
        /// A pointer that threads may share.
        struct Shared(RTCScene);
        // SAFETY: any number of threads may commit one scene by `rtcJoinCommitScene` at once.
        unsafe impl Sync for Shared {}
        impl Shared {
            fn commit(&self, embree: &Embree) {
                // SAFETY: the scene is alive, and nothing but the threads that build it uses it yet.
                unsafe { embree.rtcJoinCommitScene(self.0) };
            }
        }
        let (embree, shared) = (self.embree, Shared(scene.raw));
        thread::scope(|scope| {
            let join = |_: usize| {
                let builder = thread::Builder::new().name("azulejo-scene".to_owned());
                builder.spawn_scoped(scope, || shared.commit(embree)).ok()
            };
            let joining: Vec<_> = (0..joining).map_while(join).collect();
            shared.commit(embree);
            // A scope waits for the closures alone; a caller that counts threads is to find none.
            joining.into_iter().for_each(|thread| drop(thread.join()));
        });
    }

    /// An error if Embree has complained.
    fn verdict(&self) -> Result<()> {
        let complaints = self.complaints.lock().unwrap_or_else(PoisonError::into_inner);
        if complaints.is_empty() { Ok(()) } else { Err(Error::Embree(complaints.join("; "))) }
    }

    /// Takes ownership of a new object of this device, or says why there is none.
    fn own<T>(&self, raw: *mut T, release: unsafe extern "C" fn(*mut T)) -> Result<Handle<*mut T>> {
        self.verdict()?;
        Ok(Handle { raw, release })
    }

    /// A geometry of triangles that have been checked.
    fn geometry(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Handle<RTCGeometry>> {
        let embree = self.embree;
        // SAFETY: the device is alive.
        let geometry = self
            .own(unsafe { embree.rtcNewGeometry(self.raw, RTC_GEOMETRY_TYPE_TRIANGLE) }, embree.rtcReleaseGeometry)?;
        self.fill(&geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions)?;
        let triangles: Vec<_> = triangles.iter().map(|&triangle| collapse_without_area(positions, triangle)).collect();
        self.fill(&geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, &triangles)?;
        // SAFETY: the geometry is alive, and no other thread knows it.
        unsafe { embree.rtcCommitGeometry(geometry.raw) };
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
        let data = unsafe {
            self.embree.rtcSetNewGeometryBuffer(geometry.raw, buffer, 0, format, size_of::<T>(), items.len())
        }
        .cast();
        self.verdict()?;
        // SAFETY: Embree made the buffer, without an error, for this many items of this size, aligned to 16 bytes.
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

/// The buffers of a triangle geometry in a scene.
#[derive(Clone, Copy, Debug)]
pub struct HostBuffers {
    /// The vertices.
    pub vertices: NonNull<f32>,
    /// The indices.
    pub indices: NonNull<u32>,
}

/// Finds the buffers of geometries in a scene that another part of the program made, an `RTCScene`. Nothing of the
/// scene or of its device is changed.
///
/// # Safety
/// `scene` is a committed scene of the libembree that the program has linked or, if it has none in its global scope, of
/// the one that this crate loads ([`FILE`]), and stays so as long as the buffers
/// are used; `geometries` are attached to it as triangles, of one time step. None of this can be asked of Embree,
/// except for the version, which is compared.
///
/// # Errors
/// [`Error::InvalidArgument`] for a `scene` that is null and for geometries without buffers; [`Error::Embree`] if the
/// scene's library cannot be found or is of another version than the one that this crate was built for.
pub unsafe fn host_buffers(scene: *mut c_void, geometries: &[u32]) -> Result<Vec<HostBuffers>> {
    let scene: RTCScene = scene.cast();
    if scene.is_null() {
        return Err(Error::invalid("scene", "is NULL"));
    }
    // A scene of another version can only be asked for it by its own library.
    let linked = Embree::of_program();
    let embree = match &linked {
        Some(embree) => embree,
        None => Embree::load().map_err(|missing| Error::Embree(missing.to_string()))?,
    };
    // SAFETY: by the contract; the reference to the device that Embree hands out is given back.
    unsafe {
        let device = embree.rtcGetSceneDevice(scene);
        let verdict = embree.check(device);
        embree.rtcReleaseDevice(device);
        verdict.map_err(|mismatch| Error::Embree(mismatch.to_string()))?;
    }
    let buffers = |&id: &u32| {
        // SAFETY: by the contract there is such a geometry, which stays the scene's.
        let (vertices, indices) = unsafe {
            let geometry = embree.rtcGetGeometry(scene, id);
            let buffer = |kind| embree.rtcGetGeometryBufferData(geometry, kind, 0);
            (buffer(RTC_BUFFER_TYPE_VERTEX), buffer(RTC_BUFFER_TYPE_INDEX))
        };
        match (NonNull::new(vertices.cast()), NonNull::new(indices.cast())) {
            (Some(vertices), Some(indices)) => Ok(HostBuffers { vertices, indices }),
            _ => Err(Error::invalid("geometries", format!("geometry {id} has no vertices or no indices"))),
        }
    };
    geometries.iter().map(buffers).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_complaint_of_embree_becomes_an_error_with_its_text() {
        let device = Device::new().unwrap();
        // SAFETY: the device is alive; Embree refuses a geometry of a type that does not exist.
        let raw = unsafe { device.embree.rtcNewGeometry(device.raw, RTCGeometryType::MAX) };
        let Err(Error::Embree(text)) = device.own(raw, device.embree.rtcReleaseGeometry) else {
            panic!("no complaint")
        };
        assert!(!text.is_empty());
    }

    #[test]
    fn a_buffer_that_embree_refuses_is_an_error() {
        let device = Device::new().unwrap();
        // SAFETY: the device is alive.
        let raw = unsafe { device.embree.rtcNewGeometry(device.raw, RTC_GEOMETRY_TYPE_TRIANGLE) };
        let geometry = device.own(raw, device.embree.rtcReleaseGeometry).unwrap();
        let items_of_three_bytes = [[0u8; 3]; 4];
        let refused = device.fill(&geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, &items_of_three_bytes);
        assert!(matches!(refused, Err(Error::Embree(_))));
    }

    #[test]
    fn no_more_threads_build_than_were_asked_for_or_there_are_cores() {
        let cores = thread::available_parallelism().unwrap().get();
        assert_eq!(joining_threads(1, 1_000_000), 0);
        assert_eq!(joining_threads(2, 1_000_000), 1.min(cores - 1));
        assert_eq!(joining_threads(0, 1_000_000_000), cores - 1);
        assert_eq!(joining_threads(4096, 1_000_000_000), cores - 1);
        assert_eq!(joining_threads(0, 4095), 0);
    }
}
