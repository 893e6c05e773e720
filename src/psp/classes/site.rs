//! The classes of a group, with radii that are constant or vary, and the surface on which they grow.

use crate::error::Result;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::classes::ground::ClassGround;
use crate::psp::classes::layers::{Layer, Layers};
use crate::psp::fill::{Block, FillOptions, Kinds, Measures, ONE_PIECE, Open, Site, Space, UniformGround, fill};
use crate::psp::fragment::Facing;
use crate::psp::given::Obstacles;
use crate::psp::levels::SurfaceSample;
use crate::psp::set::{RADIUS_SLACK, Sample, SampleSet, surface_samples};
use crate::rng::{Draw, Rng};

/// Cubes are so large that no radius is above this multiple of their own: half of the twelve between the samples
/// accepted in one cube and in the next of its colour.
const LARGEST: f64 = 6.0;

/// The surface, and the classes allowed on each triangle.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    pub mesh: &'a Mesh,
    /// A bit for each class, by triangle.
    pub masks: Option<&'a [u32]>,
    /// The given samples, for each class.
    pub given: &'a [Obstacles],
    /// No given samples.
    pub none: &'a Obstacles,
    pub facing: Facing,
}

impl Places<'_> {
    /// True if samples of a class may stand on a triangle.
    pub fn allow(&self, class: u8, triangle: u32) -> bool {
        self.masks.is_none_or(|masks| masks[triangle as usize] >> class & 1 == 1)
    }
}

/// A class, and what there is of it.
#[derive(Clone, Copy)]
pub struct Classed<L = ()> {
    pub class: u8,
    pub local: L,
}

/// The unit of the radii of classes on a surface: constant, or varying.
pub trait Unit: Copy + Sync {
    type Sample: Copy + SurfaceSample + Send + Sync;

    /// An upper estimate of the samples of one class of a radius.
    fn expected_samples(&self, mesh: &Mesh, radius: f64) -> f64;

    /// The least that a radius of 1 is anywhere.
    fn least(&self) -> f64;

    /// Adds samples of a group to those that there are, behind them, until none of its classes can take another one.
    /// Returns the number of darts.
    fn fill(
        group: &Group<Self>,
        job: &Job,
        samples: Vec<Self::Sample>,
        options: FillOptions,
    ) -> Result<(Vec<Self::Sample>, u64)>;
}

/// Classes of one own radius that are filled together.
pub struct Group<'a, U> {
    pub places: Places<'a>,
    pub unit: U,
    pub members: Vec<Classed>,
    pub radius: f64,
    /// The own radius of the last level.
    pub finest: f64,
    pub layers: Layers,
    /// The largest rank of the samples that are added, if they get ranks.
    pub largest_rank: Option<f64>,
}

impl<'a, U: Unit> Group<'a, U> {
    /// An upper estimate of its samples.
    pub fn expected_samples(&self) -> f64 {
        self.members.len() as f64 * self.unit.expected_samples(self.places.mesh, self.radius)
    }

    /// The radius that cubes are made for, where a radius may be `largest` times that.
    pub fn radius_of_cubes(&self, largest: f64) -> f64 {
        self.radius.max(self.layers.largest() / largest)
    }

    /// The largest radius at which a sample matters to another one.
    pub fn reach(&self) -> f64 {
        self.layers.largest().max(self.largest_rank.unwrap_or(0.0))
    }

    /// The largest rank as a radius of a layer. Without samples of the group it has no part in ranks.
    pub fn largest_rank_in(&self, layer: usize) -> Option<f64> {
        let Layer { radius, of, .. } = self.layers.all[layer];
        let has_members = self.members.iter().any(|member| of >> member.class & 1 == 1);
        self.largest_rank.filter(|_| has_members).map(|rank| rank * (radius / self.radius))
    }

    /// The given samples that are tested in a layer: in the own layers of classes.
    pub fn obstacles(&self, layer: usize) -> &'a Obstacles {
        self.members.get(layer).map_or(self.places.none, |member| &self.places.given[usize::from(member.class)])
    }
}

impl<U: Unit> Kinds for Group<'_, U> {
    type Kind = Classed;

    fn kinds(&self) -> &[Classed] {
        &self.members
    }

    fn random_kind(&self, rng: &mut Rng) -> Classed {
        self.members[rng.below(self.members.len() as u64) as usize]
    }

    fn allows(&self, member: Classed, triangle: u32) -> bool {
        self.places.allow(member.class, triangle)
    }
}

/// A unit of 1.
#[derive(Clone, Copy)]
pub struct Constant<'a> {
    pub measures: &'a Measures,
}

impl Unit for Constant<'_> {
    type Sample = Sample;

    fn expected_samples(&self, mesh: &Mesh, radius: f64) -> f64 {
        self.measures.expected_samples(mesh, radius)
    }

    fn least(&self) -> f64 {
        1.0
    }

    fn fill(group: &Group<Self>, job: &Job, samples: Vec<Sample>, options: FillOptions) -> Result<(Vec<Sample>, u64)> {
        let (mesh, in_blocks) = (group.places.mesh, group.expected_samples() > ONE_PIECE);
        let radius_of_cubes = group.radius_of_cubes(LARGEST);
        let mut set = if in_blocks {
            SampleSet::of(mesh, radius_of_cubes, &samples)
        } else {
            SampleSet::with(mesh, radius_of_cubes, samples)
        };
        let darts = fill(job, group, &mut set, in_blocks, options)?.darts;
        Ok((set.into_samples(), darts))
    }
}

/// The classes of a group with constant radii.
type UniformClasses<'a> = ClassGround<'a, UniformGround<'a>>;

impl Site for Group<'_, Constant<'_>> {
    type Ground<'b>
        = UniformClasses<'b>
    where
        Self: 'b;
    const NEIGHBOURS_COUNT: bool = true;

    fn mesh(&self) -> &Mesh {
        self.places.mesh
    }

    fn measures(&self) -> &Measures {
        self.unit.measures
    }

    fn is_bare(&self) -> bool {
        false
    }

    fn chunk_rng(&self, seed: u64, chunk: usize, member: Classed) -> Rng {
        Rng::at(seed, Draw::Fill, &[chunk as u64, member.class.into()])
    }

    fn reach(&self) -> f64 {
        Group::reach(self)
    }

    fn ground(&self, block: Option<&Block>) -> UniformClasses<'_> {
        let (Places { mesh, facing, .. }, extent) = (self.places, block.map(|block| &block.extent));
        ClassGround::new(self, |layer, radius| {
            let space = Space::new(mesh, radius * (1.0 + RADIUS_SLACK));
            let ground = UniformGround::new(mesh, space, extent, facing, self.obstacles(layer));
            ground.ranked(self.largest_rank_in(layer))
        })
    }

    fn add(ground: &mut UniformClasses, sample: &Sample) {
        ground.add(sample);
    }

    fn layer<'g>(ground: &'g UniformClasses<'_>, member: Classed) -> &'g UniformGround<'g> {
        ground.own(member.class)
    }

    fn narrowed(ground: &UniformClasses, member: Classed, open: Open) -> Open<Classed> {
        ground.open_in_all(member.class, &open)
    }
}

/// The samples with their classes, and with their ranks if they have some.
pub fn class_samples<S: SurfaceSample>(mesh: &Mesh, samples: &[S], is_ranked: bool) -> Points<3> {
    let samples = samples.iter().map(SurfaceSample::sample);
    let mut set = surface_samples(mesh, samples.clone());
    set.classes = samples.clone().map(|sample| sample.class.into()).collect();
    if is_ranked {
        set.ranks = samples.map(|sample| sample.rank).collect();
    }
    set
}
