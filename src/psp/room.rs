//! The neighbour search inside one block: what stands in it and around it, in a small dense grid.

use glam::DVec3;

use crate::grid3::distance_squared;
use crate::mesh::exact;
use crate::psp::blocks::{Block, SIDE};

/// How far a room reaches beyond its block, in radii. A block looks at what is near to fragments whose centre is in it:
/// within a radius, the extent of the fragment, at most 4/3, and one more for its neighbours.
const HALO: u32 = 4;
/// The side of a cell in radii.
const CELL: u32 = 2;
/// Cells along an axis.
const CELLS: usize = ((SIDE + 2 * HALO) / CELL) as usize;

const NONE: u16 = u16::MAX;

/// Conflict-free points in and around a block. There are at most sqrt(2) for each cell, the densest packing, and some
/// along the border: a `u16` counts them.
pub(super) struct Room {
    radius: f64,
    origin: [f64; 3],
    per_unit: f64,
    /// The first point of the chain in each cell.
    heads: Vec<u16>,
    next: Vec<u16>,
    points: Vec<[f32; 3]>,
}

impl Room {
    /// An empty room. Blocks count from `origin`.
    pub fn new(block: Block, origin: [f64; 3], radius: f64) -> Self {
        let corner =
            |axis: usize| origin[axis] + (f64::from(block.0[axis]) * f64::from(SIDE) - f64::from(HALO)) * radius;
        Self {
            radius,
            origin: [0, 1, 2].map(corner),
            per_unit: 1.0 / (f64::from(CELL) * radius),
            heads: vec![NONE; CELLS * CELLS * CELLS],
            next: Vec::new(),
            points: Vec::new(),
        }
    }

    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The cell along an axis, too low or too high outside the room.
    fn cell(&self, axis: usize, x: f64) -> i32 {
        let cells = (x - self.origin[axis]) * self.per_unit;
        // Towards minus infinity, as far as it matters.
        if cells < 0.0 { -1 } else { cells as i32 }
    }

    /// Adds a point, or leaves it out if it is outside.
    pub fn add(&mut self, point: [f32; 3]) {
        let cell = [0, 1, 2].map(|axis| self.cell(axis, f64::from(point[axis])));
        if cell.iter().all(|x| (0..CELLS as i32).contains(x)) {
            let [x, y, z] = cell.map(|x| x as usize);
            let head = &mut self.heads[(z * CELLS + y) * CELLS + x];
            self.next.push(*head);
            *head = self.points.len() as u16;
            self.points.push(point);
        }
    }

    /// Whether a point is closer to another one than the radius: in `f64` from the floats, without tolerance.
    pub fn rejects(&self, point: [f32; 3]) -> bool {
        let squared = self.radius * self.radius;
        self.any_in_reach(point.map(f64::from), self.radius, |other| distance_squared(point, other) < squared)
    }

    /// Visits the points within a distance of a point, as seen from there.
    pub fn near(&self, centre: DVec3, distance: f64, mut visit: impl FnMut(DVec3)) {
        self.any_in_reach(centre.to_array(), distance, |point| {
            let offset = exact(point) - centre;
            if offset.length_squared() <= distance * distance {
                visit(offset);
            }
            false
        });
    }

    /// Whether the test holds for a point in one of the cells that a ball touches.
    fn any_in_reach(&self, centre: [f64; 3], distance: f64, mut test: impl FnMut([f32; 3]) -> bool) -> bool {
        // The margin covers the rounding of the sums.
        let reach = distance * (1.0 + 1e-9);
        let low = [0, 1, 2].map(|axis| self.cell(axis, centre[axis] - reach).max(0) as usize);
        let high = [0, 1, 2].map(|axis| (self.cell(axis, centre[axis] + reach) + 1).clamp(0, CELLS as i32) as usize);
        for z in low[2]..high[2] {
            for y in low[1]..high[1] {
                let row = (z * CELLS + y) * CELLS;
                for &head in &self.heads[row + low[0].min(high[0])..row + high[0]] {
                    let mut id = head;
                    while id != NONE {
                        if test(self.points[id as usize]) {
                            return true;
                        }
                        id = self.next[id as usize];
                    }
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn finds_what_a_loop_over_all_points_in_the_room_finds() {
        for (origin, radius) in [([0.0; 3], 0.05), ([-7.0, 3.0, 1e3], 1.5)] {
            let block = Block([1, 0, 2]);
            let side = f64::from(SIDE) * radius;
            let corner: [f64; 3] = std::array::from_fn(|axis| origin[axis] + f64::from(block.0[axis]) * side);
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            // In the room and outside.
            let mut point = |margin: f64| -> [f32; 3] {
                corner.map(|x| (x - margin * radius + (side + 2.0 * margin * radius) * rng.unit()) as f32)
            };
            let mut room = Room::new(block, origin, radius);
            let mut points: Vec<[f32; 3]> = Vec::new();
            for _ in 0..4000 {
                let new = point(4.5);
                room.add(new);
                points.push(new);
                let centre = point(1.05);
                let close = |other: &&[f32; 3]| distance_squared(centre, **other) < radius * radius;
                assert_eq!(room.rejects(centre), points.iter().any(|other| close(&other)));
                let (around, reach) = (exact(centre), 2.9 * radius);
                let mut found = Vec::new();
                room.near(around, reach, |offset| found.push(offset));
                let expected = points.iter().map(|&other| exact(other) - around);
                let mut expected: Vec<_> = expected.filter(|p| p.length_squared() <= reach * reach).collect();
                let by_place = |a: &DVec3, b: &DVec3| a.to_array().partial_cmp(&b.to_array()).unwrap();
                found.sort_by(by_place);
                expected.sort_by(by_place);
                assert_eq!(found, expected);
            }
        }
    }
}
