//! Pages of sixteen samples with a radius each, and the tests on them, in `f32`: the counterpart of `psp/fill/page.rs`,
//! which is for one radius.
//!
//! Every sample and every place has a ball of half its radius around it. Two samples conflict when their balls overlap,
//! and a place is covered when its ball overlaps that of a sample. A triangle is covered by a sample when its three
//! corners are: the distance to a sample, less a radius that changes linearly over the triangle, is convex.
//!
//! As there, the tests give only answers that are certain, and all levels of vector instructions give the same bits.

use crate::psp::fill::page::GROUP;
use crate::psp::fill::space::Place;
use crate::psp::fragment::{CORNERS, Cover};
use crate::simd::{self, Lanes, Work};

/// The samples on a page.
pub(super) const LANES: usize = simd::LANES;

/// Balls certainly overlap if their squared distance is at most this share of the square of the sum of their radii.
/// (Rounding amounts to 2e-6.)
pub(super) const WITHIN: f32 = 1.0 - 1e-5;
/// Balls certainly do not overlap if their squared distance is at least this share of the square of the sum of their
/// radii. (Rounding amounts to 2e-6.)
pub(super) const BEYOND: f32 = 1.0 + 1e-4;

/// A coordinate for lanes without a sample. Its square is a float.
const FAR: f32 = 1e18;

/// A place, and half of the radius there.
pub(super) type Ball = [f32; 4];

/// The balls of up to sixteen samples, one axis after the other; lanes without a sample are far away.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Page(pub [[f32; LANES]; 4]);

/// Some triangles, by the balls of their corners, and a page for each.
pub(super) struct Group {
    pub triangles: [[Ball; 3]; GROUP],
    pub pages: [u32; GROUP],
}

/// A fragment relative to a place near it.
pub(super) struct Part {
    pub origin: Place,
    /// The ball of a corner.
    pub corner: Ball,
    /// The differences of the balls of the other two corners from that ball.
    pub edges: [Ball; 2],
    /// A ball that overlaps that of any sample which covers a sixteenth.
    pub whole: Ball,
}

impl Page {
    /// A page without samples.
    pub const EMPTY: Self = Self([[FAR; LANES], [FAR; LANES], [FAR; LANES], [0.0; LANES]]);

    /// Puts a sample into a lane.
    pub fn put(&mut self, lane: usize, ball: Ball) {
        (0..4).for_each(|axis| self.0[axis][lane] = ball[axis]);
    }
}

impl Group {
    pub const EMPTY: Self = Self { triangles: [[[0.0; 4]; 3]; GROUP], pages: [0; GROUP] };
}

/// The samples of a page, one axis after the other.
#[inline(always)]
fn samples<L: Lanes>(lanes: L, page: &Page) -> [L::Floats; 4] {
    [lanes.load(&page.0[0]), lanes.load(&page.0[1]), lanes.load(&page.0[2]), lanes.load(&page.0[3])]
}

/// The squared distances of sixteen balls from one, and a share of the squares of the sums of their radii.
#[inline(always)]
fn squares<L: Lanes>(lanes: L, balls: [L::Floats; 4], ball: Ball, share: f32) -> [L::Floats; 2] {
    let x = lanes.sub(balls[0], lanes.splat(ball[0]));
    let y = lanes.sub(balls[1], lanes.splat(ball[1]));
    let z = lanes.sub(balls[2], lanes.splat(ball[2]));
    let squares = lanes.add(lanes.add(lanes.mul(x, x), lanes.mul(y, y)), lanes.mul(z, z));
    let sums = lanes.add(balls[3], lanes.splat(ball[3]));
    [squares, lanes.mul(lanes.mul(sums, sums), lanes.splat(share))]
}

/// The lanes in which one of sixteen balls may overlap a given one.
#[inline(always)]
fn may_overlap<L: Lanes>(lanes: L, balls: [L::Floats; 4], ball: Ball) -> L::Mask {
    let [squares, limits] = squares(lanes, balls, ball, BEYOND);
    lanes.at_most(squares, limits)
}

/// The lanes in which one of sixteen balls certainly overlaps a given one.
#[inline(always)]
fn overlap<L: Lanes>(lanes: L, balls: [L::Floats; 4], ball: Ball) -> L::Mask {
    let [squares, limits] = squares(lanes, balls, ball, WITHIN);
    lanes.less(squares, limits)
}

/// The samples of a page that may overlap a ball: a bit for each.
pub struct Near<'a> {
    pub page: &'a Page,
    pub ball: Ball,
}

impl Work for Near<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        lanes.bits(may_overlap(lanes, samples(lanes, self.page), self.ball)) as u16
    }
}

/// The samples of a page that certainly cover all three corners of a triangle.
pub struct Covering<'a> {
    pub page: &'a Page,
    pub corners: &'a [Ball; 3],
}

impl Work for Covering<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let (samples, [a, b, c]) = (samples(lanes, self.page), *self.corners);
        let two = lanes.both(overlap(lanes, samples, a), overlap(lanes, samples, b));
        lanes.bits(lanes.both(two, overlap(lanes, samples, c))) as u16
    }
}

/// The triangles of a group that a sample of their page certainly covers: a bit for each.
pub struct CoveredTriangles<'a> {
    pub group: &'a Group,
    pub pages: &'a [Page],
}

impl Work for CoveredTriangles<'_> {
    type Out = u64;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u64 {
        let mut covered = 0;
        for (lane, &page) in self.group.pages.iter().enumerate() {
            let (page, corners) = (&self.pages[page as usize], &self.group.triangles[lane]);
            covered |= u64::from(Covering { page, corners }.run(lanes) != 0) << lane;
        }
        covered
    }
}

/// The sixteenths of a fragment that one of the samples `among` these of a page certainly covers.
pub struct CoveredSixteenths<'a> {
    pub page: &'a Page,
    pub part: &'a Part,
    pub among: u16,
}

impl Work for CoveredSixteenths<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let Self { page, part, among } = self;
        let [x, y, z, radii] = samples(lanes, page);
        let [from_x, from_y, from_z] = part.origin;
        let (x, y) = (lanes.sub(x, lanes.splat(from_x)), lanes.sub(y, lanes.splat(from_y)));
        let seen = [x, y, lanes.sub(z, lanes.splat(from_z)), radii];
        let mut reaching = lanes.bits(may_overlap(lanes, seen, part.whole)) as u16 & among;
        if reaching == 0 {
            return 0;
        }
        let (s, t) = (lanes.load(&CORNERS[0]), lanes.load(&CORNERS[1]));
        let (mut corners, mut balls) = (seen, [[0.0; LANES]; 4]);
        let mut axis = 0;
        while axis < 4 {
            lanes.store(seen[axis], &mut balls[axis]);
            let e = lanes.mul(s, lanes.splat(part.edges[0][axis]));
            let f = lanes.mul(t, lanes.splat(part.edges[1][axis]));
            corners[axis] = lanes.add(lanes.splat(part.corner[axis]), lanes.add(e, f));
            axis += 1;
        }
        let mut cover = Cover::default();
        while reaching != 0 {
            let lane = reaching.trailing_zeros() as usize % LANES;
            let sample = [balls[0][lane], balls[1][lane], balls[2][lane], balls[3][lane]];
            cover.add(lanes.bits(overlap(lanes, corners, sample)) as u16);
            reaching &= reaching - 1;
        }
        cover.sixteenths()
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
        let mut counts = [0; 3];
        for round in 0..1000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let mut pages = [Page::EMPTY; 4];
            for page in &mut pages[1..] {
                for lane in 0..13 {
                    let [x, y, z] = [(); 3].map(|()| coordinate(1.5));
                    page.put(lane, [x, y, z, 0.5 + coordinate(0.4)]);
                }
            }
            let mut group = Group::EMPTY;
            for lane in 0..60 {
                let (at, size) = ([(); 3].map(|()| coordinate(1.0)), [0.5, 0.1, 1e-4][lane % 3]);
                group.triangles[lane] = [(); 3].map(|()| {
                    let [x, y, z] = at.map(|x| x + coordinate(size));
                    [x, y, z, 0.5 + coordinate(0.1)]
                });
                group.pages[lane] = lane as u32 % 4;
            }
            let mut ball = |size: f64, half: f32, change: f64| -> Ball {
                let [x, y, z] = [(); 3].map(|()| coordinate(size));
                [x, y, z, half + coordinate(change)]
            };
            let (place, size) = (ball(1.0, 0.5, 0.1), [1.0, 0.3, 1e-3][round % 3]);
            let [x, y, z, _] = ball(0.5, 0.0, 0.0);
            let part = Part {
                origin: [x, y, z],
                corner: ball(0.1, 0.5, 0.1),
                edges: [ball(size, 0.0, 0.2 * size), ball(size, 0.0, 0.2 * size)],
                whole: ball(0.3, 1.0, 0.1),
            };
            let among = if round % 4 == 0 { 0x5a5a } else { u16::MAX };
            let all = |level: Level| {
                let parts =
                    [1, 2, 3].map(|page| run(level, CoveredSixteenths { page: &pages[page], part: &part, among }));
                let corners =
                    [0, 1, 2].map(|page| run(level, Covering { page: &pages[page], corners: &group.triangles[page] }));
                let triangles = run(level, CoveredTriangles { group: &group, pages: &pages });
                (run(level, Near { page: &pages[1], ball: place }), corners, triangles, parts)
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|level| all(level) == expected));
            counts[0] += expected.0.count_ones();
            counts[1] += expected.2.count_ones();
            counts[2] += expected.3.map(u16::count_ones).iter().sum::<u32>();
        }
        assert!(counts.into_iter().all(|count| count > 1000), "{counts:?}");
    }
}
