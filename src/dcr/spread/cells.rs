//! The points by cells of a grid of the torus, for forces that reach no farther than a cell is wide.
//!
//! Neither who a neighbour is nor how many there are matters to a force, only where they are: so places are all that the
//! grid holds, row by row, and the neighbours of a point stand in three runs of memory.

use std::ops::Range;

use glam::Vec2;

use super::constraints::Constraints;
use super::torus::{Place, Torus};

/// A torus cut into cells.
pub(super) struct Cells {
    torus: Torus,
    /// Columns and rows.
    counts: [usize; 2],
    /// Cell `c` holds the places `starts[c]..starts[c + 1]`.
    starts: Vec<u32>,
    places: Vec<Place>,
}

impl Cells {
    /// Sorts places into cells that are not narrower than `reach`, in spacings. Takes O(n).
    pub(super) fn new(torus: &Torus, places: &[Place], reach: f32) -> Self {
        // A strip that is thinner than the distance of its points has no more cells than points.
        let limit = (places.len() + 8) as f64;
        let count = |length: f64| (length / f64::from(reach)).floor().clamp(1.0, limit) as usize;
        let counts = torus.frame.size().to_array().map(count);
        let mut cells = Self { torus: *torus, counts, starts: vec![0; counts[0] * counts[1] + 1], places: Vec::new() };
        let mut indices: Vec<u32> = places.iter().map(|&place| cells.cell(place) as u32).collect();
        indices.iter().for_each(|&cell| cells.starts[cell as usize + 1] += 1);
        for cell in 1..cells.starts.len() {
            cells.starts[cell] += cells.starts[cell - 1];
        }
        let mut next = cells.starts.clone();
        cells.places = vec![[0; 2]; places.len()];
        for (index, &place) in indices.iter_mut().zip(places) {
            let slot = &mut next[*index as usize];
            cells.places[*slot as usize] = place;
            *slot += 1;
        }
        cells
    }

    /// The column or row of a coordinate.
    fn along(&self, axis: usize, coordinate: u32) -> usize {
        ((u64::from(coordinate) * self.counts[axis] as u64) >> 32) as usize
    }

    fn cell(&self, place: Place) -> usize {
        self.along(1, place[1]) * self.counts[0] + self.along(0, place[0])
    }

    /// The columns or rows next to one, each once, as ranges.
    fn near(&self, axis: usize, index: usize) -> [Range<usize>; 2] {
        let count = self.counts[axis];
        match index {
            _ if count <= 3 => [0..count, 0..0],
            0 => [0..2, count - 1..count],
            _ if index + 1 == count => [index - 1..count, 0..1],
            _ => [index - 1..index + 2, 0..0],
        }
    }

    /// The force by all neighbours in conflict.
    pub(super) fn force(&self, constraints: &Constraints, place: Place) -> Vec2 {
        let mut sum = Vec2::ZERO;
        let columns = self.near(0, self.along(0, place[0]));
        for row in self.near(1, self.along(1, place[1])).into_iter().flatten() {
            for columns in &columns {
                let cell = |column| self.starts[row * self.counts[0] + column] as usize;
                for &other in &self.places[cell(columns.start)..cell(columns.end)] {
                    let offset = self.torus.way(place, other);
                    sum += constraints.push(offset, offset.length_squared());
                }
            }
        }
        sum
    }
}
