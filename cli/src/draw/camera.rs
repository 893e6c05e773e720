//! A camera that finds its own place in front of an object.

use glam::{Vec2, Vec3};

/// The position of the camera: a little to the side, a little above, at this distance from the middle of a unit box.
const AZIMUTH: f32 = -0.32;
const ELEVATION: f32 = 0.26;
const DISTANCE: f32 = 3.6;

/// A pinhole camera. Places on its image plane are in units of the distance, y up.
pub struct Camera {
    pub eye: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
}

/// A rectangle of the image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    pub centre: Vec2,
    /// Half the width and half the height.
    pub half: Vec2,
}

impl Camera {
    /// A camera in front (z) of an object of about unit size around the origin, y up.
    pub fn in_front() -> Self {
        let (sin, cos) = AZIMUTH.sin_cos();
        let forward = -Vec3::new(sin * ELEVATION.cos(), ELEVATION.sin(), cos * ELEVATION.cos());
        let right = forward.cross(Vec3::Y).normalize();
        Self { eye: -DISTANCE * forward, right, up: right.cross(forward), forward }
    }

    /// The direction in which a place of the image plane is seen.
    pub fn direction(&self, place: Vec2) -> Vec3 {
        self.forward + place.x * self.right + place.y * self.up
    }

    /// The place on the image plane at which a point is seen.
    pub fn project(&self, point: Vec3) -> Vec2 {
        let offset = point - self.eye;
        Vec2::new(offset.dot(self.right), offset.dot(self.up)) / offset.dot(self.forward)
    }

    /// The smallest window of a width-to-height `aspect` that shows all points, with a `margin` in parts of its size.
    pub fn window_on(&self, points: impl Iterator<Item = Vec3>, aspect: f32, margin: f32) -> Window {
        let (low, high) = points
            .map(|point| self.project(point))
            .fold((Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY)), |(low, high), place| {
                (low.min(place), high.max(place))
            });
        let half = 0.5 * (high - low) * (1.0 + 2.0 * margin);
        let height = half.y.max(half.x / aspect);
        Window { centre: 0.5 * (low + high), half: Vec2::new(height * aspect, height) }
    }
}

impl Window {
    /// The place at a share of the width and of the height, from the upper left corner.
    pub fn at(&self, x: f32, y: f32) -> Vec2 {
        self.centre + self.half * Vec2::new(2.0 * x - 1.0, 1.0 - 2.0 * y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sees_a_point_in_the_direction_of_its_projection() {
        let camera = Camera::in_front();
        let point = Vec3::new(0.3, -0.2, 0.1);
        let direction = camera.direction(camera.project(point));
        assert!(direction.cross(point - camera.eye).length() < 1e-5);
        assert!(camera.project(Vec3::Y).y > 0.0 && camera.project(Vec3::X).x > 0.0);
    }

    #[test]
    fn a_window_shows_all_points_in_its_aspect() {
        let camera = Camera::in_front();
        let points = [Vec3::new(-0.5, -0.1, 0.2), Vec3::new(0.4, 0.3, 0.0), Vec3::new(0.0, 0.1, -0.4)];
        let window = camera.window_on(points.into_iter(), 1.5, 0.05);
        assert!((window.half.x / window.half.y - 1.5).abs() < 1e-5);
        for place in points.map(|point| camera.project(point)) {
            assert!(((place - window.centre).abs().cmplt(window.half)).all());
        }
        assert_eq!(window.at(0.5, 0.5), window.centre);
        assert!((window.at(1.0, 0.0) - window.centre - window.half).length() < 1e-6);
    }
}
