//! Points near a fragment on a stack, and the coarse tests, in `f32`, that nearly all work of merging and filling goes through.
//!
//! Lengths are in radii. The tests say what is certain; what they leave open is decided in `f64` (`surroundings.rs`).
//! The code here is plain and portable. `vectors/` has the same functions in the widest vectors of the processor,
//! whose results are the same to the bit: no sum has another order, no rounding is left out.

use glam::Vec3A;

use crate::psp::sixteenths::{CORNERS, Cover, SIXTEENTHS, STANDING};

/// What rounding can add to a squared distance of about 1, and some more. Places in a cube's surroundings are off by 2^-21 on
/// each axis, which makes 3.3e-6 for two of them; places near a fragment and the sums of a few terms are off by a third of
/// that.
pub(super) const SLACK: f32 = 1e-5;

/// Points that are tested together.
pub(super) const LANES: usize = 8;

/// A coordinate of no point. Its square is a float.
pub(super) const FAR: f32 = 1e18;

/// A few points, one axis after the other; places without a point are [`FAR`] away.
pub(super) type PointLanes = [[f32; LANES]; 3];

/// Where a fragment lies.
#[derive(Clone, Copy)]
pub(super) struct LocalFragment {
    pub corner: Vec3A,
    /// From there to the second and to the third corner.
    pub edges: [Vec3A; 2],
    /// All of the fragment is this near to its centre.
    pub extent: f32,
}

impl LocalFragment {
    /// A place of the fragment, by shares of its edges.
    #[inline(always)]
    pub fn at(&self, [s, t]: [f32; 2]) -> Vec3A {
        self.corner + (s * self.edges[0] + t * self.edges[1])
    }

    /// The centre, and the square of how far from it a ball of radius 1 can be that touches the fragment.
    #[inline(always)]
    pub fn reach(&self) -> ([f32; 3], f32) {
        let reach = 1.0 + self.extent;
        (self.at([1.0 / 3.0; 2]).to_array(), reach * reach + SLACK)
    }

    /// One of the sixteen parts.
    #[inline(always)]
    pub fn sixteenth(&self, index: usize) -> Self {
        let [[s, t], ..] = SIXTEENTHS[index];
        let share = if index < STANDING { 0.25 } else { -0.25 };
        Self {
            corner: self.at([0.25 * s as f32, 0.25 * t as f32]),
            edges: [share * self.edges[0], share * self.edges[1]],
            extent: 0.25 * self.extent,
        }
    }
}

/// Points near a place, as a stack.
pub(super) struct PointStack {
    /// The first `len` are points. Behind them there is space for [`SPARE`] more, which whole vectors are written to.
    pub axes: [Vec<f32>; 3],
    pub len: usize,
}

/// No vectors are wider.
const SPARE: usize = 16;

impl PointStack {
    pub fn new() -> Self {
        Self { axes: [const { Vec::new() }; 3], len: 0 }
    }

    /// Makes space for `count` more points.
    pub fn reserve(&mut self, count: usize) {
        let needed = self.len + count + SPARE;
        if self.axes[0].len() < needed {
            self.axes.iter_mut().for_each(|axis| axis.resize(2 * needed, FAR));
        }
    }

    /// The point at an index.
    pub fn point(&self, index: usize) -> [f32; 3] {
        [self.axes[0][index], self.axes[1][index], self.axes[2][index]]
    }

    /// Appends the points that are no farther than the square root of `reach2` from `centre`, as seen from there. There
    /// is space for them.
    pub fn append(&mut self, places: &PointLanes, centre: [f32; 3], reach2: f32) {
        for offset in offsets(places, centre) {
            self.push(offset, square(offset) <= reach2);
        }
    }

    /// Appends those of the points `from..to` that are no farther than the square root of `reach2` from `centre`, as they
    /// are. There is space for them.
    pub fn append_reaching(&mut self, from: usize, to: usize, centre: [f32; 3], reach2: f32) {
        for index in from..to {
            let point = self.point(index);
            self.push(point, square([0, 1, 2].map(|axis| point[axis] - centre[axis])) <= reach2);
        }
    }

    /// Written in any case and counted only if it is one: a branch would be a guess.
    fn push(&mut self, point: [f32; 3], is_one: bool) {
        (0..3).for_each(|axis| self.axes[axis][self.len] = point[axis]);
        self.len += usize::from(is_one);
    }

    /// The sixteenths that one of the points `from..` certainly covers: all their corners are inside its ball.
    pub fn covered(&self, from: usize, fragment: &LocalFragment) -> u16 {
        self.covered_by(from..self.len, fragment)
    }

    /// Of the sixteenths of each sixteenth, a bit for each, takes those that one of the points `from..` certainly covers.
    pub fn take_covered(&self, from: usize, fragment: &LocalFragment, open: &mut [u16; 16]) {
        for (index, open) in open.iter_mut().enumerate().filter(|(_, open)| **open != 0) {
            let part = fragment.sixteenth(index);
            let (centre, reach2) = part.reach();
            let reaches = |&index: &usize| {
                let point = self.point(index);
                square([0, 1, 2].map(|axis| point[axis] - centre[axis])) <= reach2
            };
            *open &= !self.covered_by((from..self.len).filter(reaches), &part);
        }
    }

    fn covered_by(&self, points: impl Iterator<Item = usize>, fragment: &LocalFragment) -> u16 {
        let corners: [_; 16] = std::array::from_fn(|i| fragment.at([CORNERS[0][i], CORNERS[1][i]]).to_array());
        let mut cover = Cover::default();
        for index in points {
            let point = self.point(index);
            let mut inside = 0;
            for (lane, corner) in corners.iter().enumerate() {
                let offset = [0, 1, 2].map(|axis| corner[axis] - point[axis]);
                inside |= u16::from(square(offset) < 1.0 - SLACK) << lane;
            }
            cover.add(inside);
        }
        cover.sixteenths()
    }
}

/// Which of some points may be closer than 1 to a point: a bit for each.
pub(super) fn close(places: &PointLanes, point: [f32; 3]) -> u8 {
    let mut close = 0;
    for (lane, offset) in offsets(places, point).enumerate() {
        close |= u8::from(square(offset) <= 1.0 + SLACK) << lane;
    }
    close
}

/// PointLanes as seen from a point.
fn offsets(places: &PointLanes, from: [f32; 3]) -> impl Iterator<Item = [f32; 3]> {
    (0..LANES).map(move |lane| [0, 1, 2].map(|axis| places[axis][lane] - from[axis]))
}

fn square([x, y, z]: [f32; 3]) -> f32 {
    x * x + y * y + z * z
}
