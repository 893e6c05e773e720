//! Hash grid over points in space that grows: the neighbour search in 3D.

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::math::distance_squared;

/// Points in cells of one size, chained in a hash table. Insertion is a short serial phase between parallel, read-only
/// searches. Results are sets: they do not depend on the order of insertion.
pub struct Grid3 {
    cell_size: f64,
    origin: [f64; 3],
    /// Head of the chain of each bucket, `NONE` if empty; a power of two, at least as many as points.
    heads: Vec<u32>,
    /// For each point, the next one in its chain.
    next: Vec<u32>,
    points: Vec<[f32; 3]>,
}

const NONE: u32 = u32::MAX;

/// The points of a task of [`smallest_distance`]: few, since most may be in one cell.
const TASK: usize = 256;

/// The number of points that are inserted between two reports of progress.
const REPORTED: usize = 1 << 14;

impl Grid3 {
    /// An empty grid. `cell_size` is the radius of the usual search; cells are counted from `origin`.
    pub fn new(origin: [f64; 3], cell_size: f64) -> Self {
        Self { cell_size, origin, heads: vec![NONE; 64], next: Vec::new(), points: Vec::new() }
    }

    /// The grid of many points.
    pub fn of(job: &Job, origin: [f64; 3], cell_size: f64, points: &[[f32; 3]]) -> Result<Self> {
        let mut grid = Self::new(origin, cell_size);
        for (chunk, done) in points.chunks(REPORTED).zip(0..) {
            job.report((done * REPORTED) as f64 / points.len() as f64)?;
            chunk.iter().for_each(|&point| _ = grid.insert(point));
        }
        Ok(grid)
    }

    fn cell(&self, point: [f64; 3]) -> [i64; 3] {
        std::array::from_fn(|axis| ((point[axis] - self.origin[axis]) / self.cell_size).floor() as i64)
    }

    fn bucket(&self, [x, y, z]: [i64; 3]) -> usize {
        // Large primes of Teschner et al. 2003; the multiply brings the mixed bits to the top.
        let mixed = (x as u64).wrapping_mul(73_856_093)
            ^ (y as u64).wrapping_mul(19_349_663)
            ^ (z as u64).wrapping_mul(83_492_791);
        (mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - self.heads.len().ilog2())) as usize
    }

    /// Adds a point and returns its id.
    pub fn insert(&mut self, point: [f32; 3]) -> u32 {
        let id = self.points.len() as u32;
        self.points.push(point);
        self.next.push(NONE);
        if self.points.len() > self.heads.len() {
            self.heads = vec![NONE; 2 * self.heads.len()];
            (0..=id).for_each(|id| self.link(id));
        } else {
            self.link(id);
        }
        id
    }

    fn link(&mut self, id: u32) {
        let bucket = self.bucket(self.cell(self.points[id as usize].map(f64::from)));
        self.next[id as usize] = self.heads[bucket];
        self.heads[bucket] = id;
    }

    /// The ids of all points in the cells that a ball touches, and of some others: the caller tests the distance. An id
    /// can occur twice if two of the cells share a bucket.
    pub fn candidates(&self, centre: [f64; 3], radius: f64) -> impl Iterator<Item = u32> {
        // Cell boundaries are compared in f64 as computed on insertion; the margin covers the rounding of `centre`.
        let reach = radius * (1.0 + 1e-9);
        let low = self.cell(centre.map(|x| x - reach));
        let high = self.cell(centre.map(|x| x + reach));
        (low[2]..=high[2])
            .flat_map(move |z| (low[1]..=high[1]).flat_map(move |y| (low[0]..=high[0]).map(move |x| [x, y, z])))
            .flat_map(|cell| {
                let head = self.heads[self.bucket(cell)];
                std::iter::successors((head != NONE).then_some(head), |&id| {
                    let next = self.next[id as usize];
                    (next != NONE).then_some(next)
                })
            })
    }
}

/// The smallest distance between two points; infinite for fewer than two. O(n log n) for points that are neither
/// clustered in space nor lined up in planes across their longest extent.
pub fn smallest_distance(job: &Job, positions: &[[f32; 3]]) -> Result<f64> {
    let bound = neighbours_in_order(positions);
    job.report(0.1)?;
    if bound == 0.0 || bound == f64::INFINITY {
        return Ok(bound);
    }
    // Of n points, some pair in this order is about as close as n points on a surface are, so cells hold few points.
    let grid = Grid3::of(&job.part(0.1, 0.4), [0.0; 3], bound, positions)?;
    let chunks = chunks_of(positions.len(), TASK);
    let nearest = job.part(0.4, 1.0).map(chunks.len(), |chunk| {
        let squared = |i: usize| {
            grid.candidates(positions[i].map(f64::from), bound)
                .filter(|&other| other as usize != i)
                .map(|other| distance_squared(positions[i], positions[other as usize]))
                .fold(f64::INFINITY, f64::min)
        };
        chunks.range(chunk).map(squared).fold(f64::INFINITY, f64::min)
    })?;
    Ok(nearest.into_iter().fold(f64::INFINITY, f64::min).sqrt())
}

/// A first bound: the smallest distance of points that are consecutive along the longest extent.
fn neighbours_in_order(positions: &[[f32; 3]]) -> f64 {
    let extent = |axis: usize| {
        let (low, high) = positions
            .iter()
            .map(|position| f64::from(position[axis]))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        high - low
    };
    let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let mut ordered = positions.to_vec();
    ordered.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
    let squared = ordered.windows(2).map(|pair| distance_squared(pair[0], pair[1]));
    squared.fold(f64::INFINITY, f64::min).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn finds_what_a_loop_over_all_points_finds() {
        for cell_size in [0.02, 0.1, 3.0] {
            let mut rng = Rng::at(9, Draw::Probe, &[]);
            let mut grid = Grid3::new([-5.0, 0.0, 0.5], cell_size);
            let mut points = Vec::new();
            for id in 0..500u32 {
                let point: [f32; 3] = std::array::from_fn(|_| rng.unit() as f32);
                points.push(point);
                assert_eq!(grid.insert(point), id);
                let centre: [f32; 3] = std::array::from_fn(|_| rng.unit() as f32);
                for radius in [0.05, 0.1] {
                    let mut found: Vec<_> = grid
                        .candidates(centre.map(f64::from), radius)
                        .filter(|&id| distance_squared(centre, points[id as usize]) <= radius * radius)
                        .collect();
                    found.sort();
                    found.dedup();
                    let expected: Vec<_> = (0..=id)
                        .filter(|&id| distance_squared(centre, points[id as usize]) <= radius * radius)
                        .collect();
                    assert_eq!(found, expected);
                }
            }
            assert_eq!(grid.points, points);
        }
    }
}
