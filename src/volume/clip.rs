//! Clip, in space (thesis §2.3.1 and 2.3.2): the pattern, a set of a cubic torus, and the parts of it that are laid into leaves.
//!
//! As in the plane (`kdrt/clip.rs`), but that a clip is turned by any of the 48 symmetries of the cube.

use std::sync::Arc;

use crate::error::Result;
use crate::index::Binned;
use crate::job::Job;
use crate::kdrt::{Key, Leaf, Patterns};
use crate::plane::{GivenDisks, Lattice, Rect};
use crate::points::MAXIMAL_DENSITY_IN_SPACE;
use crate::rng::{Draw, Rng};
use crate::simd::Level;
use crate::volume::search::{Centre, square};
use crate::volume::set::Set;
use crate::volume::space::Space;

/// The shortest side of a pattern, in radii: about 30,000 samples.
const SHORTEST: f64 = 34.5;

/// The side of a pattern in leaf sizes, at least: a leaf has no place of it twice.
const LEAF_SIZES: f64 = 2.0;

/// The longest side of a pattern that a context keeps, in radii: 390,000 samples.
const LONGEST_KEPT: f64 = 81.0;

/// The most bytes that a sample of a pattern takes: itself, while it is sorted, and its bins.
const BYTES_PER_SAMPLE: f64 = 45.0;

/// The six orders of three axes.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// The side of the pattern for leaves of at least `leaf_size`, both in radii.
pub fn pattern_side(leaf_size: f64) -> f64 {
    (LEAF_SIZES * leaf_size).max(SHORTEST)
}

/// The bytes that the pattern for leaves of at least `leaf_size`, in radii, takes at most.
pub fn pattern_bytes(leaf_size: f64) -> f64 {
    let side = pattern_side(leaf_size);
    BYTES_PER_SAMPLE * MAXIMAL_DENSITY_IN_SPACE * side * side * side
}

/// A maximal set of a cubic torus of lattice points, with its points in cubic bins that can be clipped.
pub struct Pattern {
    side: i32,
    /// The bins along an axis.
    bins: i32,
    /// The points by bins: x is the fastest axis.
    points: Binned<Centre>,
}

/// An interval of an axis of the torus.
#[derive(Clone, Copy, Default)]
struct Piece {
    from: i32,
    to: i32,
    /// The coordinate in the domain of a point with coordinate x in the interval is `base` + x, or `base` - x if the axis is
    /// reflected.
    base: i32,
}

impl Pattern {
    /// The pattern of a domain with this lattice, which the context keeps from an earlier call with the same arguments, or a
    /// new one, by instructions of some level.
    pub fn kept(job: &Job, domain: &Lattice<3>, leaf_size: f64, seed: u64, level: Level) -> Result<Arc<Self>> {
        let side = pattern_side(leaf_size);
        let (is_small, side) = (side <= LONGEST_KEPT, (side * domain.radius).ceil() as i32 + 1);
        Patterns::kept(job, Key::new(side, domain.radius, seed), is_small, || Self::new(job, domain, side, seed, level))
    }

    /// A pattern with a side in lattice points.
    fn new(job: &Job, domain: &Lattice<3>, side: i32, seed: u64, level: Level) -> Result<Self> {
        let (lattice, given) = (domain.square_torus(side), GivenDisks::default());
        let space = Space { lattice: &lattice, given: &given, solid: None };
        let points = Set::new(job, space, seed, level)?.into_points();
        Ok(Self::from_points(&points, side, lattice.separation.reach))
    }

    /// The points in bins that are about `width` wide.
    fn from_points(points: &[Centre], side: i32, width: i32) -> Self {
        let bins = (side / width.max(1)).max(1);
        let bin = |point: &Centre| {
            let [x, y, z] = point.map(|x| bin_of(x, bins, side));
            (z * bins as usize + y) * bins as usize + x
        };
        let count = (bins as usize).pow(3);
        Self { side, bins, points: Binned::new(count, points.iter().map(|point| (bin(point), *point))) }
    }

    /// The clip of a leaf.
    pub fn clip(&self, leaf: &Leaf<3>) -> Clip<'_> {
        let mut rng = Rng::at(leaf.key, Draw::Clip, &[]);
        let offset = std::array::from_fn(|_| rng.below(self.side as u64) as i32);
        let (axes, reflections) = (ORDERS[rng.below(ORDERS.len() as u64) as usize], rng.bits());
        let is_reflected = std::array::from_fn(|axis| reflections >> axis & 1 == 1);
        Clip { pattern: self, rect: leaf.rect, offset, axes, is_reflected }
    }
}

/// The bin of a coordinate.
fn bin_of(x: i32, bins: i32, side: i32) -> usize {
    (i64::from(x) * i64::from(bins) / i64::from(side)) as usize
}

/// A part of a pattern as it is laid into a leaf.
#[derive(Clone, Copy)]
pub struct Clip<'a> {
    pattern: &'a Pattern,
    /// The leaf.
    pub rect: Rect<3>,
    /// The point of the torus, along its axes, that is laid on the leaf's lower corner.
    offset: [i32; 3],
    /// The axis of the torus that lies along each axis of the domain, and true if it is reflected.
    axes: [usize; 3],
    is_reflected: [bool; 3],
}

impl<'a> Clip<'a> {
    /// The same clip in an image of the leaf.
    pub fn translated(self, by: [i32; 3]) -> Self {
        Self { rect: self.rect.translated(by), ..self }
    }

    /// The part of the torus that is laid on an interval of the leaf along an axis of the domain: the second piece may be
    /// empty.
    fn pieces(&self, axis: usize, min: i32, max: i32) -> [Piece; 2] {
        let (side, offset, first) = (self.pattern.side, self.offset[self.axes[axis]], self.rect.min[axis]);
        let length = max - min;
        debug_assert!(length <= side);
        if self.is_reflected[axis] {
            let from = (offset - (max - 1 - first)).rem_euclid(side);
            let before = length.min(side - from);
            let base = max - 1 + from;
            [Piece { from, to: from + before, base }, Piece { from: 0, to: length - before, base: base - side }]
        } else {
            let from = (offset + min - first).rem_euclid(side);
            let before = length.min(side - from);
            let base = min - from;
            [Piece { from, to: from + before, base }, Piece { from: 0, to: length - before, base: base + side }]
        }
    }

    /// Visits the points of the clip in `part`, a part of the leaf's rectangle, until a visit returns true; true if one does.
    #[inline(always)]
    pub fn find(&self, part: &Rect<3>, mut visit: impl FnMut(Centre) -> bool) -> bool {
        let (Pattern { side, bins, points }, axes) = (self.pattern, self.axes);
        let (side, bins) = (*side, *bins);
        if part.is_empty() {
            return false;
        }
        // By the axes of the torus.
        let mut pieces = [[Piece::default(); 2]; 3];
        for axis in 0..3 {
            pieces[axes[axis]] = self.pieces(axis, part.min[axis], part.max[axis]);
        }
        let signs = self.is_reflected.map(|is_reflected| if is_reflected { -1 } else { 1 });
        let span = |piece: Piece| bin_of(piece.from, bins, side)..bin_of(piece.to - 1, bins, side) + 1;
        let bins = bins as usize;
        for along_z in pieces[2].into_iter().filter(|piece| piece.from < piece.to) {
            for along_y in pieces[1].into_iter().filter(|piece| piece.from < piece.to) {
                for along_x in pieces[0].into_iter().filter(|piece| piece.from < piece.to) {
                    let pieces = [along_x, along_y, along_z];
                    let bases = axes.map(|axis| pieces[axis].base);
                    let columns = span(along_x);
                    for (z, y) in span(along_z).flat_map(|z| span(along_y).map(move |y| (z, y))) {
                        let row = (z * bins + y) * bins;
                        for &point in &points.items()[points.range(row + columns.start..row + columns.end)] {
                            let is_inside =
                                (0..3).all(|axis| (pieces[axis].from..pieces[axis].to).contains(&point[axis]));
                            let place = std::array::from_fn(|axis| bases[axis] + signs[axis] * point[axes[axis]]);
                            if is_inside && visit(place) {
                                return true;
                            }
                        }
                    }
                }
            }
        }
        false
    }

    /// True if a point of the clip conflicts with a lattice point: is within a reach of it and its square below a threshold.
    pub fn conflicts(&self, point: Centre, reach: i32, threshold: i64) -> bool {
        let near = Rect { min: point.map(|x| x - reach), max: point.map(|x| x + reach + 1) };
        self.find(&near.intersection(&self.rect), |other| square(other, point) < threshold)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random_points(count: usize, side: i32, rng: &mut Rng) -> Vec<Centre> {
        (0..count).map(|_| std::array::from_fn(|_| rng.below(side as u64) as i32)).collect()
    }

    /// Every clip against a loop over all points, and conflicts against a loop over the clip.
    #[test]
    fn a_clip_is_the_turned_and_translated_part_of_the_torus() {
        let (mut rng, side) = (Rng::at(3, Draw::Probe, &[]), 90);
        let pattern_points = random_points(500, side, &mut rng);
        let (mut found, mut turns) = ([0; 2], std::collections::HashSet::new());
        for key in 0..400 {
            let pattern = Pattern::from_points(&pattern_points, side, [1, 7, 30, 200][key as usize % 4]);
            let min: Centre = std::array::from_fn(|_| rng.below(1_000) as i32 - 500);
            let max = std::array::from_fn(|axis| min[axis] + 1 + rng.below(side as u64) as i32);
            let leaf = Leaf { rect: Rect { min, max }, key };
            let clip = pattern.clip(&leaf);
            turns.insert((clip.axes, clip.is_reflected));
            let moved = std::array::from_fn(|_| rng.below(60) as i32 - 30);
            let part = leaf.rect.intersection(&leaf.rect.translated(moved));
            let mut points = Vec::new();
            assert!(!clip.find(&part, |point| {
                points.push(point);
                false
            }));
            points.sort_unstable();
            let laid = |point: &Centre| -> Centre {
                std::array::from_fn(|axis| {
                    let from = point[clip.axes[axis]] - clip.offset[clip.axes[axis]];
                    min[axis] + if clip.is_reflected[axis] { -from } else { from }.rem_euclid(side)
                })
            };
            let mut expected: Vec<_> = pattern_points.iter().map(laid).filter(|&point| part.contains(point)).collect();
            expected.sort_unstable();
            assert_eq!(points, expected);

            let all: Vec<_> = pattern_points.iter().map(laid).filter(|&point| leaf.rect.contains(point)).collect();
            for _ in 0..20 {
                let place: Centre = std::array::from_fn(|axis| min[axis] - 20 + rng.below(130) as i32);
                let (reach, threshold) = (9, 95);
                let conflicts = all.iter().any(|&other| square(other, place) < threshold);
                assert_eq!(clip.conflicts(place, reach, threshold), conflicts);
                found[usize::from(conflicts)] += 1;
            }
        }
        assert!(found[0] > 300 && found[1] > 300 && turns.len() == 48, "{found:?} {}", turns.len());
    }

    /// All distances along the torus are preserved.
    #[test]
    fn clips_of_whole_torus_keep_distances() {
        let (mut rng, side) = (Rng::at(4, Draw::Probe, &[]), 50);
        let squared = |a: Centre, b: Centre| -> i64 {
            let along = |axis: usize| (a[axis] - b[axis]).rem_euclid(side);
            (0..3).map(|axis| i64::from(along(axis).min(side - along(axis))).pow(2)).sum()
        };
        let distances = |points: &[Centre]| {
            let mut all: Vec<_> = points.iter().flat_map(|&a| points.iter().map(move |&b| squared(a, b))).collect();
            all.sort_unstable();
            all
        };
        let points = random_points(40, side, &mut rng);
        let pattern = Pattern::from_points(&points, side, 6);
        for key in 0..100 {
            let leaf = Leaf { rect: Rect { min: [7; 3], max: [7 + side; 3] }, key };
            let mut laid = Vec::new();
            pattern.clip(&leaf).find(&leaf.rect, |point| {
                laid.push(point);
                false
            });
            assert_eq!(distances(&laid), distances(&points));
        }
    }
}
