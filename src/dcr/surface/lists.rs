//! The lists of all samples, kept up to date while these move.
//!
//! A list holds the samples within a radius of the position in which its sample was *listed*. A sample that has strayed
//! from there by half of the skin is listed anew at its position; it is added to the lists of the samples found there.
//! So two samples that do not have each other are no closer than the radius less the skin.

use glam::{DVec3, Vec3};

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::grading::{Grading, grade, level};
use crate::dcr::surface::moves::{Local, Mover};
use crate::dcr::surface::near::{Finds, Image, Patches, SampleSearch, Surroundings, cell_side, mirrored};
use crate::dcr::surface::relaxation::FARTHEST;
use crate::dcr::surface::view::{Star, View};
use crate::error::Result;
use crate::index::MovingGrid3;
use crate::job::{Job, chunks, chunks_of};
use crate::mesh::exact;
use crate::simd::{LANES, Lanes, Position};

/// The distance up to which neighbours are needed, in spacings.
const REACH: f64 = 1.7;

/// The distance beyond that up to which neighbours are listed.
const SKIN: f64 = 0.3;

/// The least stride for which samples in sight are listed, in spacings.
const LEAST_STRIDE: f64 = 0.2;

/// The largest factor by which the grade of a sample grows in a step, and that by which it differs, when forces act,
/// from the grade with which the sample was listed.
pub const GROWTH: f32 = 1.2;
const DRIFT: f32 = 1.1;

/// The number of samples of one task.
const CHUNK: usize = 128;

/// The number of samples that are found before they are listed.
const BATCH: usize = 1 << 16;

/// The neighbours of all samples.
pub struct Neighbourhoods<'a, G> {
    connected: &'a ConnectedMesh<'a>,
    grading: &'a G,
    patches: Patches,
    spacing: f64,
    /// The distance up to which others are in sight, in spacings.
    sight: f64,
    /// The farthest that samples may move in a step, in spacings: those out of sight then end no closer than the floor.
    farthest: f64,
    lists: Vec<List>,
    locals: Vec<Local>,
    /// The positions in which samples were listed, and their grades there where these vary.
    cells: MovingGrid3,
    grades: Vec<f32>,
    /// The samples that are to be listed.
    strayed: Vec<u32>,
    /// The last search by which each sample was listed.
    searches: Vec<u32>,
    search: u32,
}

impl<'a, G: Grading> Neighbourhoods<'a, G> {
    /// Lists of samples that are never closer to each other than `floor` spacings.
    pub fn new(
        job: &Job,
        connected: &'a ConnectedMesh<'a>,
        grading: &'a G,
        spacing: f64,
        floor: f64,
        movers: &[Mover],
        positions: &[Position],
    ) -> Result<Self> {
        // Grades change between the search and the end of the step.
        let [drift, growth] = if G::VARIES { [DRIFT, DRIFT * GROWTH] } else { [1.0; 2] };
        let most = f64::from(FARTHEST * drift);
        let farthest = ((REACH - floor) / 2.0).clamp(LEAST_STRIDE, most);
        let sight = f64::from(growth) * floor + 2.0 * farthest + SKIN;
        // On a level grades are up to twice the least one.
        let widest = if G::VARIES { f64::from(2.0 * grading.least()) } else { 1.0 };
        let side = cell_side(spacing * widest, REACH + SKIN, sight);
        let cells =
            MovingGrid3::new(exact(connected.mesh.bounds().0), side, positions.iter().map(|&place| vec3(place)));
        let local = |mover: &Mover| Local::on(connected, spacing, mover.place.triangle, Vec3::ZERO);
        let tasks = chunks(movers.len());
        let locals = job.concat(tasks.len(), |task| movers[tasks.range(task)].iter().map(local).collect())?;
        Ok(Self {
            connected,
            grading,
            patches: Patches::new(job, connected, spacing * f64::from(finest::<G>(positions)))?,
            spacing,
            sight,
            farthest,
            lists: vec![List::default(); movers.len()],
            locals,
            cells,
            grades: if G::VARIES { positions.iter().map(|position| position[3]).collect() } else { Vec::new() },
            strayed: (0..movers.len() as u32).collect(),
            searches: vec![0; movers.len()],
            search: 0,
        })
    }

    /// The farthest that a sample may move in a step, in mean spacings.
    pub fn farthest(&self, sample: u32) -> f64 {
        self.farthest * f64::from(self.grade(sample))
    }

    /// The grade with which a sample was listed.
    #[inline]
    fn grade(&self, sample: u32) -> f32 {
        if G::VARIES { self.grades[sample as usize] } else { 1.0 }
    }

    /// The lists, to be read, and the samples' views of their triangles, to be kept up to date.
    pub fn lists_and_locals(&mut self) -> (&[List], &mut [Local]) {
        (&self.lists, &mut self.locals)
    }

    /// Puts a sample back on a triangle.
    pub fn put_back(&mut self, sample: u32, local: Local) {
        self.locals[sample as usize] = local;
    }

    /// All other samples that could be closer than the floor after this step.
    pub fn in_sight(&self, sample: u32) -> impl Iterator<Item = u32> {
        let list = &self.lists[sample as usize];
        list.reached().chain(list.others().iter().copied())
    }

    /// The samples in sight that are not reached on the surface.
    #[cfg(test)]
    pub fn others(&self, sample: u32) -> &[u32] {
        self.lists[sample as usize].others()
    }

    /// Notes the samples that have strayed from where they were listed.
    pub fn follow(&mut self, job: &Job, positions: &[Position]) -> Result<()> {
        let (unit, most) = ((1.0 / self.spacing) as f32, (SKIN / 2.0) as f32);
        let has_strayed = |&sample: &u32| {
            let position = positions[sample as usize];
            let strayed = (vec3(position) - self.cells.position(sample)) * unit;
            let listed = self.grade(sample);
            let has_drifted = || {
                let drift = grade::<G>(position) / listed;
                !(1.0 / DRIFT..=DRIFT).contains(&drift)
            };
            strayed.length_squared() >= most * most * (listed * listed) || (G::VARIES && has_drifted())
        };
        let tasks = chunks(positions.len());
        self.strayed = job
            .concat(tasks.len(), |task| tasks.range(task).map(|sample| sample as u32).filter(has_strayed).collect())?;
        Ok(())
    }

    /// Lists the samples that have strayed.
    pub fn search(&mut self, job: &Job, movers: &mut [Mover], positions: &[Position]) -> Result<()> {
        if self.strayed.is_empty() {
            return Ok(());
        }
        let strayed = std::mem::take(&mut self.strayed);
        self.search += 1;
        for &sample in &strayed {
            let position = positions[sample as usize];
            self.cells.put(sample, vec3(position), level(self.grading, grade::<G>(position)));
            if G::VARIES {
                self.grades[sample as usize] = position[3];
            }
            self.searches[sample as usize] = self.search;
        }
        self.list(&job.part(0.0, 0.8), &strayed, movers)?;
        let mut met = Vec::new();
        strayed.iter().for_each(|&sample| self.meet(sample, &mut met));
        self.list(&job.part(0.8, 1.0), &met, movers)
    }

    /// Lists samples, in batches so small that the results take little memory.
    fn list(&mut self, job: &Job, samples: &[u32], movers: &mut [Mover]) -> Result<()> {
        let share = |first: usize| first.min(samples.len()) as f64 / samples.len() as f64;
        for (first, part) in (0..).step_by(BATCH).zip(samples.chunks(BATCH)) {
            let found = self.find(&job.part(share(first), share(first + BATCH)), part, movers)?;
            self.take(part, found, movers);
        }
        Ok(())
    }

    fn find(&self, job: &Job, samples: &[u32], movers: &[Mover]) -> Result<Vec<Vec<(List, Local)>>> {
        let search = SampleSearch {
            connected: self.connected,
            patches: &self.patches,
            cells: &self.cells,
            grading: self.grading,
            grades: &self.grades,
            spacing: self.spacing,
            radius: REACH + SKIN,
            sight: self.sight,
        };
        let seen = |sample: u32| (movers[sample as usize].place.triangle, self.locals[sample as usize].normal());
        let chunks = chunks_of(samples.len(), CHUNK);
        job.map(chunks.len(), |chunk| {
            let mut finds = Finds::default();
            let found = samples[chunks.range(chunk)].iter().map(|&sample| {
                let around: Surroundings = search.around(sample, seen, &mut finds);
                let triangle = movers[sample as usize].place.triangle;
                let local = Local::on(self.connected, self.spacing, triangle, around.normal);
                (List::new(sample, around), local)
            });
            found.collect()
        })
    }

    fn take(&mut self, samples: &[u32], found: Vec<Vec<(List, Local)>>, movers: &mut [Mover]) {
        for (&sample, (list, local)) in samples.iter().zip(found.into_iter().flatten()) {
            self.lists[sample as usize] = list;
            self.locals[sample as usize] = local;
            // Stars refer to samples by their position in the list.
            (movers[sample as usize].star, movers[sample as usize].rest) = (Star::default(), 0);
        }
    }

    /// Adds the samples listed in this search to the lists of those that they have met and that are not listed in it.
    /// Those of the latter that must be listed anew for this are added to `met`.
    fn meet(&mut self, sample: u32, met: &mut Vec<u32>) {
        let list = std::mem::take(&mut self.lists[sample as usize]);
        for other in list.reached() {
            if self.is_unlisted(other)
                && !self.lists[other as usize].has(sample)
                && !self.lists[other as usize].add(sample)
            {
                self.list_too(other, met);
            }
        }
        for &Image { sample: other, edge } in list.images() {
            // Images are mutual too.
            if self.is_unlisted(other) && !self.lists[other as usize].images().contains(&Image { sample, edge }) {
                self.list_too(other, met);
            }
        }
        for &other in list.others() {
            let known = &self.lists[other as usize];
            if self.is_unlisted(other) && !known.others().contains(&sample) && !known.has(sample) {
                self.list_too(other, met);
            }
        }
        self.lists[sample as usize] = list;
    }

    fn is_unlisted(&self, sample: u32) -> bool {
        self.searches[sample as usize] != self.search
    }

    fn list_too(&mut self, sample: u32, met: &mut Vec<u32>) {
        self.searches[sample as usize] = self.search;
        met.push(sample);
    }
}

/// The least grade of samples, a bound of the size of patches.
fn finest<G: Grading>(positions: &[Position]) -> f32 {
    positions.iter().map(|&position| grade::<G>(position)).fold(1.0, f32::min)
}

fn vec3([x, y, z, _]: Position) -> Vec3 {
    Vec3::new(x, y, z)
}

// The list of the samples around one, from one search to the next.

/// All samples, to whose numbers lists refer.
pub struct Listed<'a, G> {
    connected: &'a ConnectedMesh<'a>,
    positions: &'a [Position],
    unit: f32,
    grading: std::marker::PhantomData<G>,
}

impl<'a, G: Grading> Listed<'a, G> {
    /// `unit` is 1 over the mean spacing.
    pub fn new(connected: &'a ConnectedMesh<'a>, _: &G, positions: &'a [Position], unit: f32) -> Self {
        Self { connected, positions, unit, grading: std::marker::PhantomData }
    }
}

/// The number of vectors of samples that are kept in place.
const VECTORS: usize = 2;

/// The samples around one sample.
#[derive(Clone, Default)]
pub struct List {
    /// Samples that are reached on the surface; the sample itself beyond the last.
    reached: [[u32; LANES]; VECTORS],
    count: usize,
    /// The parts that most samples lack.
    more: Option<Box<More>>,
}

#[derive(Clone, Default)]
struct More {
    /// More samples that are reached on the surface.
    reached: Vec<u32>,
    images: Vec<Image>,
    /// The samples in sight that are not reached.
    others: Vec<u32>,
}

impl List {
    pub fn new(sample: u32, around: Surroundings) -> Self {
        let mut list = Self { reached: [[sample; LANES]; VECTORS], ..Self::default() };
        let (first, rest) = around.reached.split_at(around.reached.len().min(LANES * VECTORS));
        list.reached.as_flattened_mut()[..first.len()].copy_from_slice(first);
        list.count = first.len();
        if !(rest.is_empty() && around.images.is_empty() && around.others.is_empty()) {
            let (images, others) = (around.images, around.others);
            list.more = Some(Box::new(More { reached: rest.to_vec(), images, others }));
        }
        list
    }

    /// The samples that are reached on the surface.
    pub fn reached(&self) -> impl Iterator<Item = u32> + '_ {
        let more = self.more.iter().flat_map(|more| &more.reached);
        self.reached.as_flattened()[..self.count].iter().chain(more).copied()
    }

    /// The sample of a candidate in a view; none for an image.
    pub fn sample(&self, candidate: usize) -> Option<u32> {
        self.reached().nth(candidate)
    }

    /// The samples in sight that are not reached on the surface.
    pub fn others(&self) -> &[u32] {
        self.more.as_ref().map_or(&[], |more| &more.others)
    }

    /// The images of samples by the boundary.
    pub fn images(&self) -> &[Image] {
        self.more.as_ref().map_or(&[], |more| &more.images)
    }

    /// True if a sample is reached on the surface.
    pub fn has(&self, sample: u32) -> bool {
        // Beyond the last is the sample itself, which is never queried.
        self.reached.as_flattened().contains(&sample)
            || self.more.as_ref().is_some_and(|more| more.reached.contains(&sample))
    }

    /// Adds a sample that is reached, if there is space and the list has nothing that must be found again with it.
    pub fn add(&mut self, sample: u32) -> bool {
        let is_simple = self.more.is_none() && self.count < LANES * VECTORS;
        if is_simple {
            self.reached.as_flattened_mut()[self.count] = sample;
            self.count += 1;
        }
        is_simple
    }

    /// Passes all samples that are reached, and the images, to a view. Returns the number of samples, which come first,
    /// and their least grade.
    #[inline(always)]
    pub fn show<L: Lanes, G: Grading>(
        &self,
        lanes: L,
        from: Position,
        all: &Listed<G>,
        view: &mut View,
    ) -> (usize, f32) {
        view.clear();
        let (own, unit, positions) = (grade::<G>(from), all.unit, all.positions);
        let scale = lanes.splat(unit / own);
        let (mut shown, mut least) = (0, own);
        while shown < self.count {
            let [x, y, z] = lanes.gather(positions, &self.reached[shown / LANES]);
            if G::VARIES {
                let grades = self.reached[shown / LANES].map(|sample| positions[sample as usize][3]);
                view.grade_vector::<G>(shown / LANES, own, grades);
                least = least.min(lanes.least(lanes.load(&grades)));
            }
            let offset = |x, from| lanes.mul(lanes.sub(x, lanes.splat(from)), scale);
            let count = (self.count - shown).min(LANES);
            view.add_vector(lanes, [offset(x, from[0]), offset(y, from[1]), offset(z, from[2])], count);
            shown += LANES;
        }
        match &self.more {
            None => (self.count, least),
            Some(more) => more.show(from, all, (view, least)),
        }
    }
}

impl More {
    #[inline(never)]
    fn show<G: Grading>(
        &self,
        from: Position,
        &Listed { connected, positions, unit, .. }: &Listed<G>,
        (view, mut least): (&mut View, f32),
    ) -> (usize, f32) {
        let own = grade::<G>(from);
        let unit = unit / own;
        let grade_of = |sample: u32| grade::<G>(positions[sample as usize]);
        let exact = |[x, y, z, _]: Position| DVec3::new(x.into(), y.into(), z.into());
        let from = exact(from);
        for &sample in &self.reached {
            view.add_graded::<G>((exact(positions[sample as usize]) - from).as_vec3() * unit, own, grade_of(sample));
            least = least.min(grade_of(sample));
        }
        let count = view.count();
        for image in &self.images {
            let place = mirrored(exact(positions[image.sample as usize]), connected.ends(image.edge));
            view.add_graded::<G>((place - from).as_vec3() * unit, own, grade_of(image.sample));
        }
        (count, least)
    }
}
