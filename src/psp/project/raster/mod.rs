//! Projection by rasterisation, the equivalent of ray tracing that thesis §3.4.3 describes: each triangle is drawn over the
//! projectors, and the points of the pattern that it covers are its hits.
//!
//! Corners and points are rounded to an integer lattice, 2^-30 of the projector's width, in which all is exact: adjacent
//! triangles have no gap and no overlap, and a hit does not depend on the machine's vectors or on an Embree. All triangles
//! of a tile of the projector are drawn by one task; so no counters are shared, which the thesis finds irregular.

use std::ops::Range;

use glam::DVec3;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::psp::blocks::Groups;
use crate::psp::project::pattern;
use crate::psp::project::projector::{Collector, Found, Projector};
use crate::trace::Hit;
use tiles::{Tile, Tiles};
use triangle::{END, Place, Triangle, extent, extent_between};

#[cfg(test)]
mod tests;
mod tiles;
mod triangle;

/// Triangles per task.
const CHUNK: usize = 1024;
/// By how much rounding can move a point against the border of its cell or tile, in units of the lattice, and some more.
const MARGIN: f64 = 2.0;

/// The pattern, and how a mesh is seen on a projector.
pub(crate) struct Rasteriser {
    tiles: Tiles,
    centre: DVec3,
    per_radius: f64,
    /// Half the width of a projector, in radii.
    reach: f64,
    /// Units of the lattice in a radius.
    units: f64,
}

/// A tile on a projector: the number of the projector, the row, the column. Tiles repeat the pattern without end.
type TilePlace = [i32; 3];

/// The triangles that are near each tile.
type Bins = Groups<TilePlace, u32>;

impl Rasteriser {
    /// Makes the pattern.
    pub fn new(job: &Job, mesh: &Mesh, radius: f64, seed: u64) -> Result<Self> {
        let (low, high) = mesh.bounds();
        let (low, high) = (exact(low), exact(high));
        let diagonal = (high - low).length() / radius;
        let (side, points) = pattern::torus(&job.part(0.0, 0.7), diagonal, seed)?;
        let tiles = Tiles::new(&job.part(0.7, 1.0), side, &points)?;
        // Some points of a tile that meets the mesh can be beyond it.
        let reach = 0.5 * diagonal + side / f64::from(tiles.count) + 1.0;
        Ok(Self { tiles, centre: 0.5 * (low + high), per_radius: 1.0 / radius, reach, units: 0.5 * END as f64 / reach })
    }

    /// Draws the mesh over three projectors and collects all hits. As rays count the points of tiles near triangles.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Found> {
        let bins = self.sort(&job.part(0.0, 0.2), collector.mesh, projectors)?;
        collector.collect(&job.part(0.2, 1.0), bins.len(), |bin, take| {
            let [projector, row, column] = bins.place(bin);
            let plane = &projectors[projector as usize];
            let mut drawing = Drawing::new(self, plane, column, row);
            for &triangle in bins.items(bin) {
                drawing.draw(triangle, collector.mesh);
            }
            take(projector as usize, drawing.points.len(), &drawing.hits());
        })
    }

    /// Sorts the triangles by the tiles that they come near.
    fn sort(&self, job: &Job, mesh: &Mesh, projectors: &[Projector; 3]) -> Result<Bins> {
        let chunks = chunks_of(mesh.triangles().len(), CHUNK);
        let side = self.tiles.side / f64::from(self.tiles.count) * self.units;
        let shifts = projectors
            .each_ref()
            .map(|projector| projector.shift(self.tiles.side).map(|shift| (shift + self.reach) * self.units));
        let (bins, _) = Groups::collect(job, chunks.len(), |chunk, add| {
            let with_area = |&triangle: &u32| mesh.triangle_area(triangle) > 0.0;
            for triangle in chunks.range(chunk).map(|triangle| triangle as u32).filter(with_area) {
                let corners = self.corners(mesh, triangle);
                for (number, (projector, shift)) in (0..).zip(projectors.iter().zip(&shifts)) {
                    let seen = self.see(projector, &corners);
                    let tiles = |[from, to]: [f64; 2], axis: usize| {
                        let [from, to] = [from - MARGIN, to + MARGIN].map(|x| floor((x - shift[axis]) / side));
                        from..=to
                    };
                    let columns = tiles(extent(&seen, 0), 0);
                    for row in tiles(extent(&seen, 1), 1) {
                        let columns = if columns.start() == columns.end() {
                            columns.clone()
                        } else {
                            let [bottom, top] = [row, row + 1].map(|row| shift[1] + f64::from(row) * side);
                            tiles(extent_between(&seen, bottom - MARGIN, top + MARGIN), 0)
                        };
                        columns.for_each(|column| add([number, row, column], triangle));
                    }
                }
            }
        })?;
        Ok(bins)
    }

    /// The corners of a triangle as seen from the centre of the mesh, in radii.
    fn corners(&self, mesh: &Mesh, triangle: u32) -> [DVec3; 3] {
        mesh.corners(triangle).map(|corner| (exact(corner) - self.centre) * self.per_radius)
    }

    /// Corners on a projector.
    fn see(&self, projector: &Projector, corners: &[DVec3; 3]) -> [Place; 3] {
        corners.map(|corner| self.round([projector.right.dot(corner), projector.up.dot(corner)]))
    }

    /// The place on the lattice of a point on a projector, in radii from its centre.
    fn round(&self, point: [f64; 2]) -> Place {
        // None is below zero, where truncation would round the other way.
        point.map(|x| ((x + self.reach) * self.units) as i64)
    }
}

/// The integer below; or one lower, for integers below zero, which `MARGIN` allows for.
fn floor(x: f64) -> i32 {
    x as i32 - i32::from(x < 0.0)
}

/// The end of a chain.
const NONE: u32 = u32::MAX;

/// A tile on a projector, and the hits so far.
struct Drawing<'a> {
    rasteriser: &'a Rasteriser,
    projector: &'a Projector,
    tile: &'a Tile,
    points: Vec<Place>,
    /// The corner of the tile, and cells per unit.
    corner: [f64; 2],
    per_unit: f64,
    /// In the order in which they are found, each with the one before it on the same ray.
    found: Vec<(Hit, u32)>,
    /// The last hit on each ray.
    last: Vec<u32>,
}

impl<'a> Drawing<'a> {
    fn new(rasteriser: &'a Rasteriser, projector: &'a Projector, column: i32, row: i32) -> Self {
        let Rasteriser { tiles, reach, units, .. } = rasteriser;
        let shift = projector.shift(tiles.side);
        let repetition = |axis: usize, tile: i32| shift[axis] + f64::from(tile.div_euclid(tiles.count)) * tiles.side;
        let offset = [repetition(0, column), repetition(1, row)];
        let tile = tiles.get(column, row);
        let place = |point: &[f32; 2]| rasteriser.round([0, 1].map(|axis| f64::from(point[axis]) + offset[axis]));
        let side = tiles.side / f64::from(tiles.count);
        let corner = [column, row].map(|tile| f64::from(tile) * side);
        Self {
            rasteriser,
            projector,
            points: tile.points.iter().map(place).collect(),
            corner: [0, 1].map(|axis| (corner[axis] + shift[axis] + reach) * units),
            per_unit: tiles.cells as f64 / (side * units),
            found: Vec::new(),
            last: vec![NONE; tile.points.len()],
            tile,
        }
    }

    /// The cells along an axis from one coordinate to another, as far as there are some.
    fn cells(&self, axis: usize, [from, to]: [f64; 2]) -> Range<usize> {
        let cell = |x: f64| (x - self.corner[axis]) * self.per_unit;
        let end = self.rasteriser.tiles.cells;
        // Casts end at zero.
        cell(from - MARGIN) as usize..((cell(to + MARGIN) + 1.0) as usize).min(end)
    }

    /// Notes the points that a triangle covers.
    fn draw(&mut self, triangle: u32, mesh: &Mesh) {
        let corners = self.rasteriser.corners(mesh, triangle);
        let seen = self.rasteriser.see(self.projector, &corners);
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
            let Some(inside) = edges.get_or_insert_with(|| Triangle::new(seen)) else { return };
            for point in points {
                if let Some([u, v]) = inside.barycentrics(self.points[point]) {
                    let [a, b, c] = corners.map(|corner| self.projector.forward.dot(corner) + self.rasteriser.reach);
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
        let first = row * self.rasteriser.tiles.cells;
        if columns.is_empty() {
            return 0..0;
        }
        let [start, end] = [columns.start, columns.end].map(|column| usize::from(self.tile.starts[first + column]));
        start..end
    }

    /// The hits by ray, `t` and triangle.
    fn hits(&self) -> Vec<Hit> {
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
