//! The density on a grid of the domain, and the local spacing that follows from it.
//!
//! The spacing at a position is 1 / sqrt(density) in units of that of the mean density, but no more than [`SLOPE`]
//! times a distance above that at any other position (as sizes of mesh elements are graded: Persson 2006, "Mesh size
//! functions for implicit geometries and PDE-based mesh generation"). So it is finite where no points are wanted, and a
//! point that has strayed there gives way to those at the edge instead of clearing its surroundings.

use glam::Vec2;

use crate::dcr::density::{Density, is_density};
use crate::dcr::torus::{Field, HALF, LONG_WAVES, TURN, Torus, TorusPoint, WaveGrid};
use crate::error::{Error, Result};
use crate::index::Weights;
use crate::job::{Job, chunks, chunks_of};
use crate::math::{log2, scalbn};
use crate::memory;
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng};

/// The largest growth of the spacing per distance; 1 leaves three times the error of tone beside edges, as does 0.25.
const SLOPE: f32 = 0.5;

/// The least and the largest number of cells per distance of points; in between a cell is a pixel.
const FINENESS: [f64; 2] = [4.0, 8.0];

/// Memory for a cell at the peak, when points are thrown by the weights of all cells.
const BYTES_PER_CELL: f64 = 24.2;

/// The least number of cells along an axis: even a few points must find the dark parts of an image.
const FEWEST: usize = 64;

/// A grid over the domain.
pub struct Raster {
    domain: Domain,
    /// Columns and rows.
    cells: [usize; 2],
    /// The density in units of the mean, row by row.
    density: Vec<f32>,
    /// The spacing in units of the torus, where its distance is the hexagonal one.
    spacing: Vec<f32>,
}

impl Raster {
    /// Samples a density that has been checked, for `count` points of a domain, which are asked for by an argument and
    /// will take so many bytes each. Refuses more than memory holds.
    pub fn new(
        job: &Job,
        domain: &Domain,
        density: &Density,
        count: usize,
        (argument, bytes): (&'static str, f64),
    ) -> Result<Self> {
        let torus = Torus::new(*domain, count.max(1));
        let extent = domain.extent().map(|length| length / torus.frame.spacing());
        let pixels = match *density {
            Density::Image { width, height, .. } => [width, height],
            Density::Function(_) => extent.map(|length| (FINENESS[1] * length) as usize),
        };
        let cells = [0, 1].map(|axis| {
            // A strip that is thinner than the distance of its points has no more cells than points need.
            let limit = 8 * (count + 8);
            let [least, most] = FINENESS.map(|fineness| (fineness * extent[axis]).ceil().min(limit as f64) as usize);
            pixels[axis].clamp(least, most).max(FEWEST)
        });
        let bytes = BYTES_PER_CELL * cells[0] as f64 * cells[1] as f64 + bytes * count as f64;
        memory::require(bytes, argument, &format!("{count} points of a density"))?;
        let mut raster = Self { domain: *domain, cells, density: Vec::new(), spacing: Vec::new() };
        raster.density = raster.sample(job, density, pixels)?;
        let sum: f64 = raster.density.iter().map(|&density| f64::from(density)).sum();
        if sum == 0.0 {
            return Err(Error::invalid("density", "is 0 everywhere"));
        }
        let mean = sum / raster.density.len() as f64;
        raster.density.iter_mut().for_each(|density| *density = (f64::from(*density) / mean) as f32);
        raster.spacing = raster.density.iter().map(|density| density.sqrt().recip()).collect();
        let cell = [0, 1].map(|axis| (extent[axis] / cells[axis] as f64) as f32);
        raster.limit_slope(SLOPE * Vec2::from_array(cell));
        Ok(raster)
    }

    /// The means of the density over the cells.
    fn sample(&self, job: &Job, density: &Density, pixels: [usize; 2]) -> Result<Vec<f32>> {
        let parts = match density {
            Density::Image { .. } => [0, 1].map(|axis| pixels[axis].div_ceil(self.cells[axis])),
            Density::Function(_) => [2; 2],
        };
        let rows = chunks_of(self.cells[1], 1 + 4096 / self.cells[0]);
        let sampled = job.map(rows.len(), |chunk| {
            let cells = rows.range(chunk).flat_map(|row| (0..self.cells[0]).map(move |column| [column, row]));
            cells.map(|cell| self.mean(density, cell, parts)).collect::<Result<Vec<f32>>>()
        })?;
        Ok(sampled.into_iter().collect::<Result<Vec<_>>>()?.concat())
    }

    /// The mean of the density over the parts of a cell.
    fn mean(&self, density: &Density, cell: [usize; 2], parts: [usize; 2]) -> Result<f32> {
        let share = |axis: usize, part: usize| {
            let index = (cell[axis] * parts[axis] + part) as f64 + 0.5;
            index / (self.cells[axis] * parts[axis]) as f64
        };
        let mut sum = 0.0;
        for part in (0..parts[0] * parts[1]).map(|part| [part % parts[0], part / parts[0]]) {
            sum += self.at_share(density, [share(0, part[0]), share(1, part[1])])?;
        }
        Ok((sum / (parts[0] * parts[1]) as f64) as f32)
    }

    /// The density at a fraction of the width and of the height.
    fn at_share(&self, density: &Density, share: [f64; 2]) -> Result<f64> {
        match *density {
            Density::Image { values, width, height } => {
                let sizes = [width, height];
                let [x, y] = [0, 1].map(|axis| Between::of(share[axis], sizes[axis], self.domain.boundary));
                let at = |column: usize, row: usize| f64::from(values[row * width + column]);
                let along = |row: usize| (1.0 - x.share) * at(x.first, row) + x.share * at(x.second, row);
                Ok((1.0 - y.share) * along(y.first) + y.share * along(y.second))
            }
            Density::Function(at) => {
                let extent = self.domain.extent();
                let position = [0, 1].map(|axis| self.domain.min[axis] + share[axis] * extent[axis]);
                let value = at(position);
                if !is_density(value) {
                    let reason = format!("{value:?} at {position:?} is not 0 or above and finite");
                    return Err(Error::invalid("density", reason));
                }
                Ok(value)
            }
        }
    }

    /// Lowers every spacing to the value that its neighbours allow, which are a `step` away along each axis: two passes
    /// over the grid, as in distance transforms (Rosenfeld and Pfaltz 1966), and two more across the seam of a torus.
    fn limit_slope(&mut self, step: Vec2) {
        let [columns, rows] = self.cells;
        let wraps = self.domain.boundary == Boundary::Periodic;
        let before: [([usize; 2], f32); 4] = [
            ([columns - 1, 0], step.x),
            ([0, rows - 1], step.y),
            ([columns - 1, rows - 1], step.length()),
            ([1, rows - 1], step.length()),
        ];
        let mut lower = |[column, row]: [usize; 2], is_turned: bool| {
            for ([right, up], length) in before {
                let by = if is_turned { [columns - right, rows - up] } else { [right, up] };
                let other = [(column + by[0]) % columns, (row + by[1]) % rows];
                let is_near = column.abs_diff(other[0]) <= 1 && row.abs_diff(other[1]) <= 1;
                if wraps || is_near {
                    let bound = self.spacing[other[1] * columns + other[0]] + length;
                    let spacing = &mut self.spacing[row * columns + column];
                    *spacing = spacing.min(bound);
                }
            }
        };
        let cells = || (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
        for _ in 0..if wraps { 2 } else { 1 } {
            cells().for_each(|cell| lower(cell, false));
            cells().rev().for_each(|cell| lower(cell, true));
        }
    }

    /// The local spacing at a point.
    pub fn spacing(&self, place: TorusPoint) -> f32 {
        self.interpolate(&self.spacing, place)
    }

    /// The density at a point, in units of the mean.
    pub fn density(&self, place: TorusPoint) -> f32 {
        self.interpolate(&self.density, place)
    }

    /// The position to which a point of the domain returns from where the density is 0. The spacing grows from the cells
    /// that have a density on, so its steepest descent ends in one of them; the position is the nearest of that cell.
    pub fn wanted_near(&self, place: TorusPoint) -> Option<TorusPoint> {
        if self.density(place) > 0.0 {
            return None;
        }
        let wraps = self.domain.boundary == Boundary::Periodic;
        let (shares, sizes) = ([0, 1].map(|axis| self.share(place[axis])), self.cells.map(|count| count as i64));
        let index =
            |[column, row]: [i64; 2]| (row.rem_euclid(sizes[1]) * sizes[0] + column.rem_euclid(sizes[0])) as usize;
        let is_inside = |cell: [i64; 2]| wraps || (0..2).all(|axis| (0..sizes[axis]).contains(&cell[axis]));
        // Beyond the seam of a torus the cells count on, so that the way back is the shorter one.
        let mut cell = [0, 1].map(|axis| (shares[axis] * sizes[axis] as f64) as i64);
        while self.density[index(cell)] == 0.0 {
            let around = (-1..=1).flat_map(|up| (-1..=1).map(move |right| [right, up]));
            let around = around.map(|by| [cell[0] + by[0], cell[1] + by[1]]).filter(|&cell| is_inside(cell));
            let lower = around.min_by(|&a, &b| self.spacing[index(a)].total_cmp(&self.spacing[index(b)]));
            match lower {
                Some(lower) if self.spacing[index(lower)] < self.spacing[index(cell)] => cell = lower,
                _ => return None,
            }
        }
        let nearest = [0, 1].map(|axis| {
            let [low, high] = [0, 1].map(|end| (cell[axis] + end) as f64 / sizes[axis] as f64);
            shares[axis].clamp(low, high)
        });
        Some(self.place(nearest.map(|share| if wraps { share.rem_euclid(1.0) } else { share })))
    }

    /// The fraction of the width or of the height at a coordinate of the torus.
    fn share(&self, coordinate: u32) -> f64 {
        match self.domain.boundary {
            Boundary::Periodic => f64::from(coordinate) / TURN,
            Boundary::Bounded => f64::from(coordinate.min(coordinate.wrapping_neg())) / f64::from(HALF),
        }
    }

    fn interpolate(&self, values: &[f32], place: TorusPoint) -> f32 {
        let [x, y] = [0, 1].map(|axis| Between::of(self.share(place[axis]), self.cells[axis], self.domain.boundary));
        let along = |row: usize| {
            let at = |column: usize| f64::from(values[row * self.cells[0] + column]);
            (1.0 - x.share) * at(x.first) + x.share * at(x.second)
        };
        ((1.0 - y.share) * along(y.first) + y.share * along(y.second)) as f32
    }

    /// The smallest and the largest spacing.
    pub fn range(&self) -> [f32; 2] {
        let range = [f32::INFINITY, 0.0];
        self.spacing.iter().fold(range, |[low, high], &spacing| [low.min(spacing), high.max(spacing)])
    }

    /// The density as weighted points, whose weights sum up to `total`: one for each block of cells no wider than
    /// `width`.
    pub fn weights(&self, torus: &Torus, width: f64, total: f64) -> Vec<(TorusPoint, f64)> {
        let extent = self.domain.extent().map(|length| length / torus.frame.spacing());
        let block = [0, 1].map(|axis| ((width * self.cells[axis] as f64 / extent[axis]) as usize).max(1));
        let unit = total / self.density.len() as f64;
        let starts = |axis: usize| (0..self.cells[axis]).step_by(block[axis]);
        let mut weights = Vec::new();
        for (row, column) in starts(1).flat_map(|row| starts(0).map(move |column| (row, column))) {
            let ends = [(column + block[0]).min(self.cells[0]), (row + block[1]).min(self.cells[1])];
            let rows = (row..ends[1]).map(|row| &self.density[row * self.cells[0]..][column..ends[0]]);
            let sum: f64 = rows.flatten().map(|&density| f64::from(density)).sum();
            let middle = |axis: usize, start: usize| 0.5 * (start + ends[axis]) as f64 / self.cells[axis] as f64;
            weights.push((self.place([middle(0, column), middle(1, row)]), sum * unit));
        }
        weights
    }

    /// Random points with this density.
    pub fn scatter(&self, torus: &Torus, count: usize, seed: u64) -> Vec<[f32; 2]> {
        let weights = Weights::new(self.density.iter().map(|&density| density.into()).collect());
        let point = |index: u64| {
            let mut rng = Rng::at(seed, Draw::Scatter, &[index]);
            let cell = weights.pick(&mut rng) as usize;
            let cell = [cell % self.cells[0], cell / self.cells[0]];
            let share = [0, 1].map(|axis| (cell[axis] as f64 + rng.unit()) / self.cells[axis] as f64);
            torus.leave(self.place(share))
        };
        (0..count as u64).map(point).collect()
    }

    /// The point on the torus at a fraction of the width and of the height.
    pub fn place(&self, share: [f64; 2]) -> TorusPoint {
        let period = match self.domain.boundary {
            Boundary::Periodic => TURN,
            Boundary::Bounded => f64::from(HALF),
        };
        share.map(|share| (share * period) as u64 as u32)
    }
}

/// Two neighbouring cells of a row, and a position between their centres.
struct Between {
    first: usize,
    second: usize,
    /// The distance from the first centre, in cells.
    share: f64,
}

impl Between {
    /// The cells around a fraction of the length of a row; at its ends one cell, or the one beyond the seam.
    fn of(share: f64, count: usize, boundary: Boundary) -> Self {
        let place = share * count as f64 - 0.5;
        let first = place.floor();
        let cell = |index: f64| match boundary {
            Boundary::Periodic => index.rem_euclid(count as f64) as usize % count,
            Boundary::Bounded => index.clamp(0.0, (count - 1) as f64) as usize,
        };
        Self { first: cell(first), second: cell(first + 1.0), share: place - first }
    }
}

// Removes long waves of the excess over the density, where "long" depends on the position.
//
// As in `torus/waves.rs`, the points are drawn on a grid, but so is the density; the difference drives a flow whose
// divergence it is, and the displacement of a point is the flow over the local density. A wave is long if it has four
// local spacings or more. So there is a grid for each octave of the spacing, with the waves that are long there, and a
// point reads the two that its own spacing is between. The denser the points, the shorter are the waves removed.

/// The finest grid has at most the square of this times the nodes of that for a constant density.
const FINEST: f64 = 3.0;

/// The distance of nodes over that of the weights by which the density is drawn.
const WEIGHTS: f64 = 2.0;

/// The spacing of the points that a grid is made for, over that of its octave: three nodes per wavelength of the
/// shortest waves are enough.
const NODES: f64 = 1.4;

/// The grids, from fine to coarse.
pub struct OctaveGrids {
    grids: Vec<OctaveGrid>,
    /// The spacing of the first octave.
    finest: f64,
}

struct OctaveGrid {
    spacing: f64,
    waves: WaveGrid,
    wanted: Field,
}

impl OctaveGrids {
    /// The grids for `count` points.
    pub fn new(job: &Job, torus: &Torus, raster: &Raster, count: usize) -> Result<Self> {
        let [least, largest] = raster.range().map(f64::from);
        let finest = least.max(1.0 / FINEST);
        // Beyond the size of the torus there are no waves.
        let largest = largest.min(torus.frame.size().max_element());
        let octaves = log2((largest / finest).max(1.0)).ceil() as usize;
        let mut grids = Vec::new();
        for octave in 0..=octaves {
            let spacing = finest * scalbn(1.0, octave as i32);
            let waves = WaveGrid::of_spacing(torus, count, NODES * spacing);
            let weights = raster.weights(torus, spacing / WEIGHTS, count as f64);
            let (places, weights): (Vec<TorusPoint>, Vec<f64>) = weights.into_iter().unzip();
            let places = torus.with_images(&places);
            let share = |octave: usize| octave as f64 / (octaves + 1) as f64;
            let weighted = |index: usize| (places[index], weights[index % weights.len()] as f32);
            let wanted = waves.draw(&job.part(share(octave), share(octave + 1)), places.len(), weighted)?;
            grids.push(OctaveGrid { spacing, wanted, waves });
        }
        Ok(Self { grids, finest })
    }

    /// The displacements, in spacings of the torus, of the first points of `places`: those whose local spacings are
    /// given.
    pub fn drift(&self, job: &Job, places: &[TorusPoint], spacings: &[f32]) -> Result<Vec<Vec2>> {
        let count = self.grids.len() as f64;
        let mut fields = Vec::new();
        for (index, grid) in self.grids.iter().enumerate() {
            let share = |index: usize| 0.9 * index as f64 / count;
            fields.push(grid.flow(&job.part(share(index), share(index + 1)), places)?);
        }
        let chunks = chunks(spacings.len());
        job.part(0.9, 1.0).concat(chunks.len(), |chunk| {
            chunks.range(chunk).map(|point| self.read(&fields, places[point], spacings[point])).collect()
        })
    }

    fn read(&self, fields: &[Field], place: TorusPoint, spacing: f32) -> Vec2 {
        let octave = log2(f64::from(spacing) / self.finest).clamp(0.0, (self.grids.len() - 1) as f64);
        let (fine, share) = (octave as usize, octave.fract() as f32);
        let coarse = (fine + 1).min(self.grids.len() - 1);
        let at = |octave: usize| self.grids[octave].waves.read(&fields[octave], place);
        let flow = if share == 0.0 { at(fine) } else { (1.0 - share) * at(fine) + share * at(coarse) };
        spacing * spacing * flow
    }
}

impl OctaveGrid {
    /// The flow that moves points to where they are wanted, over the mean density.
    fn flow(&self, job: &Job, places: &[TorusPoint]) -> Result<Field> {
        let mut excess = self.waves.draw(&job.part(0.0, 0.2), places.len(), |point| (places[point], 1.0))?;
        excess.iter_mut().zip(&self.wanted).for_each(|(excess, wanted)| *excess -= wanted);
        self.waves.displacements(&job.part(0.2, 1.0), excess, places.len(), LONG_WAVES / self.spacing)
    }
}
