//! The filling of gaps in sets of the plane that are edited: tile by tile, each around all that stands near it (not in
//! the thesis).
//!
//! In a tile the flat quadtree (`plane/quadtree.rs`) begins at the cells that an edit may have opened, in a grid of cells
//! that holds what stands in the tile and around it. Tiles are filled in four phases, by the parity of their column and
//! row: those of one phase are too far apart to act on each other.

use std::collections::HashMap;

use crate::editable::Edit;
use crate::error::Result;
use crate::given::Given;
use crate::job::Job;
use crate::kdrt::tiles::{Tile, Tiles};
use crate::plane::{CellAxis, CellGrid, Disk, GivenDisks, Lattice, Quadtree};
use crate::points::Domain;
use crate::region::Region;
use crate::rng::{Draw, Rng};

/// The parities of columns and rows that are filled one after the other.
const PHASES: [[i32; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// A rectangle of the plane as the ground of a set.
pub struct InPlane {
    pub(crate) tiles: Tiles,
    pub(crate) radius: f64,
}

impl InPlane {
    /// A domain with its lattice, which has the radius in its units.
    pub(crate) fn new(domain: Domain, lattice: Lattice, radius: f64) -> Self {
        Self { tiles: Tiles::new(domain, lattice), radius }
    }

    /// The lattice point of a sample, if it is one.
    pub(crate) fn point(&self, sample: [f32; 2]) -> Option<[i32; 2]> {
        let lattice = &self.tiles.lattice;
        let point = lattice.point(sample);
        (lattice.rect().contains(point) && lattice.position(point) == sample).then_some(point)
    }

    /// The samples that are missing in the regions of an edit.
    pub(crate) fn fill(&self, job: &Job, edit: &Edit<2, [f32; 2], Tile>) -> Result<Vec<[f32; 2]>> {
        let mut touched: HashMap<Tile, Vec<&Region>> = HashMap::new();
        for region in edit.regions {
            self.tiles.touched_by(region).into_iter().for_each(|tile| touched.entry(tile).or_default().push(region));
        }
        let mut touched: Vec<_> = touched.into_iter().collect();
        touched.sort_unstable_by_key(|&([x, y], _)| [y, x]);
        let (disks, mut filled, mut samples) = (self.disks(edit), HashMap::new(), Vec::new());
        for (phase, parity) in (0..).zip(PHASES) {
            let (tiles, others) = touched.into_iter().partition(|(tile, _)| tile.map(|index| index & 1) == parity);
            touched = others;
            let tiles: Vec<(Tile, Vec<&Region>)> = tiles;
            let job = job.part(0.25 * f64::from(phase), 0.25 * f64::from(phase + 1));
            let found = job.map(tiles.len(), |index| self.fill_tile(edit, &disks, &filled, &tiles[index]))?;
            for ((tile, _), found) in tiles.into_iter().zip(found) {
                samples.extend(found.iter().map(|&point| self.tiles.lattice.position(point)));
                filled.insert(tile, found);
            }
        }
        Ok(samples)
    }

    /// The given samples whose disks can reach the regions of an edit.
    fn disks(&self, edit: &Edit<2, [f32; 2], Tile>) -> GivenDisks {
        let span = |axis: usize| {
            let ends = edit.regions.iter().map(|region| {
                let (min, max, radius) = (region.min[axis], region.max[axis], region.radius);
                let ball = [region.centre[axis] - radius, region.centre[axis] + radius];
                // On a torus the two need not meet, but in their images.
                if max - min < 2.0 * radius { [min, max] } else { ball }
            });
            ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
        };
        let spans = [span(0), span(1)];
        // Cells that a region touches reach up to a radius beyond it.
        let is_near = |position: [f32; 2], clearance: f64| {
            let reach = 1.1 * clearance + self.radius;
            (0..2).all(|axis| self.tiles.gap(axis, f64::from(position[axis]), spans[axis]) <= reach)
        };
        let near = edit.given.iter().filter(|given| is_near(given.position, given.clearance));
        let (positions, clearances): (Vec<_>, Vec<_>) = near.map(|given| (given.position, given.clearance)).unzip();
        GivenDisks::new(
            &self.tiles.domain,
            &self.tiles.lattice,
            self.radius,
            &Given::with_clearances(&positions, &clearances),
        )
    }

    /// The lattice points at which samples are missing in the cells of a tile that some regions touch.
    fn fill_tile(
        &self,
        edit: &Edit<2, [f32; 2], Tile>,
        disks: &GivenDisks,
        filled: &HashMap<Tile, Vec<[i32; 2]>>,
        (tile, regions): &(Tile, Vec<&Region>),
    ) -> Vec<[i32; 2]> {
        let Tiles { domain, lattice, .. } = &self.tiles;
        let (rect, size, reach) = (self.tiles.rect(*tile), lattice.size, lattice.separation.reach);
        let wraps = self.tiles.wraps();
        let mut window = rect.grown(reach);
        for axis in 0..2 {
            if wraps[axis] || !self.tiles.is_periodic() {
                (window.min[axis], window.max[axis]) = (window.min[axis].max(0), window.max[axis].min(size[axis]));
            }
        }
        let (mut points, mut obstacles) = (Vec::new(), disks.near(&rect));
        for (other, shift) in self.tiles.around(*tile) {
            let shifted = |point: [i32; 2]| [point[0] + shift[0], point[1] + shift[1]];
            for own in edit.standing.in_bins([other]) {
                if let Some(point) = self.point(own.sample) {
                    points.extend(Some(shifted(point)).filter(|&point| window.contains(point)));
                } else {
                    let disk = Disk::around(domain, lattice, own.sample, self.radius);
                    let centre = [0, 1].map(|axis| disk.centre[axis] + f64::from(shift[axis]));
                    obstacles.extend(Some(Disk { centre, ..disk }).filter(|disk| disk.meets(&rect)));
                }
            }
            let new = filled.get(&other).into_iter().flatten().map(|&point| shifted(point));
            points.extend(new.filter(|&point| window.contains(point)));
        }

        let axes = size.map(|size| CellAxis::new(size, lattice.radius));
        let mut grid = CellGrid::wrapping(&axes, &window, wraps, lattice.separation);
        grid.set_obstacles(obstacles);
        points.into_iter().for_each(|point| grid.insert(grid.cell(point), point));
        let cells = grid.cells_of(&rect);
        let cells = (cells.min[1]..cells.max[1]).flat_map(|y| (cells.min[0]..cells.max[0]).map(move |x| [x, y]));
        let is_open = |&cell: &[i32; 2]| {
            let part = grid.rect(cell).intersection(&rect);
            let corners = [part.min, part.max.map(|x| x - 1)].map(|corner| lattice.position(corner));
            grid.sample(cell).is_none() && regions.iter().any(|region| self.tiles.touches(region, corners))
        };
        let mut quadtree = Quadtree::new(&grid, rect, cells.filter(is_open));
        let mut rng = Rng::at(edit.seed, Draw::Edit, &tile.map(|index| index as u64));
        let mut found = Vec::new();
        quadtree.fill(&mut grid, &mut rng, |_, sample| found.push(sample));
        found
    }
}
