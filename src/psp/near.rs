//! What is near a place: the coarse tests, in `f32`, that nearly all work of merging and filling goes through.
//!
//! Lengths are in radii. The tests say what is certain; what they leave open is decided in `f64` (`room.rs`, `fill.rs`).
//! The code here is plain and portable. `vectors.rs` has the same functions in the widest vectors of the processor,
//! whose results are the same to the bit: no sum has another order, no rounding is left out.

use glam::Vec3A;

use crate::psp::cover::{CORNERS, Cover, SIXTEENTHS, STANDING};

/// What rounding can add to a squared distance of about 1, and some more. Places in a room are off by 2^-21 on each axis,
/// which makes 3.3e-6 for two of them; places near a fragment and the sums of a few terms are off by a third of that.
pub(super) const SLACK: f32 = 1e-5;

/// Points that are tested together.
pub(super) const LANES: usize = 8;

/// A coordinate of no point. Its square is a float.
pub(super) const FAR: f32 = 1e18;

/// A few points, one axis after the other; places without a point are [`FAR`] away.
pub(super) type Places = [[f32; LANES]; 3];

/// Where a fragment lies.
#[derive(Clone, Copy)]
pub(super) struct Local {
    pub corner: Vec3A,
    /// From there to the second and to the third corner.
    pub edges: [Vec3A; 2],
    /// All of the fragment is this near to its centre.
    pub extent: f32,
}

impl Local {
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
pub(super) struct Near {
    /// The first `len` are points. Behind them there is room for [`SPARE`] more, which whole vectors are written to.
    pub axes: [Vec<f32>; 3],
    pub len: usize,
}

/// Level are no wider.
const SPARE: usize = 16;

impl Near {
    pub fn new() -> Self {
        Self { axes: [const { Vec::new() }; 3], len: 0 }
    }

    /// Makes room for `count` more points.
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
    /// is room for them.
    pub fn append(&mut self, places: &Places, centre: [f32; 3], reach2: f32) {
        for offset in offsets(places, centre) {
            self.push(offset, square(offset) <= reach2);
        }
    }

    /// Appends those of the points `from..to` that are no farther than the square root of `reach2` from `centre`, as they
    /// are. There is room for them.
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
    pub fn covered(&self, from: usize, fragment: &Local) -> u16 {
        self.covered_by(from..self.len, fragment)
    }

    /// Of the sixteenths of each sixteenth, a bit for each, takes those that one of the points `from..` certainly covers.
    pub fn take_covered(&self, from: usize, fragment: &Local, open: &mut [u16; 16]) {
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

    fn covered_by(&self, points: impl Iterator<Item = usize>, fragment: &Local) -> u16 {
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
pub(super) fn close(places: &Places, point: [f32; 3]) -> u8 {
    let mut close = 0;
    for (lane, offset) in offsets(places, point).enumerate() {
        close |= u8::from(square(offset) <= 1.0 + SLACK) << lane;
    }
    close
}

/// Places as seen from a point.
fn offsets(places: &Places, from: [f32; 3]) -> impl Iterator<Item = [f32; 3]> {
    (0..LANES).map(move |lane| [0, 1, 2].map(|axis| places[axis][lane] - from[axis]))
}

fn square([x, y, z]: [f32; 3]) -> f32 {
    x * x + y * y + z * z
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::psp::vectors;
    use crate::rng::{Draw, Rng};
    use crate::simd::Level;

    fn points(near: &Near) -> Vec<[f32; 3]> {
        (0..near.len).map(|index| near.point(index)).collect()
    }

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let (mut reaching, mut covered, mut open, mut closer) = (0, 0, 0, 0);
        for round in 0..3000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let pages: Vec<Places> = (0..5)
                .map(|_| std::array::from_fn(|_| std::array::from_fn(|_| coordinate(1.5))))
                .map(|mut places: Places| {
                    places.iter_mut().for_each(|axis| axis[6..].fill(FAR));
                    places
                })
                .collect();
            let centre: [f32; 3] = std::array::from_fn(|_| coordinate(0.5));
            let mut vector = || Vec3A::from_array(std::array::from_fn(|_| coordinate([1.0, 0.3, 1e-3][round % 3])));
            let fragment = Local { corner: vector(), edges: [vector(), vector()], extent: 0.5 };
            let all = |vectors: Level| {
                let mut near = Near::new();
                near.reserve(80);
                pages.iter().for_each(|page| vectors::append(vectors, &mut near, page, centre, 3.0));
                let end = near.len;
                vectors::append_reaching(vectors, &mut near, end / 3, end, centre, 1.5);
                let covered = vectors::covered(vectors, &near, end, &fragment);
                let mut open = std::array::from_fn(|index| [u16::MAX, 0, 0x1234][(index + round) % 3]);
                vectors::take_covered(vectors, &near, end / 2, &fragment, &mut open);
                (points(&near), end, covered, open, vectors::close(vectors, &pages[0], centre))
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|vectors| all(vectors) == expected));
            reaching += expected.0.len() - expected.1;
            covered += expected.2.count_ones();
            open += expected.3.iter().map(|open| open.count_ones()).sum::<u32>();
            closer += expected.4.count_ones();
        }
        assert!(
            reaching > 10_000 && covered > 3000 && open > 10_000 && closer > 1000,
            "{reaching} {covered} {open} {closer}"
        );
    }
}
