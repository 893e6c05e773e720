//! Parts of triangles: their barycentrics, and their geometry in space.

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;
use crate::psp::fill::extent::Extent;
use crate::psp::sixteenths::SIXTEENTHS;

/// A part of a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fragment {
    pub triangle: u32,
    /// Barycentrics `(u, v)` of the corners.
    pub corners: [[f64; 2]; 3],
}

/// The geometry of a fragment in space.
#[derive(Clone, Copy)]
pub struct Shape {
    pub corners: [DVec3; 3],
    pub centre: DVec3,
    /// The corner opposite the longest edge.
    pub apex: usize,
    /// The length of the longest edge.
    pub longest: f64,
    /// The largest distance of its points from its centre.
    pub extent: f64,
}

impl Fragment {
    pub fn whole(triangle: u32) -> Self {
        Self { triangle, corners: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] }
    }

    /// The area: that of the whole triangle, times the share of its barycentrics.
    pub fn area(&self, mesh: &Mesh) -> f64 {
        let [a, b, c] = self.corners.map(DVec2::from_array);
        mesh.triangle_area(self.triangle) * (b - a).perp_dot(c - a).abs()
    }

    /// The barycentrics of the point with barycentrics `(s, t)` in the fragment.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        let [a, b, c] = self.corners;
        std::array::from_fn(|axis| (1.0 - s - t) * a[axis] + s * b[axis] + t * c[axis])
    }

    /// The box around it, rounded to floats.
    pub fn extent(&self, mesh: &Mesh) -> Extent {
        Extent::of(self.corners.map(|corner| mesh.point_exact(self.triangle, corner).as_vec3().to_array()))
    }

    pub fn shape(&self, mesh: &Mesh) -> Shape {
        let [a, b, c] = mesh.exact_corners(self.triangle);
        let at = |[u, v]: [f64; 2]| (1.0 - u - v) * a + u * b + v * c;
        let [p, q, r] = self.corners;
        Shape::of([at(p), at(q), at(r)])
    }

    /// The parts of its own shape that lines parallel to its edges cut it into, `count` along each edge.
    pub fn parts(&self, count: u32) -> impl Iterator<Item = Self> {
        let at = move |x: u32, y: u32| self.at([x, y].map(|x| f64::from(x) / f64::from(count)));
        (0..count).flat_map(move |y| (0..count - y).map(move |x| (x, y))).flat_map(move |(x, y)| {
            let standing = Self { corners: [at(x, y), at(x + 1, y), at(x, y + 1)], ..*self };
            let turned = || Self { corners: [at(x + 1, y + 1), at(x, y + 1), at(x + 1, y)], ..*self };
            [Some(standing), (x + y + 1 < count).then(turned)].into_iter().flatten()
        })
    }

    /// The number of parts of its own shape along each of its edges that makes them no longer than `longest`.
    pub fn count_up_to(&self, mesh: &Mesh, longest: f64) -> u32 {
        (self.shape(mesh).longest / longest).ceil().max(1.0) as u32
    }

    /// The parts of its own shape that are no longer than `longest`.
    pub fn parts_up_to(&self, mesh: &Mesh, longest: f64) -> impl Iterator<Item = Self> {
        self.parts(self.count_up_to(mesh, longest))
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
}
