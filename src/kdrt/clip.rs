//! Clip (thesis §2.3.1 and 2.3.2): the pattern and the parts of it that are laid into the leaves.
//!
//! Departures: the pattern is periodic, so every offset can be clipped; it lies on the lattice of the plane and has the
//! plane's radius, so translations are exact and nothing is scaled; and a clip is what lies *inside* the leaf, without
//! the thesis's margin of 2r, because the gaps along its border are filled anyway.

use crate::error::Result;
use crate::job::Job;
use crate::lattice::{Lattice, Rect};
use crate::maximal;
use crate::rng::{Draw, Rng};

use super::divide::Leaf;

/// The pattern's side in radii, at least: about 8,000 samples.
const SHORTEST_SIDE: f64 = 108.0;

/// The pattern's side in leaf sizes, at least. The larger the pattern, the fewer parts of it are seen twice: its size
/// decides how much repetition the spectrum shows, more than that of the leaves.
const LEAF_SIZES: f64 = 4.0;

/// The side of the pattern for leaves of at least `leaf_size`, both in radii.
pub(super) fn pattern_side(leaf_size: f64) -> f64 {
    SHORTEST_SIDE.max(LEAF_SIZES * leaf_size)
}

/// A maximal set on a square torus of lattice points, with its points in rows that can be clipped.
pub(super) struct Pattern {
    side: i32,
    /// The height of a row.
    height: i32,
    /// Row `i` holds the points `starts[i]..starts[i + 1]`, from left to right.
    starts: Vec<usize>,
    points: Vec<[i32; 2]>,
}

/// A run of points of one row of the pattern, from left to right, where it is laid on the plane.
pub(super) struct Row<'a> {
    points: &'a [[i32; 2]],
    shift: [i32; 2],
    /// The part of the plane that the run stands for.
    pub part: Rect,
    /// Whether all points lie in `part`: some may lie below or above it otherwise.
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
        Ok(Self::from_points(maximal::sample_points(job, &lattice, seed)?, side, lattice.reach))
    }

    fn from_points(mut points: Vec<[i32; 2]>, side: i32, height: i32) -> Self {
        points.sort_unstable_by_key(|&[x, y]| (y / height, x, y));
        let rows = (side - 1) / height + 1;
        let starts = (0..=rows).map(|row| points.partition_point(|point| point[1] / height < row)).collect();
        Self { side, height, starts, points }
    }

    /// The point of the torus that is laid on a leaf's lower corner.
    fn offset(&self, leaf: &Leaf) -> [i32; 2] {
        let mut rng = Rng::at(leaf.key, Draw::Clip, &[]);
        std::array::from_fn(|_| rng.below(self.side as u64) as i32)
    }

    /// Visits the leaf's clip in `part`, a part of its rectangle, by rows.
    pub fn rows(&self, leaf: &Leaf, part: &Rect, mut visit: impl FnMut(Row)) {
        let offset = self.offset(leaf);
        let pieces: [_; 2] = std::array::from_fn(|axis| {
            let start = (part.min[axis] - leaf.rect.min[axis] + offset[axis]) % self.side;
            self.pieces(start, part.length(axis), part.min[axis])
        });
        for &(bottom, top, up) in pieces[1].iter().filter(|(bottom, top, _)| bottom < top) {
            for row in bottom / self.height..=(top - 1) / self.height {
                let points = &self.points[self.starts[row as usize]..self.starts[row as usize + 1]];
                let (row_bottom, row_top) = (row * self.height, ((row + 1) * self.height).min(self.side));
                let (bottom, top) = (bottom.max(row_bottom), top.min(row_top));
                for &(left, right, along) in pieces[0].iter().filter(|(left, right, _)| left < right) {
                    let first = points.partition_point(|point| point[0] < left);
                    let count = points[first..].partition_point(|point| point[0] < right);
                    visit(Row {
                        points: &points[first..first + count],
                        shift: [along, up],
                        part: Rect { min: [left, bottom], max: [right, top] }.translated([along, up]),
                        is_whole: (bottom, top) == (row_bottom, row_top),
                    });
                }
            }
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Every clip against a loop over all points and their images.
    #[test]
    fn a_clip_is_the_translated_part_of_the_torus() {
        let side = 1000;
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let points: Vec<[i32; 2]> = (0..400).map(|_| std::array::from_fn(|_| rng.below(side) as i32)).collect();
        let side = side as i32;
        let pattern = Pattern::from_points(points.clone(), side, 37);
        for key in 0..300 {
            let min = std::array::from_fn(|_| rng.below(10_000) as i32 - 5_000);
            let leaf = Leaf { rect: Rect { min, max: [min[0] + 700, min[1] + 1000] }, key };
            let part = leaf.rect.intersection(&leaf.rect.translated([key as i32 - 150, 3 * key as i32 - 500]));
            let mut clip = pattern.clip(&leaf, &part);
            clip.sort_unstable();

            let offset = pattern.offset(&leaf);
            let mut expected: Vec<[i32; 2]> = points
                .iter()
                .map(|point| [0, 1].map(|axis: usize| min[axis] + (point[axis] - offset[axis]).rem_euclid(side)))
                .filter(|&point| part.contains(point))
                .collect();
            expected.sort_unstable();
            assert_eq!(clip, expected);
        }
    }
}
