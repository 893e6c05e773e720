//! What samples cover where the radius varies: the general case of `psp/fill/grid.rs`.
//!
//! A point p is covered by a sample s that is nearer than the mean of their radii. A sixteenth is covered if its centre
//! is nearer to s than half the radius of s and half the least radius of the fragment, less the sixteenth's extent: then
//! all of it is, whatever the radius is at its points.

use glam::DVec3;

use crate::mesh::{Mesh, exact};
use crate::psp::adaptive::field::{RadiusBounds, RadiusField};
use crate::psp::adaptive::grids::{Dot, OctaveGrids};
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::outline::{Nearby, Outline, SLACK};
use crate::psp::adaptive::set::HALF;
use crate::psp::adaptive::vectors;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::lanes::{FAR, LANES, PointLanes};
use crate::psp::patches::CoverTest;
use crate::psp::rain::Target;
use crate::psp::samples::Sample;
use crate::psp::vectors::within;
use crate::simd::Level;

/// How long, in local radii, the sixteenths of a partly covered patch are, whose sixteenths in turn it tells apart.
const FINE: f64 = 0.25;
/// The least radius on a patch stands for those on its sixteenths where the radius changes by no more than this share.
const FLAT: f64 = 0.05;
/// How much farther, in local radii, samples are gathered than a fragment needs: its neighbours will need them too.
const SPARE: f64 = 1.0;
/// At how many fragments a cube may look for each of its pieces and samples. Slopes of 1 take about a hundred, of 30 a
/// thousand: stating a far steeper one would mean waiting for hours.
const LOOKS: u64 = 1 << 12;

/// A fragment, and the radius on it.
#[derive(Clone, Copy)]
pub(super) struct GradedPart {
    fragment: Fragment,
    shape: Shape,
    bounds: RadiusBounds,
    /// Where the samples on the stack are seen from.
    origin: DVec3,
}

/// The samples in and around a cube, and those that are added to them.
pub(super) struct GradedCover<'a> {
    mesh: &'a Mesh,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    grids: &'a mut OctaveGrids,
    /// Distances are computed in a unit that is about the radius, the end of the octave.
    per_unit: f64,
    /// At how many fragments it may still look.
    looks: u64,
    /// The samples added, and where they are.
    added: Vec<Dot>,
    places: Vec<PointLanes>,
    level: Level,
    /// Where samples were gathered, how far around, for which normal, and how many were added before.
    centre: DVec3,
    reach: f64,
    gathered_for: [f32; 3],
    gathered: usize,
    stack: Vec<Nearby>,
}

impl<'a> GradedCover<'a> {
    pub fn new(
        mesh: &'a Mesh,
        field: &'a RadiusField<'a>,
        quota: &'a Quota,
        grids: &'a mut OctaveGrids,
        unit: f64,
    ) -> Self {
        Self {
            mesh,
            field,
            quota,
            grids,
            per_unit: 1.0 / unit,
            looks: 0,
            added: Vec::new(),
            places: Vec::new(),
            level: Level::widest(),
            centre: DVec3::ZERO,
            reach: f64::NEG_INFINITY,
            gathered_for: [0.0; 3],
            gathered: 0,
            stack: Vec::new(),
        }
    }

    /// Allows as many looks as a piece or a sample is worth.
    pub fn allow_looks(&mut self) {
        self.looks += LOOKS;
    }

    /// Counts a look at a fragment; the radii have failed where there are too many.
    fn look(&mut self, place: DVec3) {
        match self.looks.checked_sub(1) {
            Some(looks) => self.looks = looks,
            None => self.field.give_up(place),
        }
    }

    /// The normal of a triangle, where normals matter.
    fn normal(&self, triangle: u32) -> [f32; 3] {
        if self.grids.rule.asks_normals() { self.mesh.normal(triangle) } else { [0.0; 3] }
    }

    /// A part in units of the test.
    fn outline(&self, part: &GradedPart) -> Outline {
        Outline::new(&part.shape, part.bounds, part.origin, self.per_unit)
    }

    /// Pushes the samples in the stack from `from` on that can reach a fragment.
    fn push_reaching(&mut self, outline: &Outline, from: usize) {
        // All are copied, and those that reach it overwrite the others: a branch would be a guess.
        let (start, mut end) = (self.stack.len(), self.stack.len());
        self.stack.resize(2 * start - from, Nearby::default());
        for index in from..start {
            let sample = self.stack[index];
            self.stack[end] = sample;
            end += usize::from(outline.is_reached_by(&sample));
        }
        self.stack.truncate(end);
    }

    /// A point as seen from the first sample that was added, in units of the test.
    fn place(&self, point: DVec3) -> [f32; 3] {
        let first = self.added.first().map_or(point, |dot| exact(dot.position));
        ((point - first) * self.per_unit).as_vec3().to_array()
    }
}

impl CoverTest for GradedCover<'_> {
    type Part = GradedPart;
    type Radius = RadiusBounds;

    fn radius_on(&mut self, fragment: &Fragment, shape: &Shape) -> RadiusBounds {
        self.look(shape.centre);
        self.field.bounds(fragment, shape, self.field.all())
    }

    fn locate(&mut self, &fragment: &Fragment, &shape: &Shape, bounds: RadiusBounds) -> GradedPart {
        let reach = 0.5 * bounds.largest + shape.extent;
        let normal = self.normal(fragment.triangle);
        if self.reach < reach + self.centre.distance(shape.centre) || normal != self.gathered_for {
            (self.centre, self.reach) = (shape.centre, reach + SPARE * bounds.scale());
            (self.gathered_for, self.gathered) = (normal, self.added.len());
            self.stack.clear();
            let (stack, per_unit, reach) = (&mut self.stack, self.per_unit, self.reach);
            self.grids.near(self.centre, reach, normal, |offset, radius| {
                stack.push(Nearby::new(offset, radius, reach, per_unit));
            });
        }
        GradedPart { fragment, shape, bounds, origin: self.centre }
    }

    fn locate_among_added(
        &mut self,
        &fragment: &Fragment,
        &shape: &Shape,
        bounds: RadiusBounds,
        known: usize,
    ) -> GradedPart {
        let (origin, reach) = (shape.centre, 0.5 * bounds.largest + shape.extent);
        let normal = self.normal(fragment.triangle);
        let (place, farthest) = (self.place(shape.centre), (1.0 + SLACK) * (reach * self.per_unit + HALF));
        for (lanes, dots) in self.places.iter().zip(self.added.chunks(LANES)).skip(known / LANES) {
            let mut near = within(self.level, lanes, place, (farthest * farthest) as f32);
            while near != 0 {
                let dot = &dots[near.trailing_zeros() as usize];
                let (offset, limit) = (exact(dot.position) - origin, reach + 0.5 * dot.radius);
                if offset.length_squared() <= limit * limit && self.grids.rule.sees(dot.normal, normal) {
                    self.stack.push(Nearby::new(offset, dot.radius, reach, self.per_unit));
                }
                near &= near - 1;
            }
        }
        GradedPart { fragment, shape, bounds, origin }
    }

    fn sixteenth(&mut self, part: &GradedPart, index: usize) -> GradedPart {
        let (fragment, shape) = (part.fragment.sixteenth(index), part.shape.sixteenth(index));
        self.look(shape.centre);
        GradedPart { fragment, shape, bounds: self.field.bounds(&fragment, &shape, part.bounds), origin: part.origin }
    }

    fn open_sixteenths(&mut self, part: &GradedPart, from: usize) -> u16 {
        if self.field.has_failed() {
            return 0;
        }
        let (outline, start) = (self.outline(part), self.stack.len());
        self.push_reaching(&outline, from);
        vectors::open_sixteenths(self.level, &outline, &self.stack[start..])
    }

    fn take_covered(&mut self, part: &GradedPart, from: usize, open: &mut [u16; 16]) {
        let (outline, start) = (self.outline(part), self.stack.len());
        self.push_reaching(&outline, from);
        let is_flat = part.bounds.largest - part.bounds.least <= FLAT * part.bounds.scale();
        for (index, open) in open.iter_mut().enumerate().filter(|(_, open)| **open != 0) {
            let sixteenth = if is_flat {
                outline.sixteenth(index)
            } else {
                let part = self.sixteenth(part, index);
                self.outline(&part)
            };
            *open &= vectors::open_sixteenths(self.level, &sixteenth, &self.stack[start..]);
        }
        self.stack.truncate(start);
    }

    fn radius(&self, part: &GradedPart) -> RadiusBounds {
        part.bounds
    }

    fn is_fine(&self, longest: f64, bounds: RadiusBounds) -> bool {
        // What is proved covered falls short by what the radius changes on a sixteenth.
        longest + 0.25 * (bounds.largest - bounds.least) <= 4.0 * FINE * bounds.middle()
    }

    fn added(&self) -> usize {
        self.added.len()
    }

    fn gathered(&self) -> usize {
        self.gathered
    }

    fn height(&self) -> usize {
        self.stack.len()
    }

    fn truncate(&mut self, height: usize) {
        self.stack.truncate(height);
    }
}

impl Target for GradedCover<'_> {
    /// A sample and its radius.
    type Dart = (Sample, f64);

    /// It rains as densely as samples will stand: this is the mean of 1 / radius² where the radius grows evenly.
    fn density(&self, bounds: RadiusBounds) -> f64 {
        1.0 / (bounds.least * bounds.largest)
    }

    fn dart(&self, sample: Sample, bounds: RadiusBounds) -> (Sample, f64) {
        (sample, self.field.at_within(&sample, bounds))
    }

    fn add(&mut self, &(sample, radius): &(Sample, f64)) -> bool {
        let dot = Dot { position: sample.position, radius, normal: self.normal(sample.triangle) };
        if self.grids.rejects(&dot) {
            return false;
        }
        self.grids.add(dot);
        let (place, lane) = (self.place(exact(dot.position)), self.added.len() % LANES);
        if lane == 0 {
            self.places.push([[FAR; LANES]; 3]);
        }
        (0..3).for_each(|axis| self.places[self.added.len() / LANES][axis][lane] = place[axis]);
        self.added.push(dot);
        self.quota.take(1);
        self.allow_looks();
        true
    }

    fn is_futile(&self) -> bool {
        self.field.has_failed() || self.quota.is_exceeded()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::adaptive::grids::ConflictRule;
    use crate::psp::adaptive::radius::Radius;
    use crate::rng::{Draw, Rng};

    /// Against exact distances to the corners of every sixteenth: what is covered by no single sample is kept, and what
    /// is covered with its extent to spare is dropped.
    #[test]
    fn only_covered_sixteenths_are_dropped_and_all_that_are_well_covered() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let (mut kept, mut dropped) = (0, 0);
        for round in 0..3000 {
            let (size, ratio) = ([1.0, 0.1, 1e-3][round % 3], [1.0, 8.0, 500.0f64][round / 3 % 3]);
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            let mesh = Mesh::new(vec![corner(), corner(), corner()], vec![[0, 1, 2]]).unwrap();
            let radii: [f32; 3] = std::array::from_fn(|_| (1.0 + 0.5 * rng.unit()) as f32);
            let field = RadiusField::new(&mesh, Radius::PerVertex(&radii)).unwrap();
            let (mut grids, mut dots) = (OctaveGrids::new(ConflictRule { cosine: -1.0 }), Vec::new());
            for _ in 0..6 {
                let radius = ratio.powf(rng.unit());
                let position = std::array::from_fn(|_| (8.0 + 1.2 * radius * (2.0 * rng.unit() - 1.0)) as f32);
                grids.add(Dot { position, radius, normal: [0.0; 3] });
                dots.push((exact(position), radius));
            }
            let (whole, unit) = (Fragment::whole(0), 2.0);
            let shape = whole.shape(&mesh);
            let bounds = field.bounds(&whole, &shape, field.all());
            let quota = Quota::new(1.0, &mesh);
            let mut test = GradedCover::new(&mesh, &field, &quota, &mut grids, unit);
            let part = test.locate(&whole, &shape, bounds);
            let open = test.open_sixteenths(&part, 0);
            for index in 0..16 {
                let part = whole.sixteenth(index).shape(&mesh);
                let is_covered = dots.iter().any(|&(centre, radius)| {
                    part.corners.iter().all(|corner| corner.distance(centre) < 0.5 * (bounds.least + radius))
                });
                let well = dots.iter().any(|&(centre, radius)| {
                    let limit = 0.5 * (bounds.least + radius) - part.extent - 4.0 * SLACK * (radius + 4.0);
                    part.centre.distance(centre) < limit && limit > part.extent
                });
                let is_open = open >> index & 1 == 1;
                assert!(is_open || is_covered);
                assert!(!(is_open && well));
                kept += u32::from(is_open);
                dropped += u32::from(!is_open);
            }
        }
        assert!(kept > 5000 && dropped > 5000, "{kept} {dropped}");
    }
}
