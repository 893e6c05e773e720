//! What is still uncovered: the surface in patches, of which each knows the sixteenths that are not proved covered.
//! The thesis has no such search; its loop goes on until it is told to stop.
//!
//! A fragment of a triangle is cut into four by four congruent ones of its own shape (`cover.rs`). Such a sixteenth is
//! covered if its three corners are nearer to one sample than the radius: then all of it is inside one ball. This is
//! asked in `f32`, of all sixteen at once, in the vectors of the processor (`near.rs`); its slack only delays a decision,
//! since what it keeps is looked at again in smaller parts, down to the exact test of a single point (`fill.rs`).
//!
//! A patch knows the sixteenths of its sixteenths: large enough to be few, and yet with hardly any area that is covered.

use glam::{DVec2, DVec3, Vec3};

use crate::mesh::{Mesh, exact};
use crate::psp::cover::SIXTEENTHS;
use crate::psp::near::{FAR, LANES, Local, Near, Places, SLACK};
use crate::psp::room::Room;
use crate::psp::vectors;
use crate::simd::Level;

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
    /// For each sixteenth, a bit for each sixteenth of it that may be uncovered; at least one.
    pub open: [u16; 16],
    /// The length of the longest edge.
    pub longest: f64,
    /// How many of the samples added since the search began are accounted for.
    seen: usize,
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

impl Patch {
    /// The number of open sixteenths of sixteenths.
    pub fn open_parts(&self) -> u32 {
        self.open.iter().map(|open| open.count_ones()).sum()
    }

    /// The area that may be uncovered.
    pub fn open_area(&self, mesh: &Mesh) -> f64 {
        self.fragment.area(mesh) * f64::from(self.open_parts()) / 256.0
    }
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
        let [a, b, c] = mesh.exact_corners(self.triangle);
        let at = |[u, v]: [f64; 2]| (1.0 - u - v) * a + u * b + v * c;
        let [p, q, r] = self.corners;
        Shape::of([at(p), at(q), at(r)])
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
        let [a, b, c] = SIXTEENTHS[index];
        let at = |[s, t]: [f64; 2]| self.at([0.25 * s, 0.25 * t]);
        Self { corners: [at(a), at(b), at(c)], ..*self }
    }
}

impl Shape {
    fn of(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let opposite = [b.distance_squared(c), c.distance_squared(a), a.distance_squared(b)];
        let apex = (1..3).fold(0, |best, i| if opposite[i] > opposite[best] { i } else { best });
        let centre = (a + b + c) / 3.0;
        let squared = centre.distance_squared(a).max(centre.distance_squared(b)).max(centre.distance_squared(c));
        Self { corners, centre, apex, longest: opposite[apex].sqrt(), extent: squared.sqrt() }
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

/// How far around a fragment samples are gathered, in radii, even if it needs less: its neighbours will need them too.
const REACH: f32 = 2.5;

/// A search for uncovered surface in one room.
pub(super) struct Coverage<'a> {
    mesh: &'a Mesh,
    room: &'a mut Room,
    vectors: Level,
    /// Patches with some sixteenths covered are cut up until these are no longer than this ...
    fine: f64,
    /// ... or the patch is no longer than this.
    finest: f64,
    /// The places of the samples added since the search began, and how many.
    added: Vec<Places>,
    count: usize,
    /// Where samples were gathered, how far around, in radii, and how many were added before.
    centre: [f32; 3],
    reach: f32,
    seen: usize,
    /// The samples gathered, as seen from the centre. Behind them, for each fragment that contains the one in question,
    /// those that can reach it.
    near: Near,
}

impl<'a> Coverage<'a> {
    pub fn new(mesh: &'a Mesh, room: &'a mut Room, fine: f64, finest: f64) -> Self {
        let (vectors, near) = (Level::widest(), Near::new());
        let (centre, reach) = ([0.0; 3], f32::NEG_INFINITY);
        Self { mesh, room, vectors, fine, finest, added: Vec::new(), count: 0, centre, reach, seen: 0, near }
    }

    /// Adds a sample, unless it conflicts with another one.
    pub fn add(&mut self, sample: [f32; 3]) -> bool {
        if self.room.rejects(sample) {
            return false;
        }
        self.room.add(sample);
        let place = self.room.place(exact(sample));
        let lane = self.count % LANES;
        if lane == 0 {
            self.added.push([[FAR; LANES]; 3]);
        }
        (0..3).for_each(|axis| self.added[self.count / LANES][axis][lane] = place[axis]);
        self.count += 1;
        true
    }

    /// Appends the uncovered parts of a fragment, in fixed order.
    pub fn search(&mut self, fragment: &Fragment, uncovered: &mut Vec<Patch>) {
        let shape = fragment.shape(self.mesh);
        let (local, gathered) = self.locate(&shape);
        let open = self.open_sixteenths(&local, 0);
        self.keep(fragment, shape.longest, &local, open, gathered, uncovered);
        self.near.len = gathered;
    }

    /// Takes from a patch what samples cover that were added since it was looked at.
    pub fn update(&mut self, patch: &mut Patch) {
        if patch.seen == self.count {
            return;
        }
        let shape = patch.fragment.shape(self.mesh);
        let (gathered, centre) = (self.near.len, self.room.place(shape.centre));
        let local = self.local(&shape, centre);
        let reach = 1.0 + local.extent;
        for places in &self.added[patch.seen / LANES..] {
            self.near.reserve(LANES);
            vectors::append(self.vectors, &mut self.near, places, centre, reach * reach + SLACK);
        }
        patch.seen = self.count;
        if self.near.len > gathered {
            vectors::take_covered(self.vectors, &self.near, gathered, &local, &mut patch.open);
        }
        self.near.len = gathered;
    }

    /// Appends the parts of a patch that are uncovered when they are looked at more closely.
    pub fn refine(&mut self, patch: &Patch, uncovered: &mut Vec<Patch>) {
        let (local, gathered) = self.locate(&patch.fragment.shape(self.mesh));
        for index in (0..16).filter(|&index| patch.open[index] != 0) {
            let (fragment, part) = (patch.fragment.sixteenth(index), local.sixteenth(index));
            self.keep(&fragment, 0.25 * patch.longest, &part, patch.open[index], 0, uncovered);
            self.near.len = gathered;
        }
    }

    /// Where a fragment lies. Sees to it that `near` holds the samples that can reach it, and others, and counts them.
    fn locate(&mut self, shape: &Shape) -> (Local, usize) {
        let extent = (shape.extent / self.room.radius()) as f32;
        let place = self.room.place(shape.centre);
        let apart = Vec3::from_array(place).distance(Vec3::from_array(self.centre));
        if self.reach < 1.0 + extent + apart + SLACK {
            (self.centre, self.reach) = (place, (1.0 + extent).max(REACH));
            (self.near.len, self.seen) = (0, self.count);
            self.room.gather(place, self.reach, &mut self.near);
        }
        (self.local(shape, self.centre), self.near.len)
    }

    /// Where a fragment lies as seen from a place.
    fn local(&self, shape: &Shape, from: [f32; 3]) -> Local {
        let per_radius = 1.0 / self.room.radius();
        let in_radii = |vector: DVec3| (vector * per_radius).as_vec3a();
        let [a, b, c] = shape.corners;
        Local {
            corner: in_radii(a - self.room.at(from)),
            edges: [in_radii(b - a), in_radii(c - a)],
            extent: (shape.extent * per_radius) as f32,
        }
    }

    /// Keeps a fragment as a patch, or in parts. `near[from..]` holds the samples that can reach it.
    fn keep(
        &mut self,
        fragment: &Fragment,
        longest: f64,
        local: &Local,
        open: u16,
        from: usize,
        uncovered: &mut Vec<Patch>,
    ) {
        let (is_fine, is_finest) = (longest <= 4.0 * self.fine, longest <= self.finest);
        let is_kept = |index: usize| open >> index & 1 == 1 && (is_fine || is_finest || open == u16::MAX);
        let parts = std::array::from_fn(|index| if is_kept(index) { u16::MAX } else { 0 });
        let mut patch = Patch { fragment: *fragment, open: parts, longest, seen: self.seen };
        if is_fine && !is_finest {
            vectors::take_covered(self.vectors, &self.near, from, local, &mut patch.open);
        }
        for index in (0..16).filter(|&index| open >> index & 1 == 1 && !is_kept(index)) {
            let (part, start) = (local.sixteenth(index), self.near.len);
            let open = self.open_sixteenths(&part, from);
            if open != 0 {
                self.keep(&fragment.sixteenth(index), 0.25 * longest, &part, open, start, uncovered);
            }
            self.near.len = start;
        }
        if patch.open != [0; 16] {
            uncovered.push(patch);
        }
    }

    /// The sixteenths that no single sample in `near[from..]` certainly covers. Appends those that can reach the fragment.
    fn open_sixteenths(&mut self, local: &Local, from: usize) -> u16 {
        let (start, (centre, reach2)) = (self.near.len, local.reach());
        self.near.reserve(start - from);
        vectors::append_reaching(self.vectors, &mut self.near, from, start, centre, reach2);
        !vectors::covered(self.vectors, &self.near, start, local)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::blocks::Block;
    use crate::rng::{Draw, Rng};

    /// Against exact distances to the corners of every sixteenth: what is covered by no single sample is kept, and what
    /// one covers is dropped. The sixteenths together are the fragment. Both for a search and for an update.
    #[test]
    fn only_covered_sixteenths_are_dropped_and_all_that_are_well_covered() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let (mut kept, mut dropped) = (0, 0);
        for round in 0..3000 {
            let size = [1.0, 0.1, 1e-3][round % 3];
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            let mesh = Mesh::new(vec![corner(), corner(), corner()], vec![[0, 1, 2]]).unwrap();
            let mut room = Room::new(Block([0; 3]), [0.0; 3], 1.0);
            let whole = Fragment::whole(0);
            let shape = whole.shape(&mesh);
            let mut coverage = Coverage::new(&mesh, &mut room, 0.1, 0.0);
            let mut samples = Vec::new();
            for _ in 0..6 {
                let sample = std::array::from_fn(|_| (8.0 - 1.2 + 2.4 * rng.unit()) as f32);
                if coverage.add(sample) {
                    samples.push(exact(sample));
                }
            }
            let open = if round % 2 == 0 {
                let (local, _) = coverage.locate(&shape);
                coverage.open_sixteenths(&local, 0)
            } else {
                let mut patch = Patch { fragment: whole, open: [u16::MAX; 16], longest: shape.longest, seen: 0 };
                coverage.update(&mut patch);
                (0..16).fold(0, |open, index| open | u16::from(patch.open[index] != 0) << index)
            };
            for index in 0..16 {
                let part = whole.sixteenth(index).shape(&mesh);
                assert!((16.0 * whole.sixteenth(index).area(&mesh) / mesh.area() - 1.0).abs() < 1e-9);
                let farthest =
                    |sample: &DVec3| part.corners.map(|c| c.distance(*sample)).into_iter().fold(0.0, f64::max);
                let is_covered = samples.iter().any(|sample| farthest(sample) < 1.0);
                let well = samples.iter().any(|sample| farthest(sample) < 1.0 - 3.0 * f64::from(SLACK));
                let is_open = open >> index & 1 == 1;
                // One that is looked at in sixteen parts can be covered by several samples.
                assert!(is_open || is_covered || round % 2 == 1);
                assert!(!(is_open && well));
                kept += u32::from(is_open);
                dropped += u32::from(!is_open);
            }
        }
        assert!(kept > 5000 && dropped > 5000, "{kept} {dropped}");
    }
}
