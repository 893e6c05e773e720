//! Clip (thesis §2.3.1 and 2.3.2): the pattern and the parts of it that are laid into the leaves.
//!
//! Departures: the pattern is periodic, so every offset can be clipped; it lies on the lattice of the plane and has the
//! plane's radius, so translations are exact and nothing is scaled; a clip is turned at random as well as shifted; and
//! it contains only the points *inside* the leaf, without the thesis's margin of 2r, because the gaps along its
//! boundary are filled anyway.

use std::sync::Arc;

use crate::error::Result;
use crate::index::Binned;
use crate::job::Job;
use crate::maximal;
use crate::plane::{Lattice, Rect};
use crate::rng::{Draw, Rng};

use crate::kdrt::divide::Leaf;
use crate::kdrt::patterns::{Key, Patterns};

/// The pattern's side in leaf sizes and its bounds in radii, if leaves are not very large: about 28,000 samples with
/// the leaves of the default size.
///
/// A set shows its pattern: at every frequency the expected power is the pattern's own, smoothed over 1 / leaf size. So
/// the periodogram varies more than that of an unbiased set, by about 0.35 (leaf size / side)² of its mean squared, and
/// with the side chosen here by no more than unbiased sets do among each other (docs/kdrt.md).
const LEAF_SIZES: f64 = 10.0;
const SIDES: [f64; 2] = [108.0, 200.0];

/// The side of the pattern in leaf sizes, at least: very large leaves trade the spectrum for speed.
const FEWEST_LEAF_SIZES: f64 = 4.0;

/// The side of the pattern for leaves of at least `leaf_size`, both in radii.
pub fn pattern_side(leaf_size: f64) -> f64 {
    (LEAF_SIZES * leaf_size).clamp(SIDES[0], SIDES[1]).max(FEWEST_LEAF_SIZES * leaf_size)
}

/// A maximal set on a square torus of lattice points, with its points in rows that can be clipped.
pub struct Pattern {
    side: i32,
    /// The height of a row.
    height: i32,
    /// The pattern after each of its [`TURNS`].
    turned: Vec<Binned<[i32; 2]>>,
}

/// The pattern unchanged, mirrored, transposed, and both. Sets of real numbers have the same power at opposite
/// frequencies, so the other four symmetries of the square would add nothing.
const TURNS: usize = 4;

/// The points of a pattern by rows of this height, in each from left to right.
fn by_rows(points: &[[i32; 2]], rows: usize, height: i32) -> Binned<[i32; 2]> {
    let mut sorted = Binned::new(rows, points.iter().map(|&point| ((point[1] / height) as usize, point)));
    for row in 0..rows {
        sorted.bin_mut(row).sort_unstable_by_key(|&[x, y]| i64::from(x) << 32 | i64::from(y));
    }
    sorted
}

/// A run of points of one row of the pattern, from left to right, where it is laid on the plane.
pub struct Row<'a> {
    points: &'a [[i32; 2]],
    shift: [i32; 2],
    /// The part of the plane that the run stands for.
    pub part: Rect,
    /// True if all points lie in `part`: otherwise some may lie below or above it.
    pub is_whole: bool,
}

impl<'a> Row<'a> {
    /// The points on the plane.
    pub fn points(&self) -> impl ExactSizeIterator<Item = [i32; 2]> + use<'a> {
        let [along, up] = self.shift;
        self.points.iter().map(move |&[x, y]| [x + along, y + up])
    }

    /// The points left of `left`, those from there to before `right`, and the others.
    pub fn split(&self, left: i32, right: i32) -> [Self; 3] {
        let [left, right] = [left, right].map(|x| x.clamp(self.part.min[0], self.part.max[0]));
        // The outer runs are short: a few steps from the ends.
        let start = self.points().position(|point| point[0] >= left).unwrap_or(self.points.len());
        let end =
            start + self.points[start..].iter().rposition(|&[x, _]| x + self.shift[0] < right).map_or(0, |i| i + 1);
        let run = |points, from, to| Self {
            points,
            part: Rect { min: [from, self.part.min[1]], max: [to, self.part.max[1]] },
            ..*self
        };
        [
            run(&self.points[..start], self.part.min[0], left),
            run(&self.points[start..end], left, right),
            run(&self.points[end..], right, self.part.max[0]),
        ]
    }
}

impl Pattern {
    /// A pattern for a plane on `plane`, with a side in lattice points.
    pub fn new(job: &Job, plane: &Lattice, side: i32, seed: u64) -> Result<Self> {
        let lattice = plane.square_torus(side);
        let points = maximal::sample_points(&job.part(0.0, 0.99), &lattice, seed)?;
        Self::from_points(&job.part(0.99, 1.0), &points, side, lattice.separation.reach)
    }

    /// [`Pattern::new`], or the one that the context keeps from an earlier call with the same arguments.
    pub fn kept(job: &Job, plane: &Lattice, side: i32, seed: u64) -> Result<Arc<Self>> {
        let is_small = f64::from(side) <= SIDES[1] * plane.radius + 1.0;
        Patterns::kept(job, Key::new(side, plane.radius, seed), is_small, || Self::new(job, plane, side, seed))
    }

    fn from_points(job: &Job, points: &[[i32; 2]], side: i32, height: i32) -> Result<Self> {
        let turned = job.map(TURNS, |turn| {
            let turned: Vec<_> = points.iter().map(|&point| turned(point, side, turn)).collect();
            by_rows(&turned, ((side - 1) / height + 1) as usize, height)
        })?;
        Ok(Self { side, height, turned })
    }

    /// The point of the torus that is laid on a leaf's lower corner, and the turn of the torus before that.
    fn place(&self, leaf: &Leaf) -> ([i32; 2], usize) {
        let mut rng = Rng::at(leaf.key, Draw::Clip, &[]);
        (std::array::from_fn(|_| rng.below(self.side as u64) as i32), rng.below(TURNS as u64) as usize)
    }

    /// Visits the leaf's clip in `part`, a part of its rectangle, by rows.
    pub fn rows(&self, leaf: &Leaf, part: &Rect, mut visit: impl FnMut(Row)) {
        let (offset, turn) = self.place(leaf);
        let rows = &self.turned[turn];
        let pieces: [_; 2] = std::array::from_fn(|axis| {
            let start = (part.min[axis] - leaf.rect.min[axis] + offset[axis]) % self.side;
            self.pieces(start, part.length(axis), part.min[axis])
        });
        for &(bottom, top, up) in pieces[1].iter().filter(|(bottom, top, _)| bottom < top) {
            for row in bottom / self.height..=(top - 1) / self.height {
                let points = rows.bin(row as usize);
                let (row_bottom, row_top) = (row * self.height, ((row + 1) * self.height).min(self.side));
                let (bottom, top) = (bottom.max(row_bottom), top.min(row_top));
                for &(left, right, along) in pieces[0].iter().filter(|(left, right, _)| left < right) {
                    let (first, end) = (self.first_from(points, left), self.first_from(points, right));
                    visit(Row {
                        points: &points[first..end],
                        shift: [along, up],
                        part: Rect { min: [left, bottom], max: [right, top] }.translated([along, up]),
                        is_whole: (bottom, top) == (row_bottom, row_top),
                    });
                }
            }
        }
    }

    /// The first point of a row that does not lie left of `x`. Points of a row are so even that it is near its index in
    /// an equidistant row: found more quickly than by bisection.
    fn first_from(&self, row: &[[i32; 2]], x: i32) -> usize {
        let mut index = (x as u64 * row.len() as u64 / self.side as u64) as usize;
        while index > 0 && row[index - 1][0] >= x {
            index -= 1;
        }
        while index < row.len() && row[index][0] < x {
            index += 1;
        }
        index
    }

    /// The points of the leaf's clip that lie in `part`.
    #[cfg(test)]
    pub fn clip(&self, leaf: &Leaf, part: &Rect) -> Vec<[i32; 2]> {
        let mut points = Vec::new();
        self.rows(leaf, part, |row| points.extend(row.points().filter(|&point| row.part.contains(point))));
        points
    }

    /// An interval of the torus as two intervals (the second may be empty) within the square, each with the
    /// translation that takes it to its place after `target`.
    fn pieces(&self, start: i32, length: i32, target: i32) -> [(i32, i32, i32); 2] {
        debug_assert!((0..self.side).contains(&start) && length <= self.side);
        let first = length.min(self.side - start);
        [(start, start + first, target - start), (0, length - first, target + first)]
    }
}

/// A point of a square torus after one of four turns.
fn turned([x, y]: [i32; 2], side: i32, turn: usize) -> [i32; 2] {
    match turn {
        0 => [x, y],
        1 => [side - 1 - x, y],
        2 => [y, x],
        _ => [side - 1 - y, x],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kdrt::patterns::PATTERNS;

    /// Turns preserve all distances on the torus, and no two are the same or opposite.
    #[test]
    fn turns_are_symmetries_of_the_torus() {
        let (a, b, side) = ([3, 17], [95, 40], 100);
        let offset = |turn| {
            let [a, b] = [a, b].map(|point| turned(point, side, turn));
            [0, 1].map(|axis: usize| (b[axis] - a[axis]).rem_euclid(side))
        };
        let length = |[x, y]: [i32; 2]| x.min(side - x).pow(2) + y.min(side - y).pow(2);
        let opposite = |[x, y]: [i32; 2]| [side - x, side - y];
        for turn in 0..4 {
            assert_eq!(length(offset(turn)), length(offset(0)));
            assert!((0..turn).all(|other| offset(other) != offset(turn) && offset(other) != opposite(offset(turn))));
        }
    }

    /// Seeds, radii and sides in turns, more than are kept: each pattern is the one of its arguments, and those used
    /// last are not made again.
    #[test]
    fn a_context_keeps_the_patterns_used_last_and_never_gives_that_of_other_arguments() {
        let context = crate::job::Context::new(1).unwrap();
        let domain =
            crate::points::Domain { min: [0.0; 2], max: [40.0; 2], boundary: crate::points::Boundary::Bounded };
        let made = |keeping: bool, (radius, side, seed): (f64, i32, u64)| {
            let lattice = Lattice::new(&domain, radius).unwrap();
            let side = side * lattice.radius.ceil() as i32;
            context
                .run(None, |job| match keeping {
                    true => Pattern::kept(job, &lattice, side, seed),
                    false => Pattern::new(job, &lattice, side, seed).map(Arc::new),
                })
                .unwrap()
        };
        let all = [(0.5, 12, 1), (0.5, 12, 2), (0.5, 13, 1), (0.5f64.next_up(), 12, 1), (1.0, 12, 1), (1.0, 12, 2)];
        let points = |pattern: &Pattern| pattern.turned.iter().map(|turn| turn.items().to_vec()).collect::<Vec<_>>();
        for round in 0..3 {
            for (i, &arguments) in all.iter().enumerate() {
                let pattern = made(true, arguments);
                assert!(points(&pattern) == points(&made(false, arguments)), "{round} {arguments:?}");
                let earlier = all[..=i].iter().rev().take(PATTERNS);
                assert!(earlier.clone().all(|&again| Arc::ptr_eq(&made(true, again), &made(true, again))));
                assert!(Arc::ptr_eq(&pattern, &made(true, arguments)));
            }
        }
        // Of different seeds no point is the same.
        let [one, two] = [all[0], all[1]].map(|arguments| points(&made(true, arguments)));
        assert!(one[0].iter().all(|point| !two[0].contains(point)));
        // A large one is not kept.
        let large = (0.5, 201, 1);
        assert!(!Arc::ptr_eq(&made(true, large), &made(true, large)));
    }

    /// Every clip against a loop over all points and their images.
    #[test]
    fn a_clip_is_the_translated_part_of_the_torus() {
        let side = 1000;
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let points: Vec<[i32; 2]> = (0..400).map(|_| std::array::from_fn(|_| rng.below(side) as i32)).collect();
        let side = side as i32;
        let context = crate::job::Context::new(1).unwrap();
        let pattern = context.run(None, |job| Pattern::from_points(job, &points, side, 37)).unwrap();
        for key in 0..300 {
            let min = std::array::from_fn(|_| rng.below(10_000) as i32 - 5_000);
            let leaf = Leaf { rect: Rect { min, max: [min[0] + 700, min[1] + 1000] }, key };
            let part = leaf.rect.intersection(&leaf.rect.translated([key as i32 - 150, 3 * key as i32 - 500]));
            let mut clip = pattern.clip(&leaf, &part);
            clip.sort_unstable();

            let (offset, turn) = pattern.place(&leaf);
            let mut expected: Vec<[i32; 2]> = points
                .iter()
                .map(|&point| turned(point, side, turn))
                .map(|point| [0, 1].map(|axis: usize| min[axis] + (point[axis] - offset[axis]).rem_euclid(side)))
                .filter(|&point| part.contains(point))
                .collect();
            expected.sort_unstable();
            assert_eq!(clip, expected);
        }
    }
}
