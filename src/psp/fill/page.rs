//! Pages of sixteen samples, and the tests on them that do nearly all work of a fill, in `f32`.
//!
//! The tests give only answers that are certain; everything else is decided later, in smaller parts or in `f64`
//! (`grid.rs`). All levels of vector instructions give the same bits.

use glam::DVec3;

use crate::psp::fill::space::Place;
use crate::simd::{self, Lanes, Work};

/// The samples on a page.
pub const LANES: usize = simd::LANES;

/// A coordinate for lanes without a sample. Its square is a float.
const FAR: f32 = 1e18;

/// The places of up to sixteen samples, one axis after the other; lanes without a sample are far away.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Page(pub [[f32; LANES]; 3]);

const THIRD: f64 = 1.0 / 3.0;
/// The factor by which rounding can increase the square of a reach, and more.
const REACH_SLACK: f32 = 1.0001;

/// Triangles that are tested together.
pub const GROUP: usize = 64;

/// Some triangles, by their corners, and a page for each.
pub struct Group {
    pub triangles: [[Place; 3]; GROUP],
    pub pages: [u32; GROUP],
}

/// A fragment relative to a place near it.
pub struct Part {
    pub origin: Place,
    pub corner: [f32; 3],
    /// The vectors from the corner to the other two.
    pub edges: [[f32; 3]; 2],
    pub centre: [f32; 3],
    /// The squared distance from the centre above which no sample covers any of it.
    pub reach2: f32,
}

impl Part {
    /// A fragment by its corners; `reach` is the largest distance from its centre of samples that cover any of it.
    #[inline(always)]
    pub fn new([a, b, c]: [DVec3; 3], reach: f32) -> Self {
        let origin = a.as_vec3();
        let [corner, to_b, to_c] = [a - origin.as_dvec3(), b - a, c - a];
        Self {
            origin: origin.to_array(),
            corner: corner.as_vec3().to_array(),
            edges: [to_b.as_vec3().to_array(), to_c.as_vec3().to_array()],
            centre: (corner + (to_b + to_c) * THIRD).as_vec3().to_array(),
            reach2: reach * reach * REACH_SLACK,
        }
    }
}

impl Page {
    /// A page without samples.
    pub const EMPTY: Self = Self([[FAR; LANES]; 3]);

    /// Puts a sample into a lane.
    pub fn put(&mut self, lane: usize, place: Place) {
        (0..3).for_each(|axis| self.0[axis][lane] = place[axis]);
    }

    /// The sample in a lane.
    pub fn place(&self, lane: usize) -> Place {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }
}

impl Group {
    pub const EMPTY: Self = Self { triangles: [[[0.0; 3]; 3]; GROUP], pages: [0; GROUP] };
}

/// The samples of a page, one axis after the other.
#[inline(always)]
pub fn samples<L: Lanes>(lanes: L, page: &Page) -> [L::Floats; 3] {
    [lanes.load(&page.0[0]), lanes.load(&page.0[1]), lanes.load(&page.0[2])]
}

/// The squared distances of sixteen places from one.
#[inline(always)]
pub fn squares<L: Lanes>(lanes: L, places: [L::Floats; 3], from: Place) -> L::Floats {
    let x = lanes.sub(places[0], lanes.splat(from[0]));
    let y = lanes.sub(places[1], lanes.splat(from[1]));
    let z = lanes.sub(places[2], lanes.splat(from[2]));
    lanes.add(lanes.add(lanes.mul(x, x), lanes.mul(y, y)), lanes.mul(z, z))
}

/// The samples of a page that are no farther from a place than the square root of `limit`: a bit for each.
pub struct Near<'a> {
    pub page: &'a Page,
    pub place: Place,
    pub limit: f32,
}

impl Work for Near<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let squares = squares(lanes, samples(lanes, self.page), self.place);
        lanes.bits(lanes.at_most(squares, lanes.splat(self.limit))) as u16
    }
}

/// The samples of a page that are nearer to all three corners than the square root of `limit`.
pub struct Covering<'a> {
    pub page: &'a Page,
    pub corners: &'a [Place; 3],
    pub limit: f32,
}

impl Work for Covering<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let (samples, [a, b, c]) = (samples(lanes, self.page), *self.corners);
        // The farthest corner decides.
        let farthest = lanes.max(squares(lanes, samples, a), squares(lanes, samples, b));
        let farthest = lanes.max(farthest, squares(lanes, samples, c));
        lanes.bits(lanes.less(farthest, lanes.splat(self.limit))) as u16
    }
}

/// The triangles of a group that lie, with their three corners, nearer to one sample of their page than the square root
/// of `limit`: a bit for each.
pub struct CoveredTriangles<'a> {
    pub group: &'a Group,
    pub pages: &'a [Page],
    pub limit: f32,
}

impl Work for CoveredTriangles<'_> {
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

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let mut counts = [0; 2];
        for _ in 0..1000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let mut pages = [Page::EMPTY; 4];
            for page in &mut pages[1..] {
                (0..13).for_each(|lane| page.put(lane, std::array::from_fn(|_| coordinate(1.5))));
            }
            let mut group = Group::EMPTY;
            for lane in 0..60 {
                let (at, size) = ([(); 3].map(|()| coordinate(1.0)), [0.5, 0.1, 1e-4][lane % 3]);
                let corners = [(); 3].map(|()| std::array::from_fn(|axis| at[axis] + coordinate(size)));
                group.triangles[lane] = corners;
                group.pages[lane] = lane as u32 % 4;
            }
            let place = [(); 3].map(|()| coordinate(1.0));
            let all = |level: Level| {
                let corners = [0, 1, 2].map(|page| {
                    run(level, Covering { page: &pages[page], corners: &group.triangles[page], limit: 1.0 })
                });
                let triangles = run(level, CoveredTriangles { group: &group, pages: &pages, limit: 1.0 });
                (run(level, Near { page: &pages[1], place, limit: 1.0 }), corners, triangles)
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|level| all(level) == expected));
            counts[0] += expected.0.count_ones();
            counts[1] += expected.2.count_ones();
        }
        assert!(counts.into_iter().all(|count| count > 1000), "{counts:?}");
    }
}
