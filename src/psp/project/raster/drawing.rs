//! One tile of a projector, over which triangles are drawn.

use std::ops::Range;

use crate::mesh::Mesh;
use crate::psp::project::projector::Projector;
use crate::psp::project::raster::lattice::{LatticePoint, MARGIN, ProjectorLattice, extent, extent_between};
use crate::psp::project::raster::tiles::{PatternTile, PatternTiles};
use crate::psp::project::raster::triangle::ProjectedTriangle;
use crate::trace::Hit;

/// The end of a chain.
const NONE: u32 = u32::MAX;

/// A tile on a projector, and the hits so far.
pub(super) struct Drawing<'a> {
    tiles: &'a PatternTiles,
    lattice: &'a ProjectorLattice,
    projector: &'a Projector,
    tile: &'a PatternTile,
    pub points: Vec<LatticePoint>,
    /// The corner of the tile, and cells per unit.
    corner: [f64; 2],
    per_unit: f64,
    /// In the order in which they are found, each with the one before it on the same ray.
    found: Vec<(Hit, u32)>,
    /// The last hit on each ray.
    last: Vec<u32>,
}

impl<'a> Drawing<'a> {
    pub fn new(
        tiles: &'a PatternTiles,
        lattice: &'a ProjectorLattice,
        projector: &'a Projector,
        column: i32,
        row: i32,
    ) -> Self {
        let ProjectorLattice { reach, units, .. } = lattice;
        let shift = projector.shift(tiles.side);
        let repetition = |axis: usize, tile: i32| shift[axis] + f64::from(tile.div_euclid(tiles.count)) * tiles.side;
        let offset = [repetition(0, column), repetition(1, row)];
        let tile = tiles.get(column, row);
        let place = |point: &[f32; 2]| lattice.round([0, 1].map(|axis| f64::from(point[axis]) + offset[axis]));
        let side = tiles.side / f64::from(tiles.count);
        let corner = [column, row].map(|tile| f64::from(tile) * side);
        Self {
            tiles,
            lattice,
            projector,
            points: tile.items().iter().map(place).collect(),
            corner: [0, 1].map(|axis| (corner[axis] + shift[axis] + reach) * units),
            per_unit: tiles.cells as f64 / (side * units),
            found: Vec::new(),
            last: vec![NONE; tile.items().len()],
            tile,
        }
    }

    /// The cells along an axis from one coordinate to another, as far as there are some.
    fn cells(&self, axis: usize, [from, to]: [f64; 2]) -> Range<usize> {
        let cell = |x: f64| (x - self.corner[axis]) * self.per_unit;
        let end = self.tiles.cells;
        // Casts end at zero.
        cell(from - MARGIN) as usize..((cell(to + MARGIN) + 1.0) as usize).min(end)
    }

    /// Notes the points that a triangle covers.
    pub fn draw(&mut self, triangle: u32, mesh: &Mesh) {
        let corners = self.lattice.corners(mesh, triangle);
        let seen = self.lattice.see(self.projector, &corners);
        let width = self.cells(0, extent(&seen, 0));
        let mut edges = None;
        for row in self.cells(1, extent(&seen, 1)) {
            let columns = if width.len() <= 3 {
                width.clone()
            } else {
                let [bottom, top] = [row, row + 1].map(|row| self.corner[1] + row as f64 / self.per_unit);
                self.cells(0, extent_between(&seen, bottom - MARGIN, top + MARGIN))
            };
            let points = self.points_in(row, columns);
            if points.is_empty() {
                continue;
            }
            let Some(inside) = edges.get_or_insert_with(|| ProjectedTriangle::new(seen)) else { return };
            for point in points {
                if let Some([u, v]) = inside.barycentrics(self.points[point]) {
                    let [a, b, c] = corners.map(|corner| self.projector.forward.dot(corner) + self.lattice.reach);
                    let t = (1.0 - u - v) * a + u * b + v * c;
                    let hit = Hit { ray: point as u32, triangle, uv: [u as f32, v as f32], t: t as f32 };
                    let before = std::mem::replace(&mut self.last[point], self.found.len() as u32);
                    self.found.push((hit, before));
                }
            }
        }
    }

    /// The points in some cells of a row.
    fn points_in(&self, row: usize, columns: Range<usize>) -> Range<usize> {
        let first = row * self.tiles.cells;
        if columns.is_empty() {
            return 0..0;
        }
        self.tile.range(first + columns.start..first + columns.end)
    }

    /// The hits by ray, `t` and triangle.
    pub fn hits(&self) -> Vec<Hit> {
        let mut hits: Vec<Hit> = Vec::with_capacity(self.found.len());
        for &last in &self.last {
            let (start, mut next) = (hits.len(), last);
            while next != NONE {
                let (hit, before) = self.found[next as usize];
                hits.push(hit);
                next = before;
            }
            hits[start..].sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
        }
        hits
    }
}
