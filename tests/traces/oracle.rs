//! Möller and Trumbore's intersection of a ray and a triangle (1997) in `f64`: what Embree should find, and how far
//! `f32` may be from it.

use azulejo::trace::{Hit, Ray};

type Vector = [f64; 3];

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The point in which a ray meets the plane of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    pub uv: [f64; 2],
    pub t: f64,
    /// By how much `f32` arithmetic may miss `uv`: it grows as the triangle gets thin in the view of the ray.
    pub uv_error: f64,
    /// By how much it may miss `t`.
    pub t_error: f64,
}

impl Meeting {
    /// The meeting of a ray and a triangle, unless they are parallel or the triangle has no area.
    pub fn of(ray: &Ray, corners: [[f32; 3]; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| corner.map(f64::from));
        let (origin, direction) = (ray.origin.map(f64::from), ray.direction.map(f64::from));
        let (ab, ac, from_a) = (minus(b, a), minus(c, a), minus(origin, a));
        let p = cross(direction, ac);
        let determinant = dot(ab, p);
        if determinant == 0.0 {
            return None;
        }
        let q = cross(from_a, ab);
        let t = dot(ac, q) / determinant;
        // Embree moves the corners by the origin, which rounds them to the spacing at that distance; an edge function
        // is a product of such a corner, an edge and the direction.
        let distance = [a, b, c].into_iter().map(|corner| length(minus(corner, origin))).fold(0.0, f64::max);
        let edge = length(ab).max(length(ac)).max(length(minus(c, b)));
        let spacing = 4.0 * f32::EPSILON as f64;
        let uv_error = spacing * distance * edge * length(direction) / determinant.abs();
        let t_error = uv_error * (t.abs() + edge / length(direction)) + spacing * t.abs();
        Some(Self { uv: [dot(from_a, p) / determinant, dot(direction, q) / determinant], t, uv_error, t_error })
    }

    /// Its depth inside the triangle, in barycentrics; below zero outside.
    fn depth(&self) -> f64 {
        let [u, v] = self.uv;
        u.min(v).min(1.0 - u - v)
    }

    /// True if no rounding can hide the hit.
    pub fn certain(&self) -> bool {
        self.depth() > self.uv_error && self.t > self.t_error
    }

    /// True if rounding may make a hit of it.
    pub fn possible(&self) -> bool {
        self.depth() >= -self.uv_error && self.t >= -self.t_error
    }

    /// True for a hit that is this meeting, up to rounding.
    pub fn is(&self, hit: &Hit) -> bool {
        (hit.t as f64 - self.t).abs() <= self.t_error
            && (0..2).all(|i| (hit.uv[i] as f64 - self.uv[i]).abs() <= self.uv_error)
    }
}
