//! Pages of sixteen samples, and the tests on them that do nearly all work of a fill, in `f32`.
//!
//! A sample has three coordinates or, where the radius varies, a fourth one: half of its radius. Every sample and every
//! place then has a ball of half its radius around it. Two samples conflict when their balls overlap, and a place is
//! covered when its ball overlaps that of a sample. A triangle is covered by a sample when its three corners are: the
//! distance to a sample, less a radius that changes linearly over the triangle, is convex.
//!
//! Squared distances are compared with a limit or, where samples have radii, with the square of the sum of the two
//! times a limit near 1. The tests give only answers that are certain; everything else is decided later, in smaller
//! parts or in `f64` (`grid.rs`). All levels of vector instructions give the same bits.

use glam::DVec3;

use crate::psp::fill::space::Place;
use crate::simd::{self, Lanes, Work};

/// The samples on a page.
pub const LANES: usize = simd::LANES;

/// Balls certainly overlap if their squared distance is at most this share of the square of the sum of their radii.
/// (Rounding amounts to 2e-6.)
pub const WITHIN: f32 = 1.0 - 1e-5;
/// Balls certainly do not overlap if their squared distance is at least this share of the square of the sum of their
/// radii. (Rounding amounts to 2e-6.)
pub const BEYOND: f32 = 1.0 + 1e-4;

/// A coordinate for lanes without a sample. Its square is a float.
const FAR: f32 = 1e18;

/// The axes of space, before that of radii.
const SPACE: usize = 3;

/// Up to sixteen samples, one axis after the other; lanes without a sample are far away.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Page<const AXES: usize>(pub [[f32; LANES]; AXES]);

const THIRD: f64 = 1.0 / 3.0;

/// Triangles that are tested together.
pub const BATCH: usize = 64;

/// Triangles by their corners, and a page for each.
pub struct Batch<const AXES: usize = SPACE> {
    pub triangles: [[[f32; AXES]; 3]; BATCH],
    pub pages: [u32; BATCH],
}

/// A fragment relative to a place near it.
pub struct Part<const AXES: usize> {
    pub origin: Place,
    pub corner: [f32; AXES],
    /// The differences of the other two corners from that one.
    pub edges: [[f32; AXES]; 2],
    /// The centre, and the limit of the squared distances from it of samples that cover any of it.
    pub centre: [f32; AXES],
    pub limit: f32,
}

impl<const AXES: usize> Part<AXES> {
    /// A fragment by its corners and half of the radii there; `reach` is the radius of a ball around its centre that
    /// every sample lies in, or with a ball of its own overlaps, that covers any of it.
    #[inline(always)]
    pub fn new([a, b, c]: [DVec3; 3], halves: [f64; 3], reach: f32) -> Self {
        let origin = a.as_vec3();
        let [corner, to_b, to_c] = [a - origin.as_dvec3(), b - a, c - a];
        let centre = with(corner + (to_b + to_c) * THIRD, reach);
        Self {
            origin: origin.to_array(),
            corner: with(corner, halves[0] as f32),
            edges: [with(to_b, (halves[1] - halves[0]) as f32), with(to_c, (halves[2] - halves[0]) as f32)],
            centre,
            limit: if AXES > SPACE { BEYOND } else { reach * reach * BEYOND },
        }
    }
}

/// A vector in space, with a radius if there is an axis for it.
#[inline(always)]
fn with<const AXES: usize>(vector: DVec3, radius: f32) -> [f32; AXES] {
    let (vector, mut all) = (vector.as_vec3(), [radius; AXES]);
    [all[0], all[1], all[2]] = [vector.x, vector.y, vector.z];
    all
}

impl<const AXES: usize> Page<AXES> {
    /// A page without samples.
    pub const EMPTY: Self = {
        let (mut page, mut axis) = ([[FAR; LANES]; AXES], SPACE);
        while axis < AXES {
            page[axis] = [0.0; LANES];
            axis += 1;
        }
        Self(page)
    };

    /// Puts a sample into a lane.
    pub fn put(&mut self, lane: usize, sample: [f32; AXES]) {
        (0..AXES).for_each(|axis| self.0[axis][lane] = sample[axis]);
    }

    /// The sample in a lane.
    pub fn sample(&self, lane: usize) -> [f32; AXES] {
        std::array::from_fn(|axis| self.0[axis][lane])
    }

    /// The place of the sample in a lane.
    pub fn place(&self, lane: usize) -> Place {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }
}

impl<const AXES: usize> Batch<AXES> {
    pub const EMPTY: Self = Self { triangles: [[[0.0; AXES]; 3]; BATCH], pages: [0; BATCH] };
}

/// The samples of a page, one axis after the other.
#[inline(always)]
pub fn samples<const AXES: usize, L: Lanes>(lanes: L, page: &Page<AXES>) -> [L::Floats; AXES] {
    let (mut samples, mut axis) = ([lanes.splat(0.0); AXES], 0);
    while axis < AXES {
        samples[axis] = lanes.load(&page.0[axis]);
        axis += 1;
    }
    samples
}

/// The squared distances of sixteen samples from one, and what they are compared with.
#[inline(always)]
pub fn squares<const AXES: usize, L: Lanes>(
    lanes: L,
    samples: [L::Floats; AXES],
    from: [f32; AXES],
    limit: f32,
) -> [L::Floats; 2] {
    let x = lanes.sub(samples[0], lanes.splat(from[0]));
    let y = lanes.sub(samples[1], lanes.splat(from[1]));
    let z = lanes.sub(samples[2], lanes.splat(from[2]));
    let (mut limits, mut axis) = (lanes.splat(limit), SPACE);
    while axis < AXES {
        let sums = lanes.add(samples[axis], lanes.splat(from[axis]));
        limits = lanes.mul(lanes.mul(sums, sums), limits);
        axis += 1;
    }
    [lanes.add(lanes.add(lanes.mul(x, x), lanes.mul(y, y)), lanes.mul(z, z)), limits]
}

/// The samples of a page whose squared distance from one does not exceed the limit: a bit for each.
pub struct Near<'a, const AXES: usize> {
    pub page: &'a Page<AXES>,
    pub from: [f32; AXES],
    pub limit: f32,
}

impl<const AXES: usize> Work for Near<'_, AXES> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let [squares, limits] = squares(lanes, samples(lanes, self.page), self.from, self.limit);
        lanes.bits(lanes.at_most(squares, limits)) as u16
    }
}

/// The samples of a page whose squared distances from all three corners are below the limit.
pub struct Covering<'a, const AXES: usize> {
    pub page: &'a Page<AXES>,
    pub corners: &'a [[f32; AXES]; 3],
    pub limit: f32,
}

impl<const AXES: usize> Work for Covering<'_, AXES> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let (samples, [a, b, c]) = (samples(lanes, self.page), *self.corners);
        let two = lanes.both(covered(lanes, samples, a, self.limit), covered(lanes, samples, b, self.limit));
        lanes.bits(lanes.both(two, covered(lanes, samples, c, self.limit))) as u16
    }
}

/// The lanes whose squared distance is below the limit.
#[inline(always)]
fn covered<const AXES: usize, L: Lanes>(
    lanes: L,
    samples: [L::Floats; AXES],
    from: [f32; AXES],
    limit: f32,
) -> L::Mask {
    let [squares, limits] = squares(lanes, samples, from, limit);
    lanes.less(squares, limits)
}

/// The triangles of a group that one sample of their page covers: a bit for each.
pub struct CoveredTriangles<'a, const AXES: usize> {
    pub group: &'a Batch<AXES>,
    pub pages: &'a [Page<AXES>],
    pub limit: f32,
}

impl<const AXES: usize> Work for CoveredTriangles<'_, AXES> {
    type Out = u64;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u64 {
        let (mut covered, limit) = (0, self.limit);
        for (lane, &page) in self.group.pages.iter().enumerate() {
            let (page, corners) = (&self.pages[page as usize], &self.group.triangles[lane]);
            covered |= u64::from(Covering { page, corners, limit }.run(lanes) != 0) << lane;
        }
        covered
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};
    use crate::simd::{Level, run};

    /// On pages with samples of this radius, give or take the spread, and squared distances of about 1.
    fn all_vectors_give_the_same_bits<const AXES: usize>(radius: f32, spread: f64, limit: f32) {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let mut counts = [0; 2];
        for _ in 0..1000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let mut sample = |at: [f32; 3], size: f64| -> [f32; AXES] {
                let axes = [0, 1, 2].map(|axis| f64::from(at[axis] + coordinate(size)));
                with(DVec3::from_array(axes), radius + coordinate(spread))
            };
            let mut pages = [Page::EMPTY; 4];
            for page in &mut pages[1..] {
                (0..13).for_each(|lane| page.put(lane, sample([0.0; 3], 1.5)));
            }
            let mut group = Batch::EMPTY;
            for lane in 0..60 {
                let ([x, y, z], size) =
                    (sample([0.0; 3], 1.0).first_chunk().copied().unwrap(), [0.5, 0.1, 1e-4][lane % 3]);
                group.triangles[lane] = [(); 3].map(|()| sample([x, y, z], size));
                group.pages[lane] = lane as u32 % 4;
            }
            let from = sample([0.0; 3], 1.0);
            let all = |level: Level| {
                let corners = [0, 1, 2]
                    .map(|page| run(level, Covering { page: &pages[page], corners: &group.triangles[page], limit }));
                let triangles = run(level, CoveredTriangles { group: &group, pages: &pages, limit });
                (run(level, Near { page: &pages[1], from, limit }), corners, triangles)
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|level| all(level) == expected));
            counts[0] += expected.0.count_ones();
            counts[1] += expected.2.count_ones();
        }
        assert!(counts.into_iter().all(|count| count > 1000), "{counts:?}");
    }

    #[test]
    fn all_vectors_give_the_same_bits_with_one_radius_and_with_many() {
        all_vectors_give_the_same_bits::<3>(0.0, 0.0, 1.0);
        all_vectors_give_the_same_bits::<4>(0.5, 0.4, WITHIN);
    }
}
