//! The push–pull law of the forces between neighbours: two constraints, neither of which exerts a force when it is met.
//!
//! * *Conflict*: neighbours closer than the conflict radius push the point away, as in the thesis (eq. 4.10).
//! * *Coverage*: triangles with a circumradius above the coverage radius pull the point towards their circumcentre,
//!   which is the position farthest from all points. The thesis attracts along long edges instead, but a long edge need
//!   not mean a hole, nor a hole a long edge (Ahmed et al. 2016, "A simple push-pull algorithm for blue-noise
//!   sampling").

use glam::Vec2;

use crate::geometry::scaled_circumcentre;
use crate::math::square;
use crate::simd::Lanes;

/// The fraction of its last displacement that a point repeats in a step.
pub const MOMENTUM: f32 = 0.78;

/// The fraction of its clearance that a point may move by: less than half, so that no triangle turns over.
pub const SAFE_FRACTION: f32 = 0.45;

/// The clearance, in spacings, of points that are in no mesh.
pub const FREE_CLEARANCE: f32 = 1.0;

/// The tension at which a pull stops growing: otherwise the wide holes of random sets would draw the points around them
/// too far in.
const STRONGEST_PULL: f32 = 1.0;

/// The steps over which constraints grow stiffer.
pub const STIFFENING: u32 = 60;

/// The points that are the neighbours of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its neighbours in the Delaunay triangulation: they keep their distance and close holes (§4.3.3).
    Delaunay,
    /// Its nearest points: they only repel (§4.3.4). The smallest distance ends larger than with Delaunay neighbours,
    /// and so do the holes.
    Nearest,
}

/// The constraints and their stiffness, in spacings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraints {
    pub conflict_radius: f32,
    pub coverage_radius: f32,
    /// The displacement by a conflict of tension 1.
    pub push: f32,
    /// The displacement by a hole of tension 1.
    pub pull: f32,
}

/// The sum of forces on a point, and the bound of its move.
#[derive(Clone, Copy, Default)]
pub struct Force {
    pub sum: Vec2,
    /// The least height of the triangles around the point. If no corner of a triangle moves by half of its least
    /// height, it cannot turn over: three points that close to a line form no triangle of that height.
    pub clearance: f32,
}

impl Force {
    /// The displacement of a point in a step, and its velocity after it; `drift` is the part of the displacement that
    /// is not repeated.
    #[inline(always)]
    pub fn moves(self, velocity: Vec2, drift: Vec2) -> (Vec2, Vec2) {
        let limit = SAFE_FRACTION * self.clearance;
        let velocity = MOMENTUM * velocity + self.sum;
        let limited = |vector: Vec2| limited(vector.to_array(), limit).into();
        (limited(velocity + drift), limited(velocity))
    }
}

/// The velocity of a point after a step in which this force acts on it, which is its displacement if nothing else moves it.
#[inline(always)]
pub fn carried<const D: usize>(velocity: [f32; D], force: [f32; D], clearance: f32) -> [f32; D] {
    let (mut sum, mut axis) = (force, 0);
    while axis < D {
        sum[axis] += MOMENTUM * velocity[axis];
        axis += 1;
    }
    limited(sum, SAFE_FRACTION * clearance)
}

/// A vector times a number.
#[inline(always)]
fn scaled<const D: usize>(mut vector: [f32; D], scale: f32) -> [f32; D] {
    let mut axis = 0;
    while axis < D {
        vector[axis] *= scale;
        axis += 1;
    }
    vector
}

/// A vector, cut to a length.
#[inline(always)]
fn limited<const D: usize>(vector: [f32; D], limit: f32) -> [f32; D] {
    let (mut squared, mut axis) = (0.0, 0);
    while axis < D {
        squared += vector[axis] * vector[axis];
        axis += 1;
    }
    let scale = if squared > limit * limit { limit / squared.sqrt() } else { 1.0 };
    scaled(vector, scale)
}

impl Constraints {
    /// The constraints of a step with Delaunay neighbours. Radii, stiffness and momentum were chosen on sets of 1,000
    /// to 65,536 points: with more momentum or stiffer pulls sets get more regular.
    pub fn of_step(iterations: u32) -> Self {
        let stiff = iterations.min(STIFFENING) as f32 / STIFFENING as f32;
        let (push, pull) = (0.1 + 0.3 * stiff, 0.1 + 0.1 * stiff);
        Self { conflict_radius: 0.862, coverage_radius: 0.66, push, pull }
    }

    /// The force by the neighbours, which form a ring around the point, in counter-clockwise order.
    pub fn force(&self, ring: &[Vec2]) -> Force {
        // The square of the least height is a fraction: one division is enough for all.
        let (mut sum, mut least) = (Vec2::ZERO, (f32::INFINITY, 1f32));
        let mut before = *ring.last().unwrap_or(&Vec2::ZERO);
        let mut before_squared = before.length_squared();
        for &offset in ring {
            let (squared, opposite) = (offset.length_squared(), (offset - before).length_squared());
            // Twice the area of the triangle.
            let area = before.perp_dot(offset);
            let height = (area.max(0.0) * area, before_squared.max(squared).max(opposite));
            least = if height.0 * least.1 < least.0 * height.1 { height } else { least };
            sum += self.push(offset, squared);
            // The circumradius is the product of the edges over four times the area.
            if before_squared * squared * opposite > square(2.0 * self.coverage_radius * area) {
                sum += self.pull(before, offset, area);
            }
            (before, before_squared) = (offset, squared);
        }
        Force { sum, clearance: (least.0 / least.1).sqrt() }
    }

    /// The force by one neighbour.
    pub fn push(&self, offset: Vec2, squared: f32) -> Vec2 {
        if squared >= self.conflict_radius * self.conflict_radius || squared == 0.0 {
            return Vec2::ZERO;
        }
        self.conflict(squared.sqrt()) * offset
    }

    /// The factor of the offset of a neighbour in conflict, at a distance from the point: below 0.
    #[inline(always)]
    pub fn conflict(&self, distance: f32) -> f32 {
        self.push * (self.conflict_radius.recip() - distance.recip())
    }

    /// [`Constraints::conflict`] in vectors.
    #[inline(always)]
    pub fn conflicts<L: Lanes>(&self, lanes: L, distance: L::Floats) -> L::Floats {
        let near = lanes.div(lanes.splat(1.0), distance);
        lanes.mul(lanes.splat(self.push), lanes.sub(lanes.splat(self.conflict_radius.recip()), near))
    }

    /// The factor of the offset of a circumcentre, of this circumradius.
    #[inline(always)]
    pub fn hole(&self, radius: f32) -> f32 {
        self.pull * (self.coverage_radius.recip() - radius.recip()).min(STRONGEST_PULL * radius.recip())
    }

    /// [`Constraints::hole`] in vectors.
    #[inline(always)]
    pub fn holes<L: Lanes>(&self, lanes: L, radius: L::Floats) -> L::Floats {
        let near = lanes.div(lanes.splat(1.0), radius);
        let tension = lanes.sub(lanes.splat(self.coverage_radius.recip()), near);
        lanes.mul(lanes.splat(self.pull), lanes.min(tension, lanes.mul(lanes.splat(STRONGEST_PULL), near)))
    }

    /// The force by a hole: the triangle between two neighbours, of twice this area.
    pub fn pull(&self, a: Vec2, b: Vec2, area: f32) -> Vec2 {
        let centre = scaled_circumcentre(a, b) * (2.0 * area).recip();
        let radius = centre.length();
        // Infinite or NaN for triangles without area, and 0 by rounding where two neighbours almost coincide.
        if !(radius.is_finite() && radius > 0.0) {
            return Vec2::ZERO;
        }
        self.hole(radius) * centre
    }
}

// Forces where the spacing varies: the constraints of the momentum method, with distances in units of the mean spacing
// of the two points, circumradii in units of the spacing that the density at the centre asks for, and displacements in
// units of the point's own spacing.
//
// Holes are judged by the density itself because a spacing whose growth is limited is too small beside edges: with it,
// holes would pull points out of dark areas, and the error of tone is three to ten times as large.

/// A neighbour in the ring around a point: its offset and its local spacing.
#[derive(Clone, Copy)]
pub struct RingPoint {
    pub offset: Vec2,
    pub spacing: f32,
}

/// The force on a point, in units of its spacing, by the neighbours in the ring around it, in counter-clockwise order;
/// `density_at` gives the density, in units of the mean, at an offset from the point.
pub fn graded_force(
    constraints: &Constraints,
    spacing: f32,
    ring: &[RingPoint],
    density_at: impl Fn(Vec2) -> f32,
) -> Force {
    let (mut sum, mut clearance) = (Vec2::ZERO, f32::INFINITY);
    let Some(&(mut before)) = ring.last() else { return Force { sum, clearance } };
    for &neighbour in ring {
        let offset = neighbour.offset / (0.5 * (spacing + neighbour.spacing));
        sum += constraints.push(offset, offset.length_squared());
        let (a, b) = (before.offset, neighbour.offset);
        let (area, longest) = (a.perp_dot(b), a.length_squared().max(b.length_squared()).max(a.distance_squared(b)));
        clearance = clearance.min(area.max(0.0) / longest.sqrt());
        sum += pull(constraints, spacing.min(before.spacing).min(neighbour.spacing), a, b, &density_at);
        before = neighbour;
    }
    Force { sum, clearance }
}

/// The force by the triangle of a point and two neighbours, the least of whose spacings is given: none unless its
/// circumradius is too large for the spacing at its centre.
fn pull(constraints: &Constraints, least: f32, a: Vec2, b: Vec2, density_at: impl Fn(Vec2) -> f32) -> Vec2 {
    let area = a.perp_dot(b);
    // The circumradius is the product of the edges over twice this area.
    let edges = a.length_squared() * b.length_squared() * a.distance_squared(b);
    if edges <= square(2.0 * least * constraints.coverage_radius * area) {
        return Vec2::ZERO;
    }
    let centre = scaled_circumcentre(a, b) / (2.0 * area);
    if !centre.is_finite() {
        return Vec2::ZERO;
    }
    let scale = density_at(centre).sqrt();
    if scale * centre.length() > constraints.coverage_radius {
        constraints.pull(scale * a, scale * b, scale * scale * area)
    } else {
        Vec2::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_that_all_but_coincide_push_and_do_not_tear() {
        // Their circumcentre is computed as the point itself: a hole of radius 0, which must not be a divisor.
        let ring = [
            Vec2::new(-0.57636416, 0.43213812),
            Vec2::new(-0.6563772, -1.291182),
            Vec2::new(0.480859, -1.1277492),
            Vec2::new(1.228005, 0.07295092),
            Vec2::new(0.7383431, 1.509538),
            Vec2::new(0.73834306, 1.509538),
        ];
        let Force { sum, clearance } = Constraints::of_step(30).force(&ring);
        assert!(sum.is_finite() && sum.length() < 1.0 && clearance > 0.0, "{sum}, {clearance}");
    }
}
