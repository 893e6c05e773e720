//! Pages of sixteen samples with a radius each, and the tests on them, in `f32`: what `psp/fill/page.rs` is for one
//! radius.
//!
//! Everything has a ball of half its radius around it. Two samples conflict when their balls overlap, and a place is
//! covered when its ball overlaps that of a sample. A triangle is covered by a sample when its three corners are: the
//! distance to a sample, less a radius that changes evenly over the triangle, is convex.
//!
//! As there, the tests say what is certain, and `vectors/` has the same functions, equal to the bit.

use crate::psp::fill::page::GROUP;
use crate::psp::fill::space::Place;
use crate::psp::sixteenths::{CORNERS, Cover};

/// The samples on a page.
pub(super) const LANES: usize = 16;

/// Balls with a squared distance of up to this share of the square of their radii's sum certainly overlap, ...
pub(super) const WITHIN: f32 = 1.0 - 1e-5;
/// ... and from this on they certainly do not. (Rounding amounts to 2e-6.)
pub(super) const BEYOND: f32 = 1.0 + 1e-4;

/// A coordinate of no sample. Its square is a float.
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

/// A fragment as seen from a place near it.
pub(super) struct Part {
    pub origin: Place,
    /// The ball of a corner.
    pub corner: Ball,
    /// From there to the balls of the other two.
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

    /// Which samples may overlap a ball: a bit for each.
    pub fn near(&self, ball: Ball) -> u16 {
        self.overlapping(ball, BEYOND)
    }

    /// Which samples certainly cover all three corners of a triangle.
    pub fn covering(&self, [a, b, c]: &[Ball; 3]) -> u16 {
        self.covers(*a) & self.covers(*b) & self.covers(*c)
    }

    fn overlapping(&self, ball: Ball, share: f32) -> u16 {
        let mut near = 0;
        for lane in 0..LANES {
            let sum = self.0[3][lane] + ball[3];
            near |= u16::from(self.square(lane, ball) <= sum * sum * share) << lane;
        }
        near
    }

    fn covers(&self, ball: Ball) -> u16 {
        let mut covers = 0;
        for lane in 0..LANES {
            let sum = self.0[3][lane] + ball[3];
            covers |= u16::from(self.square(lane, ball) < sum * sum * WITHIN) << lane;
        }
        covers
    }

    fn square(&self, lane: usize, ball: Ball) -> f32 {
        square([0, 1, 2].map(|axis| self.0[axis][lane] - ball[axis]))
    }

    /// The sixteenths of a fragment that one of the samples `among` these certainly covers.
    pub fn covered(&self, part: &Part, among: u16) -> u16 {
        let mut cover = Cover::default();
        let corners: [Ball; 16] = std::array::from_fn(|i| {
            [0, 1, 2, 3].map(|axis| {
                part.corner[axis] + (CORNERS[0][i] * part.edges[0][axis] + CORNERS[1][i] * part.edges[1][axis])
            })
        });
        for lane in (0..LANES).filter(|lane| among >> lane & 1 == 1) {
            let sample = [0, 1, 2].map(|axis| self.0[axis][lane] - part.origin[axis]);
            let sum = self.0[3][lane] + part.whole[3];
            if square([0, 1, 2].map(|axis| sample[axis] - part.whole[axis])) <= sum * sum * BEYOND {
                let mut inside = 0;
                for (bit, corner) in corners.iter().enumerate() {
                    let offset = [0, 1, 2].map(|axis| corner[axis] - sample[axis]);
                    let sum = corner[3] + self.0[3][lane];
                    inside |= u16::from(square(offset) < sum * sum * WITHIN) << bit;
                }
                cover.add(inside);
            }
        }
        cover.sixteenths()
    }
}

impl Group {
    pub const EMPTY: Self = Self { triangles: [[[0.0; 4]; 3]; GROUP], pages: [0; GROUP] };

    /// Which triangles a sample of their page certainly covers: a bit for each.
    pub fn covered(&self, pages: &[Page]) -> u64 {
        let mut covered = 0;
        for (lane, &page) in self.pages.iter().enumerate() {
            let covering = pages[page as usize].covering(&self.triangles[lane]);
            covered |= u64::from(covering != 0) << lane;
        }
        covered
    }
}

fn square([x, y, z]: [f32; 3]) -> f32 {
    x * x + y * y + z * z
}
