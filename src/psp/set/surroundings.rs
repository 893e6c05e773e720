//! The neighbour search in one cube: the samples in it and around it, in a small dense grid.

use glam::{DVec3, Vec3A};

use crate::math::distance_squared;
use crate::mesh::exact;
use crate::psp::set::lanes::{FAR, LANES, PointLanes, SLACK};
use crate::psp::set::vectors;
use crate::simd::Level;

/// The distance by which the grid extends at least beyond the cube, in radii. Searches extend to one radius from points
/// in the cube.
const HALO: f64 = 4.0;
/// The side of a cell in radii: a page or two of a surface.
const CELL: f32 = 4.0;
/// The cells that a ball touches are found with this margin, in radii, for the rounding of places.
const MARGIN: f32 = 1e-4;

const NONE: u32 = u32::MAX;

/// Conflict-free points in and around a cube.
pub struct Surroundings {
    /// Half the side of the grid in radii, and cells along an axis.
    half: f32,
    cells: usize,
    radius: f64,
    centre: DVec3,
    per_radius: f64,
    /// The lower and upper corner, widened by a rounding.
    bounds: [Vec3A; 2],
    vectors: Level,
    /// The first page of each cell.
    heads: Vec<u32>,
    pages: Vec<Page>,
    /// The points of each page.
    points: Vec<[[f32; 3]; LANES]>,
}

/// Some of the points in a cell.
#[repr(align(64))]
struct Page {
    /// The places relative to the centre of the cube, in radii.
    places: PointLanes,
    count: u32,
    /// The next page of the cell.
    next: u32,
}

impl Surroundings {
    /// No points yet, around the cube that reaches `half` its side from a centre.
    pub fn new(centre: DVec3, half: f64, radius: f64) -> Self {
        let cells = 2 * ((half / radius + HALO) / f64::from(CELL)).round() as usize;
        let grid_half = 0.5 * CELL * cells as f32;
        let reach = f64::from(grid_half) * radius * 1.01;
        Self {
            half: grid_half,
            cells,
            radius,
            centre,
            bounds: [(centre - reach).as_vec3a(), (centre + reach).as_vec3a()],
            per_radius: 1.0 / radius,
            vectors: Level::widest(),
            heads: vec![NONE; cells * cells * cells],
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
        let Self { half, cells, .. } = *self;
        if place.iter().any(|x| x.abs() >= half) {
            return;
        }
        // A sum can be rounded up to the very end.
        let [x, y, z] = place.map(|x| (((x + half) / CELL) as usize).min(cells - 1));
        let head = &mut self.heads[(z * cells + y) * cells + x];
        if *head == NONE || self.pages[*head as usize].count as usize == LANES {
            self.pages.push(Page { places: [[FAR; LANES]; 3], count: 0, next: *head });
            self.points.push([[0.0; 3]; LANES]);
            *head = (self.pages.len() - 1) as u32;
        }
        let number = *head as usize;
        let page = &mut self.pages[number];
        let lane = page.count as usize;
        (0..3).for_each(|axis| page.places[axis][lane] = place[axis]);
        page.count += 1;
        self.points[number][lane] = point;
    }

    /// True if a point is closer to another one than the radius: in `f64` from the floats, without tolerance.
    pub fn rejects(&self, point: [f32; 3]) -> bool {
        let place = self.place(exact(point));
        let squared = self.radius * self.radius;
        self.any_page(place, |number, page| {
            let mut close = vectors::within(self.vectors, &page.places, place, 1.0 + SLACK);
            while close != 0 {
                let other = self.points[number][close.trailing_zeros() as usize];
                if distance_squared(point, other) < squared {
                    return true;
                }
                close &= close - 1;
            }
            false
        })
    }

    /// True if the test holds for a page of the cells that the ball around a place touches.
    #[inline(always)]
    fn any_page(&self, centre: [f32; 3], mut test: impl FnMut(usize, &Page) -> bool) -> bool {
        let Self { half, cells, .. } = *self;
        let cell = |x: f32| ((x + half) / CELL).clamp(0.0, cells as f32) as usize;
        let low = centre.map(|x| cell(x - 1.0 - MARGIN));
        let high = centre.map(|x| (cell(x + 1.0 + MARGIN) + 1).min(cells));
        for z in low[2]..high[2] {
            for y in low[1]..high[1] {
                let row = (z * cells + y) * cells;
                for &head in &self.heads[row + low[0].min(high[0])..row + high[0]] {
                    let mut id = head;
                    while id != NONE {
                        let page = &self.pages[id as usize];
                        if test(id as usize, page) {
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
            let cube = [1.0, 0.0, 2.0];
            let side = 24.0 * radius;
            let corner: [f64; 3] = std::array::from_fn(|axis| origin[axis] + cube[axis] * side);
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            // Inside and outside.
            let mut point = |margin: f64| -> [f32; 3] {
                corner.map(|x| (x - margin * radius + (side + 2.0 * margin * radius) * rng.unit()) as f32)
            };
            let mut surroundings = Surroundings::new(DVec3::from_array(corner) + 0.5 * side, 0.5 * side, radius);
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
