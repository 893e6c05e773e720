//! Embree alone: the same rays in packets that are filled beforehand, and a filter that rejects all hits and counts
//! them.

use std::ptr;

use azulejo::trace::Ray;
use embree4_sys::*;
use rayon::prelude::*;

/// Packets per task: 4096 rays of 16.
const PACKETS: usize = 256;

/// The lanes that are traced: all. Embree faults on a mask that is not aligned.
#[repr(align(64))]
struct Valid([i32; 16]);
static ALL: Valid = Valid([-1; 16]);

/// The context that is passed to the filter.
#[repr(C)]
struct Counter {
    context: RTCRayQueryContext,
    hits: u64,
}

/// # Safety
/// Called by Embree, for rays whose context is that of a [`Counter`].
unsafe extern "C" fn count(arguments: *const RTCFilterFunctionNArguments) {
    // SAFETY: the pointers are valid for N rays; no one else uses the counter during the query.
    unsafe {
        let arguments = &*arguments;
        let counter = &mut *arguments.context.cast::<Counter>();
        for lane in 0..arguments.N as usize {
            let valid = arguments.valid.add(lane);
            counter.hits += u64::from(*valid == -1);
            *valid = 0;
        }
    }
}

/// A committed scene.
pub struct Bare {
    embree: &'static Embree,
    device: RTCDevice,
    scene: RTCScene,
}

// SAFETY: a scene that has been committed is only read.
unsafe impl Sync for Bare {}

impl Drop for Bare {
    fn drop(&mut self) {
        // SAFETY: both references are owned, and given back once.
        unsafe {
            self.embree.rtcReleaseScene(self.scene);
            self.embree.rtcReleaseDevice(self.device);
        }
    }
}

impl Bare {
    /// Built as `azulejo::trace` builds it.
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let embree = Embree::load().expect("Embree");
        // SAFETY: the objects live until `Drop`; the buffers are as long as what is copied into them.
        unsafe {
            let device = embree.rtcNewDevice(ptr::null());
            let scene = embree.rtcNewScene(device);
            embree.rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
            let geometry = embree.rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            let buffer =
                |kind, format, count| embree.rtcSetNewGeometryBuffer(geometry, kind, 0, format, 12, count).cast();
            let vertices = buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions.len());
            ptr::copy_nonoverlapping(positions.as_ptr(), vertices, positions.len());
            let indices = embree.rtcSetNewGeometryBuffer(
                geometry,
                RTC_BUFFER_TYPE_INDEX,
                0,
                RTC_FORMAT_UINT3,
                12,
                triangles.len(),
            );
            ptr::copy_nonoverlapping(triangles.as_ptr(), indices.cast(), triangles.len());
            embree.rtcCommitGeometry(geometry);
            embree.rtcAttachGeometry(scene, geometry);
            embree.rtcReleaseGeometry(geometry);
            embree.rtcCommitScene(scene);
            Self { embree, device, scene }
        }
    }

    /// The number of hits on all rays, in parallel on the threads of the pool that calls.
    pub fn count_hits(&self, packets: &mut Packets) -> u64 {
        match packets {
            Packets::Four(packets) => self.count(packets, |rays, scene, arguments| {
                // SAFETY: the scene is committed, the rays are finite, the arguments initialised.
                unsafe { self.embree.intersect4(ALL.0.as_ptr(), scene, rays, arguments) }
            }),
            Packets::Eight(packets) => self.count(packets, |rays, scene, arguments| {
                // SAFETY: the same.
                unsafe { self.embree.intersect8(ALL.0.as_ptr(), scene, rays, arguments) }
            }),
            Packets::Sixteen(packets) => self.count(packets, |rays, scene, arguments| {
                // SAFETY: the same.
                unsafe { self.embree.intersect16(ALL.0.as_ptr(), scene, rays, arguments) }
            }),
        }
    }

    fn count<P: Send>(
        &self,
        packets: &mut [P],
        intersect: impl Fn(&mut P, RTCScene, &mut RTCIntersectArguments) + Sync,
    ) -> u64 {
        let task = |packets: &mut [P]| {
            let mut counter = Counter { context: RTCRayQueryContext::default(), hits: 0 };
            let mut arguments = RTCIntersectArguments::default();
            // SAFETY: the structs are those of the headers that were bound.
            unsafe {
                rtcInitRayQueryContext(&mut counter.context);
                rtcInitIntersectArguments(&mut arguments);
            }
            arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
            arguments.filter = Some(count);
            // The pointer is to the whole counter: that is what the filter makes of it.
            arguments.context = ptr::from_mut(&mut counter).cast();
            packets.iter_mut().for_each(|rays| intersect(rays, self.scene, &mut arguments));
            counter.hits
        };
        packets.par_chunks_mut(PACKETS).map(task).sum()
    }
}

/// Rays in Embree's layout; those of the last packet that there are not are the last ray again.
pub enum Packets {
    Four(Vec<RTCRayHit4>),
    Eight(Vec<RTCRayHit8>),
    Sixteen(Vec<RTCRayHit16>),
}

macro_rules! packets {
    ($struct:ty, $width:literal, $rays:ident) => {
        $rays.chunks($width).map(|rays| {
            let mut packet = <$struct>::default();
            for lane in 0..$width {
                let Ray { origin, direction } = rays[lane.min(rays.len() - 1)];
                let ray = &mut packet.ray;
                [ray.org_x[lane], ray.org_y[lane], ray.org_z[lane]] = origin;
                [ray.dir_x[lane], ray.dir_y[lane], ray.dir_z[lane]] = direction;
                ray.tfar[lane] = f32::INFINITY;
                ray.mask[lane] = u32::MAX;
                packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            }
            packet
        })
    };
}

impl Packets {
    /// Packets of 16, 8 or 4.
    pub fn new(width: usize, rays: &[Ray]) -> Self {
        match width {
            16 => Self::Sixteen(packets!(RTCRayHit16, 16, rays).collect()),
            8 => Self::Eight(packets!(RTCRayHit8, 8, rays).collect()),
            _ => Self::Four(packets!(RTCRayHit4, 4, rays).collect()),
        }
    }
}
