//! A surface on which the classes of a group grow together.
//!
//! There is a copy of the surface for each class: a part can be open to one class and covered for another. Each layer
//! by itself is a surface of one radius, and a dart or a part of the surface is tested in the layers of its class.
//!
//! Darts for all classes of the group are thrown at one density and in random order, the first ones and those of each
//! round, so that no class has an advantage.

use crate::error::Result;
use crate::job::Job;
use crate::math::rounded_down;
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::classes::layers::Layers;
use crate::psp::fill::{
    Block, Extent, FillOptions, GROUP, Ground, Measures, ONE_PIECE, Open, Patch, Point, Site, Space, UniformGround,
    Whole, fill,
};
use crate::psp::fragment::{Facing, Fragment};
use crate::psp::given::Obstacles;
use crate::psp::set::{RADIUS_SLACK, Sample, SampleSet};
use crate::rng::{Draw, Rng};

/// Cubes are so large that no radius is above this multiple of their own: half of the twelve between the samples
/// accepted in one cube and in the next of its colour.
const LARGEST: f64 = 6.0;

/// The surface, and the classes allowed on each triangle.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    pub mesh: &'a Mesh,
    pub measures: &'a Measures,
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
    fn allow(&self, class: u8, triangle: u32) -> bool {
        self.masks.is_none_or(|masks| masks[triangle as usize] >> class & 1 == 1)
    }
}

/// Classes of one own radius that are filled together.
pub struct Group<'a> {
    pub places: Places<'a>,
    pub members: Vec<u8>,
    pub radius: f64,
    pub layers: Layers,
    /// The largest rank of the samples that are added, if they get ranks.
    pub largest_rank: Option<f64>,
}

impl Group<'_> {
    /// An upper estimate of its samples.
    pub fn expected_samples(&self) -> f64 {
        let Places { mesh, measures, .. } = self.places;
        self.members.len() as f64 * measures.expected_samples(mesh, self.radius)
    }

    /// Adds samples of the group to those that there are, behind them, until none of its classes can take another one.
    /// Returns the number of darts.
    pub fn fill(&self, job: &Job, samples: Vec<Sample>, options: FillOptions) -> Result<(Vec<Sample>, u64)> {
        let (mesh, in_blocks) = (self.places.mesh, self.expected_samples() > ONE_PIECE);
        let radius_of_cubes = self.radius.max(self.layers.largest() / LARGEST);
        let mut set = if in_blocks {
            SampleSet::of(mesh, radius_of_cubes, &samples)
        } else {
            SampleSet::with(mesh, radius_of_cubes, samples)
        };
        let darts = fill(job, self, &mut set, in_blocks, options)?.darts;
        Ok((set.into_samples(), darts))
    }
}

impl Site for Group<'_> {
    type Kind = u8;
    type Ground<'b>
        = ClassGround<'b>
    where
        Self: 'b;
    const NEIGHBOURS_COUNT: bool = true;

    fn mesh(&self) -> &Mesh {
        self.places.mesh
    }

    fn measures(&self) -> &Measures {
        self.places.measures
    }

    fn is_bare(&self) -> bool {
        false
    }

    fn kinds(&self) -> &[u8] {
        &self.members
    }

    fn random_kind(&self, rng: &mut Rng) -> u8 {
        self.members[rng.below(self.members.len() as u64) as usize]
    }

    fn allows(&self, class: u8, triangle: u32) -> bool {
        self.places.allow(class, triangle)
    }

    fn chunk_rng(&self, seed: u64, chunk: usize, class: u8) -> Rng {
        Rng::at(seed, Draw::Fill, &[chunk as u64, class.into()])
    }

    fn reach(&self) -> f64 {
        self.layers.largest().max(self.largest_rank.unwrap_or(0.0))
    }

    fn ground(&self, block: Option<&Block>) -> ClassGround<'_> {
        ClassGround::new(self, block.map(|block| &block.extent))
    }

    fn add(ground: &mut ClassGround, sample: &Sample) {
        ground.add(sample);
    }

    fn layer<'g>(ground: &'g ClassGround<'_>, class: u8) -> &'g UniformGround<'g> {
        ground.own(class)
    }

    fn narrowed(ground: &ClassGround, class: u8, open: Open) -> Open<u8> {
        ground.open_in_all(class, &open)
    }
}

/// The surface with the samples of all classes.
pub struct ClassGround<'a> {
    places: &'a Places<'a>,
    layers: &'a Layers,
    /// The own radius of the group, and a bit for each of its classes.
    radius: f64,
    members: u32,
    grounds: Vec<UniformGround<'a>>,
    /// The samples that the fill has added.
    accepted: Vec<Sample>,
    /// The number of darts thrown.
    darts: u64,
}

impl<'a> ClassGround<'a> {
    /// A ground without samples but those given for each class.
    fn new(group: &'a Group<'a>, extent: Option<&Extent>) -> Self {
        let Group { places, layers, members, radius, largest_rank } = group;
        let &Places { mesh, facing, given, none, .. } = places;
        let obstacles = |layer: usize| {
            layers.of_class.iter().position(|layers| layers.first() == Some(&layer)).map_or(none, |class| &given[class])
        };
        let ground = |layer: usize| {
            let space = Space::new(mesh, layers.all[layer].radius * (1.0 + RADIUS_SLACK));
            let largest = largest_rank.map(|rank| rank * (layers.all[layer].radius / radius));
            UniformGround::new(mesh, space, extent, facing, obstacles(layer)).ranked(largest)
        };
        let grounds = (0..layers.all.len()).map(ground).collect();
        let members = members.iter().fold(0, |bits, class| bits | 1 << class);
        Self { places, layers, radius: *radius, members, grounds, accepted: Vec::new(), darts: 0 }
    }

    /// The surface with the samples that have the own radius of a class.
    fn own(&self, class: u8) -> &UniformGround<'a> {
        &self.grounds[self.layers.of_class[usize::from(class)][0]]
    }

    /// Adds a sample that is there already.
    fn add(&mut self, sample: &Sample) {
        for (layer, ground) in self.layers.all.iter().zip(&mut self.grounds) {
            if layer.of >> sample.class & 1 == 1 {
                ground.add(sample);
            }
        }
    }

    /// The rank of a sample that is added now: how large the own radius may be for it to conflict with no sample of the
    /// group.
    fn rank(&self, sample: &Sample) -> f32 {
        let in_group = |layer: &&usize| self.layers.all[**layer].of & self.members != 0;
        let rank = |&layer: &usize| self.grounds[layer].rank(sample) * (self.radius / self.layers.all[layer].radius);
        let layers = &self.layers.of_class[usize::from(sample.class)];
        rounded_down(layers.iter().filter(in_group).map(rank).fold(f64::INFINITY, f64::min))
    }

    /// True if a dart conflicts with a sample.
    fn rejects(&self, dart: &Sample) -> bool {
        self.layers.of_class[usize::from(dart.class)].iter().any(|&layer| self.grounds[layer].rejects(dart))
    }

    /// Those of the open parts of the own layer of a class that are open in all others.
    fn open_in_all(&self, class: u8, open: &Open) -> Open<u8> {
        let mut all = Open::default();
        for wholes in open.wholes.chunks(GROUP) {
            let mut bits = self.open_in_others(class, wholes, u64::MAX >> (GROUP - wholes.len()));
            while bits != 0 {
                let &Whole { triangle, area, longest, .. } = &wholes[bits.trailing_zeros() as usize];
                all.wholes.push(Whole { triangle, area, longest, local: class });
                bits &= bits - 1;
            }
        }
        all.patches.extend(open.patches.iter().filter_map(|patch| self.patch_in_others(class, patch)));
        all
    }

    /// The layers of a class except its own.
    fn others(&self, class: u8) -> impl Iterator<Item = &UniformGround<'a>> {
        self.layers.of_class[usize::from(class)][1..].iter().map(|&layer| &self.grounds[layer])
    }

    /// Those of some open triangles that are open in all layers but the own one: a bit for each.
    fn open_in_others(&self, class: u8, wholes: &[Whole], mut open: u64) -> u64 {
        for ground in self.others(class) {
            if open == 0 {
                break;
            }
            open &= ground.open_wholes(wholes);
        }
        open
    }

    /// A patch of the own layer as far as it is open in all others.
    fn patch_in_others(&self, class: u8, patch: &Patch) -> Option<Patch<u8>> {
        let open = self.open_parts_in_others(class, patch, patch.open);
        let &Patch { fragment, area, longest, .. } = patch;
        (open != 0).then_some(Patch { fragment, open, area, longest, local: class })
    }

    fn open_parts_in_others(&self, class: u8, patch: &Patch, mut open: u16) -> u16 {
        let own = self.own(class).radius();
        for ground in self.others(class) {
            let longest = (f64::from(patch.longest) * own / ground.radius()) as f32;
            // No ball contains a part longer than its diameter, and the longest edge of a sixteenth is a quarter.
            if open != 0 && longest <= 8.01 {
                open = ground.open_sixteenths(&Patch { open, longest, ..*patch });
            }
        }
        open
    }
}

/// A whole without its class, as the layers take it.
fn plain(&Whole { triangle, area, longest, .. }: &Whole<u8>) -> Whole {
    Whole { triangle, area, longest, local: () }
}

/// A patch without its class, as the layers take it.
fn plain_patch(&Patch { fragment, open, area, longest, .. }: &Patch<u8>) -> Patch {
    Patch { fragment, open, area, longest, local: () }
}

impl Ground for ClassGround<'_> {
    /// The class; all classes of a group have the same own radius.
    type Local = u8;
    type Dart = Sample;
    type Sample = Sample;

    fn finest(&self, class: u8) -> f32 {
        self.own(class).finest(())
    }

    fn patch(&self, fragment: &Fragment, class: u8) -> Option<Patch<u8>> {
        self.own(class).patch(fragment, ()).and_then(|patch| self.patch_in_others(class, &patch))
    }

    fn subdivide(&self, patch: &Patch<u8>, patches: &mut Vec<Patch<u8>>) {
        let mut parts = Vec::new();
        self.own(patch.local).subdivide(&plain_patch(patch), &mut parts);
        patches.extend(parts.iter().filter_map(|part| self.patch_in_others(patch.local, part)));
    }

    fn open_sixteenths(&self, patch: &Patch<u8>) -> u16 {
        let plain = plain_patch(patch);
        let open = self.own(patch.local).open_sixteenths(&plain);
        self.open_parts_in_others(patch.local, &plain, open)
    }

    fn open_wholes(&self, wholes: &[Whole<u8>]) -> u64 {
        let (mut open, mut start) = (0, 0);
        for run in wholes.chunk_by(|a, b| a.local == b.local) {
            let (class, plain): (_, Vec<Whole>) = (run[0].local, run.iter().map(plain).collect());
            let of_run = self.own(class).open_wholes(&plain);
            open |= self.open_in_others(class, &plain, of_run) << start;
            start += run.len();
        }
        open
    }

    fn mesh(&self) -> &Mesh {
        self.places.mesh
    }

    fn dart(&self, point: Point<u8>, corners: &[[f32; 3]; 3]) -> Sample {
        let barycentrics = round_barycentrics(point.barycentrics);
        Sample { class: point.local, ..Sample::on(corners, point.triangle, barycentrics) }
    }

    fn throw(&mut self, sample: Sample) {
        self.darts += 1;
        if !self.rejects(&sample) {
            let sample = Sample { rank: self.rank(&sample), ..sample };
            self.add(&sample);
            self.accepted.push(sample);
        }
    }

    fn is_open(&self, point: Point<u8>) -> bool {
        self.places.allow(point.local, point.triangle) && !self.rejects(&self.dart_at(point))
    }

    fn into_accepted(self) -> (Vec<Sample>, u64) {
        (self.accepted, self.darts)
    }
}
