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

    /// The points of the leaf's clip that lie in `part`, a part of its rectangle; in the coordinates of the plane.
    pub fn clip(&self, leaf: &Leaf, part: &Rect) -> Vec<[i32; 2]> {
        let offset = self.offset(leaf);
        let pieces: [_; 2] = std::array::from_fn(|axis| {
            let start = (part.min[axis] - leaf.rect.min[axis] + offset[axis]) % self.side;
            self.pieces(start, part.length(axis), part.min[axis])
        });
        let mut points = Vec::new();
        for &(bottom, top, up) in pieces[1].iter().filter(|(bottom, top, _)| bottom < top) {
            for &(left, right, along) in pieces[0].iter().filter(|(left, right, _)| left < right) {
                let piece = Rect { min: [left, bottom], max: [right, top] };
                points.extend(self.points_in(&piece).map(|[x, y]| [x + along, y + up]));
            }
        }
        points
    }

    /// An interval of the torus as two intervals (the second may be empty) within the square, each with the
    /// translation that takes it to its place after `target`.
    fn pieces(&self, start: i32, length: i32, target: i32) -> [(i32, i32, i32); 2] {
        debug_assert!((0..self.side).contains(&start) && length <= self.side);
        let first = length.min(self.side - start);
        [(start, start + first, target - start), (0, length - first, target + first)]
    }

    fn points_in(&self, rect: &Rect) -> impl Iterator<Item = [i32; 2]> {
        let rect = *rect;
        (rect.min[1] / self.height..=(rect.max[1] - 1) / self.height).flat_map(move |row| {
            let row = &self.points[self.starts[row as usize]..self.starts[row as usize + 1]];
            let first = row.partition_point(|point| point[0] < rect.min[0]);
            let end = first + row[first..].partition_point(|point| point[0] < rect.max[0]);
            row[first..end].iter().copied().filter(move |point| rect.contains(*point))
        })
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
