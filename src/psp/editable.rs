//! Maximal sets that are edited: samples are erased in a region, given samples come and go, and the gaps are filled
//! again. All of it takes time in proportion to what changes, not to the set or the mesh (departs from the thesis).
//!
//! A maximal set has gaps only where something was erased: within a radius of an erased sample, or in the clearance of a
//! given sample that was removed. Only the triangles there are looked at, and only the samples and the given samples
//! around them. They are found by the cubes that the set grew in (`cubes.rs`): samples are kept by cube, and the
//! triangles of the mesh are sorted into cubes once, by the first refill.
//!
//! The new samples depend on the seed, on the regions of the edits and on the samples that stand around them, by their
//! places alone: after the same edits the same seed gives the same samples, whatever was erased. Edits are filled one by
//! one, the last one first: an earlier one, of which nothing is left to fill, then changes nothing.

use std::collections::HashMap;
use std::sync::Arc;

use crate::check;
use crate::error::{Error, Result};
use crate::given::Given;
use crate::host::Stopwatch;
use crate::index::Grid3;
use crate::job::{Context, Job, Progress};
use crate::math::distance_squared;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::cubes::Cube;
use crate::psp::fill::blocks::Blocks;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::measures::{DENSITY, Measures, check_radius_on, require_samples};
use crate::psp::fill::uniform::{Surface, Uniform};
use crate::psp::fill::{FillOptions, fill_parts};
use crate::psp::fragment::Facing;
use crate::psp::given::{GivenSamples, balls};
use crate::psp::options::RegionOptions;
use crate::psp::report::{Report, rho};
use crate::psp::samples::{Sample, SampleSet, surface_samples};
use crate::region::Region;

/// The reach of a sample in radii, in a search for what it covers: more than 1 by what rounding can matter, which is
/// below a few float spacings, of which a radius has 64.
const REACH: f64 = 1.1;

/// Peak memory per sample of a region; and the samples for which memory must be free before those of the region are counted,
/// since its blocks are made for that.
const BYTES_PER_SAMPLE: f64 = 200.0;
const FEWEST: f64 = 2e4;

/// A sample and its id.
#[derive(Clone, Copy)]
struct Numbered {
    id: u64,
    sample: Sample,
}

/// A given sample, its id and its clearance.
#[derive(Clone, Copy)]
struct GivenSample {
    id: u64,
    position: [f32; 3],
    clearance: f64,
}

/// A set of samples on a mesh that is edited, in any part of it at any time, made by
/// [`Psp::into_editable`](super::Psp::into_editable).
///
/// Every sample has an *id*, which no other sample of the set ever has, and keeps it, with all its bytes, until it is
/// erased. After a [refill](Self::refill) the set is maximal, on the mesh and around the given samples as they are
/// then. Between an edit and the refill it is a valid set with gaps.
///
/// To undo a stroke of a brush, erase the samples that it added, by their ids, and [restore](Self::restore) those that
/// it erased. To redo it, erase the same region and refill with the same seed: the samples are the same, bit for bit,
/// with new ids.
pub struct EditableSet {
    mesh: Arc<Mesh>,
    measures: Arc<Measures>,
    radius: f64,
    facing: Facing,
    seed: u64,
    /// A set without samples, which knows the cubes.
    empty: SampleSet,
    samples: HashMap<Cube, Vec<Numbered>>,
    len: usize,
    /// The cube of each sample that the set has ever had, by id.
    cube_of: Vec<Cube>,
    /// By rising ids.
    given: Vec<GivenSample>,
    next_given: u64,
    /// The regions of each edit since the last refill, which may have gaps.
    edits: Vec<Vec<Region>>,
    /// Made by the first refill.
    blocks: Option<Blocks>,
}

impl EditableSet {
    /// A set without samples on a mesh without given ones.
    pub(super) fn new(mesh: Arc<Mesh>, measures: Arc<Measures>, radius: f64, facing: Facing, seed: u64) -> Self {
        let empty = SampleSet::new(&mesh, radius);
        let (samples, cube_of, given, edits) = (HashMap::new(), Vec::new(), Vec::new(), Vec::new());
        let (len, next_given, blocks) = (0, 0, None);
        Self { mesh, measures, radius, facing, seed, empty, samples, len, cube_of, given, next_given, edits, blocks }
    }

    /// Adds the first samples, which do not conflict, and the first given ones.
    pub(super) fn begin(&mut self, samples: Vec<Sample>, given: Vec<([f32; 3], f64)>, is_maximal: bool) {
        samples.into_iter().for_each(|sample| self.add(sample));
        self.next_given = given.len() as u64;
        let numbered = |(id, (position, clearance))| GivenSample { id, position, clearance };
        self.given = (0..).zip(given).map(numbered).collect();
        if !is_maximal {
            self.edits.push(vec![Region::EVERYWHERE]);
        }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.len
    }

    /// True if there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The seed of the set that this one began as.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// A copy of the samples, by rising [ids](Points::ids). O(n log n).
    pub fn samples(&self) -> Points<3> {
        self.points(self.samples.values().flatten().copied().collect())
    }

    /// Erases the samples in a region, and returns them. O(samples of the cubes of 24 radii that it touches).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `region` with bounds that are NaN or in the wrong order.
    pub fn erase(&mut self, region: &Region) -> Result<Points<3>> {
        region.check()?;
        let erased = self.take(region, |sample| region.contains(sample.position));
        self.edits.push(vec![region.grown(REACH * self.radius)]);
        Ok(self.points(erased))
    }

    /// Erases samples by their ids, and returns them. O(samples of the cubes that they are in).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an id in `ids` that no sample has, or that is listed twice; nothing is erased
    /// then.
    pub fn erase_ids(&mut self, ids: &[u64]) -> Result<Points<3>> {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Error::invalid("ids", format!("{} is listed twice", pair[0])));
        }
        let mut by_cube: HashMap<Cube, Vec<u64>> = HashMap::new();
        for (index, &id) in ids.iter().enumerate() {
            let Some(cube) = self.cube_with(id) else {
                return Err(Error::invalid("ids", format!("[{index}] is {id}, which no sample of the set has")));
            };
            by_cube.entry(cube).or_default().push(id);
        }
        let mut erased = Vec::new();
        for (cube, mut ids) in by_cube {
            ids.sort_unstable();
            self.take_in(cube, |own| ids.binary_search(&own.id).is_ok(), &mut erased);
        }
        let reach = REACH * self.radius;
        self.note_balls(erased.iter().map(|own| (own.sample.position, reach)));
        Ok(self.points(erased))
    }

    /// Puts samples back that were erased, with their ids.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `points` that are not samples of this set or stand already, and for one that is
    /// closer than the radius to a sample of the set, or than its clearance to a given one; nothing is put back then.
    pub fn restore(&mut self, points: &Points<3>) -> Result<()> {
        let (count, triangles) = (points.len(), self.mesh.triangles().len());
        let refused = |index: usize, reason: String| Err(Error::invalid("points", format!("[{index}] {reason}")));
        if points.ids.len() != count || points.triangles.len() != count || points.barycentrics.len() != count {
            return Err(Error::invalid("points", "are not samples of a set that is edited"));
        }
        check::triangles(&points.triangles, triangles)?;
        let restored: Vec<Numbered> = (0..count)
            .map(|i| Sample::new(&self.mesh, points.triangles[i], points.barycentrics[i]))
            .zip(&points.ids)
            .map(|(sample, &id)| Numbered { id, sample })
            .collect();
        let mut cubes: Vec<Cube> = restored.iter().map(|own| self.cube(&own.sample)).collect();
        cubes.dedup();
        let mut standing: Vec<Numbered> = self.standing_around(&cubes).copied().collect();
        let mut grid = Grid3::new([0.0; 3], self.radius);
        standing.iter().for_each(|own| _ = grid.insert(own.sample.position));
        for (index, own @ Numbered { id, sample }) in restored.iter().enumerate() {
            let is_known = usize::try_from(*id).is_ok_and(|id| id < self.cube_of.len());
            if !is_known || sample.position != points.positions[index] {
                return refused(index, format!("is not a sample of this set, in which the id {id} is another's"));
            }
            if self.cube_with(*id).is_some() {
                return refused(index, format!("stands already, with the id {id}"));
            }
            let conflicts = |&other: &u32| self.conflict(sample, &standing[other as usize].sample);
            let near = grid.candidates(sample.position.map(f64::from), self.empty.radius()).find(conflicts);
            if let Some(other) = near {
                return refused(index, format!("conflicts with sample {}", standing[other as usize].id));
            }
            if let Some(given) = self.given.iter().find(|given| given.covers(sample.position)) {
                return refused(index, format!("conflicts with given sample {}", given.id));
            }
            grid.insert(sample.position);
            standing.push(*own);
        }
        for own in restored {
            self.cube_of[own.id as usize] = self.cube(&own.sample);
            self.put(own);
        }
        Ok(())
    }

    /// Adds given samples; those without clearances have the radius of the set. Samples that are closer to one than its
    /// clearance are erased. Returns the id of the first given sample, which the others follow, and the erased samples.
    /// O(samples of the cubes that the clearances touch, for each).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for given samples out of range, by their index (`given_positions`,
    /// `given_clearances`).
    pub fn add_given(&mut self, given: Given<3>) -> Result<(u64, Points<3>)> {
        given.check()?;
        let (first, mut erased, mut gaps) = (self.next_given, Vec::new(), Vec::new());
        for (index, &position) in given.positions.iter().enumerate() {
            let clearance = given.clearance(index, self.radius);
            let given = GivenSample { id: self.next_given, position, clearance };
            self.given.push(given);
            self.next_given += 1;
            let ball = Region::ball(position.map(f64::from), clearance * REACH);
            let covered = self.take(&ball, |sample| given.covers(sample.position));
            if !covered.is_empty() {
                gaps.push((position, REACH * (clearance + self.radius)));
            }
            erased.extend(covered);
        }
        self.note_balls(gaps.into_iter());
        Ok((first, self.points(erased)))
    }

    /// Removes given samples by their ids. O(given samples).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an id in `ids` that no given sample has; nothing is removed then.
    pub fn remove_given(&mut self, ids: &[u64]) -> Result<()> {
        let place = |id: u64| self.given.binary_search_by_key(&id, |given| given.id);
        if let Some(index) = ids.iter().position(|&id| place(id).is_err()) {
            return Err(Error::invalid("ids", format!("[{index}] is {}, which no given sample has", ids[index])));
        }
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        let (mut gaps, radius) = (Vec::new(), self.radius);
        self.given.retain(|given| {
            let is_removed = sorted.binary_search(&given.id).is_ok();
            if is_removed {
                gaps.push((given.position, REACH * given.clearance.max(radius)));
            }
            !is_removed
        });
        self.note_balls(gaps.into_iter());
        Ok(())
    }

    /// Adds samples until the set is maximal, and returns them. The first call sorts the triangles of the mesh, in
    /// O(triangles); after that a call takes time in proportion to the surface in and around the regions that were
    /// edited since the last one, and reads the list of given samples once.
    ///
    /// # Errors
    /// [`Error::Cancelled`] by the progress callback: nothing is added then.
    pub fn refill(&mut self, context: &Context, seed: u64, progress: Option<&Progress>) -> Result<(Points<3>, Report)> {
        let (stopwatch, first) = (Stopwatch::start(), self.cube_of.len());
        let filled = context.run(progress, |job| self.fill(job, seed));
        let darts = filled.inspect_err(|_| self.forget(first))?;
        self.edits.clear();
        let added = self.from(first);
        let report = Report {
            samples: self.len as u64,
            rho: rho(&self.mesh, self.len, self.radius),
            radius: self.radius,
            covering_radius: Some(self.radius),
            uncovered_after: Some(0.0),
            ..Report::of_fill(added.len(), darts, &stopwatch)
        };
        Ok((self.points(added), report))
    }

    /// Fills the gaps of each edit, the last one first, and returns the number of darts.
    fn fill(&mut self, job: &Job, seed: u64) -> Result<u64> {
        let blocks = match self.blocks.take() {
            Some(blocks) => blocks,
            None => Blocks::new(&job.part(0.0, 0.2), &self.mesh, &self.measures, &self.empty, None)?,
        };
        let (count, mut darts) = (self.edits.len(), 0);
        let filled = (0..count).try_for_each(|step| {
            let share = |step: usize| 0.2 + 0.8 * step as f64 / count as f64;
            let job = job.part(share(step), share(step + 1));
            let (samples, thrown) = self.fill_edit(&job, &blocks, &self.edits[count - 1 - step], seed)?;
            samples.into_iter().for_each(|sample| self.add(sample));
            darts += thrown;
            Ok(())
        });
        self.blocks = Some(blocks);
        filled.map(|()| darts)
    }

    /// The samples that are missing in the regions of an edit, and the number of darts.
    fn fill_edit(&self, job: &Job, blocks: &Blocks, regions: &[Region], seed: u64) -> Result<(Vec<Sample>, u64)> {
        let touched = |extent: &Extent| -> Vec<&Region> {
            regions.iter().filter(|region| region.touches(extent.corners())).collect()
        };
        let parts: Vec<(usize, Vec<&Region>)> = (0..)
            .zip(&blocks.extents)
            .map(|(number, extent)| (number, touched(extent)))
            .filter(|(_, regions)| !regions.is_empty())
            .collect();
        let cubes: Vec<Cube> = parts.iter().map(|&(number, _)| blocks.cubes[number]).collect();

        let standing = self.standing_around(&cubes).map(|own| own.sample).collect();
        let mut samples = SampleSet::with(&self.mesh, self.radius, standing);
        let given = self.given_near(parts.iter().map(|&(number, _)| &blocks.extents[number]), &samples)?;

        let surface = Surface { mesh: &self.mesh, measures: &self.measures, given: &given, facing: self.facing };
        let site = Uniform { surface, radius: samples.radius(), largest_rank: None };
        let options = FillOptions { measures: false, ..FillOptions::from_nothing(seed) };
        let part = |index: usize| {
            let (number, regions) = &parts[index];
            let is_in = |extent: &Extent| regions.iter().any(|region| region.touches(extent.corners()));
            blocks.block(&self.measures, *number).part(&self.mesh, is_in)
        };
        let before = samples.len();
        let filled = fill_parts(job, &site, &mut samples, &cubes, part, options)?;
        Ok((samples.into_samples().split_off(before), filled.darts))
    }

    /// The samples in and around some cubes.
    fn standing_around(&self, cubes: &[Cube]) -> impl Iterator<Item = &Numbered> {
        let mut around: Vec<Cube> = cubes.iter().flat_map(|cube| cube.around()).collect();
        around.sort_unstable();
        around.dedup();
        around.into_iter().filter_map(|cube| self.samples.get(&cube)).flatten()
    }

    /// The given samples that can matter in some boxes.
    fn given_near<'a>(&self, extents: impl Iterator<Item = &'a Extent>, samples: &SampleSet) -> Result<GivenSamples> {
        let mut extent = Extent::EMPTY;
        extents.for_each(|other| extent.join(other));
        let near = self.given.iter().filter(|given| extent.is_in_reach(given.position, given.clearance));
        let (positions, clearances): (Vec<_>, Vec<_>) = near.map(|given| (given.position, given.clearance)).unzip();
        let given = Given::with_clearances(&positions, &clearances);
        GivenSamples::new(&self.mesh, given, self.radius, samples, self.facing)
    }

    /// Notes an edit that can have left gaps in balls, given by centre and radius: by the boxes of those that begin in
    /// the same cube.
    fn note_balls(&mut self, balls: impl Iterator<Item = ([f32; 3], f64)>) {
        let mut boxes: HashMap<Cube, Region> = HashMap::new();
        for (centre, radius) in balls {
            let centre = centre.map(f64::from);
            let [low, high] = Region::ball(centre, radius).bounds();
            let around = boxes.entry(self.empty.cube(centre)).or_insert_with(|| Region::cuboid(low, high));
            around.min = [0, 1, 2].map(|axis| around.min[axis].min(low[axis]));
            around.max = [0, 1, 2].map(|axis| around.max[axis].max(high[axis]));
        }
        if !boxes.is_empty() {
            self.edits.push(boxes.into_values().collect());
        }
    }

    /// The samples with this id and later ones.
    fn from(&self, first: usize) -> Vec<Numbered> {
        let mut cubes = self.cube_of[first..].to_vec();
        cubes.sort_unstable();
        cubes.dedup();
        let own = cubes.iter().filter_map(|cube| self.samples.get(cube)).flatten();
        own.filter(|own| own.id >= first as u64).copied().collect()
    }

    /// Removes the samples with this id and later ones, as if there had never been any.
    fn forget(&mut self, first: usize) {
        for cube in self.cube_of.split_off(first) {
            self.take_in(cube, |own| own.id >= first as u64, &mut Vec::new());
        }
    }

    /// Adds a sample with the next id.
    fn add(&mut self, sample: Sample) {
        let id = self.cube_of.len() as u64;
        self.cube_of.push(self.cube(&sample));
        self.put(Numbered { id, sample });
    }

    /// Puts a sample into its cube.
    fn put(&mut self, own: Numbered) {
        self.samples.entry(self.cube_of[own.id as usize]).or_default().push(own);
        self.len += 1;
    }

    /// The cube of a sample.
    fn cube(&self, sample: &Sample) -> Cube {
        self.empty.cube(sample.position.map(f64::from))
    }

    /// The cube that has the sample of an id, if one stands.
    fn cube_with(&self, id: u64) -> Option<Cube> {
        let cube = *self.cube_of.get(usize::try_from(id).ok()?)?;
        self.samples.get(&cube)?.iter().any(|own| own.id == id).then_some(cube)
    }

    /// Removes the samples in the cubes that a region touches for which a test holds, and returns them.
    fn take(&mut self, region: &Region, is_taken: impl Fn(&Sample) -> bool) -> Vec<Numbered> {
        let [low, high] = region.bounds();
        let [Cube(first), Cube(last)] = [low, high].map(|end| self.empty.cube(end));
        let is_touched = |&Cube(cube): &Cube| (0..3).all(|axis| (first[axis]..=last[axis]).contains(&cube[axis]));
        let count: f64 = (0..3).map(|axis| f64::from(last[axis]) - f64::from(first[axis]) + 1.0).product();
        // Each cube is looked up, or selected from all cubes if these are fewer.
        let cubes: Vec<Cube> = if count < self.samples.len() as f64 {
            let rows = (first[2]..=last[2]).flat_map(|z| (first[1]..=last[1]).map(move |y| (y, z)));
            rows.flat_map(|(y, z)| (first[0]..=last[0]).map(move |x| Cube([x, y, z]))).collect()
        } else {
            self.samples.keys().copied().filter(is_touched).collect()
        };
        let mut taken = Vec::new();
        cubes.into_iter().for_each(|cube| self.take_in(cube, |own| is_taken(&own.sample), &mut taken));
        taken
    }

    /// Moves the samples of a cube for which a test holds.
    fn take_in(&mut self, cube: Cube, is_taken: impl Fn(&Numbered) -> bool, taken: &mut Vec<Numbered>) {
        let Some(own) = self.samples.get_mut(&cube) else { return };
        let before = taken.len();
        own.retain(|own| {
            let is_taken = is_taken(own);
            if is_taken {
                taken.push(*own);
            }
            !is_taken
        });
        if own.is_empty() {
            self.samples.remove(&cube);
        }
        self.len -= taken.len() - before;
    }

    /// True if two samples are too close.
    fn conflict(&self, a: &Sample, b: &Sample) -> bool {
        let normal = |sample: &Sample| self.facing.normal(&self.mesh, sample.triangle);
        self.empty.conflict(a.position, b.position) && self.facing.sees(normal(a), normal(b))
    }

    /// Samples by rising ids, with their normals.
    fn points(&self, mut numbered: Vec<Numbered>) -> Points<3> {
        numbered.sort_unstable_by_key(|own| own.id);
        let ids = numbered.iter().map(|own| own.id).collect();
        Points { ids, ..surface_samples(&self.mesh, numbered.iter().map(|own| &own.sample)) }
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
/// Those of [`Psp::new`](super::Psp::new), and [`Error::InvalidArgument`] for a `region` with bounds that are NaN or in
/// the wrong order. Where the call is cancelled nothing is returned.
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
    let mut set = EditableSet::new(mesh.clone(), measures, radius, Facing::new(cosine)?, seed);
    set.begin(Vec::new(), balls(given, radius).collect(), true);
    set.edits.push(vec![*region]);
    let blocks = |job: &Job| Blocks::new(job, mesh, &set.measures, &set.empty, Some(region));
    let blocks = context.run(None, blocks)?;
    // Only if the whole mesh would have too many samples, those of the region are counted.
    if set.measures.checked_samples(mesh, radius, BYTES_PER_SAMPLE, Given::default()).is_err() {
        let area = |number| blocks.block(&set.measures, number).items.row(mesh).total();
        let samples = DENSITY * (0..blocks.cubes.len()).map(area).sum::<f64>() / (radius * radius);
        require_samples(samples, BYTES_PER_SAMPLE, "radius", &format!("{radius:?} asks for"))?;
    }
    set.blocks = Some(blocks);
    let (points, report) = set.refill(context, seed, progress)?;
    Ok((
        Points { ids: Vec::new(), ..points },
        Report { rho: 0.0, covering_radius: None, uncovered_after: None, ..report },
    ))
}

impl GivenSample {
    /// True if a position is closer than the clearance.
    fn covers(&self, position: [f32; 3]) -> bool {
        distance_squared(self.position, position) < self.clearance * self.clearance
    }
}
