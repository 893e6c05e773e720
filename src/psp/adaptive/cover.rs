//! What samples cover where the radius varies: the general case of `psp/uniform_cover.rs`.
//!
//! A point p is covered by a sample s that is nearer than the mean of their radii. A sixteenth is covered if its centre
//! is nearer to s than half the radius of s and half the least radius of the fragment, less the sixteenth's extent: then
//! all of it is, whatever the radius is at its points.

use glam::{DVec3, Vec3};

use crate::mesh::{Mesh, exact};
use crate::psp::adaptive::field::{RadiusBounds, RadiusField};
use crate::psp::adaptive::grids::{Dot, OctaveGrids};
use crate::psp::adaptive::limits::Quota;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::patches::CoverTest;
use crate::psp::rain::Target;
use crate::psp::samples::Sample;
use crate::psp::sixteenths::SIXTEENTHS;
use crate::rng::Rng;

/// How much, as a share of the distances at hand, rounding can add to a distance, and some more.
const SLACK: f64 = 1e-5;
/// How much farther, in local radii, samples are gathered than a fragment needs: its neighbours will need them too.
const SPARE: f64 = 1.0;
/// At how many fragments a cube may look for each of its pieces and samples. Slopes of 1 take about a hundred, of 30 a
/// thousand: a caller who states a far steeper one would wait for hours.
const LOOKS: u64 = 1 << 12;

/// The centres of the sixteenths as seen from the centre of the fragment, in edges, one axis after the other.
const CENTRES: [[f32; 16]; 2] = {
    let mut centres = [[0.0; 16]; 2];
    let mut index = 0;
    while index < 16 {
        let [a, b, c] = SIXTEENTHS[index];
        centres[0][index] = ((a[0] + b[0] + c[0]) / 12.0 - 1.0 / 3.0) as f32;
        centres[1][index] = ((a[1] + b[1] + c[1]) / 12.0 - 1.0 / 3.0) as f32;
        index += 1;
    }
    centres
};

/// A fragment, and the radius on it.
#[derive(Clone, Copy)]
pub(super) struct GradedPart {
    fragment: Fragment,
    shape: Shape,
    bounds: RadiusBounds,
    /// Where the samples on the stack are seen from.
    origin: DVec3,
}

/// A sample near a fragment, in units of the test.
#[derive(Clone, Copy, Default)]
struct Nearby {
    offset: Vec3,
    /// Half of its radius, less what rounding can add to distances from it.
    half: f32,
}

/// The samples in and around a cube, and those that are added to them.
pub(super) struct GradedCover<'a> {
    mesh: &'a Mesh,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    grids: &'a mut OctaveGrids,
    /// Distances are computed in a unit that is about the radius.
    per_unit: f64,
    /// At how many fragments it may still look.
    looks: u64,
    added: Vec<Dot>,
    /// Where samples were gathered, how far around, for which normal, and how many were added before.
    centre: DVec3,
    reach: f64,
    normal: [f32; 3],
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
            centre: DVec3::ZERO,
            reach: f64::NEG_INFINITY,
            normal: [0.0; 3],
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

    /// The fragment that a part is, in units of the test.
    fn outline(&self, shape: &Shape, bounds: RadiusBounds, origin: DVec3) -> Outline {
        let scaled = |vector: DVec3| (vector * self.per_unit).as_vec3();
        let half = |radius: f64| (0.5 * radius * self.per_unit) as f32;
        Outline {
            centre: scaled(shape.centre - origin),
            edges: [1, 2].map(|corner| scaled(shape.corners[corner] - shape.corners[0])),
            extent: (shape.extent * self.per_unit) as f32,
            least: half(bounds.least),
            largest: half(bounds.largest),
        }
    }
}

/// A sample as it is seen from `offset` away, where distances are up to `reach` and half of its radius.
fn nearby(offset: DVec3, radius: f64, reach: f64, per_unit: f64) -> Nearby {
    let half = 0.5 * radius - SLACK * (reach + 0.5 * radius);
    Nearby { offset: (offset * per_unit).as_vec3(), half: (half * per_unit) as f32 }
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
        let normal = self.mesh.normal(fragment.triangle);
        let sees_others = normal != self.normal && self.grids.rule.cosine > -1.0;
        if self.reach < reach + self.centre.distance(shape.centre) || sees_others {
            (self.centre, self.reach) = (shape.centre, reach + SPARE * bounds.scale());
            (self.normal, self.gathered) = (normal, self.added.len());
            self.stack.clear();
            let (stack, per_unit, reach) = (&mut self.stack, self.per_unit, self.reach);
            self.grids.near(self.centre, reach, normal, |offset, radius| {
                stack.push(nearby(offset, radius, reach, per_unit));
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
        let normal = self.mesh.normal(fragment.triangle);
        for dot in &self.added[known..] {
            let (offset, limit) = (exact(dot.position) - origin, reach + 0.5 * dot.radius);
            if offset.length_squared() <= limit * limit && self.grids.rule.sees(dot.normal, normal) {
                self.stack.push(nearby(offset, dot.radius, reach, self.per_unit));
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
        let outline = self.outline(&part.shape, part.bounds, part.origin);
        // All are copied, and those that reach it overwrite the others: a branch would be a guess.
        let (start, mut end) = (self.stack.len(), self.stack.len());
        self.stack.resize(2 * start - from, Nearby::default());
        for index in from..start {
            let sample = self.stack[index];
            self.stack[end] = sample;
            end += usize::from(outline.is_reached_by(&sample));
        }
        self.stack.truncate(end);
        outline.open_sixteenths(self.stack[start..].iter())
    }

    fn take_covered(&self, part: &GradedPart, from: usize, open: &mut [u16; 16]) {
        for (index, open) in open.iter_mut().enumerate().filter(|(_, open)| **open != 0) {
            let outline = self.outline(&part.shape.sixteenth(index), part.bounds, part.origin);
            let reaching = self.stack[from..].iter().filter(|sample| outline.is_reached_by(sample));
            *open &= outline.open_sixteenths(reaching);
        }
    }

    fn radius(&self, part: &GradedPart) -> RadiusBounds {
        part.bounds
    }

    fn scale(&self, bounds: RadiusBounds) -> f64 {
        bounds.scale()
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

    /// It rains as densely as samples will stand.
    fn density(&self, bounds: RadiusBounds) -> f64 {
        1.0 / (bounds.scale() * bounds.scale())
    }

    fn dart(&self, sample: Sample, bounds: RadiusBounds) -> (Sample, f64) {
        (sample, self.field.at_within(&sample, bounds))
    }

    /// The rain on a patch is as dense as where its radius is least: where the radius is larger, a share of it falls.
    fn falls(&self, &(_, radius): &(Sample, f64), bounds: RadiusBounds, rng: &mut Rng) -> bool {
        let share = bounds.scale() / radius;
        share >= 1.0 || rng.unit() < share * share
    }

    fn add(&mut self, &(sample, radius): &(Sample, f64)) -> bool {
        let dot = Dot { position: sample.position, radius, normal: self.mesh.normal(sample.triangle) };
        if self.grids.rejects(&dot) {
            return false;
        }
        self.grids.add(dot);
        self.added.push(dot);
        self.quota.take(1);
        self.allow_looks();
        true
    }

    fn is_futile(&self) -> bool {
        self.field.has_failed() || self.quota.is_exceeded()
    }
}

/// A fragment in units of the test, and half of the radii on it.
struct Outline {
    centre: Vec3,
    edges: [Vec3; 2],
    extent: f32,
    least: f32,
    largest: f32,
}

impl Outline {
    /// Whether a sample can cover a point of the fragment.
    fn is_reached_by(&self, sample: &Nearby) -> bool {
        let limit = self.largest + self.extent + sample.half;
        (sample.offset - self.centre).length_squared() <= limit * limit
    }

    /// The sixteenths that none of these samples certainly covers.
    fn open_sixteenths<'a>(&self, samples: impl Iterator<Item = &'a Nearby>) -> u16 {
        let [e, f] = self.edges;
        // By how much the squared distance is above its limit, at the sample for which this is least.
        let mut excess = [f32::INFINITY; 16];
        for sample in samples {
            let offset = sample.offset - self.centre;
            let limit = self.least + sample.half - 0.25 * self.extent;
            // Where the limit is small against the fragment the difference of the squares would be nothing but rounding.
            let limit = if limit > 0.25 * self.extent { limit * limit } else { f32::NEG_INFINITY };
            let (squared, a, b) = (offset.length_squared() - limit, -2.0 * offset.dot(e), -2.0 * offset.dot(f));
            for i in 0..16 {
                let above = squared + (a * CENTRES[0][i] + b * CENTRES[1][i]);
                excess[i] = if above < excess[i] { above } else { excess[i] };
            }
        }
        let (ee, ef, ff) = (e.length_squared(), 2.0 * e.dot(f), f.length_squared());
        let mut open = 0;
        for i in 0..16 {
            let (s, t) = (CENTRES[0][i], CENTRES[1][i]);
            open |= u16::from(excess[i] + (s * s * ee + s * t * ef + t * t * ff) >= 0.0) << i;
        }
        open
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
