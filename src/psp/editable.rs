//! Sets on meshes that are edited (`editable.rs` in the root), and the part of a set that a region needs.
//!
//! Only the triangles near an edit are looked at, and only the samples and the given samples around them. They are found
//! by the cubes that the set grew in (`set/cubes.rs`): samples are kept by cube, and the triangles of the mesh are sorted
//! into cubes once, by the first refill (departs from the thesis, which only adds samples).

use std::sync::Arc;

use crate::editable::{self, Edit, GivenSample, Ground, Standing};
use crate::error::Result;
use crate::given::Given;
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
use crate::math::distance_squared;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::fill::{
    Blocks, DENSITY, Extent, FillOptions, Measures, Surface, Uniform, check_radius_on, fill_parts, require_samples,
};
use crate::psp::fragment::Facing;
use crate::psp::given::{GivenSamples, balls};
use crate::psp::options::RegionOptions;
use crate::psp::report::{Report, rho};
use crate::psp::set::{Cube, Sample, SampleSet, surface_samples};
use crate::region::Region;

/// A set of samples on a mesh that is edited, made by [`Psp::into_editable`](super::Psp::into_editable).
pub type EditableSet = editable::EditableSet<3, OnMesh>;

/// Peak memory per sample of a region; and the samples for which memory must be free before those of the region are counted,
/// since its blocks are made for that.
const BYTES_PER_SAMPLE: f64 = 200.0;
const FEWEST: f64 = 2e4;

/// A mesh as the ground of a set.
pub struct OnMesh {
    mesh: Arc<Mesh>,
    measures: Arc<Measures>,
    radius: f64,
    facing: Facing,
    /// A set without samples, which knows the cubes.
    empty: SampleSet,
    /// Made by the first refill.
    blocks: Option<Blocks>,
}

impl OnMesh {
    pub(crate) fn new(mesh: Arc<Mesh>, measures: Arc<Measures>, radius: f64, facing: Facing) -> Self {
        let empty = SampleSet::new(&mesh, radius);
        Self { mesh, measures, radius, facing, empty, blocks: None }
    }

    /// The given samples that can matter in some boxes.
    fn given_near<'a>(
        &self,
        given: &[GivenSample<3>],
        extents: impl Iterator<Item = &'a Extent>,
        samples: &SampleSet,
    ) -> Result<GivenSamples> {
        let mut extent = Extent::EMPTY;
        extents.for_each(|other| extent.join(other));
        let near = given.iter().filter(|given| extent.is_in_reach(given.position, given.clearance));
        let (positions, clearances): (Vec<_>, Vec<_>) = near.map(|given| (given.position, given.clearance)).unzip();
        let given = Given::with_clearances(&positions, &clearances);
        GivenSamples::new(&self.mesh, given, self.radius, samples, self.facing)
    }
}

impl Ground<3> for OnMesh {
    type Sample = Sample;
    type Bin = Cube;
    type Refilled = (Points<3>, Report);

    fn radius(&self) -> f64 {
        self.radius
    }

    fn position(sample: &Sample) -> [f32; 3] {
        sample.position
    }

    fn bin(&self, position: [f64; 3]) -> Cube {
        self.empty.cube(position)
    }

    fn bins_in(&self, region: &Region, standing: &Standing<Sample, Cube>) -> Vec<Cube> {
        let [low, high] = region.bounds();
        let [Cube(first), Cube(last)] = [low, high].map(|end| self.empty.cube(end));
        let is_touched = |&Cube(cube): &Cube| (0..3).all(|axis| (first[axis]..=last[axis]).contains(&cube[axis]));
        let count: f64 = (0..3).map(|axis| f64::from(last[axis]) - f64::from(first[axis]) + 1.0).product();
        // Each cube is looked up, or selected from all cubes if these are fewer.
        if count < standing.bins().len() as f64 {
            let rows = (first[2]..=last[2]).flat_map(|z| (first[1]..=last[1]).map(move |y| (y, z)));
            rows.flat_map(|(y, z)| (first[0]..=last[0]).map(move |x| Cube([x, y, z]))).collect()
        } else {
            standing.bins().filter(is_touched).collect()
        }
    }

    fn is_in(&self, region: &Region, position: [f32; 3]) -> bool {
        region.contains(position)
    }

    fn images(&self, position: [f32; 3]) -> Vec<[f64; 3]> {
        vec![position.map(f64::from)]
    }

    fn conflict(&self, a: &Sample, b: &Sample) -> bool {
        let normal = |sample: &Sample| self.facing.normal(&self.mesh, sample.triangle);
        self.empty.conflict(a.position, b.position) && self.facing.sees(normal(a), normal(b))
    }

    fn squared(&self, a: [f32; 3], b: [f32; 3]) -> f64 {
        distance_squared(a, b)
    }

    fn sample(&self, points: &Points<3>, index: usize) -> Option<Sample> {
        let (&triangle, &barycentrics) = points.triangles.get(index).zip(points.barycentrics.get(index))?;
        let is_known = (triangle as usize) < self.mesh.triangles().len();
        let sample = is_known.then(|| Sample::new(&self.mesh, triangle, barycentrics));
        sample.filter(|sample| sample.position == points.positions[index])
    }

    fn points(&self, samples: &[Sample]) -> Points<3> {
        surface_samples(&self.mesh, samples.iter())
    }

    fn prepare(&mut self, job: &Job) -> Result<()> {
        if self.blocks.is_none() {
            self.blocks = Some(Blocks::new(job, &self.mesh, &self.measures, &self.empty, None)?);
        }
        Ok(())
    }

    fn fill(&self, job: &Job, edit: &Edit<3, Sample, Cube>) -> Result<(Vec<Sample>, u64)> {
        let Some(blocks) = &self.blocks else { return Ok((Vec::new(), 0)) };
        let touched = |extent: &Extent| -> Vec<&Region> {
            edit.regions.iter().filter(|region| region.touches(extent.corners())).collect()
        };
        let parts: Vec<(usize, Vec<&Region>)> = (0..)
            .zip(&blocks.extents)
            .map(|(number, extent)| (number, touched(extent)))
            .filter(|(_, regions)| !regions.is_empty())
            .collect();
        let cubes: Vec<Cube> = parts.iter().map(|&(number, _)| blocks.cubes[number]).collect();

        let mut around: Vec<Cube> = cubes.iter().flat_map(|cube| cube.around()).collect();
        around.sort_unstable();
        around.dedup();
        let standing = edit.standing.in_bins(around).map(|own| own.sample).collect();
        let mut samples = SampleSet::with(&self.mesh, self.radius, standing);
        let given = self.given_near(edit.given, parts.iter().map(|&(number, _)| &blocks.extents[number]), &samples)?;

        let surface = Surface { mesh: &self.mesh, measures: &self.measures, given: &given, facing: self.facing };
        let site = Uniform { surface, radius: samples.radius(), largest_rank: None };
        let options = FillOptions { measures: false, ..FillOptions::from_nothing(edit.seed) };
        let part = |index: usize| {
            let (number, regions) = &parts[index];
            let is_in = |extent: &Extent| regions.iter().any(|region| region.touches(extent.corners()));
            blocks.block(&self.measures, *number).part(&self.mesh, is_in)
        };
        let before = samples.len();
        let filled = fill_parts(job, &site, &mut samples, &cubes, part, options)?;
        Ok((samples.into_samples().split_off(before), filled.darts))
    }

    fn refilled(&self, added: Points<3>, len: usize, darts: u64, stopwatch: &Stopwatch) -> (Points<3>, Report) {
        let report = Report {
            samples: len as u64,
            rho: rho(&self.mesh, len, self.radius),
            radius: self.radius,
            covering_radius: Some(self.radius),
            uncovered_after: Some(0.0),
            ..Report::of_fill(added.len(), darts, stopwatch)
        };
        (added, report)
    }
}

/// The part of a maximal set that a region needs: samples such that no place of the surface in the region is farther than
/// the radius from all of them or than its clearance from all given samples. What lies outside counts as covered, and is
/// not looked at. Samples stand in the region, or at most 6 radii outside it on a triangle that it touches.
///
/// Takes time in proportion to the surface in the region, and reads the list of given samples and the balls around
/// clusters of triangles once; the first call on a mesh makes these, in O(triangles). For many edits of one set use
/// [`EditableSet`].
///
/// # Errors
/// Those of [`Psp::new`](super::Psp::new), and [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a `region`
/// with bounds that are NaN or in the wrong order. Where the call is cancelled nothing is returned.
pub fn sample_region(
    context: &Context,
    mesh: &Arc<Mesh>,
    region: &Region,
    options: &RegionOptions,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    region.check()?;
    let &RegionOptions { radius, seed, given, cosine } = options;
    let measures = mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))?;
    check_radius_on(mesh, radius)?;
    given.check()?;
    require_samples(FEWEST, BYTES_PER_SAMPLE, "radius", "a region asks for")?;
    let mut ground = OnMesh::new(mesh.clone(), measures, radius, Facing::new(cosine)?);
    let blocks = |job: &Job| Blocks::new(job, mesh, &ground.measures, &ground.empty, Some(region));
    let blocks = context.run(None, blocks)?;
    // Only if the whole mesh would have too many samples, those of the region are counted.
    if ground.measures.checked_samples(mesh, radius, BYTES_PER_SAMPLE, Given::default()).is_err() {
        let area = |number| blocks.block(&ground.measures, number).items.row(mesh).total();
        let samples = DENSITY * (0..blocks.cubes.len()).map(area).sum::<f64>() / (radius * radius);
        require_samples(samples, BYTES_PER_SAMPLE, "radius", &format!("{radius:?} asks for"))?;
    }
    ground.blocks = Some(blocks);
    let mut set = EditableSet::begin(ground, seed, [], balls(given, radius), true);
    set.open(*region);
    let (points, report) = set.refill(context, seed, progress)?;
    Ok((
        Points { ids: Vec::new(), ..points },
        Report { rho: 0.0, covering_radius: None, uncovered_after: None, ..report },
    ))
}
