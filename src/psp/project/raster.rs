//! Projection by rasterisation, the equivalent of ray tracing that thesis §3.4.3 describes: each triangle is drawn over
//! the projectors, and the points of the pattern that it covers are its hits.
//!
//! Corners and points are rounded to an integer lattice, 2^-30 of the projector's width, in which everything is exact:
//! adjacent triangles have no gap and no overlap, and a hit depends neither on the machine's vector instructions nor on
//! Embree. All triangles of a tile of the projector are drawn by one task; so no counters are shared, which the thesis
//! finds irregular.

use std::ops::Range;

use glam::DVec3;

use crate::error::Result;
use crate::index::{Binned, Buckets};
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::psp::project::candidates::{Candidates, Collector};
use crate::psp::project::pattern;
use crate::psp::project::projector::Projector;
use crate::trace::Hit;

/// Triangles per task.
const TRIANGLES: usize = 1024;

/// The pattern, and the map of a mesh to a projector.
pub struct Rasteriser {
    tiles: PatternTiles,
    lattice: ProjectorLattice,
}

/// A tile on a projector: the number of the projector, the row, the column. Tiles repeat the pattern indefinitely.
type TileKey = [i32; 3];

/// The triangles near each tile.
type TrianglesByTile = Buckets<TileKey, u32>;

impl Rasteriser {
    /// Makes the pattern.
    pub fn new(job: &Job, mesh: &Mesh, radius: f64, seed: u64) -> Result<Self> {
        let (low, high) = mesh.bounds();
        let diagonal = (exact(high) - exact(low)).length() / radius;
        let (side, points) = pattern::torus(&job.part(0.0, 0.7), diagonal, seed)?;
        let tiles = PatternTiles::new(&job.part(0.7, 1.0), side, &points)?;
        // Some points of a tile that meets the mesh can be beyond it.
        let reach = 0.5 * diagonal + side / f64::from(tiles.count) + 1.0;
        Ok(Self { tiles, lattice: ProjectorLattice::new(mesh, radius, reach) })
    }

    /// Draws the mesh over three projectors and collects all hits. The points of tiles near triangles count as rays.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Candidates> {
        let bins = self.sort(&job.part(0.0, 0.2), collector.mesh, projectors)?;
        collector.collect(&job.part(0.2, 1.0), bins.len(), |bin, take| {
            let [projector, row, column] = bins.key(bin);
            let plane = &projectors[projector as usize];
            let mut drawing = Drawing::new(&self.tiles, &self.lattice, plane, column, row);
            for &triangle in bins.items(bin) {
                drawing.draw(triangle, collector.mesh);
            }
            take(projector as usize, drawing.points.len(), &drawing.hits());
        })
    }

    /// Sorts the triangles by the tiles that they come near.
    fn sort(&self, job: &Job, mesh: &Mesh, projectors: &[Projector; 3]) -> Result<TrianglesByTile> {
        let chunks = chunks_of(mesh.triangles().len(), TRIANGLES);
        let ProjectorLattice { reach, units, .. } = self.lattice;
        let side = self.tiles.side / f64::from(self.tiles.count) * units;
        let shifts = projectors
            .each_ref()
            .map(|projector| projector.shift(self.tiles.side).map(|shift| (shift + reach) * units));
        let (bins, _) = Buckets::collect(job, chunks.len(), |chunk, add| {
            let with_area = |&triangle: &u32| mesh.triangle_area(triangle) > 0.0;
            for triangle in chunks.range(chunk).map(|triangle| triangle as u32).filter(with_area) {
                let corners = self.lattice.corners(mesh, triangle);
                for (number, (projector, shift)) in (0..).zip(projectors.iter().zip(&shifts)) {
                    let seen = self.lattice.see(projector, &corners);
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
}

/// The largest integer not above a number; or one lower, for integers below zero, which `MARGIN` allows for.
fn floor(x: f64) -> i32 {
    x as i32 - i32::from(x < 0.0)
}

// The pattern in square tiles, the units of work of the rasteriser, and their points in cells, row by row: those that a
// triangle can cover in a row are neighbours in memory.

/// The side of the largest tile in radii: its points stay in the cache while triangles are drawn over them.
const LARGEST_TILE: f64 = 48.0;
/// Points per task.
const POINTS: usize = 1 << 16;

/// The pattern's tiles, all of the same size.
pub struct PatternTiles {
    /// The side of the pattern, in radii.
    pub side: f64,
    /// The number of tiles of the pattern along each axis.
    pub count: i32,
    /// The number of cells of a tile along each axis, none of them wider than a radius.
    pub cells: usize,
    /// The tiles, row by row.
    tiles: Vec<PatternTile>,
}

/// The points of a tile of the pattern by cells, row by row; in radii from the corner of the pattern.
pub type PatternTile = Binned<[f32; 2]>;

impl PatternTiles {
    /// Sorts the points of a pattern of this side.
    pub fn new(job: &Job, side: f64, points: &[[f32; 2]]) -> Result<Self> {
        let count = (side / LARGEST_TILE).ceil();
        let tile_side = side / count;
        let cells = tile_side.ceil();
        let index = |x: f64, of: f64| x.min(of - 1.0) as usize;
        let chunks = chunks_of(points.len(), POINTS);
        let (parts, _) = Buckets::collect(&job.part(0.0, 0.5), chunks.len(), |chunk, add| {
            for point in &points[chunks.range(chunk)] {
                let [column, row] = point.map(|x| index(f64::from(x) / tile_side, count));
                add(row * count as usize + column, *point);
            }
        })?;
        let sorted = job.part(0.5, 1.0).map(parts.len(), |part| {
            let number = parts.key(part);
            let corner = [number % count as usize, number / count as usize].map(|tile| tile as f64 * tile_side);
            let cell = |point: &[f32; 2]| {
                let [column, row] = [0, 1]
                    .map(|axis| index((f64::from(point[axis]) - corner[axis]).max(0.0) / tile_side * cells, cells));
                row * cells as usize + column
            };
            let points = parts.items(part).map(|point| (cell(point), *point));
            (number, PatternTile::new(cells as usize * cells as usize, points))
        })?;
        let mut tiles: Vec<_> = (0..(count * count) as usize).map(|_| PatternTile::default()).collect();
        sorted.into_iter().for_each(|(number, tile)| tiles[number] = tile);
        Ok(Self { side, count: count as i32, cells: cells as usize, tiles })
    }

    /// The tile in a column and row of the pattern, which repeats.
    pub fn get(&self, column: i32, row: i32) -> &PatternTile {
        let [column, row] = [column, row].map(|x| x.rem_euclid(self.count));
        &self.tiles[(row * self.count + column) as usize]
    }
}

// The integer lattice of a projector, on which everything is exact.

/// An exclusive bound of all coordinates: products of coordinates, and sums of a few of them, fit into `i64`.
pub const END: i64 = 1 << 30;

/// A point on a projector, in units of its lattice.
pub type LatticePoint = [i64; 2];

/// The largest distance by which rounding can move a point against the boundary of its cell or tile, in units of the
/// lattice, and some more.
pub const MARGIN: f64 = 2.0;

/// The map from the space of a mesh to the lattice of a projector.
pub struct ProjectorLattice {
    centre: DVec3,
    per_radius: f64,
    /// Half the width of a projector, in radii.
    pub reach: f64,
    /// Units of the lattice in a radius.
    pub units: f64,
}

impl ProjectorLattice {
    /// The lattice of projectors that extend to `reach`, in radii from the centre of the mesh.
    pub fn new(mesh: &Mesh, radius: f64, reach: f64) -> Self {
        let (low, high) = mesh.bounds();
        let centre = 0.5 * (exact(low) + exact(high));
        Self { centre, per_radius: 1.0 / radius, reach, units: 0.5 * END as f64 / reach }
    }

    /// The corners of a triangle as seen from the centre of the mesh, in radii.
    pub fn corners(&self, mesh: &Mesh, triangle: u32) -> [DVec3; 3] {
        mesh.corners(triangle).map(|corner| (exact(corner) - self.centre) * self.per_radius)
    }

    /// The corners of a triangle on the lattice of a projector.
    pub fn see(&self, projector: &Projector, corners: &[DVec3; 3]) -> [LatticePoint; 3] {
        corners.map(|corner| self.round([projector.right.dot(corner), projector.up.dot(corner)]))
    }

    /// The place on the lattice of a point on a projector, in radii from its centre.
    pub fn round(&self, point: [f64; 2]) -> LatticePoint {
        // None is below zero, where truncation would round up.
        point.map(|x| ((x + self.reach) * self.units) as i64)
    }
}

/// The least and the largest coordinate of a triangle on an axis.
pub fn extent(corners: &[LatticePoint; 3], axis: usize) -> [f64; 2] {
    let [a, b, c] = corners.map(|corner| corner[axis]);
    [a.min(b).min(c), a.max(b).max(c)].map(|x| x as f64)
}

/// The least and the largest x of the part of a triangle between two heights, which is not empty.
pub fn extent_between(corners: &[LatticePoint; 3], low: f64, high: f64) -> [f64; 2] {
    let corners = corners.map(|corner| corner.map(|x| x as f64));
    let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
    for i in 0..3 {
        let ([p, q], [r, s]) = (corners[i], corners[(i + 1) % 3]);
        let ends = [low, high].map(|y| y.clamp(q.min(s), q.max(s)));
        if ends[0] <= high && ends[1] >= low {
            for y in ends {
                let x = if q == s { p } else { p + (r - p) * ((y - q) / (s - q)) };
                extent = [extent[0].min(x), extent[1].max(x)];
            }
            if q == s {
                extent = [extent[0].min(r), extent[1].max(r)];
            }
        }
    }
    extent
}

// Triangles on a projector, in integers: the points inside, and their barycentrics (Pineda 1988, "A parallel algorithm
// for polygon rasterization").
//
// A point on an edge counts as if it were moved to the right by an infinitesimal distance, and up by a much smaller
// one. So of all triangles that meet along an edge, or around a corner, and do not overlap there, exactly one contains
// it.

/// An edge of a triangle: positive on its inner side, with the rule for points on it.
#[derive(Clone, Copy)]
struct ProjectedEdge {
    slope: LatticePoint,
    constant: i64,
    /// 0 if points on the edge are inside, else 1.
    bias: i64,
}

/// A triangle on a projector.
pub struct ProjectedTriangle {
    /// Each edge is opposite the corner of its number.
    edges: [ProjectedEdge; 3],
    /// Twice the area; positive.
    area: i64,
}

impl ProjectedTriangle {
    /// A triangle on a projector; `None` if its area there is 0.
    pub fn new(corners: [LatticePoint; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let sign = area.signum();
        let edge = |from: LatticePoint, to: LatticePoint| {
            let slope = [sign * (from[1] - to[1]), sign * (to[0] - from[0])];
            let inside = slope[0] > 0 || (slope[0] == 0 && slope[1] > 0);
            ProjectedEdge { slope, constant: -(slope[0] * from[0] + slope[1] * from[1]), bias: i64::from(!inside) }
        };
        let edges = [edge(b, c), edge(c, a), edge(a, b)];
        (area != 0).then_some(Self { edges, area: area.abs() })
    }

    /// The shares of the second and third corner in a point; none for points outside.
    pub fn barycentrics(&self, [x, y]: LatticePoint) -> Option<[f64; 2]> {
        let [a, b, c] = self.edges.map(|edge| edge.slope[0] * x + edge.slope[1] * y + edge.constant - edge.bias);
        // For points outside, one of them is negative, and with it their bitwise or.
        let weight = |value: i64, edge: usize| (value + self.edges[edge].bias) as f64 / self.area as f64;
        (a | b | c >= 0).then(|| [weight(b, 1), weight(c, 2)])
    }
}

// One tile of a projector, over which triangles are drawn.

/// The end of a chain.
const NONE: u32 = u32::MAX;

/// A tile on a projector, and the hits so far.
pub struct Drawing<'a> {
    tiles: &'a PatternTiles,
    lattice: &'a ProjectorLattice,
    projector: &'a Projector,
    tile: &'a PatternTile,
    pub points: Vec<LatticePoint>,
    /// The corner of the tile, and cells per unit.
    corner: [f64; 2],
    per_unit: f64,
    /// The hits in the order in which they are found, each with the one before it on the same ray.
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

    /// The cells along an axis from one coordinate to another, clipped to those of the tile.
    fn cells(&self, axis: usize, [from, to]: [f64; 2]) -> Range<usize> {
        let cell = |x: f64| (x - self.corner[axis]) * self.per_unit;
        let end = self.tiles.cells;
        // Casts saturate at zero.
        cell(from - MARGIN) as usize..((cell(to + MARGIN) + 1.0) as usize).min(end)
    }

    /// Records the points that a triangle covers.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    const SIDE: i64 = 25;

    fn turn([a, b, c]: [LatticePoint; 3]) -> i64 {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum()
    }

    /// A mesh of 5 by 5 quads whose inner corners are displaced at random; each is cut in two, some along an edge.
    fn quads(rng: &mut Rng) -> Vec<[LatticePoint; 3]> {
        let inner = 1..5;
        let mut corner = |x: i64, y: i64| {
            let moves = inner.contains(&x) && inner.contains(&y);
            [x, y].map(|i| 5 * i + if moves { rng.below(4) as i64 } else { 0 })
        };
        let corners: Vec<Vec<_>> = (0..=5).map(|y| (0..=5).map(|x| corner(x, y)).collect()).collect();
        let quads = (0..5).flat_map(|y| (0..5).map(move |x| (x, y)));
        let halves = quads.flat_map(|(x, y): (usize, usize)| {
            let [a, b, c, d] = [corners[y][x], corners[y][x + 1], corners[y + 1][x + 1], corners[y + 1][x]];
            let mut cuts = [[[a, b, c], [a, c, d]], [[b, a, d], [d, c, b]]];
            cuts.rotate_left(rng.below(2) as usize);
            // One of the two cuts lies inside the quad.
            if cuts[0].map(turn).iter().product::<i64>() < 0 { cuts[1] } else { cuts[0] }
        });
        halves.collect()
    }

    #[test]
    fn a_mesh_has_every_point_once() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for _ in 0..300 {
            let triangles = quads(&mut rng);
            for point in (1..SIDE).flat_map(|y| (1..SIDE).map(move |x| [x, y])) {
                let hits = triangles.iter().filter_map(|t| ProjectedTriangle::new(*t)?.barycentrics(point)).count();
                assert_eq!(hits, 1, "{point:?}");
            }
        }
    }

    #[test]
    fn barycentrics_lead_back_to_the_point_at_any_size() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let mut inside = 0;
        for round in 0..20_000 {
            let size = [10, 1000, END as u64][round % 3];
            let mut place = || [rng.below(size) as i64, rng.below(size) as i64];
            let (corners, point) = ([place(), place(), place()], place());
            let Some([u, v]) = ProjectedTriangle::new(corners).and_then(|triangle| triangle.barycentrics(point)) else {
                continue;
            };
            inside += 1;
            assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 + 1e-15);
            for axis in 0..2 {
                let [a, b, c] = corners.map(|corner| corner[axis] as f64);
                assert!((a + u * (b - a) + v * (c - a) - point[axis] as f64).abs() < 1e-14 * size as f64 + 1e-12);
            }
        }
        assert!(inside > 1000, "{inside}");
    }

    #[test]
    fn the_extent_of_a_row_holds_all_its_points() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for _ in 0..2000 {
            let mut place = || [rng.below(SIDE as u64) as i64, rng.below(SIDE as u64) as i64];
            let corners = [place(), place(), place()];
            let Some(triangle) = ProjectedTriangle::new(corners) else { continue };
            let ([left, right], [bottom, top]) = (extent(&corners, 0), extent(&corners, 1));
            for y in bottom as i64..=top as i64 {
                let [low, high] = extent_between(&corners, y as f64 - 0.5, y as f64 + 0.5);
                assert!(left <= low && high <= right, "wider than the triangle");
                for x in (0..SIDE).filter(|&x| triangle.barycentrics([x, y]).is_some()) {
                    assert!((low - 1e-9..=high + 1e-9).contains(&(x as f64)));
                }
            }
        }
    }
}
