//! What is still uncovered: the surface, bisected until each part is proved covered or small. The thesis has no such
//! search; its loop goes on until it is told to stop.
//!
//! A ball is convex, so a fragment of a triangle is covered if its three corners are within the radius of *one and the
//! same* sample. Corners covered by different samples prove nothing: such a fragment is bisected and its halves are
//! judged. Fragments come from bisecting the longest edge (Rivara 1984), which turns needles into well-shaped parts.

use glam::DVec3;

use crate::mesh::Mesh;
use crate::psp::samples::SampleSet;

/// A part that no sample reaches is not bisected below this length, in radii: it is wholly uncovered, and a first dart
/// will change more than a closer look.
const UNREACHED: f64 = 2.0;

/// A part of a triangle: a slice of it or all of it, its longest edge bisected any number of times.
#[derive(Clone, Copy)]
pub(super) struct Fragment {
    pub triangle: u32,
    /// 1, the number of the slice, then a bit for each bisection: which half was taken. With the triangle it is the name
    /// of the fragment.
    pub path: u64,
    /// Barycentrics `(u, v)` of the corners.
    pub corners: [[f64; 2]; 3],
}

impl Fragment {
    pub fn whole(triangle: u32) -> Self {
        Self { triangle, path: 1, corners: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] }
    }

    /// The area: the whole triangle's, by the share of its barycentrics.
    pub fn area(&self, mesh: &Mesh) -> f64 {
        let [a, b, c] = self.corners.map(glam::DVec2::from_array);
        mesh.triangle_area(self.triangle) * (b - a).perp_dot(c - a).abs()
    }

    /// The barycentrics of the point with barycentrics `(s, t)` in the fragment.
    pub fn at(&self, s: f64, t: f64) -> [f64; 2] {
        let [a, b, c] = self.corners;
        std::array::from_fn(|axis| (1.0 - s - t) * a[axis] + s * b[axis] + t * c[axis])
    }

    pub fn shape(&self, mesh: &Mesh) -> Shape {
        let corners = self.corners.map(|corner| mesh.point_exact(self.triangle, corner));
        let opposite = |i: usize| corners[(i + 1) % 3].distance_squared(corners[(i + 2) % 3]);
        let apex = (1..3).fold(0, |best, i| if opposite(i) > opposite(best) { i } else { best });
        Shape { corners, apex, longest: opposite(apex).sqrt() }
    }

    /// The two halves on either side of the line from the corner `apex` to the middle of the edge opposite.
    pub fn bisect(&self, apex: usize) -> [Self; 2] {
        let (b, c) = ((apex + 1) % 3, (apex + 2) % 3);
        let middle = std::array::from_fn(|axis| 0.5 * (self.corners[b][axis] + self.corners[c][axis]));
        [(c, 0), (b, 1)].map(|(moved, bit)| {
            let mut half = Self { path: self.path << 1 | bit, ..*self };
            half.corners[moved] = middle;
            half
        })
    }
}

/// Where a fragment lies in space.
pub(super) struct Shape {
    pub corners: [DVec3; 3],
    /// The corner opposite the longest edge.
    pub apex: usize,
    /// The length of the longest edge.
    pub longest: f64,
}

impl Shape {
    fn centre(&self) -> DVec3 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }

    /// All of the fragment is this near to its centre.
    fn extent(&self) -> f64 {
        let centre = self.centre();
        self.corners.iter().fold(0.0, |extent, corner| centre.distance(*corner).max(extent))
    }
}

/// A search for uncovered surface: reads the samples, changes nothing, and is made anew by each task.
pub(super) struct Coverage<'a> {
    mesh: &'a Mesh,
    samples: &'a SampleSet,
    /// Samples that can reach the fragment in question, behind those of the fragments that it is a part of.
    nearby: Vec<DVec3>,
}

impl<'a> Coverage<'a> {
    pub fn new(mesh: &'a Mesh, samples: &'a SampleSet) -> Self {
        Self { mesh, samples, nearby: Vec::new() }
    }

    /// Appends the uncovered parts of a fragment that is not much larger than the radius, in fixed order.
    ///
    /// Parts are bisected until no longer than `finest`, or where no sample reaches them than [`UNREACHED`].
    pub fn uncovered(&mut self, fragment: &Fragment, finest: f64, uncovered: &mut Vec<Fragment>) {
        let shape = fragment.shape(self.mesh);
        let reach = self.samples.radius() + shape.extent();
        self.nearby.clear();
        self.samples.near(shape.centre(), reach).for_each(|sample| self.nearby.push(sample));
        self.descend(fragment, &shape, 0, finest, uncovered);
    }

    /// `nearby[from..]` holds the samples that can reach the fragment.
    fn descend(&mut self, fragment: &Fragment, shape: &Shape, from: usize, finest: f64, uncovered: &mut Vec<Fragment>) {
        let radius = self.samples.radius();
        let covers = |sample: &DVec3| shape.corners.iter().all(|c| c.distance_squared(*sample) < radius * radius);
        if self.nearby[from..].iter().any(covers) {
            return;
        }
        let unreached = self.nearby.len() == from;
        if shape.longest <= finest || (unreached && shape.longest <= UNREACHED * radius) {
            uncovered.push(*fragment);
            return;
        }
        for half in fragment.bisect(shape.apex) {
            let shape = half.shape(self.mesh);
            let (centre, reach) = (shape.centre(), radius + shape.extent());
            let (start, end) = (from, self.nearby.len());
            for index in start..end {
                let sample = self.nearby[index];
                if sample.distance_squared(centre) <= reach * reach {
                    self.nearby.push(sample);
                }
            }
            self.descend(&half, &shape, end, finest, uncovered);
            self.nearby.truncate(end);
        }
    }
}
