//! Removes long waves of the excess over the density, where "long" depends on the position.
//!
//! As in `ground/waves.rs`, the points are drawn on a grid, but so is the density; the difference drives a flow whose
//! divergence it is, and the displacement of a point is the flow over the local density. A wave is long if it has four
//! local spacings or more. So there is a grid for each octave of the spacing, with the waves that are long there, and a
//! point reads the two that its own spacing is between. The denser the points, the shorter are the waves removed.

use glam::Vec2;

use crate::dcr::density::raster::Raster;
use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::ground::waves::{Field, LONG_WAVES, WaveGrid};
use crate::error::Result;
use crate::job::{Job, chunks};
use crate::math::{log2, scalbn};

/// The finest grid has at most the square of this times the nodes of that for a constant density.
const FINEST: f64 = 3.0;

/// The distance of nodes over that of the weights by which the density is drawn.
const WEIGHTS: f64 = 2.0;

/// The spacing of the points that a grid is made for, over that of its octave: three nodes per wavelength of the
/// shortest waves are enough.
const NODES: f64 = 1.4;

/// The grids, from fine to coarse.
pub(super) struct OctaveGrids {
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
    pub(super) fn new(job: &Job, torus: &Torus, raster: &Raster, count: usize) -> Result<Self> {
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
    pub(super) fn drift(&self, job: &Job, places: &[TorusPoint], spacings: &[f32]) -> Result<Vec<Vec2>> {
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
