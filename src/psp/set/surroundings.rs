//! The neighbour search in one cube: the samples in it and around it, in a small dense grid.

use glam::{DVec3, Vec3A};

use crate::math::distance_squared;
use crate::mesh::exact;
use crate::psp::set::cubes::{Cube, SIDE};
use crate::psp::set::lanes::{FAR, LANES, PointLanes, SLACK};
use crate::psp::set::vectors;
use crate::simd::Level;

/// The distance by which the grid extends beyond the cube, in radii. Searches extend to one radius from points in the
/// cube.
const HALO: u32 = 4;
/// The side of a cell in radii: a page or two of a surface.
const CELL: f32 = 4.0;
/// Half the side of the grid in radii.
const HALF: f32 = (SIDE / 2 + HALO) as f32;
/// Cells along an axis.
const CELLS: usize = (2.0 * HALF / CELL) as usize;
/// The cells that a ball touches are found with this margin, in radii, for the rounding of places.
const MARGIN: f32 = 1e-4;

const NONE: u16 = u16::MAX;

/// Conflict-free points in and around a cube. There are at most sqrt(2) for each cube of side one radius, the densest
/// packing, and some along the boundary: a `u16` counts them.
pub struct Surroundings {
    radius: f64,
    centre: DVec3,
    per_radius: f64,
    /// The lower and upper corner, widened by a rounding.
    bounds: [Vec3A; 2],
    vectors: Level,
    /// The first page of each cell.
    heads: Vec<u16>,
    pages: Vec<Page>,
    points: Vec<[f32; 3]>,
}

/// Some of the points in a cell.
#[repr(align(64))]
struct Page {
    /// The places relative to the centre of the cube, in radii.
    places: PointLanes,
    points: [u16; LANES],
    count: u16,
    /// The next page of the cell.
    next: u16,
}

impl Surroundings {
    /// No points yet. Cubes count from `origin`.
    pub fn new(cube: Cube, origin: [f64; 3], radius: f64) -> Self {
        let centre = [0, 1, 2].map(|axis| origin[axis] + (f64::from(cube.0[axis]) + 0.5) * f64::from(SIDE) * radius);
        let (centre, half) = (DVec3::from_array(centre), f64::from(HALF) * radius * 1.01);
        Self {
            radius,
            centre,
            bounds: [(centre - half).as_vec3a(), (centre + half).as_vec3a()],
            per_radius: 1.0 / radius,
            vectors: Level::widest(),
            heads: vec![NONE; CELLS * CELLS * CELLS],
            pages: Vec::new(),
            points: Vec::new(),
        }
    }

    /// The place of a point relative to the centre of the cube, in radii.
    pub fn place(&self, point: DVec3) -> [f32; 3] {
        ((point - self.centre) * self.per_radius).as_vec3().to_array()
    }

    /// True if a point may be inside: a quick test that excludes the many that are not.
    pub fn may_hold(&self, point: [f32; 3]) -> bool {
        let ([low, high], point) = (self.bounds, Vec3A::from_array(point));
        (point.cmpge(low) & point.cmple(high)).all()
    }

    /// Adds a point, unless it is outside.
    pub fn add(&mut self, point: [f32; 3]) {
        let place = self.place(exact(point));
        if place.iter().any(|x| x.abs() >= HALF) {
            return;
        }
        // A sum can be rounded up to the very end.
        let [x, y, z] = place.map(|x| (((x + HALF) / CELL) as usize).min(CELLS - 1));
        let head = &mut self.heads[(z * CELLS + y) * CELLS + x];
        if *head == NONE || usize::from(self.pages[usize::from(*head)].count) == LANES {
            self.pages.push(Page { places: [[FAR; LANES]; 3], points: [0; LANES], count: 0, next: *head });
            *head = (self.pages.len() - 1) as u16;
        }
        let page = &mut self.pages[usize::from(*head)];
        let lane = usize::from(page.count);
        (0..3).for_each(|axis| page.places[axis][lane] = place[axis]);
        page.points[lane] = self.points.len() as u16;
        page.count += 1;
        self.points.push(point);
    }

    /// True if a point is closer to another one than the radius: in `f64` from the floats, without tolerance.
    pub fn rejects(&self, point: [f32; 3]) -> bool {
        let place = self.place(exact(point));
        let squared = self.radius * self.radius;
        self.any_page(place, |page| {
            let mut close = vectors::within(self.vectors, &page.places, place, 1.0 + SLACK);
            while close != 0 {
                let other = page.points[close.trailing_zeros() as usize];
                if distance_squared(point, self.points[usize::from(other)]) < squared {
                    return true;
                }
                close &= close - 1;
            }
            false
        })
    }

    /// True if the test holds for a page of the cells that the ball around a place touches.
    #[inline(always)]
    fn any_page(&self, centre: [f32; 3], mut test: impl FnMut(&Page) -> bool) -> bool {
        let cell = |x: f32| ((x + HALF) / CELL).clamp(0.0, CELLS as f32) as usize;
        let low = centre.map(|x| cell(x - 1.0 - MARGIN));
        let high = centre.map(|x| (cell(x + 1.0 + MARGIN) + 1).min(CELLS));
        for z in low[2]..high[2] {
            for y in low[1]..high[1] {
                let row = (z * CELLS + y) * CELLS;
                for &head in &self.heads[row + low[0].min(high[0])..row + high[0]] {
                    let mut id = head;
                    while id != NONE {
                        let page = &self.pages[usize::from(id)];
                        if test(page) {
                            return true;
                        }
                        id = page.next;
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
    fn finds_what_a_loop_over_all_points_finds() {
        for (origin, radius) in [([0.0; 3], 0.05), ([-7.0, 3.0, 1e3], 1.5)] {
            let cube = Cube([1, 0, 2]);
            let side = f64::from(SIDE) * radius;
            let corner: [f64; 3] = std::array::from_fn(|axis| origin[axis] + f64::from(cube.0[axis]) * side);
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            // Inside and outside.
            let mut point = |margin: f64| -> [f32; 3] {
                corner.map(|x| (x - margin * radius + (side + 2.0 * margin * radius) * rng.unit()) as f32)
            };
            let mut surroundings = Surroundings::new(cube, origin, radius);
            let mut points: Vec<[f32; 3]> = Vec::new();
            for _ in 0..4000 {
                let new = point(4.5);
                surroundings.add(new);
                points.push(new);
                let centre = point(1.05);
                let close = |other: &&[f32; 3]| distance_squared(centre, **other) < radius * radius;
                assert_eq!(surroundings.rejects(centre), points.iter().any(|other| close(&other)));
                // Points near a point in or at the cube are not excluded by the quick test.
                assert!(!points.iter().any(|other| close(&other) && !surroundings.may_hold(*other)));
            }
        }
    }
}
