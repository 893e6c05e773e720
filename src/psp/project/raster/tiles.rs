//! The pattern in square tiles, the units of work of the rasteriser, and their points in cells, row by row: those that a
//! triangle can cover in a row are neighbours in memory.

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::psp::blocks::Groups;

/// The side of the largest tile in radii: its points stay in the cache while triangles are drawn over them.
const LARGEST_TILE: f64 = 48.0;
/// Points per task.
const CHUNK: usize = 1 << 16;

/// The pattern's tiles, all of the same size.
pub(super) struct Tiles {
    /// The side of the pattern, in radii.
    pub side: f64,
    /// How many tiles the pattern has along each axis.
    pub count: i32,
    /// How many cells a tile has along each axis, none of them wider than a radius.
    pub cells: usize,
    /// Row by row.
    tiles: Vec<Tile>,
}

/// A tile of the pattern.
#[derive(Default)]
pub(super) struct Tile {
    /// Sorted by cells, row by row; in radii from the corner of the pattern.
    pub points: Vec<[f32; 2]>,
    /// Where the points of each cell begin, and where those of the last one end.
    pub starts: Vec<u16>,
}

impl Tiles {
    /// Sorts the points of a pattern of this side.
    pub fn new(job: &Job, side: f64, points: &[[f32; 2]]) -> Result<Self> {
        let count = (side / LARGEST_TILE).ceil();
        let tile_side = side / count;
        let cells = tile_side.ceil();
        let number = |x: f64, of: f64| x.min(of - 1.0) as usize;
        let chunks = chunks_of(points.len(), CHUNK);
        let (parts, _) = Groups::collect(&job.part(0.0, 0.5), chunks.len(), |chunk, add| {
            for point in &points[chunks.range(chunk)] {
                let [column, row] = point.map(|x| number(f64::from(x) / tile_side, count));
                add(row * count as usize + column, *point);
            }
        })?;
        let sorted = job.part(0.5, 1.0).map(parts.len(), |part| {
            let place = parts.place(part);
            let corner = [place % count as usize, place / count as usize].map(|tile| tile as f64 * tile_side);
            let cell = |point: &[f32; 2]| {
                let [column, row] = [0, 1]
                    .map(|axis| number((f64::from(point[axis]) - corner[axis]).max(0.0) / tile_side * cells, cells));
                row * cells as usize + column
            };
            let points: Vec<_> = parts.items(part).copied().collect();
            (place, Tile::new(&points, cells as usize * cells as usize, cell))
        })?;
        let mut tiles: Vec<_> = (0..(count * count) as usize).map(|_| Tile::default()).collect();
        sorted.into_iter().for_each(|(place, tile)| tiles[place] = tile);
        Ok(Self { side, count: count as i32, cells: cells as usize, tiles })
    }

    /// The tile in a column and row of the pattern, which repeats.
    pub fn get(&self, column: i32, row: i32) -> &Tile {
        let [column, row] = [column, row].map(|x| x.rem_euclid(self.count));
        &self.tiles[(row * self.count + column) as usize]
    }
}

impl Tile {
    /// Sorts points by their cells, of which there are so many.
    fn new(points: &[[f32; 2]], cells: usize, cell: impl Fn(&[f32; 2]) -> usize) -> Self {
        let mut starts = vec![0; cells + 1];
        points.iter().for_each(|point| starts[cell(point) + 1] += 1);
        (0..cells).for_each(|cell| starts[cell + 1] += starts[cell]);
        let (mut next, mut sorted) = (starts.clone(), vec![[0.0; 2]; points.len()]);
        for point in points {
            let place = &mut next[cell(point)];
            sorted[usize::from(*place)] = *point;
            *place += 1;
        }
        Self { points: sorted, starts }
    }
}
