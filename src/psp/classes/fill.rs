//! The fill of a group of classes: that of one class (`psp/fill/`), on the surface in as many copies as there are classes.
//!
//! Darts for all classes of the group rain at one density and in random order, the first ones and those of each round. So
//! none of them has an advantage.

use crate::error::Result;
use crate::index::Weights;
use crate::job::{Job, chunks_of};
use crate::math::power;
use crate::mesh::Mesh;
use crate::psp::classes::ground::ClassGround;
use crate::psp::classes::layers::Layers;
use crate::psp::estimate::expected_samples;
use crate::psp::facing::Facing;
use crate::psp::fill::blocks::{Block, Blocks};
use crate::psp::fill::darts::{random_point, shuffle};
use crate::psp::fill::extent::Extent;
use crate::psp::fill::ground::Point;
use crate::psp::fill::region::{FIRST_DARTS, first_darts, open_parts, open_triangles};
use crate::psp::fill::rounds::{Open, PATCH, rounds, throw};
use crate::psp::fill::triangles::{Measures, Triangles};
use crate::psp::fill::{CHUNK, ONE_PIECE, PROBES, PROBES_IN_CUBE, RAIN_FROM};
use crate::psp::fragment::Fragment;
use crate::psp::obstacles::Obstacles;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// Cubes are so large that no radius is above so many of their own: half of the twelve between what is accepted in one
/// and in the next of its colour.
const LARGEST: f64 = 6.0;

/// The surface, and which classes may stand where.
#[derive(Clone, Copy)]
pub(super) struct Places<'a> {
    pub mesh: &'a Mesh,
    pub measures: &'a Measures,
    /// A bit for each class, by triangle.
    pub masks: Option<&'a [u32]>,
    /// What is given, for each class.
    pub given: &'a [Obstacles],
    /// Nothing given.
    pub none: &'a Obstacles,
    pub facing: Facing,
}

impl Places<'_> {
    /// Whether samples of a class may stand on a triangle.
    fn allow(&self, class: u8, triangle: u32) -> bool {
        self.masks.is_none_or(|masks| masks[triangle as usize] >> class & 1 == 1)
    }
}

/// Classes of one own radius that are filled together.
pub(super) struct Group<'a> {
    pub places: Places<'a>,
    pub members: Vec<u8>,
    pub radius: f64,
    pub layers: Layers,
    pub seed: u64,
}

impl<'a> Group<'a> {
    /// How many samples it has, rather too many.
    pub fn expected_samples(&self) -> f64 {
        self.members.len() as f64 * expected_samples(self.places.mesh, self.places.measures, self.radius)
    }

    /// Adds samples of the group to those of earlier ones until none of its classes can take another one. Returns how many
    /// darts it took.
    pub fn fill(&self, job: &Job, samples: &mut Vec<Sample>) -> Result<u64> {
        self.fill_either_way(job, samples, self.expected_samples() > ONE_PIECE)
    }

    /// Fills cube by cube or in one piece.
    fn fill_either_way(&self, job: &Job, samples: &mut Vec<Sample>, in_blocks: bool) -> Result<u64> {
        if !in_blocks {
            let mut ground = self.ground(None);
            samples.iter().for_each(|sample| ground.add(sample));
            self.fill_in_one_piece(job, &mut ground)?;
            samples.append(&mut ground.accepted);
            return Ok(ground.darts);
        }
        let Places { mesh, measures, .. } = self.places;
        let radius_of_cubes = self.radius.max(self.layers.largest() / LARGEST);
        let mut set = SampleSet::of(mesh, radius_of_cubes, samples);
        let blocks = Blocks::new(&job.part(0.0, 0.1), mesh, measures, &set)?;
        let darts =
            set.grow(&job.part(0.1, 1.0), &blocks.cubes, |number, set| self.fill_block(&blocks.block(number), set))?;
        *samples = set.into_samples();
        Ok(darts)
    }

    /// The surface without any sample.
    fn ground(&self, extent: Option<&Extent>) -> ClassGround<'_> {
        let Places { mesh, facing, given, none, .. } = self.places;
        ClassGround::new(mesh, extent, &self.layers, facing, given, none)
    }

    /// The share of so many random points, each of a random class of the group, where a sample could stand.
    fn open_share(
        &self,
        ground: &ClassGround,
        probes: usize,
        rng: &mut Rng,
        point: &mut dyn FnMut(&mut Rng) -> (u32, [f64; 2]),
    ) -> f64 {
        let mut is_open = || {
            let ((triangle, barycentrics), class) = (point(rng), self.random_class(rng));
            self.places.allow(class, triangle) && !ground.is_taken(triangle, barycentrics, class)
        };
        (0..probes).filter(|_| is_open()).count() as f64 / probes as f64
    }

    fn random_class(&self, rng: &mut Rng) -> u8 {
        self.members[rng.below(self.members.len() as u64) as usize]
    }

    /// Fills the whole surface.
    fn fill_in_one_piece(&self, job: &Job, ground: &mut ClassGround) -> Result<()> {
        let (Places { mesh, measures, .. }, seed) = (self.places, self.seed);
        let (triangles, areas) = (measures.triangles(), Weights::new(measures.areas.clone()));
        let (chunks, mut rng) = (chunks_of(triangles.groups(), CHUNK), Rng::at(seed, Draw::Fill, &[]));
        if areas.total() == 0.0 {
            return Ok(());
        }
        let mut point = |rng: &mut Rng| {
            let group = areas.pick(rng) as usize;
            let of_group = Weights::new(triangles.measure(mesh, group).0.to_vec());
            (triangles.at(triangles.group(group).start + of_group.pick(rng) as usize), random_point(rng))
        };
        if self.open_share(ground, PROBES, &mut rng, &mut point) >= RAIN_FROM {
            let mut darts = Vec::new();
            let in_chunk = |chunk: usize| {
                let mut darts = Vec::new();
                for &class in &self.members {
                    let groups = chunks.range(chunk).map(|group| (group, measures.areas[group]));
                    let rng = &mut Rng::at(seed, Draw::Fill, &[chunk as u64, class.into()]);
                    let indices = first_darts(mesh, ground.own(class).radius(), triangles, groups, rng);
                    let hit = indices.into_iter().map(|index| (triangles.at(index as usize), class));
                    darts.extend(hit.filter(|&(triangle, class)| self.places.allow(class, triangle)));
                }
                darts
            };
            job.part(0.0, 0.2).stream(chunks.len(), in_chunk, |mut part| {
                darts.append(&mut part);
                Ok(())
            })?;
            shuffle(&mut rng, &mut darts);
            let mut point =
                |triangle: u32, class: u8| Point { triangle, barycentrics: random_point(&mut rng), local: class };
            throw(ground, darts.iter().map(|&(triangle, class)| point(triangle, class)));
        }
        let balls = measures.balls(&job.part(0.2, 0.25), mesh, self.radius)?;
        // Class by class: what is looked at together is mostly of one.
        let mut open: Vec<Open<u8>> = self.members.iter().map(|_| Open::default()).collect();
        let in_chunk = |chunk: usize| -> Vec<Open<u8>> {
            let open_to = |&class: &u8| {
                let own = ground.own(class);
                let left = |&group: &usize| balls.is_none_or(|balls| !own.covers(&balls[group]));
                let indices = chunks.range(chunk).filter(left).flat_map(|group| triangles.group(group));
                self.open_of(ground, class, triangles, indices, &[])
            };
            self.members.iter().map(open_to).collect()
        };
        job.part(0.25, 0.5).stream(chunks.len(), in_chunk, |mut part| {
            open.iter_mut().zip(&mut part).for_each(|(open, part)| open.append(part));
            Ok(())
        })?;
        let job = job.part(0.5, 1.0);
        rounds(ground, joined(open), PATCH as f32, &mut rng, |round| job.report(1.0 - power(0.8, round as u32)))
    }

    /// The samples that a cube needs, and how many darts these took.
    fn fill_block(&self, block: &Block, set: &SampleSet) -> (Vec<Sample>, u64) {
        let (mesh, mut ground) = (self.places.mesh, self.ground(Some(&block.extent)));
        let mut rng = Rng::at(self.seed, Draw::Fill, &block.cube.key());
        let items = &block.items;
        let is_near = |sample: &&Sample| block.extent.is_in_reach(sample.position, self.layers.largest());
        set.around(block.cube).filter(is_near).for_each(|sample| ground.add(sample));
        let (mut row, radius) = (items.row(mesh), ground.own(self.members[0]).radius());
        let area = row.total();
        let mut point = |rng: &mut Rng| {
            let Point { triangle, barycentrics, .. } = row.point(rng);
            (triangle, barycentrics)
        };
        if area > 0.0 && self.open_share(&ground, PROBES_IN_CUBE, &mut rng, &mut point) >= RAIN_FROM {
            let expected = self.members.len() as f64 * FIRST_DARTS * area / (radius * radius);
            let darts = (0..(expected + rng.unit()) as usize).map(|_| {
                let ((triangle, barycentrics), class) = (point(&mut rng), self.random_class(&mut rng));
                Point { triangle, barycentrics, local: class }
            });
            throw(&mut ground, darts.filter(|point| self.places.allow(point.local, point.triangle)));
        }
        let open = |&class: &u8| match self.places.masks {
            None => {
                let own = ground.own(class);
                let left = items.indices_but(|ball| own.covers(ball));
                self.open_of(&ground, class, Triangles::Listed(&items.triangles), left, &items.pieces)
            }
            Some(_) => {
                let is_allowed = |&triangle: &u32| self.places.allow(class, triangle);
                let triangles: Vec<u32> = items.triangles.iter().copied().filter(is_allowed).collect();
                let pieces: Vec<_> = items.pieces.iter().copied().filter(|piece| is_allowed(&piece.triangle)).collect();
                let triangles = Triangles::Listed(&triangles);
                self.open_of(&ground, class, triangles, 0..triangles.len(), &pieces)
            }
        };
        let open = joined(self.members.iter().map(open).collect());
        let Ok(()) = rounds(&mut ground, open, PATCH as f32, &mut rng, |_| Ok::<(), std::convert::Infallible>(()));
        (ground.accepted, ground.darts)
    }

    /// What is open to a class of some triangles, by their indices, and of some pieces of others.
    fn open_of(
        &self,
        ground: &ClassGround,
        class: u8,
        triangles: Triangles,
        indices: impl Iterator<Item = usize>,
        pieces: &[Fragment],
    ) -> Open<u8> {
        let own = ground.own(class);
        let mut open = open_triangles(own, triangles, indices);
        pieces.iter().for_each(|piece| open_parts(own, piece, &mut open));
        if self.places.masks.is_some() {
            open.wholes.retain(|whole| self.places.allow(class, whole.triangle));
            open.patches.retain(|patch| self.places.allow(class, patch.fragment.triangle));
        }
        ground.open_in_all(class, &open)
    }
}

/// What is open to several classes, one after the other.
fn joined(parts: Vec<Open<u8>>) -> Open<u8> {
    let mut open = Open::default();
    parts.into_iter().for_each(|mut part| open.append(&mut part));
    open
}
