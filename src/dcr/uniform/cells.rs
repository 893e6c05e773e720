//! The points in the cells of a grid of the torus, for forces with a reach shorter than a cell is wide.
//!
//! A force depends neither on which point a neighbour is nor on the number of neighbours, only on their positions: so
//! the neighbours of a point are found as two runs of memory, eight points at a time. Points stay in their cells while
//! none has moved by more than half of the skin, the width that cells have beyond the reach, as in Verlet's lists
//! (1967); only their coordinates are updated.

use std::array::from_fn;
use std::ops::Range;

use glam::Vec2;

use crate::dcr::law::Constraints;
use crate::dcr::torus::{Torus, TorusPoint};
use crate::error::Result;
use crate::index::Binned;
use crate::job::{Job, chunks};

/// The width of cells beyond the reach of the forces, in spacings.
const SKIN: f32 = 0.2;

/// The number of points that are processed at a time.
pub const LANES: usize = 8;

/// The least square of a distance, so that even a point's distance from itself has a finite inverse.
pub const LEAST: f32 = f32::MIN_POSITIVE;

/// The number of cells along a row that the forces on a point reach on either side of its own.
const NEAR: usize = 3;

/// A torus cut into cells.
///
/// Rows are so high that forces on a point in the upper half of one come from it and the next row only, and those in
/// the lower half from it and the row below: two runs of cells hold all neighbours. The cells at each end of a row are
/// repeated beyond its other end, so that no run is cut.
pub struct VerletCells {
    torus: Torus,
    rows: usize,
    /// The number of cells from one row to the next, and of a run.
    stride: usize,
    width: usize,
    /// The reach of the forces, in spacings.
    reach: f32,
    /// The longest distance that a point may have moved since it was assigned to its cell.
    travelled: f32,
    /// The first cell of the run around each point, doubled, and 1 more in the upper half of a row.
    runs: Vec<u32>,
    /// The points by cells.
    points: Binned<u32>,
    /// The coordinates of the points, padded to fill the lanes.
    x: Vec<u32>,
    y: Vec<u32>,
}

impl VerletCells {
    /// Sorts points into cells for forces of this reach, in spacings. Takes O(n).
    pub fn new(torus: &Torus, places: &[TorusPoint], reach: f32) -> Self {
        let (size, width) = (torus.frame.size(), f64::from(reach + SKIN));
        // A strip that is thinner than the distance of its points has no more cells than points.
        let limit = (places.len() + 8) as f64;
        let count = |length: f64, width: f64| (length / width).floor().clamp(1.0, limit) as usize;
        let rows = count(size.y, 2.0 * width);
        let (columns, near) = match count(size.x, width / NEAR as f64) {
            columns if columns > 2 * NEAR => (columns, NEAR),
            _ => (1, 0),
        };
        let stride = columns + 2 * near;
        let run = |&[x, y]: &TorusPoint| {
            let half = along(2 * rows, y);
            (2 * (half / 2 * stride + along(columns, x)) + half % 2) as u32
        };
        let runs: Vec<u32> = places.iter().map(run).collect();
        let own = (0..).zip(&runs).map(|(point, &run)| (run as usize / 2 + near, point));
        // Points in the cells at one end of a row are repeated beyond the other, in cells of their own.
        let repeated = own.clone().zip(places).filter_map(|((cell, point), &[x, _])| match along(columns, x) {
            column if column < near => Some((cell + columns, point)),
            column if column >= columns - near => Some((cell - columns, point)),
            _ => None,
        });
        let repeated: Vec<(usize, u32)> = repeated.collect();
        let points = Binned::new(rows * stride, own.chain(repeated.iter().copied()));
        let [x, y] = [0, 1].map(|_| vec![0; points.items().len() + LANES]);
        Self { torus: *torus, rows, stride, width: 2 * near + 1, reach, travelled: 0.0, runs, points, x, y }
    }

    /// True if all forces of this reach are still found after a step in which points have moved by up to `distance`.
    pub fn still_serve(&mut self, distance: f32, reach: f32) -> bool {
        self.travelled += distance;
        reach + 2.0 * self.travelled <= self.reach + SKIN
    }

    /// Updates the coordinates.
    pub fn update(&mut self, job: &Job, places: &[TorusPoint]) -> Result<()> {
        let points = self.points.items();
        let chunks = chunks(points.len());
        let parts = points.chunks(chunks.size()).zip(self.x.chunks_mut(chunks.size()));
        let parts = parts.zip(self.y.chunks_mut(chunks.size()));
        job.map_each(parts.collect(), |((points, x), y)| {
            for ((&point, x), y) in points.iter().zip(x).zip(y) {
                [*x, *y] = places[point as usize];
            }
        })?;
        Ok(())
    }

    /// The points that may be in reach of a point, as ranges.
    #[inline(always)]
    pub fn around(&self, point: usize) -> [Range<usize>; 2] {
        let (first, half) = (self.runs[point] as usize / 2, self.runs[point] % 2);
        let all = self.rows * self.stride;
        let run = |first: usize| self.points.range(first..first + self.width);
        let other = match half {
            _ if self.rows == 1 => return [run(first), 0..0],
            0 if first < self.stride => first + all - self.stride,
            0 => first - self.stride,
            _ if first + self.stride >= all => first + self.stride - all,
            _ => first + self.stride,
        };
        [run(first), run(other)]
    }

    /// The `x` and `y` of eight points from `first` on.
    #[inline(always)]
    pub fn lanes(&self, first: usize) -> [&[u32; LANES]; 2] {
        [&self.x, &self.y].map(|all| all[first..first + LANES].try_into().expect("eight of them"))
    }

    /// The lengths of 2^-32 of the periods.
    #[inline(always)]
    pub fn unit(&self) -> Vec2 {
        self.torus.unit_and_longest().0
    }

    /// The force on a point by all points of these ranges that conflict with it.
    pub fn force(&self, here: TorusPoint, constraints: &Constraints, around: [Range<usize>; 2]) -> Vec2 {
        let unit = self.unit();
        let mut sum = [[0.0; LANES]; 2];
        for run in around {
            for first in run.clone().step_by(LANES) {
                let [xs, ys] = self.lanes(first);
                for i in 0..LANES.min(run.end - first) {
                    let x = xs[i].wrapping_sub(here[0]).cast_signed() as f32 * unit.x;
                    let y = ys[i].wrapping_sub(here[1]).cast_signed() as f32 * unit.y;
                    let distance = (x * x + y * y).max(LEAST).sqrt();
                    // Without conflict the factor is 0; the offset of a point from itself is 0 too.
                    let pushed = constraints.conflict(distance).min(0.0);
                    sum[0][i] += pushed * x;
                    sum[1][i] += pushed * y;
                }
            }
        }
        let [x, y] = sum.map(|lanes| {
            let halves: [f32; 4] = from_fn(|i| lanes[i] + lanes[i + 4]);
            (halves[0] + halves[2]) + (halves[1] + halves[3])
        });
        Vec2::new(x, y)
    }
}

/// The column or row of a coordinate.
fn along(count: usize, coordinate: u32) -> usize {
    ((u64::from(coordinate) * count as u64) >> 32) as usize
}
