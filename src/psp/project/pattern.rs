//! The pattern on the projectors: a maximal periodic Poisson-disk set (thesis §3.3.1), made by KDRT as §3.4.5 suggests.
//!
//! The thesis fills a whole projector with one pattern. Here a pattern has at most a few million points and is repeated
//! if the projector is larger: memory stays bounded, and since the surface is curved and every iteration is rotated,
//! the period leaves no trace.

use std::ops::ControlFlow;

use crate::error::Result;
use crate::index::Buckets;
use crate::job::{Job, chunks_of};
use crate::kdrt;
use crate::points::{Boundary, Domain};

/// Points per chunk: enough rays to keep a task busy, few enough to stay together on the surface.
const CHUNK: usize = 4096;
/// Side of the largest pattern, in radii: about four million points.
const LARGEST_SIDE: f64 = 2390.0;
/// Side of the smallest pattern, in radii: no point is its own neighbour around the torus.
const SMALLEST_SIDE: f64 = 8.0;

/// Points for a square of side `extent`, repeated with a period that is returned with them; in radii.
pub fn torus(job: &Job, extent: f64, seed: u64) -> Result<(f64, Vec<[f32; 2]>)> {
    let side = extent.clamp(SMALLEST_SIDE, LARGEST_SIDE);
    let domain = Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Periodic };
    let options = kdrt::Options::new(1.0).domain(domain).seed(seed);
    let progress = |share| job.report(share).map_or(ControlFlow::Break(()), ControlFlow::Continue);
    Ok((side, kdrt::sample(job.context(), &options, Some(&progress))?.positions))
}

/// Points on the torus of a given side, in units of the radius, in the order in which rays are traced.
pub struct RayPattern {
    pub side: f64,
    /// In Morton order, so that rays of a packet and packets of a task meet the same part of the mesh.
    points: Vec<[f32; 2]>,
    /// The lower and upper corner of each chunk.
    bounds: Vec<[[f32; 2]; 2]>,
}

impl RayPattern {
    /// A pattern for a square of side `extent`, in radii.
    pub fn new(job: &Job, extent: f64, seed: u64) -> Result<Self> {
        let (side, points) = torus(&job.part(0.0, 0.7), extent, seed)?;
        let key = |point: &[f32; 2]| morton(point.map(|x| (f64::from(x) / side * 65536.0) as u16));
        let points = sorted(&job.part(0.7, 1.0), &points, key)?;
        let bounds = points.chunks(CHUNK).map(|chunk| {
            let bound = |start: f32, pick: fn(f32, f32) -> f32| {
                [0, 1].map(|axis| chunk.iter().fold(start, |bound, point| pick(bound, point[axis])))
            };
            [bound(f32::INFINITY, f32::min), bound(f32::NEG_INFINITY, f32::max)]
        });
        Ok(Self { side, bounds: bounds.collect(), points })
    }

    /// The number of chunks.
    pub fn chunks(&self) -> usize {
        self.bounds.len()
    }

    /// The points of a chunk, moved by `offset`, that lie within `half` of the origin on both axes.
    pub fn chunk(&self, chunk: usize, offset: [f64; 2], half: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let [low, high] = self.bounds[chunk];
        let apart = |axis: usize| {
            f64::from(low[axis]) + offset[axis] > half[axis] || f64::from(high[axis]) + offset[axis] < -half[axis]
        };
        let end = self.points.len().min((chunk + 1) * CHUNK);
        let points = if apart(0) || apart(1) { &[] } else { &self.points[chunk * CHUNK..end] };
        let moved = points.iter().map(move |point| [0, 1].map(|axis| f64::from(point[axis]) + offset[axis]));
        moved.filter(move |point| point[0].abs() <= half[0] && point[1].abs() <= half[1])
    }
}

/// The points sorted by a key: into 256 parts by its upper bits, then each part.
fn sorted(job: &Job, points: &[[f32; 2]], key: impl Fn(&[f32; 2]) -> u32 + Sync) -> Result<Vec<[f32; 2]>> {
    let chunks = chunks_of(points.len(), 16 * CHUNK);
    let (parts, _) = Buckets::collect(&job.part(0.0, 0.3), chunks.len(), |chunk, add| {
        points[chunks.range(chunk)].iter().for_each(|point| add(key(point) >> 24, *point));
    })?;
    job.part(0.3, 1.0).flat_map(parts.len(), |part| {
        let mut points: Vec<_> = parts.items(part).copied().collect();
        points.sort_by_cached_key(&key);
        points
    })
}

/// The bits of two coordinates, interleaved: near points are mostly near in this order (Morton 1966).
fn morton([x, y]: [u16; 2]) -> u32 {
    let spread = |bits: u16| {
        [8, 4, 2, 1].into_iter().fold(u32::from(bits), |bits, shift| {
            let mask = u32::MAX / ((1 << shift) + 1);
            (bits | bits << shift) & mask
        })
    };
    spread(x) | spread(y) << 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;

    #[test]
    fn sorting_in_parts_sorts() {
        let points: Vec<_> = (0..100_000u32).map(|i| [i.wrapping_mul(2_654_435_769) as f32, i as f32]).collect();
        let key = |point: &[f32; 2]| point[0] as u32;
        let mut expected = points.clone();
        expected.sort_by_key(key);
        assert_eq!(Context::new(2).unwrap().run(None, |job| sorted(job, &points, key)).unwrap(), expected);
    }

    #[test]
    fn morton_interleaves_the_bits() {
        assert_eq!(morton([0xffff, 0]), 0x5555_5555);
        assert_eq!(morton([0, 0xffff]), 0xaaaa_aaaa);
        assert_eq!(morton([0b101, 0b011]), 0b01_10_11);
    }

    /// Copies of the pattern side by side: every point of a window comes from exactly one chunk of one copy.
    #[test]
    fn chunks_are_cut_to_a_window_and_repeat_around_the_torus() {
        let pattern = Context::new(1).unwrap().run(None, |job| RayPattern::new(job, 100.0, 5)).unwrap();
        assert_eq!(pattern.side, 100.0);
        let window = |offset: [f64; 2]| -> usize {
            let tiles = [-2, -1, 0, 1].map(f64::from);
            let copies = tiles.iter().flat_map(|x| tiles.map(|y| [offset[0] + x * 100.0, offset[1] + y * 100.0]));
            copies
                .map(|copy| (0..pattern.chunks()).map(|c| pattern.chunk(c, copy, [50.0, 50.0]).count()).sum::<usize>())
                .sum()
        };
        assert_eq!(window([3.25, -40.0]), pattern.points.len());
        assert!(pattern.chunks() > 1 && pattern.points.len().div_ceil(CHUNK) == pattern.chunks());
    }
}
