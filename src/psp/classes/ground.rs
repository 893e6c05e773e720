//! A surface on which the classes of a group grow together, as the rounds of a fill know it (`psp/fill/ground.rs`).
//!
//! It is the surface in as many copies as there are classes: a part of it is open to one class and not to another. Each
//! layer is a surface of one radius by itself, and a dart or a part of the surface is asked after in those of its class.

use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::classes::layers::Layers;
use crate::psp::facing::Facing;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::ground::{Ground, Patch, Point, UniformGround, Whole};
use crate::psp::fill::page::GROUP;
use crate::psp::fill::rounds::Open;
use crate::psp::fill::space::Space;
use crate::psp::fragment::Fragment;
use crate::psp::obstacles::Obstacles;
use crate::psp::samples::{RADIUS_SLACK, Sample};

/// The surface with the samples of all classes.
pub(super) struct ClassGround<'a> {
    mesh: &'a Mesh,
    layers: &'a Layers,
    grounds: Vec<UniformGround<'a>>,
    /// The samples that the fill has added.
    pub accepted: Vec<Sample>,
    /// How many darts it took.
    pub darts: u64,
}

impl<'a> ClassGround<'a> {
    /// No samples yet, but those given for each class.
    pub fn new(
        mesh: &'a Mesh,
        extent: Option<&Extent>,
        layers: &'a Layers,
        facing: Facing,
        given: &'a [Obstacles],
        none: &'a Obstacles,
    ) -> Self {
        let obstacles = |layer: usize| {
            layers.of_class.iter().position(|layers| layers.first() == Some(&layer)).map_or(none, |class| &given[class])
        };
        let ground = |layer: usize| {
            let space = Space::new(mesh, layers.all[layer].radius * (1.0 + RADIUS_SLACK));
            UniformGround::new(mesh, space, extent, facing, obstacles(layer))
        };
        let grounds = (0..layers.all.len()).map(ground).collect();
        Self { mesh, layers, grounds, accepted: Vec::new(), darts: 0 }
    }

    /// The surface with the samples that have the own radius of a class.
    pub fn own(&self, class: u8) -> &UniformGround<'a> {
        &self.grounds[self.layers.of_class[usize::from(class)][0]]
    }

    /// Tells the ground of a sample that is there already.
    pub fn add(&mut self, sample: &Sample) {
        for (layer, ground) in self.layers.all.iter().zip(&mut self.grounds) {
            if layer.of >> sample.class & 1 == 1 {
                ground.add(sample);
            }
        }
    }

    /// Whether a dart conflicts with a sample.
    fn rejects(&self, dart: &Sample) -> bool {
        self.layers.of_class[usize::from(dart.class)].iter().any(|&layer| self.grounds[layer].rejects(dart))
    }

    /// Whether a sample of a class cannot stand at a point of a triangle.
    pub fn is_taken(&self, triangle: u32, barycentrics: [f64; 2], class: u8) -> bool {
        self.rejects(&self.dart_at(Point { triangle, barycentrics, local: class }))
    }

    /// Of what is open in the own layer of a class, that which is open in all others.
    pub fn open_in_all(&self, class: u8, open: &Open) -> Open<u8> {
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

    /// The layers of a class but its own.
    fn others(&self, class: u8) -> impl Iterator<Item = &UniformGround<'a>> {
        self.layers.of_class[usize::from(class)][1..].iter().map(|&layer| &self.grounds[layer])
    }

    /// Which of some open triangles are open in all layers but the own one: a bit for each.
    fn open_in_others(&self, class: u8, wholes: &[Whole], mut open: u64) -> u64 {
        for ground in self.others(class) {
            if open == 0 {
                break;
            }
            open &= ground.open_wholes(wholes);
        }
        open
    }

    /// What is open of a patch of the own layer in all others.
    fn patch_in_others(&self, class: u8, patch: &Patch) -> Option<Patch<u8>> {
        let open = self.open_parts_in_others(class, patch, patch.open);
        let &Patch { fragment, area, longest, .. } = patch;
        (open != 0).then_some(Patch { fragment, open, area, longest, local: class })
    }

    fn open_parts_in_others(&self, class: u8, patch: &Patch, mut open: u16) -> u16 {
        let own = self.own(class).radius();
        for ground in self.others(class) {
            let longest = (f64::from(patch.longest) * own / ground.radius()) as f32;
            // No ball holds what is longer than its diameter, and the longest edge of a sixteenth is a quarter.
            if open != 0 && longest <= 8.01 {
                open = ground.open_sixteenths(&Patch { open, longest, ..*patch });
            }
        }
        open
    }
}

/// A whole as the layers know it.
fn plain(&Whole { triangle, area, longest, .. }: &Whole<u8>) -> Whole {
    Whole { triangle, area, longest, local: () }
}

/// A patch as the layers know it.
fn plain_patch(&Patch { fragment, open, area, longest, .. }: &Patch<u8>) -> Patch {
    Patch { fragment, open, area, longest, local: () }
}

impl Ground for ClassGround<'_> {
    /// The class, all of which in a group have the same own radius.
    type Local = u8;
    type Dart = Sample;

    fn finest(&self, class: u8) -> f32 {
        self.own(class).finest(())
    }

    fn look(&self, fragment: &Fragment, class: u8) -> Option<Patch<u8>> {
        self.own(class).look(fragment, ()).and_then(|patch| self.patch_in_others(class, &patch))
    }

    fn look_closer(&self, patch: &Patch<u8>, grown: &mut Vec<Patch<u8>>) {
        let mut parts = Vec::new();
        self.own(patch.local).look_closer(&plain_patch(patch), &mut parts);
        grown.extend(parts.iter().filter_map(|part| self.patch_in_others(patch.local, part)));
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
        self.mesh
    }

    fn dart(&self, point: Point<u8>, corners: &[[f32; 3]; 3]) -> Sample {
        let barycentrics = round_barycentrics(point.barycentrics);
        Sample { class: point.local, ..Sample::on(corners, point.triangle, barycentrics) }
    }

    fn throw(&mut self, sample: Sample) {
        self.darts += 1;
        if !self.rejects(&sample) {
            self.add(&sample);
            self.accepted.push(sample);
        }
    }
}
