//! A scene of triangles, and every hit on every ray that is sent through it.

use embree4_sys::{RTCRayHit, RTCRayHit4, RTCRayHit8, RTCRayHit16};

use crate::error::{Error, Result};
use crate::job::{Context, Job};
use crate::trace::build::Built;
use crate::trace::layout::RayHits;
use crate::trace::packet::Packet;
use crate::trace::ray::{Hit, LARGEST_COORDINATE, Ray};
use crate::trace::recorder::Recorder;

/// How many packets are filled before they are traced: Embree reads whole vectors, and the processor makes it wait for
/// what was stored lane by lane a moment ago.
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
    /// but the caller's), in O(n log n).
    ///
    /// Embree knows one bound for the threads of a process, the largest that one of its devices has, and sets it for all
    /// that uses TBB. A scene has a device of its own, with `num_threads`. So a build beside a device with more threads can
    /// use as many, and a device with fewer can use `num_threads` while this scene lives, but not after it.
    ///
    /// Embree calculates in `f32` with fixed thresholds: scale a mesh to about the unit box before.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `positions` that are not finite or above 1e18, and for `triangles` with an index
    /// beyond the positions; [`Error::Embree`] if the library that was loaded is not the version that this crate was
    /// built for, or if Embree refuses, for want of memory or another reason that it gives.
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]], num_threads: usize) -> Result<Self> {
        Context::new(1)?.run(None, |job| Self::build(job, positions, triangles, num_threads))
    }

    /// [`Scene::new`] as a part of a job, which can be cancelled.
    pub(crate) fn build(job: &Job, positions: &[[f32; 3]], triangles: &[[u32; 3]], num_threads: usize) -> Result<Self> {
        check(positions, triangles)?;
        let built = Built::new(positions, triangles, num_threads, job)?;
        let packet_width = built.packet_width();
        Ok(Self { built, packet_width })
    }

    /// How many rays this machine traces at once: 16, 8 or 4.
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
fn check(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
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
