//! The neighbour search of a fill with one radius: exact tests on the pages of a grid with cells of two radii.

use glam::DVec3;

use crate::mesh::exact;
use crate::psp::fill::cells::each_cell;
use crate::psp::fill::pages::{Cell, Pages};
use crate::psp::fill::space::{Place, Space};
use crate::psp::fragment::PIERCING;

/// Samples of one radius.
pub type Grid = Pages<3>;

impl Grid {
    /// Adds a sample on a triangle with this normal.
    pub fn add(&mut self, place: Place, normal: [f32; 3]) {
        self.list(self.cells.clip(self.space.cells_around(place)), place, normal, |_, _| ());
    }

    /// True if a place on a triangle with this normal is closer to a sample than the radius: in `f64`, without
    /// tolerance.
    pub fn rejects(&self, place: Place, normal: [f32; 3]) -> bool {
        self.any_near(self.space.cell(place), place, normal, self.beyond, |page, lane| {
            self.space.conflict(place, self.place(page, lane))
        })
    }

    /// True if one page of its cell shows that a place is no farther from a sample than the square root of `limit`.
    #[inline(always)]
    pub fn is_seen_within(&self, place: Place, limit: f32) -> bool {
        let Cell { page, .. } = self.cells.get(self.cells.number(self.space.cell(place)));
        self.near(page as usize, place, limit) != 0
    }

    /// True if a place is found to be no farther from a sample than the square root of `limit`.
    pub fn is_within(&self, place: Place, limit: f32) -> bool {
        self.any_page(self.space.cell(place), |page| self.near(page, place, limit) != 0)
    }

    /// The distance of a place on a triangle with this normal to the nearest sample, or `reach` if none is nearer: at
    /// most twice the radius, in the unit of places.
    pub fn distance(&self, place: Place, normal: [f32; 3], reach: f64) -> f64 {
        let mut least = reach * reach;
        each_cell(self.cells.clip(self.space.cells_within(place, reach - self.space.radius())), |cell| {
            self.any_page(cell, |number| {
                let mut near = self.near(number, place, Space::beyond(least));
                while near != 0 {
                    let lane = near.trailing_zeros() as usize;
                    if self.sees(number, lane, normal) {
                        least = least.min(exact(place).distance_squared(exact(self.place(number, lane))));
                    }
                    near &= near - 1;
                }
                false
            });
        });
        least.sqrt()
    }

    /// Those of some sixteenths of a fragment, given by its corners in the unit of the space and the normal of its
    /// triangle, that no single sample certainly covers.
    #[inline(always)]
    pub fn open_sixteenths(&self, corners: &[DVec3; 3], longest: f64, normal: [f32; 3], open: u16) -> u16 {
        // A sample that covers a sixteenth is no farther from its centre than the radius, and this is no farther from
        // the centre of the fragment than three quarters of the way to a corner, which is two thirds of the longest
        // edge.
        let reach = (self.space.radius() + 0.5 * longest) as f32;
        self.open_parts(corners, &[0.0; 3], reach, normal, open)
    }
}

/// True if the test holds for a cell whose pages have to be read for the sixteenths of a fragment: samples that cover
/// one are on the pages of each of its corners.
#[inline(always)]
pub fn any_cell(space: &Space, [a, b, c]: [DVec3; 3], mut test: impl FnMut([u32; 3]) -> bool) -> bool {
    let (to_b, to_c) = (b - a, c - a);
    let mut cells = [[0; 3]; PIERCING.len()];
    for (known, [s, t]) in PIERCING.into_iter().enumerate() {
        let cell = space.cell((a + (s * to_b + t * to_c)).as_vec3().to_array());
        let is_known = cells[..known].contains(&cell);
        cells[known] = cell;
        if !is_known && test(cell) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::psp::fill::cells::Cells;
    use crate::psp::fill::extent::Extent;
    use crate::psp::fill::page::Batch;
    use crate::psp::fragment::Fragment;
    use crate::psp::fragment::{Facing, NO_NORMAL};
    use crate::rng::{Draw, Rng};
    use crate::simd::Level;

    /// The places of the tests: near the origin, and where a radius has hardly more than 64 float spacings.
    const PLACES: [(f64, f64); 4] = [(8.0, 1.0), (8.0, 7.0), (8e30, 1e30), (2e5, 1.1)];

    fn random_point(rng: &mut Rng, centre: f64, size: f64) -> [f32; 3] {
        [(); 3].map(|()| (centre + size * (2.0 * rng.unit() - 1.0)) as f32)
    }

    /// Against exact distances: what conflicts with no sample is not rejected, and what does is.
    #[test]
    fn rejects_what_a_loop_over_all_samples_rejects() {
        for (centre, radius) in PLACES {
            let mut rng = Rng::at(1, Draw::Probe, &[]);
            let end = |radii: f64| [(centre + radii * radius) as f32; 3];
            let corners = vec![random_point(&mut rng, centre, radius), end(4.0), end(-4.0)];
            let mesh = Mesh::new(corners, vec![[0, 1, 2]]).unwrap();
            let mut grid = Grid::new(Space::new(&mesh, radius), Cells::anywhere(), Facing::ANY);
            let mut samples: Vec<[f32; 3]> = Vec::new();
            for _ in 0..2000 {
                let point = random_point(&mut rng, centre, 4.0 * radius);
                let conflicts = samples.iter().any(|&sample| exact(sample).distance(exact(point)) < radius);
                assert_eq!(grid.rejects(grid.space.place(point), NO_NORMAL), conflicts);
                let distances = samples.iter().map(|&sample| exact(sample).distance(exact(point)));
                let (reach, scale) = (1.5 * grid.space.radius(), f64::from(grid.space.scale()));
                let nearest = distances.map(|distance| distance * scale).fold(reach, f64::min);
                assert!((grid.distance(grid.space.place(point), NO_NORMAL, reach) / nearest - 1.0).abs() < 1e-15);
                if samples.len() < 400 {
                    grid.add(grid.space.place(point), NO_NORMAL);
                    samples.push(point);
                }
            }
        }
    }

    /// Against exact distances to the corners: what no single sample covers is open, and what one covers well is not.
    #[test]
    fn only_what_is_covered_is_dropped_and_all_that_is_well_covered() {
        let (mut rng, mut counts) = (Rng::at(2, Draw::Probe, &[]), [0; 4]);
        for round in 0..3000 {
            let (centre, radius) = PLACES[round % 3];
            let size = [1.0, 0.1, 1e-3][round / 3 % 3] * radius;
            let corners = (0..3).map(|_| random_point(&mut rng, centre, size)).collect();
            let Ok(mesh) = Mesh::new(corners, vec![[0, 1, 2]]) else { continue };
            let (space, mut extent) = (Space::new(&mesh, radius), Extent::EMPTY);
            mesh.corners(0).into_iter().for_each(|corner| extent.add(corner));
            let cells = if round % 2 == 0 { Cells::anywhere() } else { Cells::around(&extent, &space) };
            let mut grid = Grid::new(space, cells, Facing::ANY);
            let samples: Vec<_> = (0..30).map(|_| random_point(&mut rng, centre, 1.4 * radius)).collect();
            // A radius far larger than the mesh is replaced by a smaller one.
            let radius = grid.space.radius() / f64::from(grid.space.scale());
            samples.iter().for_each(|&sample| grid.add(grid.space.place(sample), NO_NORMAL));
            let (whole, mut group) = (Fragment::whole(0), Batch::EMPTY);
            group.triangles[0] = mesh.corners(0).map(|corner| grid.space.place(corner));
            let is_open = grid.open_triangles(&mut group, 1, |_| NO_NORMAL) == 1;
            let shape = whole.shape(&mesh);
            let scaled = shape.corners.map(|corner| grid.space.scaled(corner));
            let mut open_at = |level| {
                grid.level = level;
                grid.open_sixteenths(&scaled, shape.longest * f64::from(grid.space.scale()), NO_NORMAL, u16::MAX)
            };
            let open = open_at(Level::Portable);
            assert!(Level::available().into_iter().all(|level| open_at(level) == open), "vectors find something else");
            let parts = (0..16).map(|part| (open >> part & 1 == 1, whole.sixteenth(part)));
            for (is_open, part) in std::iter::once((is_open, whole)).chain(parts) {
                let corners = part.shape(&mesh).corners;
                let farthest =
                    |&sample: &[f32; 3]| corners.map(|c| c.distance(exact(sample))).into_iter().fold(0.0, f64::max);
                let nearest = samples.iter().map(farthest).fold(f64::INFINITY, f64::min);
                assert!(is_open || nearest < radius, "{nearest} {radius}");
                assert!(!is_open || nearest > radius * (1.0 - 2e-5), "{nearest} {radius}");
                counts[2 * usize::from(part.corners == whole.corners) + usize::from(is_open)] += 1;
            }
        }
        assert!(counts.into_iter().all(|count| count > 300), "{counts:?}");
    }
}
