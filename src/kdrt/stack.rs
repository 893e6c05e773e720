//! Stacks of layers: sets that are made one after the other, each filled around those before.
//!
//! The levels of a progressive order (`progressive.rs`) are layers, and so are the groups of classes (`classes/`). All
//! lie on one lattice. A part of a layer depends on the layers before in a part that is larger by a margin. So a part
//! of the plane is made in two passes: from the last layer to the first to find the part of each that is needed, then
//! from the first to the last.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::kdrt::{
    cache::Cache,
    region::{Part, Placed, TiledSamples},
    tiling::Tiling,
};
use crate::plane::{CellAxis, GivenDisks, Lattice, Rect};
use crate::points::Domain;
use crate::{maximal, memory};

pub use crate::kdrt::cache::Cached;

/// The most bytes that a sample takes: in the result and in the windows being made.
pub const BYTES_PER_SAMPLE: f64 = 9.5;

/// The most bytes that a given sample takes: the disks of all images, by tiles.
const BYTES_PER_GIVEN: f64 = 70.0;

/// Refuses samples that do not fit in memory beside `given` ones. `argument` is the one that asks for them.
pub fn require(samples: f64, bytes_per_sample: f64, given: usize, argument: &'static str) -> Result<()> {
    let bytes = samples * bytes_per_sample + given as f64 * BYTES_PER_GIVEN;
    memory::require(bytes, argument, &format!("about {samples:.0} samples"))
}

/// The speed of tiling relative to that of filling a layer.
const TILING_SPEED: f64 = 10.0;

/// A layer, which can be filled in any part of the plane.
pub trait Layer: Cached {
    type Sample: Placed;

    /// True if a retained plane stores all samples of this layer and of those before.
    fn is_kept(&self) -> bool;

    /// An approximate upper bound of the number of samples in a part after this layer: the cost of making them.
    fn expected(&self, part: &Part) -> f64;

    /// The part of the layers before that decides which samples there are in a part.
    fn around(&self, part: &Part) -> Part;

    /// The samples of the layers before, sorted for this one.
    fn sorted(&self, part: Part, before: &[Self::Sample]) -> TiledSamples<Self::Sample>;

    /// The samples of this layer in a part, around those of the layers before in [`Layer::around`] it.
    fn fill(&self, job: &Job, before: &TiledSamples<Self::Sample>, part: &Part) -> Result<Vec<Self::Sample>>;
}

/// The layers of a plane, of which any part can be made.
pub struct Stack<L: Layer> {
    lattice: Lattice,
    /// The samples that the first layer is filled around, if there are any, with their attributes.
    base: Option<(Base, L::Sample)>,
    layers: Vec<L>,
    /// The number of layers that are kept, and the samples up to the last of them.
    kept: Option<(usize, TiledSamples<L::Sample>)>,
    /// The parts of the other layers that windows have filled, if the stack is kept.
    cache: Option<Cache<L::Sample>>,
}

/// The rectangle of a layer that a part asks for.
struct Step<S> {
    part: Part,
    /// The samples of the layer in the part that were made before.
    found: Vec<S>,
    /// The part of the layer that is to be made, and the rectangle of it, perhaps on other images, that is wanted.
    missing: Option<(Part, Rect)>,
    /// The part of the layers before that is needed.
    before: Part,
}

impl<L: Layer> Stack<L> {
    /// Layers around the samples of a base, all of which have the attributes of the given one.
    pub fn new(lattice: Lattice, base: Option<(Base, L::Sample)>, layers: Vec<L>) -> Self {
        Self { lattice, base, layers, kept: None, cache: None }
    }

    /// The lattice of all layers.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The layers, for tests of their vectors.
    #[cfg(test)]
    pub fn layers_mut(&mut self) -> &mut [L] {
        &mut self.layers
    }

    /// Makes, for all windows, the layers that are stored as a whole.
    pub fn keep(&mut self, job: &Job) -> Result<()> {
        if let Some(last) = self.layers.iter().rposition(Layer::is_kept) {
            let whole = Part::whole(&self.lattice);
            let samples = self.up_to(job, last + 1, &whole, None)?;
            self.kept = Some((last + 1, self.layers[last].sorted(whole, &samples)));
        }
        self.cache = Some(Cache::new());
        Ok(())
    }

    /// All samples.
    pub fn whole(&self, job: &Job) -> Result<Vec<L::Sample>> {
        self.up_to(job, self.layers.len(), &Part::whole(&self.lattice), None)
    }

    /// The samples in a window of the domain.
    pub fn window(&self, job: &Job, window: &Domain) -> Result<Vec<L::Sample>> {
        let mut samples = self.points(job, &self.lattice.points_in(window))?;
        samples.retain(|sample| window.contains(self.lattice.position(sample.point())));
        Ok(samples)
    }

    /// The samples in a rectangle of lattice points; on a torus of its images, at most a period wide and high.
    pub fn points(&self, job: &Job, rect: &Rect) -> Result<Vec<L::Sample>> {
        if rect.is_empty() {
            return Ok(Vec::new());
        }
        let part = Part::new(&self.lattice, rect);
        let expected = self.layers.last().map_or(0.0, |layer| layer.expected(&part));
        let cache = self.cache.as_ref().filter(|cache| cache.is_for(expected));
        let samples = self.up_to(job, self.layers.len(), &part, cache)?;
        if part.rect == *rect {
            return Ok(samples);
        }
        let mut images = Vec::with_capacity(samples.len());
        add_images(&mut images, &samples, &part, rect);
        Ok(images)
    }

    /// The samples of the base and of the first `count` layers in a part.
    fn up_to(&self, job: &Job, count: usize, part: &Part, cache: Option<&Cache<L::Sample>>) -> Result<Vec<L::Sample>> {
        // From the last layer to the first, the part of each that is needed.
        let kept = self.kept.as_ref().map_or(0, |(kept, _)| *kept);
        let mut steps = Vec::with_capacity(count - kept);
        let mut part = *part;
        for number in (kept..count).rev() {
            let step = self.step(number, &part, cache);
            part = step.before;
            steps.push((number, step));
        }

        // From the first to the last, each in its part.
        let base = self.base.as_ref().map_or(0.0, |(base, _)| base.expected(&part.rect) / TILING_SPEED);
        let cost = |number: usize, step: &Step<L::Sample>| {
            1.0 + step.missing.as_ref().map_or(0.0, |(missing, _)| self.layers[number].expected(missing))
        };
        let total = 1.0 + base + steps.iter().map(|(number, step)| cost(*number, step)).sum::<f64>();
        let mut samples = match &self.kept {
            Some((_, kept)) => kept.samples_of(&part),
            None => self.base_in(&job.part(0.0, base / total), &part)?,
        };
        let mut done = base;
        for (number, step) in steps.into_iter().rev() {
            let next = done + cost(number, &step);
            let layer = &self.layers[number];
            if let Some((missing, wanted)) = &step.missing {
                let before = layer.sorted(step.before, &samples);
                let made = layer.fill(&job.part(done / total, next / total), &before, missing)?;
                samples = before.samples_of(&step.part);
                if let (Some(cache), Some(blocks)) = (cache, layer.blocks()) {
                    cache.add(number, blocks, missing, &made);
                }
                add_images(&mut samples, &made, missing, wanted);
            }
            samples.extend(step.found);
            done = next;
        }
        Ok(samples)
    }

    /// The need of a part of a layer: of a layer that is made by blocks, those that are not cached.
    fn step(&self, number: usize, part: &Part, cache: Option<&Cache<L::Sample>>) -> Step<L::Sample> {
        let layer = &self.layers[number];
        let Some((cache, blocks)) = cache.zip(layer.blocks()) else {
            let missing = Some((*part, part.rect));
            return Step { part: *part, found: Vec::new(), missing, before: layer.around(part) };
        };
        let (found, missing) = cache.look_up(number, blocks, &part.rect);
        let Some(rect) = missing else { return Step { part: *part, found, missing: None, before: *part } };
        let missing = Part::new(&self.lattice, &rect);
        let before = Part::new(&self.lattice, &layer.around(&missing).rect.hull(&part.rect));
        Step { part: *part, found, missing: Some((missing, rect.intersection(&part.rect))), before }
    }

    /// The samples of the base in a part.
    fn base_in(&self, job: &Job, part: &Part) -> Result<Vec<L::Sample>> {
        match &self.base {
            Some((base, sample)) => images(job, &self.lattice, base, *sample, part),
            None => Ok(Vec::new()),
        }
    }
}

/// Adds those images of the samples of a part that lie in a rectangle.
fn add_images<S: Placed>(samples: &mut Vec<S>, made: &[S], part: &Part, rect: &Rect) {
    for (piece, [along, up]) in part.images(rect) {
        samples.extend(made.iter().filter(|sample| piece.contains(sample.point())).map(|sample| {
            let [x, y] = sample.point();
            sample.moved_to([x + along, y + up])
        }));
    }
}

/// The samples of a base in a part; on a torus their images. All have the attributes of the given one.
pub fn images<S: Placed>(job: &Job, lattice: &Lattice, base: &Base, sample: S, part: &Part) -> Result<Vec<S>> {
    let points = base.images(job, lattice, &part.rect)?;
    Ok(points.into_iter().map(|point| sample.moved_to(point)).collect())
}

// # The base
//
// A set of one radius in an arbitrary order, which the layers of other kinds are filled around: a tiling or, where the
// domain is too small for one, a set of [`maximal`](crate::maximal) that is made as a whole.

/// The share of the progress that making a tiling's pattern takes.
pub const PATTERN_SHARE: f64 = 0.05;

/// A set of one radius.
pub enum Base {
    /// Any part of it is made on demand.
    Tiled(Box<Tiling>),
    /// The whole set is stored.
    Whole(WholeSet),
}

/// A set that is made as a whole.
pub struct WholeSet {
    lattice: Lattice,
    /// The rows of cells that the samples are ordered by, from left to right in each.
    rows: CellAxis,
    samples: Vec<[f32; 2]>,
}

impl Base {
    /// The set of a lattice's radius.
    pub fn new(job: &Job, lattice: Lattice, leaf_size: f64, seed: u64, around: Arc<GivenDisks>) -> Result<Self> {
        if Tiling::is_worthwhile(&lattice, leaf_size) {
            return Ok(Self::Tiled(Box::new(Tiling::new(job, lattice, leaf_size, seed, around)?)));
        }
        let samples = maximal::sample_lattice_around(job, &lattice, seed, around.near(&lattice.rect()))?;
        Ok(Self::Whole(WholeSet { rows: CellAxis::new(lattice.size[1], lattice.radius), lattice, samples }))
    }

    /// All samples of [`Base::new`], with nothing stored.
    pub fn sample(
        job: &Job,
        lattice: &Lattice,
        leaf_size: f64,
        seed: u64,
        around: Arc<GivenDisks>,
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
            Self::Tiled(tiling) => tiling.whole(job),
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

    /// True if the set of a lattice is tiled, not made as a whole.
    pub fn is_tiled(lattice: &Lattice, leaf_size: f64) -> bool {
        Tiling::is_worthwhile(lattice, leaf_size)
    }

    /// The samples in a rectangle of the domain, as lattice points.
    pub fn points(&self, job: &Job, rect: &Rect) -> Result<Vec<[i32; 2]>> {
        match self {
            Self::Tiled(tiling) => tiling.points(job, rect),
            Self::Whole(WholeSet { lattice, samples, .. }) => {
                let points = samples.iter().map(|&sample| lattice.point(sample));
                Ok(points.filter(|&point| rect.contains(point)).collect())
            }
        }
    }

    /// The samples in a rectangle of lattice points; on a torus of its images.
    pub fn images(&self, job: &Job, lattice: &Lattice, rect: &Rect) -> Result<Vec<[i32; 2]>> {
        let (whole, mut images) = (Part::whole(lattice), Vec::new());
        for (piece, [along, up]) in whole.images(rect).filter(|(piece, _)| !piece.is_empty()) {
            images.extend(self.points(job, &piece)?.into_iter().map(|[x, y]| [x + along, y + up]));
        }
        Ok(images)
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

impl WholeSet {
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
