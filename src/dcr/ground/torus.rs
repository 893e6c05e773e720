//! Points on a torus as fractions of its periods.
//!
//! A coordinate is a `u32` that counts 2^-32 of a period, so the difference of two points, taken as `i32`, is the
//! shortest offset between them, and the seam of the torus needs no code. A bounded domain becomes a torus of twice its
//! width and height, on which its three mirror images stand beside it (thesis Fig. 4.12 (b)): whatever treats a point
//! and its images alike keeps the mirrors where they are, and with them the boundary.

use glam::{DVec2, Vec2};

use crate::dcr::relaxation::Space;
use crate::error::Result;
use crate::geometry::Frame;
use crate::job::{Job, chunks};
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng};

/// A point on the torus, in 2^-32 of the periods.
pub(in crate::dcr) type TorusPoint = [u32; 2];

/// Half a period: the far boundary of a domain that is mirrored.
pub(in crate::dcr) const HALF: u32 = 1 << 31;
/// A whole one.
pub(in crate::dcr) const TURN: f64 = (1u64 << 32) as f64;

/// Points of a bounded domain keep this distance from its boundary, so that none meets its mirror image.
const INSET: u32 = 16;

/// A little less than a quarter of a period. A flip can double an edge, and half a period is the longest unambiguous
/// offset.
const LONGEST: f32 = 0.9999 * (1u32 << 30) as f32;

/// How far positions are nudged, in spacings.
const NUDGE: f64 = 1e-7;

/// Where a point and its images are on a torus that a domain is mirrored on.
const MIRRORS: [fn(TorusPoint) -> TorusPoint; 4] = [
    |place| place,
    |[x, y]| [x.wrapping_neg(), y],
    |[x, y]| [x, y.wrapping_neg()],
    |[x, y]| [x.wrapping_neg(), y.wrapping_neg()],
];

/// The torus that a domain is, or on which it is mirrored.
#[derive(Clone, Copy)]
pub(in crate::dcr) struct Torus {
    /// The domain as the user sees it.
    domain: Frame,
    /// The whole torus; its unit of length is that of all forces.
    pub(in crate::dcr) frame: Frame,
    /// The length of 2^-32 of each period.
    unit: DVec2,
    /// How often it fits into a spacing.
    per_spacing: Vec2,
}

impl Torus {
    /// The torus for `count` points of a domain.
    pub(in crate::dcr) fn new(domain: Domain, count: usize) -> Self {
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
        };
        torus.frame = Frame::new(whole, count * torus.copies());
        torus.unit = torus.frame.size() / TURN;
        torus.per_spacing = torus.unit.recip().as_vec2();
        torus
    }

    /// How often each point occurs on the torus.
    pub(in crate::dcr) fn copies(&self) -> usize {
        match self.domain.boundary() {
            Boundary::Periodic => 1,
            Boundary::Bounded => 4,
        }
    }

    /// The points of a domain on the torus, parted so that no two coincide and not all lie on one line.
    pub(in crate::dcr) fn enter(&self, points: &[[f32; 2]], seed: u64) -> Vec<TorusPoint> {
        let entered = self.frame.enter(points).into_iter();
        self.parted(&entered.map(|position| self.place(position)).collect::<Vec<_>>(), seed)
    }

    /// Points of the torus, parted so that no two coincide and not all lie on one line.
    pub(in crate::dcr) fn parted(&self, places: &[TorusPoint], seed: u64) -> Vec<TorusPoint> {
        let mut positions: Vec<DVec2> = places.iter().map(|&place| self.position(place)).collect();
        self.frame.part(&mut positions, seed);
        positions.into_iter().map(|position| self.place(position)).collect()
    }

    /// A point in the user's coordinates.
    pub(in crate::dcr) fn leave(&self, place: TorusPoint) -> [f32; 2] {
        self.domain.leave(self.position(place) * (self.frame.spacing() / self.domain.spacing()))
    }

    /// The point of the domain at a position of the torus, or the one that it is the image of.
    pub(in crate::dcr) fn place(&self, position: DVec2) -> TorusPoint {
        // What rounds up to a whole period wraps to 0.
        let fractions = (position / self.unit).round().to_array().map(|x| x as i64 as u32);
        self.inside(fractions)
    }

    /// A point, moved back into the part of the torus that is the domain.
    fn inside(&self, place: TorusPoint) -> TorusPoint {
        match self.domain.boundary() {
            Boundary::Periodic => place,
            Boundary::Bounded => place.map(|x| x.min(x.wrapping_neg()).clamp(INSET, HALF - INSET)),
        }
    }

    /// The position in spacings.
    pub(in crate::dcr) fn position(&self, place: TorusPoint) -> DVec2 {
        DVec2::new(place[0].into(), place[1].into()) * self.unit
    }

    /// The points and, where the domain is mirrored, after them their images.
    pub(in crate::dcr) fn with_images(&self, points: &[TorusPoint]) -> Vec<TorusPoint> {
        MIRRORS[..self.copies()].iter().flat_map(|mirror| points.iter().copied().map(mirror)).collect()
    }

    /// Moves the images, which follow the first `count` places, to where their points are.
    pub(in crate::dcr) fn mirror(&self, job: &Job, places: &mut [TorusPoint], count: usize) -> Result<()> {
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
    pub(in crate::dcr) fn image_distances(&self, place: TorusPoint) -> [f32; 2] {
        match self.domain.boundary() {
            Boundary::Periodic => [f32::NAN; 2],
            Boundary::Bounded => {
                let unit = self.unit.as_vec2().to_array();
                std::array::from_fn(|axis| place[axis].wrapping_mul(2).wrapping_neg().cast_signed() as f32 * unit[axis])
            }
        }
    }

    /// The offsets from a point of a bounded domain to its own images across the nearest sides.
    pub(in crate::dcr) fn own_images(&self, place: TorusPoint) -> [Vec2; 2] {
        let [x, y] = place;
        [[x.wrapping_neg(), y], [x, y.wrapping_neg()]].map(|image| self.offset_f32(place, image))
    }

    /// The positions of points, nudged by so little that it changes one thing only: where four are on one circle, as
    /// points and their mirror images are, all copies of them agree on the diagonal that is an edge.
    pub(in crate::dcr) fn nudged(&self, places: &[TorusPoint]) -> Vec<DVec2> {
        (0..).zip(places).map(|(point, &place)| self.position(place) + nudge(point)).collect()
    }

    /// The length of 2^-32 of each period, and the longest edges whose double is unambiguous: a quarter of each.
    pub(in crate::dcr) fn unit_and_longest(&self) -> (Vec2, [f32; 2]) {
        let unit = self.unit.as_vec2();
        (unit, (unit * LONGEST).to_array())
    }

    /// The shortest offset between two points.
    pub(in crate::dcr) fn offset(&self, from: TorusPoint, to: TorusPoint) -> DVec2 {
        let along = |axis: usize| f64::from(to[axis].wrapping_sub(from[axis]).cast_signed());
        DVec2::new(along(0), along(1)) * self.unit
    }

    /// [`Torus::offset`] to seven digits, which is faster.
    pub(in crate::dcr) fn offset_f32(&self, from: TorusPoint, to: TorusPoint) -> Vec2 {
        let along = |axis: usize| to[axis].wrapping_sub(from[axis]).cast_signed() as f32;
        Vec2::new(along(0), along(1)) * self.unit.as_vec2()
    }

    /// A point of the domain after a displacement.
    pub(in crate::dcr) fn moved(&self, place: TorusPoint, displacement: Vec2) -> TorusPoint {
        let by = (displacement * self.per_spacing).to_array();
        self.inside(std::array::from_fn(|axis| place[axis].wrapping_add((by[axis] as i32).cast_unsigned())))
    }
}

impl Space<TorusPoint> for Torus {
    fn distance_squared(&self, from: TorusPoint, to: TorusPoint) -> f64 {
        self.frame.offset(self.position(from), self.position(to)).length_squared()
    }
}

/// The displacement by which a point is nudged.
pub(in crate::dcr) fn nudge(point: u32) -> DVec2 {
    let mut rng = Rng::at(0, Draw::Part, &[point.into(), point.into()]);
    NUDGE * DVec2::new(rng.unit(), rng.unit())
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
