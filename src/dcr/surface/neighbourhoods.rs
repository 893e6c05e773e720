//! The lists of all samples, kept up to date while these move.
//!
//! Lists hold what is within a radius of where a sample was *listed*. A sample that has strayed from there by half of
//! the skin is listed anew where it is; the samples that it meets there get it into their lists. So two samples that do
//! not have each other are no closer than the radius less the skin.

use glam::Vec3;

use crate::dcr::surface::cells::Cells;
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::gather::Mover;
use crate::dcr::surface::lists::List;
use crate::dcr::surface::local::Local;
use crate::dcr::surface::near::{Finds, Image, SampleSearch, Surroundings};
use crate::dcr::surface::patches::Patches;
use crate::dcr::surface::relaxation::FARTHEST;
use crate::dcr::surface::view::Star;
use crate::error::Result;
use crate::job::{Job, chunks, chunks_of};
use crate::mesh::exact;
use crate::simd::Position;

/// The distance up to which neighbours are needed, in spacings.
const REACH: f64 = 1.7;

/// The distance beyond that up to which they are listed.
const SKIN: f64 = 0.3;

/// The least stride for which samples in sight are listed, in spacings.
const LEAST_STRIDE: f64 = 0.2;

/// The samples of one task.
const CHUNK: usize = 128;

/// The samples that are found before they are listed.
const BATCH: usize = 1 << 16;

/// What samples know of each other.
pub(super) struct Neighbourhoods<'a> {
    connected: &'a ConnectedMesh<'a>,
    patches: Patches,
    spacing: f64,
    /// How far others are in sight, in spacings.
    sight: f64,
    /// The farthest that samples may move in a step, in spacings: those out of sight are no closer than the floor then.
    farthest: f64,
    lists: Vec<List>,
    locals: Vec<Local>,
    /// Where samples were listed.
    cells: Cells,
    /// The samples that are to be listed.
    strayed: Vec<u32>,
    /// The last search by which each was listed.
    searches: Vec<u32>,
    search: u32,
}

impl<'a> Neighbourhoods<'a> {
    /// Of samples that are never closer to each other than `floor` spacings.
    pub(super) fn new(
        job: &Job,
        connected: &'a ConnectedMesh<'a>,
        spacing: f64,
        floor: f64,
        movers: &[Mover],
        positions: &[Position],
    ) -> Result<Self> {
        let most = f64::from(FARTHEST);
        let farthest = ((REACH - floor) / 2.0).clamp(LEAST_STRIDE, most);
        let sight = floor + 2.0 * farthest + SKIN;
        let side = SampleSearch::cell_side(spacing, REACH + SKIN, sight);
        let cells = Cells::new(exact(connected.mesh.bounds().0), side, positions.iter().map(|&place| vec3(place)));
        let local = |mover: &Mover| Local::on(connected, spacing, mover.place.triangle, Vec3::ZERO);
        let tasks = chunks(movers.len());
        let locals = job.concat(tasks.len(), |task| movers[tasks.range(task)].iter().map(local).collect())?;
        Ok(Self {
            connected,
            patches: Patches::new(job, connected, spacing)?,
            spacing,
            sight,
            farthest,
            lists: vec![List::default(); movers.len()],
            locals,
            cells,
            strayed: (0..movers.len() as u32).collect(),
            searches: vec![0; movers.len()],
            search: 0,
        })
    }

    /// The farthest that samples may move in a step, in spacings.
    pub(super) fn farthest(&self) -> f64 {
        self.farthest
    }

    /// The lists, to be read, and what samples keep of their triangles, to be kept up to date.
    pub(super) fn lists_and_locals(&mut self) -> (&[List], &mut [Local]) {
        (&self.lists, &mut self.locals)
    }

    /// Puts a sample back on a triangle.
    pub(super) fn put_back(&mut self, sample: u32, local: Local) {
        self.locals[sample as usize] = local;
    }

    /// All other samples that could be closer than the floor after this step.
    pub(super) fn in_sight(&self, sample: u32) -> impl Iterator<Item = u32> {
        let list = &self.lists[sample as usize];
        list.reached().chain(list.others().iter().copied())
    }

    /// The samples in sight that are not reached on the surface.
    #[cfg(test)]
    pub(super) fn others(&self, sample: u32) -> &[u32] {
        self.lists[sample as usize].others()
    }

    /// Notes the samples that have strayed from where they were listed.
    pub(super) fn follow(&mut self, job: &Job, positions: &[Position]) -> Result<()> {
        let (unit, most) = ((1.0 / self.spacing) as f32, (SKIN / 2.0) as f32);
        let has_strayed = |&sample: &u32| {
            let strayed = (vec3(positions[sample as usize]) - self.cells.position(sample)) * unit;
            strayed.length_squared() >= most * most
        };
        let tasks = chunks(positions.len());
        self.strayed = job
            .concat(tasks.len(), |task| tasks.range(task).map(|sample| sample as u32).filter(has_strayed).collect())?;
        Ok(())
    }

    /// Lists the samples that have strayed.
    pub(super) fn search(&mut self, job: &Job, movers: &mut [Mover], positions: &[Position]) -> Result<()> {
        if self.strayed.is_empty() {
            return Ok(());
        }
        let strayed = std::mem::take(&mut self.strayed);
        self.search += 1;
        for &sample in &strayed {
            self.cells.put(sample, vec3(positions[sample as usize]));
            self.searches[sample as usize] = self.search;
        }
        self.list(&job.part(0.0, 0.8), &strayed, movers)?;
        let mut met = Vec::new();
        strayed.iter().for_each(|&sample| self.meet(sample, &mut met));
        self.list(&job.part(0.8, 1.0), &met, movers)
    }

    /// Lists samples, so many at a time that what is found takes little memory.
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
            // Stars number the samples of the list.
            (movers[sample as usize].star, movers[sample as usize].rest) = (Star::default(), 0);
        }
    }

    /// Lets the samples that are not listed in this search, but have been met by one that is, know it. Those that must
    /// be listed anew for that are added to `met`.
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

fn vec3([x, y, z, _]: Position) -> Vec3 {
    Vec3::new(x, y, z)
}
