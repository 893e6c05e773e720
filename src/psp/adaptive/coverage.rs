//! What is still uncovered where the radius varies: `psp/coverage.rs`, of which this is the general case.
//!
//! A point p is covered by a sample s that is nearer than the mean of their radii. A sixteenth is covered if its centre
//! is nearer to s than half the radius of s and half the least radius of the fragment, less the sixteenth's extent: then
//! all of it is, whatever the radius is at its points.

use glam::{DVec3, Vec3};

use crate::mesh::Mesh;
use crate::psp::adaptive::radius::{Bounds, Field};
use crate::psp::adaptive::room::Room;
use crate::psp::cover::SIXTEENTHS;
use crate::psp::coverage::{Fragment, Shape};

/// How much, as a share of the distances at hand, rounding can add to a distance, and some more.
const SLACK: f64 = 1e-5;
/// How long, in local radii, the sixteenths of a partly covered patch are when the first dart is thrown into them.
const FINE: f64 = 0.15;
/// How much farther, in local radii, samples are gathered than a fragment needs: its neighbours will need them too.
const SPARE: f64 = 1.0;

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

/// A fragment that is not covered, and the radius on it.
#[derive(Clone, Copy)]
pub(super) struct Open {
    pub fragment: Fragment,
    /// A bit for each sixteenth that may be uncovered; at least one.
    pub parts: u16,
    /// The length of the longest edge.
    pub longest: f64,
    pub bounds: Bounds,
}

/// A sample near a fragment, in units of the search.
#[derive(Clone, Copy, Default)]
struct Nearby {
    /// As seen from the centre of the search.
    offset: Vec3,
    /// Half of its radius, less what rounding can add to distances from it.
    half: f32,
}

/// A search for uncovered surface in one room, to which nothing is added meanwhile.
pub(super) struct Coverage<'a> {
    mesh: &'a Mesh,
    field: &'a Field<'a>,
    room: &'a Room,
    per_unit: f64,
    /// Patches no longer than this are cut up no more.
    finest: f64,
    /// At how many fragments it may still look.
    pub looks: u64,
    /// Where samples were gathered, how far around, and for which normal.
    centre: DVec3,
    reach: f64,
    normal: [f32; 3],
    /// The samples gathered. Behind them, for each fragment that contains the one in question, those that can reach it.
    nearby: Vec<Nearby>,
}

impl<'a> Coverage<'a> {
    /// Distances are computed in `unit`, which is about the radius. Fails when it has looked at so many fragments.
    pub fn new(mesh: &'a Mesh, field: &'a Field<'a>, room: &'a Room, unit: f64, finest: f64, looks: u64) -> Self {
        Self {
            mesh,
            field,
            room,
            per_unit: 1.0 / unit,
            finest,
            looks,
            centre: DVec3::ZERO,
            reach: f64::NEG_INFINITY,
            normal: [0.0; 3],
            nearby: Vec::new(),
        }
    }

    /// Appends the uncovered parts of a fragment, in fixed order.
    pub fn search(&mut self, fragment: &Fragment, uncovered: &mut Vec<Open>) {
        let shape = fragment.shape(self.mesh);
        let bounds = self.field.bounds(fragment, &shape, self.field.all());
        self.gather(fragment, &shape, bounds);
        self.descend(fragment, &shape, bounds, 0, uncovered);
    }

    /// Appends the parts of a patch that are still uncovered.
    pub fn refine(&mut self, &Open { fragment, parts, bounds, .. }: &Open, uncovered: &mut Vec<Open>) {
        let shape = fragment.shape(self.mesh);
        self.gather(&fragment, &shape, bounds);
        let start = self.nearby.len();
        let parts = parts & self.open_sixteenths(&shape, bounds, 0);
        self.descend_into(&fragment, &shape, bounds, parts, start, uncovered);
        self.nearby.truncate(start);
    }

    /// Sees to it that `nearby` holds the samples that can reach a fragment, and others.
    fn gather(&mut self, fragment: &Fragment, shape: &Shape, bounds: Bounds) {
        let reach = 0.5 * bounds.largest + shape.extent;
        let normal = self.mesh.normal(fragment.triangle);
        let sees_others = normal != self.normal && self.room.rule.cosine > -1.0;
        if self.reach < reach + self.centre.distance(shape.centre) || sees_others {
            (self.centre, self.reach) = (shape.centre, reach + SPARE * bounds.scale());
            self.normal = normal;
            self.nearby.clear();
            let (nearby, per_unit, reach) = (&mut self.nearby, self.per_unit, self.reach);
            self.room.near(self.centre, reach, normal, |offset, radius| {
                let half = 0.5 * radius - SLACK * (reach + 0.5 * radius);
                nearby.push(Nearby { offset: (offset * per_unit).as_vec3(), half: (half * per_unit) as f32 });
            });
        }
    }

    /// `nearby[from..]` holds the samples that can reach the fragment, and others.
    fn descend(&mut self, fragment: &Fragment, shape: &Shape, bounds: Bounds, from: usize, uncovered: &mut Vec<Open>) {
        if self.looks == 0 {
            self.field.give_up(shape.centre);
        }
        if self.field.has_failed() {
            return;
        }
        self.looks -= 1;
        let start = self.nearby.len();
        let open = self.open_sixteenths(shape, bounds, from);
        let longest = shape.longest;
        let is_fine = longest <= 4.0 * FINE * bounds.scale() || longest <= self.finest;
        if open == u16::MAX || (open != 0 && is_fine) {
            uncovered.push(Open { fragment: *fragment, parts: open, longest, bounds });
        } else {
            self.descend_into(fragment, shape, bounds, open, start, uncovered);
        }
        self.nearby.truncate(start);
    }

    fn descend_into(
        &mut self,
        fragment: &Fragment,
        shape: &Shape,
        bounds: Bounds,
        open: u16,
        from: usize,
        uncovered: &mut Vec<Open>,
    ) {
        for index in (0..16).filter(|index| open >> index & 1 == 1) {
            let (part, shape) = (fragment.sixteenth(index), shape.sixteenth(index));
            let bounds = self.field.bounds(&part, &shape, bounds);
            self.descend(&part, &shape, bounds, from, uncovered);
        }
    }

    /// The sixteenths that no single sample in `nearby[from..]` certainly covers. Appends those that can reach them.
    fn open_sixteenths(&mut self, shape: &Shape, bounds: Bounds, from: usize) -> u16 {
        let per_unit = self.per_unit;
        let scaled = |vector: DVec3| (vector * per_unit).as_vec3();
        let centre = scaled(shape.centre - self.centre);
        let [e, f] = [1, 2].map(|i| scaled(shape.corners[i] - shape.corners[0]));
        let extent = (shape.extent * per_unit) as f32;
        let [least, largest] = [bounds.least, bounds.largest].map(|radius| (0.5 * radius * per_unit) as f32);
        let reach = largest + extent;
        // All are copied, and those that reach it overwrite the others: a branch would be a guess.
        let (start, mut end) = (self.nearby.len(), self.nearby.len());
        self.nearby.resize(2 * start - from, Nearby::default());
        for index in from..start {
            let sample = self.nearby[index];
            self.nearby[end] = sample;
            let limit = reach + sample.half;
            end += usize::from((sample.offset - centre).length_squared() <= limit * limit);
        }
        self.nearby.truncate(end);
        // By how much the squared distance is above its limit, at the sample for which this is least.
        let mut excess = [f32::INFINITY; 16];
        for sample in &self.nearby[start..] {
            let offset = sample.offset - centre;
            let limit = least + sample.half - 0.25 * extent;
            // Where the limit is small against the fragment the difference of the squares would be nothing but rounding.
            let limit = if limit > 0.25 * extent { limit * limit } else { f32::NEG_INFINITY };
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
    use crate::mesh::exact;
    use crate::psp::adaptive::radius::Radius;
    use crate::psp::adaptive::room::{Dot, Rule};
    use crate::rng::{Draw, Rng};

    /// Against exact distances to the corners of every sixteenth: what is covered by no single sample is kept, and what
    /// is covered with room for its extent is dropped.
    #[test]
    fn only_covered_sixteenths_are_dropped_and_all_that_are_well_covered() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let (mut kept, mut dropped) = (0, 0);
        for round in 0..3000 {
            let (size, ratio) = ([1.0, 0.1, 1e-3][round % 3], [1.0, 8.0, 500.0f64][round / 3 % 3]);
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            let mesh = Mesh::new(vec![corner(), corner(), corner()], vec![[0, 1, 2]]).unwrap();
            let radii: [f32; 3] = std::array::from_fn(|_| (1.0 + 0.5 * rng.unit()) as f32);
            let field = Field::new(&mesh, Radius::PerVertex(&radii)).unwrap();
            let (mut room, mut dots) = (Room::new(Rule { cosine: -1.0 }), Vec::new());
            for _ in 0..6 {
                let radius = ratio.powf(rng.unit());
                let position = std::array::from_fn(|_| (8.0 + 1.2 * radius * (2.0 * rng.unit() - 1.0)) as f32);
                room.add(Dot { position, radius, normal: [0.0; 3] });
                dots.push((exact(position), radius));
            }
            let (whole, unit) = (Fragment::whole(0), 2.0);
            let shape = whole.shape(&mesh);
            let bounds = field.bounds(&whole, &shape, field.all());
            let mut coverage = Coverage::new(&mesh, &field, &room, unit, 0.0, 1);
            coverage.gather(&whole, &shape, bounds);
            let open = coverage.open_sixteenths(&shape, bounds, 0);
            for index in 0..16 {
                let part = whole.sixteenth(index).shape(&mesh);
                let is_covered = dots.iter().any(|&(centre, radius)| {
                    part.corners.iter().all(|corner| corner.distance(centre) < 0.5 * (bounds.least + radius))
                });
                let well = dots.iter().any(|&(centre, radius)| {
                    let room = 0.5 * (bounds.least + radius) - part.extent - 4.0 * SLACK * (radius + 4.0);
                    part.centre.distance(centre) < room && room > part.extent
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
