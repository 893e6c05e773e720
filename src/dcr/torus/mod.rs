//! Points on a torus as fractions of its periods.
//!
//! A coordinate is a `u32` that counts 2^-32 of a period, so the difference of two points, taken as `i32`, is the
//! shortest offset between them, and the seam of the torus needs no code. A bounded domain becomes a torus of twice its
//! width and height, on which its three mirror images stand beside it (thesis Fig. 4.12 (b)): any operation that treats
//! a point and its images alike preserves the mirrors, and with them the boundary.

mod boundary;
mod waves;

pub use boundary::MirrorBoundary;
pub use waves::{CLUSTERED, Field, LEVEL, LONG_WAVES, WaveGrid, leveled};

use glam::{DVec2, Vec2};

use crate::dcr::relaxation::Space;
use crate::error::Result;
use crate::geometry::{Delaunay, Frame};
use crate::index::curve::{morton2, sorted};
use crate::job::{Job, chunks};
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng};

/// A point on the torus, in 2^-32 of the periods.
pub type TorusPoint = [u32; 2];

/// Half a period: the far boundary of a mirrored domain.
pub const HALF: u32 = 1 << 31;
/// A whole period.
pub const TURN: f64 = (1u64 << 32) as f64;

/// Points of a bounded domain keep this distance from its boundary, so that none meets its mirror image.
const INSET: u32 = 16;

/// A little less than a quarter of a period. A flip can double an edge, and half a period is the longest unambiguous
/// offset.
const LONGEST: f32 = 0.9999 * (1u32 << 30) as f32;

/// The distance by which positions are nudged, in spacings.
const NUDGE: f64 = 1e-7;

/// The positions of a point and its images on a torus that a domain is mirrored on.
const MIRRORS: [fn(TorusPoint) -> TorusPoint; 4] = [
    |place| place,
    |[x, y]| [x.wrapping_neg(), y],
    |[x, y]| [x, y.wrapping_neg()],
    |[x, y]| [x.wrapping_neg(), y.wrapping_neg()],
];

/// The torus that a domain is, or on which it is mirrored.
#[derive(Clone, Copy)]
pub struct Torus {
    /// The domain as the user sees it.
    domain: Frame,
    /// The whole torus; its unit of length is that of all forces.
    pub frame: Frame,
    /// The length of 2^-32 of each period.
    unit: DVec2,
    /// The number of these units in a spacing.
    per_spacing: Vec2,
    /// The bits of a coordinate that count periods of the frame: none, but for a torus of several.
    period_bits: u32,
}

impl Torus {
    /// The torus for `count` points of a domain.
    pub fn new(domain: Domain, count: usize) -> Self {
        let [width, height] = domain.extent();
        let whole = match domain.boundary {
            Boundary::Periodic => domain,
            Boundary::Bounded => Domain {
                max: [domain.min[0] + 2.0 * width, domain.min[1] + 2.0 * height],
                boundary: Boundary::Periodic,
                ..domain
            },
        };
        let mut torus = Self {
            domain: Frame::new(domain, count),
            frame: Frame::new(whole, count),
            unit: DVec2::ONE,
            per_spacing: Vec2::ONE,
            period_bits: 0,
        };
        torus.frame = Frame::new(whole, count * torus.copies());
        torus.unit = torus.frame.size() / TURN;
        torus.per_spacing = torus.unit.recip().as_vec2();
        torus
    }

    /// The torus of 2^`period_bits` periods of this one along each axis, for offsets between its points.
    pub fn covering(&self, period_bits: u32) -> Self {
        let periods = (1u64 << period_bits) as f64;
        Self { unit: self.unit * periods, per_spacing: self.per_spacing / periods as f32, period_bits, ..*self }
    }

    /// The number of times that each point occurs on the torus.
    pub fn copies(&self) -> usize {
        match self.domain.boundary() {
            Boundary::Periodic => 1,
            Boundary::Bounded => 4,
        }
    }

    /// The points of a domain on the torus.
    fn given(&self, points: &[[f32; 2]]) -> Vec<TorusPoint> {
        self.frame.enter(points).into_iter().map(|position| self.place(position)).collect()
    }

    /// The points of a domain on the torus, parted so that no two coincide and not all lie on one line.
    pub fn enter(&self, points: &[[f32; 2]], seed: u64) -> Vec<TorusPoint> {
        self.parted(&self.given(points), seed)
    }

    /// Points of the torus, parted so that no two coincide and not all lie on one line.
    pub fn parted(&self, places: &[TorusPoint], seed: u64) -> Vec<TorusPoint> {
        let mut positions: Vec<DVec2> = places.iter().map(|&place| self.position(place)).collect();
        self.frame.part(&mut positions, seed);
        positions.into_iter().map(|position| self.place(position)).collect()
    }

    /// A point in the user's coordinates.
    pub fn leave(&self, place: TorusPoint) -> [f32; 2] {
        self.domain.leave(self.position(place) * (self.frame.spacing() / self.domain.spacing()))
    }

    /// The point of the domain at a position of the torus, or the one that it is the image of.
    pub fn place(&self, position: DVec2) -> TorusPoint {
        // Away from 0 where halves are: what `round` does, but without a call. A position that rounds up to a whole period
        // wraps to 0.
        let fractions = (position / self.unit).to_array().map(|x| (x + 0.5f64.copysign(x)) as i64 as u32);
        self.inside(fractions)
    }

    /// A point, moved back into the part of the torus that is the domain.
    pub fn inside(&self, place: TorusPoint) -> TorusPoint {
        match self.domain.boundary() {
            Boundary::Periodic => place,
            Boundary::Bounded => place.map(|x| x.min(x.wrapping_neg()).clamp(INSET, HALF - INSET)),
        }
    }

    /// The position in spacings.
    pub fn position(&self, place: TorusPoint) -> DVec2 {
        DVec2::new(place[0].into(), place[1].into()) * self.unit
    }

    /// The points and, where the domain is mirrored, after them their images.
    pub fn with_images(&self, points: &[TorusPoint]) -> Vec<TorusPoint> {
        MIRRORS[..self.copies()].iter().flat_map(|mirror| points.iter().copied().map(mirror)).collect()
    }

    /// Moves the images, which follow the first `count` places, to where their points are.
    pub fn mirror(&self, job: &Job, places: &mut [TorusPoint], count: usize) -> Result<()> {
        let (points, images) = places.split_at_mut(count);
        let size = chunks(count).size();
        let parts = images.chunks_mut(count.max(1)).zip(&MIRRORS[1..]).flat_map(|(images, mirror)| {
            images.chunks_mut(size).zip(points.chunks(size)).map(move |(images, points)| (images, points, mirror))
        });
        job.map_each(parts.collect(), |(images, points, mirror)| {
            images.iter_mut().zip(points).for_each(|(image, &point)| *image = mirror(point));
        })?;
        Ok(())
    }

    /// The distances from a point to its own images across the boundary, along `x` and along `y`; NaN on a periodic
    /// domain.
    #[inline(always)]
    pub fn image_distances(&self, place: TorusPoint) -> [f32; 2] {
        match self.domain.boundary() {
            Boundary::Periodic => [f32::NAN; 2],
            Boundary::Bounded => {
                let unit = self.unit.as_vec2().to_array();
                // Within a period of the frame.
                let shortest = |offset: u32| (offset << self.period_bits).cast_signed() >> self.period_bits;
                std::array::from_fn(|axis| shortest(place[axis].wrapping_mul(2).wrapping_neg()) as f32 * unit[axis])
            }
        }
    }

    /// The offsets from a point of a bounded domain to its own images across the nearest sides.
    pub fn own_images(&self, place: TorusPoint) -> [Vec2; 2] {
        let [x, y] = place;
        [[x.wrapping_neg(), y], [x, y.wrapping_neg()]].map(|image| self.offset_f32(place, image))
    }

    /// The positions of points, nudged so little that the only effect is this: where four are on one circle, as points
    /// and their mirror images are, all copies of them agree on the diagonal that is an edge.
    pub fn nudged(&self, places: &[TorusPoint]) -> Vec<DVec2> {
        (0..).zip(places).map(|(point, &place)| self.position(place) + nudge(point)).collect()
    }

    /// The length of 2^-32 of each period, and the longest edges whose double is unambiguous: a quarter of each period.
    pub fn unit_and_longest(&self) -> (Vec2, [f32; 2]) {
        let unit = self.unit.as_vec2();
        (unit, (unit * LONGEST).to_array())
    }

    /// The shortest offset between two points.
    pub fn offset(&self, from: TorusPoint, to: TorusPoint) -> DVec2 {
        let along = |axis: usize| f64::from(to[axis].wrapping_sub(from[axis]).cast_signed());
        DVec2::new(along(0), along(1)) * self.unit
    }

    /// [`Torus::offset`] to seven digits, which is faster.
    pub fn offset_f32(&self, from: TorusPoint, to: TorusPoint) -> Vec2 {
        let along = |axis: usize| to[axis].wrapping_sub(from[axis]).cast_signed() as f32;
        Vec2::new(along(0), along(1)) * self.unit.as_vec2()
    }

    /// A point of the domain after a displacement.
    pub fn moved(&self, place: TorusPoint, displacement: Vec2) -> TorusPoint {
        self.inside(self.displaced(place, displacement))
    }

    /// A point of the torus after a displacement.
    pub fn displaced(&self, place: TorusPoint, displacement: Vec2) -> TorusPoint {
        let by = (displacement * self.per_spacing).to_array();
        std::array::from_fn(|axis| place[axis].wrapping_add((by[axis] as i32).cast_unsigned()))
    }
}

impl Space<TorusPoint> for Torus {
    fn distance_squared(&self, from: TorusPoint, to: TorusPoint) -> f64 {
        self.frame.offset(self.position(from), self.position(to)).length_squared()
    }
}

/// The displacement by which a point is nudged.
pub fn nudge(point: u32) -> DVec2 {
    let mut rng = Rng::at(0, Draw::Part, &[point.into(), point.into()]);
    NUDGE * DVec2::new(rng.unit(), rng.unit())
}

// The points of a set in the order of a Z-curve: points that are close in the plane are close in memory.

/// The starting positions of a set, in the order of the curve.
pub struct CurveOrder {
    /// The user's index of each point.
    order: Vec<u32>,
    /// The positions that were given.
    given: Vec<TorusPoint>,
    start: Vec<TorusPoint>,
}

impl CurveOrder {
    /// Orders points of the domain. Those that coincide are parted, keyed by the seed.
    pub fn new(torus: &Torus, points: &[[f32; 2]], seed: u64) -> Self {
        let given = torus.given(points);
        let parted = torus.parted(&given, seed);
        let order = order_along_curve(&parted);
        let at = |all: &[TorusPoint]| order.iter().map(|&point| all[point as usize]).collect();
        Self { given: at(&given), start: at(&parted), order }
    }

    /// The order after the points have been moved to `places` before the first step, and `places` in that order.
    pub fn reordered(&self, places: &[TorusPoint]) -> (Self, Vec<TorusPoint>) {
        let order = order_along_curve(places);
        let of = |all: &[u32]| order.iter().map(|&point| all[point as usize]).collect();
        let at = |all: &[TorusPoint]| order.iter().map(|&point| all[point as usize]).collect();
        (Self { order: of(&self.order), given: at(&self.given), start: at(&self.start) }, at(places))
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// The user's index of a point.
    pub fn user(&self, point: u32) -> usize {
        self.order[point as usize] as usize
    }

    /// The positions that were given, where points may coincide.
    pub fn given(&self) -> &[TorusPoint] {
        &self.given
    }

    /// The starting positions.
    pub fn start(&self) -> &[TorusPoint] {
        &self.start
    }

    /// The points, which are now at `places`, in the user's order; `points` are those with which the set began. Points
    /// that have not moved are returned unchanged.
    pub fn leave(&self, torus: &Torus, places: &[TorusPoint], points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for ((&point, &start), &place) in self.order.iter().zip(&self.start).zip(places) {
            if place != start {
                relaxed[point as usize] = torus.leave(place);
            }
        }
        relaxed
    }
}

/// The place of each of these points along the Z-curve.
pub fn along_curve(places: &[TorusPoint]) -> Vec<u64> {
    places.iter().map(|&place| morton2(place)).collect()
}

/// The order of places along the curve.
fn order_along_curve(places: &[TorusPoint]) -> Vec<u32> {
    sorted(places.iter().map(|&place| morton2(place))).into_iter().map(|(_, i)| i).collect()
}

// The test for edges of a triangulation of the torus that must be flipped.
//
// As long as no triangle turns over, a triangulation of moving points stays one, and flipping the edges that are not
// locally Delaunay, in any order, makes it the Delaunay triangulation again (Lawson 1977). No exact predicates are
// needed: forces do not feel the difference, and flips end because edges within rounding of 180 degrees are left
// alone.

/// The sum of two cotangents that counts as negative: below the rounding of `f64`, flips could go on for ever.
const NEGATIVE: f64 = -1e-7;

/// True if the angles that face the edge from `p` to `q`, at `r` and at `s`, sum up to more than 180 degrees: the sum
/// of their cotangents is negative.
pub fn must_flip(torus: &Torus, [p, q, r, s]: [TorusPoint; 4]) -> bool {
    let angle = |apex: TorusPoint, from: TorusPoint, to: TorusPoint| -> [f64; 2] {
        let (from, to): (DVec2, DVec2) = (torus.offset(apex, from), torus.offset(apex, to));
        [from.dot(to), from.perp_dot(to)]
    };
    let ([cos_r, sin_r], [cos_s, sin_s]) = (angle(r, p, q), angle(s, q, p));
    cos_r * sin_s + cos_s * sin_r < NEGATIVE * sin_r * sin_s
}

/// The Delaunay neighbours of all points in one step.
pub enum Neighbours<Mesh> {
    /// In a mesh that is kept from step to step and repaired by flips.
    Kept(Mesh),
    /// In a triangulation built for this step, where no mesh can be kept: sets of a few points, or with large holes.
    Built(Delaunay),
}

/// Sets for the tests of meshes that are kept: random ones, random moves as far as a mesh allows, and sets without a
/// mesh.
#[cfg(test)]
pub mod random_sets {
    use glam::Vec2;

    use super::{Torus, TorusPoint};
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Random places of the torus that a domain is or is mirrored on, and the torus. The images come after the points.
    pub fn random_places(boundary: Boundary, width: f64, count: usize) -> (Torus, Vec<TorusPoint>) {
        let torus = Torus::new(Domain { min: [0.0; 2], max: [width, 1.0], boundary }, count);
        let mut rng = Rng::at(3, Draw::Probe, &[count as u64]);
        let points: Vec<_> = (0..count).map(|_| [rng.unit() * width, rng.unit()].map(|x| x as f32)).collect();
        let places = torus.with_images(&torus.enter(&points, 0));
        (torus, places)
    }

    /// Moves the first `count` points as far as their triangles allow, and their images with them. `offsets` gives
    /// those of the neighbours of a point, counter-clockwise.
    pub fn wander(
        torus: &Torus,
        places: &mut Vec<TorusPoint>,
        count: usize,
        offsets: impl Fn(usize) -> Vec<Vec2>,
        rng: &mut Rng,
    ) {
        let clearance = |point: usize| {
            let ring = offsets(point);
            let height = |(a, b): (&Vec2, &Vec2)| a.perp_dot(*b) / a.length().max(b.length()).max(a.distance(*b));
            ring.iter().zip(ring.iter().cycle().skip(1)).map(height).fold(f32::INFINITY, f32::min)
        };
        let clearances: Vec<f32> = (0..count).map(clearance).collect();
        let moved = |(&place, clearance): (&TorusPoint, f32)| {
            torus.moved(place, Vec2::from_angle(rng.unit() as f32 * 6.3) * 0.45 * clearance)
        };
        let points: Vec<TorusPoint> = places[..count].iter().zip(clearances).map(moved).collect();
        *places = torus.with_images(&points);
    }

    /// Sets of the unit torus, each with true if it has a mesh: a few points, a set with a large hole, and one without.
    pub fn with_and_without_mesh() -> [(Torus, Vec<TorusPoint>, bool); 3] {
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        [(5, 1.0, false), (500, 0.5, false), (500, 1.0, true)].map(|(count, part, has_mesh)| {
            let points: Vec<_> = (0..count).map(|_| [rng.unit() * part, rng.unit() * part].map(|x| x as f32)).collect();
            let torus = Torus::new(Domain::unit(Boundary::Periodic), count);
            let places = torus.enter(&points, 0);
            (torus, places, has_mesh)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn torus(boundary: Boundary) -> Torus {
        Torus::new(Domain { min: [-1.0, 2.0], max: [3.0, 5.0], boundary }, 100)
    }

    #[test]
    fn points_return_to_where_they_came_from() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let points = [[-0.75, 2.25], [2.875, 4.96875], [0.0, 3.0]];
            let places = torus(boundary).enter(&points, 0);
            for (place, point) in places.iter().zip(points) {
                let left = torus(boundary).leave(*place);
                assert!((0..2).all(|axis| (left[axis] - point[axis]).abs() < 1e-6), "{left:?} {point:?}");
            }
        }
    }

    #[test]
    fn offsets_are_the_shortest_and_moves_follow_them() {
        let torus = torus(Boundary::Periodic);
        let places = torus.enter(&[[-0.875, 2.125], [2.875, 4.875], [1.0, 4.0]], 0);
        let spacing = torus.frame.spacing();
        let offset = torus.offset(places[0], places[1]);
        assert!((offset * spacing).distance(DVec2::new(-0.25, -0.25)) < 1e-6, "{offset}");
        let moved = torus.moved(places[0], offset.as_vec2());
        assert!(torus.offset(moved, places[1]).length() < 1e-6);
    }

    #[test]
    fn mirrored_points_stay_in_their_quarter() {
        let torus = torus(Boundary::Bounded);
        for point in [[-1.0, 2.0], [2.999_999_8, 4.999_999_5], [-1.0, 3.0]] {
            let place = torus.enter(&[point, [0.0, 3.0]], 0)[0];
            for displacement in [Vec2::new(-0.3, -0.2), Vec2::new(0.3, 0.1), Vec2::ZERO] {
                let moved = torus.moved(place, displacement);
                assert!(moved.iter().all(|x| (INSET..=HALF - INSET).contains(x)));
            }
        }
    }
}
