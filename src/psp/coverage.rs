//! What is still uncovered: the surface in patches, of which each knows the sixteenths that are not proved covered.
//! The thesis has no such search; its loop goes on until it is told to stop.
//!
//! A fragment of a triangle is cut into four by four congruent ones of its own shape. Such a sixteenth is covered if its
//! centre is nearer to a sample than the radius less the sixteenth's extent: then all of it is inside one ball. This is
//! asked in `f32`, of all sixteen at once, in a form that compilers vectorise; its slack only delays a decision, since
//! what it keeps is looked at again in smaller parts, down to the exact test of a single point (`fill.rs`).

use glam::{DVec2, DVec3, Vec3};

use crate::mesh::Mesh;
use crate::psp::room::Room;

/// How much, in radii, rounding can add to a distance, and some more: sums of a few terms below 20, each of them off by
/// 2^-24 of its size.
const SLACK: f64 = 1e-5;

/// A part of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Fragment {
    pub triangle: u32,
    /// Barycentrics `(u, v)` of the corners.
    pub corners: [[f64; 2]; 3],
}

/// A fragment that is not covered.
#[derive(Clone, Copy)]
pub(super) struct Patch {
    pub fragment: Fragment,
    /// A bit for each sixteenth that may be uncovered; at least one.
    pub open: u16,
    /// The length of the longest edge.
    pub longest: f64,
}

/// Where a fragment lies in space.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    pub corners: [DVec3; 3],
    pub centre: DVec3,
    /// The corner opposite the longest edge.
    pub apex: usize,
    /// The length of the longest edge.
    pub longest: f64,
    /// All of the fragment is this near to its centre.
    pub extent: f64,
}

impl Fragment {
    pub fn whole(triangle: u32) -> Self {
        Self { triangle, corners: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] }
    }

    /// The area: the whole triangle's, by the share of its barycentrics.
    pub fn area(&self, mesh: &Mesh) -> f64 {
        let [a, b, c] = self.corners.map(DVec2::from_array);
        mesh.triangle_area(self.triangle) * (b - a).perp_dot(c - a).abs()
    }

    /// The barycentrics of the point with barycentrics `(s, t)` in the fragment.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        let [a, b, c] = self.corners;
        std::array::from_fn(|axis| (1.0 - s - t) * a[axis] + s * b[axis] + t * c[axis])
    }

    pub fn shape(&self, mesh: &Mesh) -> Shape {
        Shape::of(self.corners.map(|corner| mesh.point_exact(self.triangle, corner)))
    }

    /// The two halves on either side of the line from the corner `apex` to the middle of the edge opposite.
    pub fn bisect(&self, apex: usize) -> [Self; 2] {
        let (b, c) = ((apex + 1) % 3, (apex + 2) % 3);
        let middle = std::array::from_fn(|axis| 0.5 * (self.corners[b][axis] + self.corners[c][axis]));
        [c, b].map(|moved| {
            let mut half = *self;
            half.corners[moved] = middle;
            half
        })
    }

    /// One of the sixteen parts.
    pub fn sixteenth(&self, index: usize) -> Self {
        Self { corners: SIXTEENTHS[index].map(|corner| self.at(corner.map(|x| 0.25 * x))), ..*self }
    }
}

impl Shape {
    fn of(corners: [DVec3; 3]) -> Self {
        let opposite = |i: usize| corners[(i + 1) % 3].distance_squared(corners[(i + 2) % 3]);
        let apex = (1..3).fold(0, |best, i| if opposite(i) > opposite(best) { i } else { best });
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let extent = corners.iter().fold(0.0, |most: f64, corner| most.max(centre.distance_squared(*corner))).sqrt();
        Self { corners, centre, apex, longest: opposite(apex).sqrt(), extent }
    }

    pub fn bisect(&self) -> [Self; 2] {
        let (b, c) = ((self.apex + 1) % 3, (self.apex + 2) % 3);
        let middle = 0.5 * (self.corners[b] + self.corners[c]);
        [c, b].map(|moved| {
            let mut corners = self.corners;
            corners[moved] = middle;
            Self::of(corners)
        })
    }

    /// One of the sixteen parts.
    pub fn sixteenth(&self, index: usize) -> Self {
        let [a, e, f] = [self.corners[0], self.corners[1] - self.corners[0], self.corners[2] - self.corners[0]];
        let corners = SIXTEENTHS[index].map(|[x, y]| a + 0.25 * x * e + 0.25 * y * f);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        Self { corners, centre, longest: 0.25 * self.longest, extent: 0.25 * self.extent, ..*self }
    }
}

/// The corners of the sixteenths in quarters of the fragment's edges: ten that stand as it does, then six turned over.
const SIXTEENTHS: [[[f64; 2]; 3]; 16] = {
    let mut corners = [[[0.0; 2]; 3]; 16];
    let (mut index, mut turned) = (0, 10);
    let mut row = 0;
    while row < 4 {
        let mut column = 0;
        while column + row < 4 {
            let (x, y) = (column as f64, row as f64);
            corners[index] = [[x, y], [x + 1.0, y], [x, y + 1.0]];
            index += 1;
            if column + row < 3 {
                corners[turned] = [[x + 1.0, y + 1.0], [x, y + 1.0], [x + 1.0, y]];
                turned += 1;
            }
            column += 1;
        }
        row += 1;
    }
    corners
};

/// The centres of the sixteenths as seen from the centre of the fragment, in edges, one axis after the other.
pub(super) const CENTRES: [[f32; 16]; 2] = {
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

/// How much farther, in radii, samples are gathered than a fragment needs: its neighbours will need them too.
const SPARE: f64 = 1.0;

/// A search for uncovered surface in one room, to which nothing is added meanwhile.
pub(super) struct Coverage<'a> {
    mesh: &'a Mesh,
    room: &'a Room,
    radius: f64,
    /// Patches with some sixteenths covered are cut up until these are no longer than this ...
    fine: f64,
    /// ... or the patch is no longer than this.
    finest: f64,
    /// Where samples were gathered, and how far around.
    centre: DVec3,
    reach: f64,
    /// The samples gathered, as seen from the centre, in radii. Behind them, for each fragment that contains the one in
    /// question, those that can reach it.
    nearby: Vec<Vec3>,
}

impl<'a> Coverage<'a> {
    pub fn new(mesh: &'a Mesh, room: &'a Room, fine: f64, finest: f64) -> Self {
        let (radius, centre, reach) = (room.radius(), DVec3::ZERO, f64::NEG_INFINITY);
        Self { mesh, room, radius, fine, finest, centre, reach, nearby: Vec::new() }
    }

    /// Appends the uncovered parts of a fragment, in fixed order.
    pub fn search(&mut self, fragment: &Fragment, uncovered: &mut Vec<Patch>) {
        let shape = fragment.shape(self.mesh);
        self.gather(&shape);
        self.descend(fragment, &shape, 0, uncovered);
    }

    /// Appends the parts of a patch that are still uncovered.
    pub fn refine(&mut self, patch: &Patch, uncovered: &mut Vec<Patch>) {
        let shape = patch.fragment.shape(self.mesh);
        self.gather(&shape);
        let start = self.nearby.len();
        let open = patch.open & self.open_sixteenths(&shape, 0);
        self.descend_into(&patch.fragment, &shape, open, start, uncovered);
        self.nearby.truncate(start);
    }

    /// Sees to it that `nearby` holds the samples that can reach a fragment, and others.
    fn gather(&mut self, shape: &Shape) {
        let reach = self.radius + shape.extent;
        if self.reach < reach + self.centre.distance(shape.centre) {
            (self.centre, self.reach) = (shape.centre, reach + SPARE * self.radius);
            self.nearby.clear();
            let (nearby, per_radius) = (&mut self.nearby, 1.0 / self.radius);
            self.room.near(self.centre, self.reach, |offset| nearby.push((offset * per_radius).as_vec3()));
        }
    }

    /// `nearby[from..]` holds the samples that can reach the fragment, and others.
    fn descend(&mut self, fragment: &Fragment, shape: &Shape, from: usize, uncovered: &mut Vec<Patch>) {
        let start = self.nearby.len();
        let open = self.open_sixteenths(shape, from);
        let longest = shape.longest;
        if open == u16::MAX || (open != 0 && (longest <= 4.0 * self.fine || longest <= self.finest)) {
            uncovered.push(Patch { fragment: *fragment, open, longest });
        } else {
            self.descend_into(fragment, shape, open, start, uncovered);
        }
        self.nearby.truncate(start);
    }

    fn descend_into(&mut self, fragment: &Fragment, shape: &Shape, open: u16, from: usize, uncovered: &mut Vec<Patch>) {
        for index in (0..16).filter(|index| open >> index & 1 == 1) {
            self.descend(&fragment.sixteenth(index), &shape.sixteenth(index), from, uncovered);
        }
    }

    /// The sixteenths that no single sample in `nearby[from..]` certainly covers. Appends those that can reach them.
    fn open_sixteenths(&mut self, shape: &Shape, from: usize) -> u16 {
        let per_radius = 1.0 / self.radius;
        let extent = shape.extent * per_radius;
        let in_radii = |vector: DVec3| (vector * per_radius).as_vec3();
        let centre = in_radii(shape.centre - self.centre);
        let [e, f] = [1, 2].map(|i| in_radii(shape.corners[i] - shape.corners[0]));
        let reach = ((1.0 + extent) * (1.0 + extent) + SLACK) as f32;
        // All are copied, and those that reach it overwrite the others: a branch would be a guess.
        let (start, mut end) = (self.nearby.len(), self.nearby.len());
        self.nearby.resize(2 * start - from, Vec3::ZERO);
        for index in from..start {
            let sample = self.nearby[index];
            self.nearby[end] = sample;
            end += usize::from((sample - centre).length_squared() <= reach);
        }
        self.nearby.truncate(end);
        let mut nearest = [f32::INFINITY; 16];
        for &sample in &self.nearby[start..] {
            let offset = sample - centre;
            let (squared, a, b) = (offset.length_squared(), -2.0 * offset.dot(e), -2.0 * offset.dot(f));
            for i in 0..16 {
                let d2 = squared + (a * CENTRES[0][i] + b * CENTRES[1][i]);
                nearest[i] = if d2 < nearest[i] { d2 } else { nearest[i] };
            }
        }
        let limit = (1.0 - 0.25 * extent - SLACK).max(0.0);
        let limit = (limit * limit) as f32;
        let (ee, ef, ff) = (e.length_squared(), 2.0 * e.dot(f), f.length_squared());
        let mut open = 0;
        for i in 0..16 {
            let (s, t) = (CENTRES[0][i], CENTRES[1][i]);
            let d2 = nearest[i] + (s * s * ee + s * t * ef + t * t * ff);
            open |= u16::from(d2 >= limit) << i;
        }
        open
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::blocks::Block;
    use crate::rng::{Draw, Rng};

    /// Against exact distances to the corners of every sixteenth: what is covered by no single sample is kept, and what
    /// is covered with room for its extent is dropped. The sixteenths together are the fragment.
    #[test]
    fn only_covered_sixteenths_are_dropped_and_all_that_are_well_covered() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let (mut kept, mut dropped) = (0, 0);
        for round in 0..3000 {
            let size = [1.0, 0.1, 1e-3][round % 3];
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            let mesh = Mesh::new(vec![corner(), corner(), corner()], vec![[0, 1, 2]]).unwrap();
            let mut room = Room::new(Block([0; 3]), [0.0; 3], 1.0);
            for _ in 0..6 {
                let sample: [f32; 3] = std::array::from_fn(|_| (8.0 - 1.2 + 2.4 * rng.unit()) as f32);
                room.add(sample);
            }
            let (whole, mut samples) = (Fragment::whole(0), Vec::new());
            let shape = whole.shape(&mesh);
            room.near(shape.centre, 5.0, |offset| samples.push(shape.centre + offset));
            let mut coverage = Coverage::new(&mesh, &room, 0.1, 0.0);
            coverage.gather(&shape);
            let open = coverage.open_sixteenths(&shape, 0);
            for index in 0..16 {
                let part = whole.sixteenth(index).shape(&mesh);
                assert!(part.centre.distance(shape.sixteenth(index).centre) < 1e-12);
                assert!((part.extent / shape.sixteenth(index).extent - 1.0).abs() < 1e-9);
                assert!((16.0 * whole.sixteenth(index).area(&mesh) / mesh.area() - 1.0).abs() < 1e-9);
                let farthest =
                    |sample: &DVec3| part.corners.map(|c| c.distance(*sample)).into_iter().fold(0.0, f64::max);
                let is_covered = samples.iter().any(|sample| farthest(sample) < 1.0);
                let well = samples.iter().any(|sample| sample.distance(part.centre) + part.extent < 1.0 - 3.0 * SLACK);
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
