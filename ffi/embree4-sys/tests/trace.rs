//! The bindings against the library that is loaded: version, sizes, and a ray through one triangle by every query.

use std::ffi::{c_int, c_void};
use std::ptr;

use embree4_sys::*;

const VERTICES: [[f32; 3]; 3] = [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];

/// A device with a scene of two triangles, one behind the other, that may be traced with a filter.
struct World {
    embree: &'static Embree,
    device: RTCDevice,
    scene: RTCScene,
}

impl World {
    fn new() -> Self {
        let embree = Embree::load().unwrap();
        // SAFETY: the handles are used in the order of the manual, the buffers are filled up to their sizes, and no
        // call fails: the caller asserts that no error was left behind.
        unsafe {
            let device = embree.rtcNewDevice(c"threads=1".as_ptr());
            assert!(!device.is_null());
            let scene = embree.rtcNewScene(device);
            embree.rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
            for depth in [0.0, 1.0] {
                let geometry = embree.rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
                let vertices: *mut [f32; 3] = embree
                    .rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3)
                    .cast();
                for (i, [x, y, z]) in VERTICES.into_iter().enumerate() {
                    vertices.add(i).write([x, y, z + depth]);
                }
                let indices: *mut [u32; 3] =
                    embree.rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 1).cast();
                indices.write([0, 1, 2]);
                embree.rtcCommitGeometry(geometry);
                embree.rtcAttachGeometry(scene, geometry);
                embree.rtcReleaseGeometry(geometry);
            }
            embree.rtcCommitScene(scene);
            assert_eq!(embree.rtcGetDeviceError(device), RTC_ERROR_NONE);
            Self { embree, device, scene }
        }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: both are owned and released once.
        unsafe {
            self.embree.rtcReleaseScene(self.scene);
            self.embree.rtcReleaseDevice(self.device);
        }
    }
}

#[test]
fn the_loaded_library_is_the_bound_one() {
    let world = World::new();
    // SAFETY: the device is alive.
    let (version, verdict) = unsafe { (world.embree.version(world.device), world.embree.check(world.device)) };
    assert_eq!((version.major, version.minor), (BOUND_VERSION.major, BOUND_VERSION.minor));
    assert_eq!(verdict, Ok(()));
}

/// Embree divides by an approximate reciprocal: the last bits depend on the processor.
fn rounded(x: f32) -> f32 {
    (x * 1024.0).round() / 1024.0
}

/// A query as a filter sees it: the context that the query was given, with more behind it.
#[repr(C)]
struct Seen {
    context: RTCRayQueryContext,
    hits: Vec<(u32, f32)>,
}

/// Records the ray's id and the distance of each hit, and rejects it.
unsafe extern "C" fn record(arguments: *const RTCFilterFunctionNArguments) {
    // SAFETY: Embree passes valid arguments; the context is the first member of the `Seen` of the query; the arrays
    // of a packet of N follow each other in the ray: 8 N floats before `tfar`, 10 N before `id`.
    unsafe {
        let arguments = &*arguments;
        let seen = &mut *arguments.context.cast::<Seen>();
        let n = arguments.N as usize;
        for lane in 0..n {
            if *arguments.valid.add(lane) == -1 {
                let id = *arguments.ray.cast::<u32>().add(10 * n + lane);
                seen.hits.push((id, rounded(*arguments.ray.cast::<f32>().add(8 * n + lane))));
                *arguments.valid.add(lane) = 0;
            }
        }
    }
}

/// Runs a query without a filter, then one that records.
unsafe fn closest_and_all(query: &mut dyn FnMut(*mut RTCIntersectArguments)) -> Vec<(u32, f32)> {
    let mut arguments = RTCIntersectArguments::default();
    let mut seen = Seen { context: RTCRayQueryContext::default(), hits: Vec::new() };
    // SAFETY: both structs are of the sizes that the library expects (tested above).
    unsafe {
        rtcInitIntersectArguments(&mut arguments);
        rtcInitRayQueryContext(&mut seen.context);
    }
    query(&mut arguments);
    arguments.context = ptr::from_mut(&mut seen).cast();
    arguments.filter = Some(record);
    // Without the flag the filter is not called.
    query(&mut arguments);
    assert_eq!(seen.hits, []);
    arguments.context = ptr::from_mut(&mut seen).cast();
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER | RTC_RAY_QUERY_FLAG_COHERENT;
    query(&mut arguments);
    seen.hits.sort_by(|a, b| a.partial_cmp(b).unwrap());
    seen.hits
}

#[test]
fn a_single_ray_meets_both_triangles() {
    let world = World::new();
    let mut closest = Vec::new();
    let mut query = |arguments| {
        let mut rayhit = RTCRayHit::default();
        (rayhit.ray.org_x, rayhit.ray.org_y, rayhit.ray.dir_z) = (0.25, 0.5, 1.0);
        (rayhit.ray.tfar, rayhit.ray.mask, rayhit.ray.id) = (f32::INFINITY, !0, 7);
        rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        // SAFETY: the scene is committed; the structs are valid for the call.
        unsafe { world.embree.intersect1(world.scene, &mut rayhit, arguments) };
        let [t, u, v] = [rayhit.ray.tfar, rayhit.hit.u, rayhit.hit.v].map(rounded);
        closest.push((rayhit.hit.geomID, t, u, v));
    };
    // SAFETY: the query passes the arguments on to Embree.
    let all = unsafe { closest_and_all(&mut query) };
    assert_eq!(closest, [(0, 2.0, 0.25, 0.5), (0, 2.0, 0.25, 0.5), (RTC_INVALID_GEOMETRY_ID, f32::INFINITY, 0.0, 0.0)]);
    assert_eq!(all, [(7, 2.0), (7, 3.0)]);
}

macro_rules! packet_test {
    ($test:ident, $packet:ty, $intersect:ident, $width:literal) => {
        #[test]
        fn $test() {
            #[repr(C, align(64))]
            struct Valid([c_int; $width]);

            let world = World::new();
            let mut closest = Vec::new();
            // The last lane is idle, and its ray ends before it begins: where Embree 3.13 emulates wider packets than
            // the machine's own, it looks only at that.
            let mut valid = Valid([-1; $width]);
            valid.0[$width - 1] = 0;
            let mut query = |arguments| {
                let mut packet = <$packet>::default();
                packet.ray.org_x = [0.25; $width];
                packet.ray.org_y = std::array::from_fn(|lane| 0.5 + lane as f32 / 64.0);
                packet.ray.dir_z = [1.0; $width];
                packet.ray.tfar = [f32::INFINITY; $width];
                packet.ray.tfar[$width - 1] = f32::NEG_INFINITY;
                packet.ray.mask = [!0; $width];
                packet.ray.id = std::array::from_fn(|lane| lane as u32);
                packet.hit.geomID = [RTC_INVALID_GEOMETRY_ID; $width];
                // SAFETY: the scene is committed; the structs are valid and aligned for the call.
                unsafe { world.embree.$intersect(valid.0.as_ptr(), world.scene, &mut packet, arguments) };
                let [t, u, v] = [packet.ray.tfar[0], packet.hit.u[0], packet.hit.v[0]].map(rounded);
                closest.push((packet.hit.geomID[0], t, u, v));
                assert_eq!(packet.hit.geomID[$width - 1], RTC_INVALID_GEOMETRY_ID);
            };
            // SAFETY: the query passes the arguments on to Embree.
            let all = unsafe { closest_and_all(&mut query) };
            assert_eq!(closest[..2], [(0, 2.0, 0.25, 0.5); 2]);
            assert_eq!(closest[2].0, RTC_INVALID_GEOMETRY_ID);
            let expected: Vec<_> = (0..$width - 1).flat_map(|lane| [(lane, 2.0), (lane, 3.0)]).collect();
            assert_eq!(all, expected);
        }
    };
}

packet_test!(four_rays_meet_both_triangles, RTCRayHit4, intersect4, 4);
packet_test!(eight_rays_meet_both_triangles, RTCRayHit8, intersect8, 8);
packet_test!(sixteen_rays_meet_both_triangles, RTCRayHit16, intersect16, 16);

/// The device's error function gets the text of an error, and the device its code.
#[test]
fn errors_come_with_their_text() {
    unsafe extern "C" fn note(user: *mut c_void, _code: RTCError, text: *const std::ffi::c_char) {
        // SAFETY: `user` is the string below, and the text ends with a NUL.
        unsafe { *user.cast::<String>() = std::ffi::CStr::from_ptr(text).to_string_lossy().into_owned() };
    }
    let world = World::new();
    let mut text = String::new();
    // SAFETY: the string outlives the device's use of it; Embree refuses a type of geometry that does not exist.
    let code = unsafe {
        world.embree.rtcSetDeviceErrorFunction(world.device, Some(note), ptr::from_mut(&mut text).cast());
        world.embree.rtcNewGeometry(world.device, RTCGeometryType::MAX);
        world.embree.rtcSetDeviceErrorFunction(world.device, None, ptr::null_mut());
        world.embree.rtcGetDeviceError(world.device)
    };
    assert_ne!(code, RTC_ERROR_NONE);
    assert!(!text.is_empty());
}
