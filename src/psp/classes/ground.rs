//! A surface on which the classes of a group grow together.
//!
//! There is a copy of the surface for each class: a part can be open to one class and covered for another. Each layer
//! by itself is a ground of the fill, of one radius or of varying ones, and a dart or a part of the surface is tested in
//! the layers of its class.
//!
//! Darts for all classes of the group are thrown at one density and in random order, the first ones and those of each
//! round, so that no class has an advantage.

use crate::math::rounded_down;
use crate::mesh::Mesh;
use crate::psp::classes::layers::Layers;
use crate::psp::classes::site::{Classed, Group, Places};
use crate::psp::fill::{BATCH, Ground, Layer, Open, Patch, Point, WholeTriangle};
use crate::psp::fragment::Fragment;
use crate::psp::levels::SurfaceSample;
use crate::psp::set::Sample;

/// The surface with the samples of all classes.
pub struct ClassGround<'a, G: Layer> {
    places: &'a Places<'a>,
    layers: &'a Layers,
    /// The own radius of the group, and a bit for each of its classes.
    radius: f64,
    members: u32,
    grounds: Vec<G>,
    /// The samples that the fill has added.
    accepted: Vec<G::Sample>,
    /// The number of darts thrown.
    darts: u64,
}

impl<'a, G: Layer<Sample: SurfaceSample + Copy>> ClassGround<'a, G> {
    /// The surface without samples, given the grounds of the layers of a group.
    pub fn new<R>(group: &'a Group<R>, ground: impl Fn(usize, f64) -> G) -> Self {
        let Group { places, layers, radius, .. } = group;
        let grounds = (0..layers.all.len()).map(|layer| ground(layer, layers.all[layer].radius)).collect();
        let members = group.members.iter().fold(0, |bits, member| bits | 1 << member.class);
        Self { places, layers, radius: *radius, members, grounds, accepted: Vec::new(), darts: 0 }
    }

    /// The surface with the samples that have the own radius of a class.
    pub fn own(&self, class: u8) -> &G {
        &self.grounds[self.layers.of_class[usize::from(class)][0]]
    }

    /// Adds a sample that is there already.
    pub fn add(&mut self, sample: &G::Sample) {
        for (layer, ground) in self.layers.all.iter().zip(&mut self.grounds) {
            if layer.of >> sample.sample().class & 1 == 1 {
                ground.add(sample);
            }
        }
    }

    /// The rank of a sample that is added now: how large the own radius may be for it to conflict with no sample of the
    /// group.
    fn rank(&self, class: u8, sample: &G::Sample) -> f32 {
        let in_group = |layer: &&usize| self.layers.all[**layer].of & self.members != 0;
        let rank = |&layer: &usize| self.grounds[layer].rank(sample) * (self.radius / self.layers.all[layer].radius);
        let layers = &self.layers.of_class[usize::from(class)];
        rounded_down(layers.iter().filter(in_group).map(rank).fold(f64::INFINITY, f64::min))
    }

    /// True if a sample of a class conflicts with another one.
    fn rejects(&self, class: u8, sample: &G::Sample) -> bool {
        self.layers.of_class[usize::from(class)].iter().any(|&layer| self.grounds[layer].rejects(sample))
    }

    /// Those of the open parts of the own layer of a class that are open in all others.
    pub fn open_in_all(&self, class: u8, open: &Open<G::Local>) -> Open<Classed<G::Local>> {
        let mut all = Open::default();
        for wholes in open.wholes.chunks(BATCH) {
            let mut bits = self.open_in_others(class, wholes, u64::MAX >> (BATCH - wholes.len()));
            while bits != 0 {
                let &WholeTriangle { triangle, area, longest, local } = &wholes[bits.trailing_zeros() as usize];
                all.wholes.push(WholeTriangle { triangle, area, longest, local: Classed { class, local } });
                bits &= bits - 1;
            }
        }
        all.patches.extend(open.patches.iter().filter_map(|patch| self.patch_in_others(class, patch)));
        all
    }

    /// The layers of a class except its own.
    fn others(&self, class: u8) -> impl Iterator<Item = &G> {
        self.layers.of_class[usize::from(class)][1..].iter().map(|&layer| &self.grounds[layer])
    }

    /// Those of some open triangles that are open in all layers but the own one: a bit for each.
    fn open_in_others(&self, class: u8, wholes: &[WholeTriangle<G::Local>], mut open: u64) -> u64 {
        for ground in self.others(class) {
            if open == 0 {
                break;
            }
            open &= ground.open_wholes(wholes);
        }
        open
    }

    /// A patch of the own layer as far as it is open in all others.
    fn patch_in_others(&self, class: u8, patch: &Patch<G::Local>) -> Option<Patch<Classed<G::Local>>> {
        let open = self.open_parts_in_others(class, patch, patch.open);
        let &Patch { fragment, area, longest, local, .. } = patch;
        (open != 0).then_some(Patch { fragment, open, area, longest, local: Classed { class, local } })
    }

    fn open_parts_in_others(&self, class: u8, patch: &Patch<G::Local>, mut open: u16) -> u16 {
        let own = self.own(class).radius();
        for ground in self.others(class) {
            let longest = (f64::from(patch.longest) * own / ground.radius()) as f32;
            if open != 0 && ground.may_cover(longest) {
                open = ground.open_sixteenths(&Patch { open, longest, ..*patch });
            }
        }
        open
    }
}

/// A whole without its class, as the layers take it.
fn plain<L: Copy>(&WholeTriangle { triangle, area, longest, local }: &WholeTriangle<Classed<L>>) -> WholeTriangle<L> {
    WholeTriangle { triangle, area, longest, local: local.local }
}

/// A patch without its class, as the layers take it.
fn plain_patch<L: Copy>(&Patch { fragment, open, area, longest, local }: &Patch<Classed<L>>) -> Patch<L> {
    Patch { fragment, open, area, longest, local: local.local }
}

impl<G: Layer<Sample: SurfaceSample + Copy>> Ground for ClassGround<'_, G> {
    type Local = Classed<G::Local>;
    type Dart = Classed<G::Dart>;
    type Sample = G::Sample;

    fn finest(&self, Classed { class, local }: Classed<G::Local>) -> f32 {
        self.own(class).finest(local)
    }

    fn patch(&self, fragment: &Fragment, Classed { class, local }: Classed<G::Local>) -> Option<Patch<Self::Local>> {
        self.own(class).patch(fragment, local).and_then(|patch| self.patch_in_others(class, &patch))
    }

    fn subdivide(&self, patch: &Patch<Self::Local>, patches: &mut Vec<Patch<Self::Local>>) {
        let (class, mut parts) = (patch.local.class, Vec::new());
        self.own(class).subdivide(&plain_patch(patch), &mut parts);
        patches.extend(parts.iter().filter_map(|part| self.patch_in_others(class, part)));
    }

    fn open_sixteenths(&self, patch: &Patch<Self::Local>) -> u16 {
        let (class, plain) = (patch.local.class, plain_patch(patch));
        let open = self.own(class).open_sixteenths(&plain);
        self.open_parts_in_others(class, &plain, open)
    }

    fn open_wholes(&self, wholes: &[WholeTriangle<Self::Local>]) -> u64 {
        let (mut open, mut start) = (0, 0);
        for run in wholes.chunk_by(|a, b| a.local.class == b.local.class) {
            let (class, plain): (_, Vec<WholeTriangle<G::Local>>) =
                (run[0].local.class, run.iter().map(plain).collect());
            let of_run = self.own(class).open_wholes(&plain);
            open |= self.open_in_others(class, &plain, of_run) << start;
            start += run.len();
        }
        open
    }

    fn mesh(&self) -> &Mesh {
        self.places.mesh
    }

    fn dart(&self, point: Point<Self::Local>, corners: &[[f32; 3]; 3]) -> Classed<G::Dart> {
        let (class, Point { triangle, barycentrics, local }) = (point.local.class, point);
        Classed { class, local: self.own(class).dart(Point { triangle, barycentrics, local: local.local }, corners) }
    }

    fn throw(&mut self, Classed { class, local: dart }: Classed<G::Dart>) {
        self.darts += 1;
        if let Some(mut sample) = self.own(class).settled(&dart, |sample| self.rejects(class, sample)) {
            let rank = self.rank(class, &sample);
            *sample.sample_mut() = Sample { rank, class, ..*sample.sample() };
            self.add(&sample);
            self.accepted.push(sample);
        }
    }

    fn is_open(&self, point: Point<Self::Local>) -> bool {
        let (class, triangle) = (point.local.class, point.triangle);
        let least = || self.own(class).least(&self.dart_at(point).local);
        self.places.allow(class, triangle) && !self.rejects(class, &least())
    }

    fn into_accepted(self) -> (Vec<G::Sample>, u64) {
        (self.accepted, self.darts)
    }
}
