//! What is still uncovered: the surface in patches, of which each knows the sixteenths that are not proved covered.
//! The thesis has no such search; its loop goes on until it is told to stop.
//!
//! A fragment of a triangle is cut into four by four congruent ones of its own shape. Such a sixteenth is covered if its
//! centre is nearer to a sample than the radius less the sixteenth's extent: then all of it is inside one ball. This is
//! asked in `f32`, of all sixteen at once, in a form that compilers vectorise; its slack only delays a decision, since
//! what it keeps is looked at again in smaller parts, down to the exact test of a single point (`fill.rs`).

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;
use crate::psp::room::Room;

/// How much, in radii, rounding can add to a distance, and some more: sums of a few terms below 9, each of them off by
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
    corners: [DVec3; 3],
    pub centre: DVec3,
    /// The corner opposite the longest edge.
    pub apex: usize,
    /// The length of the longest edge.
    pub longest: f64,
    /// All of the fragment is this near to its centre.
    extent: f64,
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
    fn sixteenth(&self, index: usize) -> Self {
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

/// A search for uncovered surface in one room.
pub(super) struct Coverage<'a> {
    mesh: &'a Mesh,
    radius: f64,
    /// Patches with some sixteenths covered are cut up until these are no longer than this ...
    fine: f64,
    /// ... or the patch is no longer than this.
    finest: f64,
    /// Samples that can reach the fragment in question, behind those of the fragments that it is a part of.
    nearby: Vec<DVec3>,
}

impl<'a> Coverage<'a> {
    pub fn new(mesh: &'a Mesh, radius: f64, fine: f64, finest: f64) -> Self {
        Self { mesh, radius, fine, finest, nearby: Vec::new() }
    }

    /// Appends the uncovered parts of a fragment, in fixed order.
    pub fn search(&mut self, room: &Room, fragment: &Fragment, uncovered: &mut Vec<Patch>) {
        let shape = fragment.shape(self.mesh);
        self.nearby.clear();
        room.near(shape.centre, self.radius + shape.extent, &mut self.nearby);
        self.descend(fragment, &shape, 0, uncovered);
    }

    /// Appends the parts of a patch that are still uncovered.
    pub fn refine(&mut self, room: &Room, patch: &Patch, uncovered: &mut Vec<Patch>) {
        let shape = patch.fragment.shape(self.mesh);
        self.nearby.clear();
        room.near(shape.centre, self.radius + shape.extent, &mut self.nearby);
        let open = patch.open & self.open_sixteenths(&shape, 0);
        self.descend_into(&patch.fragment, &shape, open, 0, uncovered);
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
        let (centre, extent) = (shape.centre, shape.extent * per_radius);
        let [e, f] = [1, 2].map(|i| (shape.corners[i] - shape.corners[0]) * per_radius).map(|edge| edge.as_vec3());
        let reach = ((1.0 + extent) * (1.0 + extent) + SLACK) as f32;
        let mut nearest = [f32::INFINITY; 16];
        for index in from..self.nearby.len() {
            let sample = self.nearby[index];
            let offset = ((sample - centre) * per_radius).as_vec3();
            let squared = offset.length_squared();
            if squared > reach {
                continue;
            }
            self.nearby.push(sample);
            let [a, b] = [e, f].map(|edge| -2.0 * offset.dot(edge));
            for i in 0..16 {
                let d2 = squared + (a * CENTRES[0][i] + b * CENTRES[1][i]);
                nearest[i] = if d2 < nearest[i] { d2 } else { nearest[i] };
            }
        }
        let limit = (1.0 - 0.25 * extent - SLACK).max(0.0);
        let limit = (limit * limit) as f32;
        let mut open = 0;
        for i in 0..16 {
            let centre = CENTRES[0][i] * e + CENTRES[1][i] * f;
            open |= u16::from(nearest[i] + centre.length_squared() >= limit) << i;
        }
        open
    }
}
