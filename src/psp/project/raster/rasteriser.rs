//! The rasteriser: sorts the triangles by the tiles of the projectors that they come near, then draws tile by tile.

use crate::error::Result;
use crate::index::Buckets;
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::psp::project::collector::{Collector, Found};
use crate::psp::project::pattern;
use crate::psp::project::projector::Projector;
use crate::psp::project::raster::drawing::Drawing;
use crate::psp::project::raster::lattice::{MARGIN, ProjectorLattice, extent, extent_between};
use crate::psp::project::raster::tiles::PatternTiles;

/// Triangles per task.
const CHUNK: usize = 1024;

/// The pattern, and how a mesh is seen on a projector.
pub(in crate::psp) struct Rasteriser {
    tiles: PatternTiles,
    lattice: ProjectorLattice,
}

/// A tile on a projector: the number of the projector, the row, the column. Tiles repeat the pattern without end.
type TileKey = [i32; 3];

/// The triangles that are near each tile.
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

    /// Draws the mesh over three projectors and collects all hits. As rays count the points of tiles near triangles.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Found> {
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
        let chunks = chunks_of(mesh.triangles().len(), CHUNK);
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

/// The integer below; or one lower, for integers below zero, which `MARGIN` allows for.
fn floor(x: f64) -> i32 {
    x as i32 - i32::from(x < 0.0)
}
