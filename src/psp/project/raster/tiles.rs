//! The pattern in square tiles, the units of work of the rasteriser, and their points in cells, row by row: those that a
//! triangle can cover in a row are neighbours in memory.

use crate::error::Result;
use crate::index::Binned;
use crate::index::Buckets;
use crate::job::{Job, chunks_of};

/// The side of the largest tile in radii: its points stay in the cache while triangles are drawn over them.
const LARGEST_TILE: f64 = 48.0;
/// Points per task.
const CHUNK: usize = 1 << 16;

/// The pattern's tiles, all of the same size.
pub(super) struct PatternTiles {
    /// The side of the pattern, in radii.
    pub side: f64,
    /// How many tiles the pattern has along each axis.
    pub count: i32,
    /// How many cells a tile has along each axis, none of them wider than a radius.
    pub cells: usize,
    /// Row by row.
    tiles: Vec<PatternTile>,
}

/// The points of a tile of the pattern by cells, row by row; in radii from the corner of the pattern.
pub(super) type PatternTile = Binned<[f32; 2]>;

impl PatternTiles {
    /// Sorts the points of a pattern of this side.
    pub fn new(job: &Job, side: f64, points: &[[f32; 2]]) -> Result<Self> {
        let count = (side / LARGEST_TILE).ceil();
        let tile_side = side / count;
        let cells = tile_side.ceil();
        let index = |x: f64, of: f64| x.min(of - 1.0) as usize;
        let chunks = chunks_of(points.len(), CHUNK);
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
