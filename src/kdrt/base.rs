//! A set of one radius in any order, and what the layers of others are filled around: a tiling or, where the domain is
//! too small for one, a set of [`maximal`](crate::maximal) that is made as a whole.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::kdrt::around::Around;
use crate::kdrt::output::capacity;
use crate::kdrt::tiling::Tiling;
use crate::maximal;
use crate::plane::CellAxis;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::points::Domain;

/// The share of the progress that making a tiling's pattern takes.
pub const PATTERN_SHARE: f64 = 0.05;

/// A set of one radius.
pub enum Base {
    /// Any part of it is made when it is asked for.
    Tiled(Box<Tiling>),
    /// All of it is made.
    Whole(Whole),
}

/// A set that is made as a whole.
pub struct Whole {
    lattice: Lattice,
    /// The rows of cells that the samples come in, from left to right in each.
    rows: CellAxis,
    samples: Vec<[f32; 2]>,
}

impl Base {
    /// The set of a lattice's radius.
    pub fn new(job: &Job, lattice: Lattice, leaf_size: f64, seed: u64, around: Arc<Around>) -> Result<Self> {
        if Tiling::is_worthwhile(&lattice, leaf_size) {
            return Ok(Self::Tiled(Box::new(Tiling::new(job, lattice, leaf_size, seed, around)?)));
        }
        let samples = maximal::sample_lattice_around(job, &lattice, seed, around.near(&lattice.rect()))?;
        Ok(Self::Whole(Whole { rows: CellAxis::new(lattice.size[1], lattice.radius), lattice, samples }))
    }

    /// All samples of [`Base::new`], of which nothing is kept.
    pub fn sample(
        job: &Job,
        lattice: &Lattice,
        leaf_size: f64,
        seed: u64,
        around: Arc<Around>,
    ) -> Result<Vec<[f32; 2]>> {
        let made = if Tiling::is_worthwhile(lattice, leaf_size) { PATTERN_SHARE } else { 1.0 };
        match Self::new(&job.part(0.0, made), lattice.clone(), leaf_size, seed, around)? {
            Self::Whole(whole) => Ok(whole.samples),
            tiled @ Self::Tiled(_) => tiled.whole(&job.part(made, 1.0)),
        }
    }

    /// All samples.
    pub fn whole(&self, job: &Job) -> Result<Vec<[f32; 2]>> {
        match self {
            Self::Tiled(tiling) => {
                let windows = tiling.windows();
                let expected = capacity(tiling.lattice().expected_samples());
                job.concat_about(expected, windows.len(), |i| tiling.window(&windows[i]))
            }
            Self::Whole(whole) => Ok(whole.samples.clone()),
        }
    }

    /// The samples in a part of the domain, in the order of [`Base::whole`].
    pub fn window(&self, job: &Job, window: &Domain) -> Result<Vec<[f32; 2]>> {
        match self {
            Self::Tiled(tiling) => tiling.part(job, window),
            Self::Whole(whole) => Ok(whole.window(window)),
        }
    }

    /// The samples in a rectangle of the domain, as lattice points.
    pub fn points(&self, job: &Job, rect: &Rect) -> Result<Vec<[i32; 2]>> {
        match self {
            Self::Tiled(tiling) => tiling.points(job, rect),
            Self::Whole(Whole { lattice, samples, .. }) => {
                let points = samples.iter().map(|&sample| lattice.point(sample));
                Ok(points.filter(|&point| rect.contains(point)).collect())
            }
        }
    }

    /// Hands all samples to `visit`, part by part.
    pub fn stream(&self, job: &Job, mut visit: impl FnMut(&[[f32; 2]]) -> ControlFlow<()>) -> Result<()> {
        let mut visit = |samples: &[[f32; 2]]| {
            if samples.is_empty() || visit(samples).is_continue() { Ok(()) } else { Err(Error::Cancelled) }
        };
        match self {
            Self::Tiled(tiling) => {
                let windows = tiling.windows();
                job.stream(windows.len(), |i| tiling.window(&windows[i]), |samples| visit(&samples))
            }
            Self::Whole(whole) => visit(&whole.samples),
        }
    }

    /// The number of samples that are still to be made for a rectangle, about.
    pub fn expected(&self, rect: &Rect) -> f64 {
        match self {
            Self::Tiled(tiling) => tiling.expected(rect),
            Self::Whole(_) => 0.0,
        }
    }
}

impl Whole {
    /// The samples in a part of the domain: in O(log n) for each row and O(1) for each sample.
    fn window(&self, window: &Domain) -> Vec<[f32; 2]> {
        let points = self.lattice.points_in(window);
        let mut inside = Vec::new();
        if points.is_empty() {
            return inside;
        }
        let row_of = |sample: [f32; 2]| self.rows.cell(self.lattice.point(sample)[1]);
        for row in self.rows.cell(points.min[1])..=self.rows.cell(points.max[1] - 1) {
            let is_before = |&sample: &[f32; 2]| (row_of(sample), f64::from(sample[0])) < (row, window.min[0]);
            let rest = &self.samples[self.samples.partition_point(is_before)..];
            let run = rest.iter().take_while(|sample| f64::from(sample[0]) < window.max[0] && row_of(**sample) == row);
            inside.extend(run.filter(|sample| window.contains(**sample)));
        }
        inside
    }
}
