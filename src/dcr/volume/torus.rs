//! Points of a cuboid as fractions of the periods of a torus.
//!
//! As in the plane (`dcr/torus/mod.rs`) a coordinate counts 2^-32 of a period, so that differences wrap without any code.
//! A bounded cuboid lies in a torus that is longer by more than forces reach: what stands on one face does not see the
//! opposite one, and the boundary is a wall that points are held back by. No mirror images are needed: a point is never
//! nearer to the image of another than to the other itself, and constraints that are met exert no force.
//!
//! On an axis that is short for the reach of the forces the torus has several periods, and points have images in each.
//! On an axis thinner than a layer of points there are none: each point then counts once, at its nearest place.

use crate::dcr::relaxation::Space;
use crate::math::{rounded_down, rounded_up, square};
use crate::points::{Boundary, Domain};
use crate::simd::Position;

/// The coordinates of a point, in 2^-32 of the periods.
pub type Place = [u32; 3];

/// The number of these units in a period.
const TURN: f64 = (1u64 << 32) as f64;

/// The distance of layers in the densest packing, in spacings: sqrt(2/3). No cuboid is thinner for points than one layer.
const LAYER: f64 = 0.816496580927726;

/// A bounded cuboid is longer by so many spacings for points, which stand on both of its faces. With more, the last conflict
/// radius cannot be satisfied.
const WALLS: f64 = 0.2;

/// The halvings of the interval in which the spacing is found: to the last bit.
const BISECTIONS: u32 = 80;

/// The distance from face to face around the torus of a bounded cuboid, and the least half period with images, in spacings:
/// beyond all that is listed.
const BEYOND: f64 = 1.6;

/// The torus of a cuboid.
#[derive(Clone, Copy)]
pub struct VolumeTorus {
    domain: Domain<3>,
    /// The unit of length of all forces.
    spacing: f64,
    /// The length of 2^-32 of each period, in spacings.
    unit: [f64; 3],
    /// The last coordinate in the domain on each axis.
    last: Place,
    /// The binary logarithm of the number of periods of the domain on each axis.
    period_bits: [u32; 3],
}

impl VolumeTorus {
    /// The torus for `count` points, at least one.
    pub fn new(domain: Domain<3>, count: usize) -> Self {
        Self::with_spacing(domain, spacing(&domain, count))
    }

    /// The torus of a cuboid for the inside of a body in it, of this volume and surface.
    pub fn around(domain: Domain<3>, [volume, area]: [f64; 2], count: usize) -> Self {
        Self::with_spacing(domain, spacing_inside(volume, area, count))
    }

    fn with_spacing(domain: Domain<3>, spacing: f64) -> Self {
        let extent = domain.extent();
        let mut torus = Self { domain, spacing, unit: [0.0; 3], last: [u32::MAX; 3], period_bits: [0; 3] };
        for (axis, side) in extent.into_iter().enumerate() {
            let length = side / spacing;
            let period = match domain.boundary {
                Boundary::Bounded => {
                    let period = length + BEYOND;
                    torus.last[axis] = (length / period * TURN) as u32;
                    period
                }
                Boundary::Periodic => {
                    let bits = match length {
                        ..LAYER => 0,
                        _ => (0..).find(|&bits| length * f64::from(1 << bits) >= 2.0 * BEYOND).unwrap_or(0),
                    };
                    (torus.period_bits[axis], torus.last[axis]) = (bits, u32::MAX >> bits);
                    length * f64::from(1 << bits)
                }
            };
            torus.unit[axis] = period / TURN;
        }
        torus
    }

    /// The cuboid.
    pub fn domain(&self) -> Domain<3> {
        self.domain
    }

    /// The unit of length of all forces.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The length of 2^-32 of each period, in spacings.
    pub fn unit(&self) -> [f64; 3] {
        self.unit
    }

    /// The number of these units in a spacing.
    pub fn per_spacing(&self) -> [f32; 3] {
        self.unit.map(|unit| (1.0 / unit) as f32)
    }

    /// The length of each period, in spacings.
    pub fn periods(&self) -> [f64; 3] {
        self.unit.map(|unit| unit * TURN)
    }

    /// The sides of the cuboid, in spacings.
    #[cfg(test)]
    pub fn extent(&self) -> [f64; 3] {
        self.domain.extent().map(|length| length / self.spacing)
    }

    /// The offsets of the images of a point, without its own.
    pub fn images(&self) -> impl Iterator<Item = Place> + Clone + use<> {
        let [x, y, z] = self.period_bits;
        let along = |number: u32, bits: u32| if bits == 0 { 0 } else { number << (u32::BITS - bits) };
        let part = move |number: u32, below: u32, bits: u32| along(number >> below & ((1 << bits) - 1), bits);
        (1..1u32 << (x + y + z)).map(move |number| [part(number, 0, x), part(number, x, y), part(number, x + y, z)])
    }

    /// The place of a point of the domain.
    pub fn enter(&self, point: [f32; 3]) -> Place {
        std::array::from_fn(|axis| {
            let length = (f64::from(point[axis]) - self.domain.min[axis]) / self.spacing;
            self.inside(axis, (length / self.unit[axis] + 0.5) as i64)
        })
    }

    /// The place at these coordinates, in spacings from the lower corner.
    pub fn place(&self, along: [f64; 3]) -> Place {
        std::array::from_fn(|axis| self.inside(axis, (along[axis] / self.unit[axis] + 0.5) as i64))
    }

    /// The place of a point of the domain, as shares of its sides.
    pub fn fraction(&self, shares: [f64; 3]) -> Place {
        std::array::from_fn(|axis| (shares[axis] * f64::from(self.last[axis])) as u32)
    }

    /// The point of a place, rounded to floats of the domain.
    pub fn leave(&self, place: Place) -> [f32; 3] {
        std::array::from_fn(|axis| {
            let (min, max) = (self.domain.min[axis], self.domain.max[axis]);
            let highest = rounded_down(max);
            let highest = if f64::from(highest) < max { highest } else { highest.next_down() };
            let length = f64::from(place[axis]) * self.unit[axis] * self.spacing;
            ((min + length) as f32).min(highest).max(rounded_up(min))
        })
    }

    /// A place after a displacement in spacings, and for each axis whether the boundary held it back.
    #[inline(always)]
    pub fn moved(&self, place: Place, by: [f32; 3], per_spacing: [f32; 3]) -> (Place, [bool; 3]) {
        let (mut at, mut held, mut axis) = (place, [false; 3], 0);
        while axis < 3 {
            let to = i64::from(place[axis]) + i64::from((by[axis] * per_spacing[axis]) as i32);
            at[axis] = self.inside(axis, to);
            held[axis] = self.is_bounded() && to != i64::from(at[axis]);
            axis += 1;
        }
        (at, held)
    }

    #[inline(always)]
    fn is_bounded(&self) -> bool {
        self.domain.boundary == Boundary::Bounded
    }

    /// A coordinate in the domain.
    #[inline(always)]
    fn inside(&self, axis: usize, x: i64) -> u32 {
        let last = self.last[axis];
        match self.domain.boundary {
            // The number of places is a power of two.
            Boundary::Periodic => x as u32 & last,
            Boundary::Bounded => x.clamp(0, last.into()) as u32,
        }
    }
}

impl Space<Position> for VolumeTorus {
    fn distance_squared(&self, from: Position, to: Position) -> f64 {
        let (from, to) = (place(from), place(to));
        let along = |axis: usize| {
            // Within a period of the domain.
            let bits = self.period_bits[axis];
            let offset = (to[axis].wrapping_sub(from[axis]) << bits).cast_signed() >> bits;
            f64::from(offset) * self.unit[axis]
        };
        square(along(0)) + square(along(1)) + square(along(2))
    }
}

/// A place as the bits of floats, with which nothing is computed: so the vectors that gather positions gather places.
#[inline(always)]
pub fn packed([x, y, z]: Place) -> Position {
    [f32::from_bits(x), f32::from_bits(y), f32::from_bits(z), 0.0]
}

/// The place that bits of floats are.
#[inline(always)]
pub fn place([x, y, z, _]: Position) -> Place {
    [x.to_bits(), y.to_bits(), z.to_bits()]
}

/// [`Domain::packed_distance`] of a cuboid that is as large as it is for points: its sides grow with the distance, less than
/// that does.
fn spacing(domain: &Domain<3>, count: usize) -> f64 {
    let side = |length: f64, distance: f64| match domain.boundary {
        Boundary::Bounded => (length + WALLS * distance).max(LAYER * distance),
        Boundary::Periodic => length.max(LAYER * distance),
    };
    let holds = |distance: f64| {
        let places: f64 = domain.extent().into_iter().map(|length| side(length, distance) / distance).product();
        places * std::f64::consts::SQRT_2
    };
    solved(holds, domain.extent().into_iter().fold(0.0, f64::max), count)
}

/// The same of a body: half as much is added all along its surface, which has two sides of a cuboid on each axis, and no body is
/// thinner than a layer of points between two sides.
fn spacing_inside(volume: f64, area: f64, count: usize) -> f64 {
    let holds = |distance: f64| {
        let layer = 0.5 * area * distance;
        (volume + WALLS * layer).max(LAYER * layer) * std::f64::consts::SQRT_2 / (distance * distance * distance)
    };
    solved(holds, area.sqrt(), count)
}

/// The distance at which a space holds that many points; it holds fewer the larger that is. By halving an interval, beginning
/// anywhere above 0: only operations that are the same to the bit everywhere.
fn solved(holds: impl Fn(f64) -> f64, start: f64, count: usize) -> f64 {
    let mut high = start;
    while holds(high) > count as f64 {
        high *= 2.0;
    }
    while holds(0.5 * high) <= count as f64 {
        high *= 0.5;
    }
    let mut low = 0.5 * high;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if holds(middle) > count as f64 { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::{Draw, Rng};

    #[test]
    fn spacings_are_those_of_the_densest_packing() {
        // Cubes with a point at each corner and on each face.
        for side in [1u32, 2, 7] {
            let domain = Domain { max: [f64::from(side); 3], ..Domain::unit(Boundary::Periodic) };
            let found = spacing(&domain, 4 * side.pow(3) as usize);
            assert!((found - 0.5f64.sqrt()).abs() < 1e-14, "{found}");
        }
        // Triangles of side 1 in a plane.
        let thin = Domain { min: [0.0; 3], max: [100.0 * 0.75f64.sqrt(), 1.0, 1e-20], boundary: Boundary::Periodic };
        assert!((spacing(&thin, 100) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn places_are_points_of_the_domain_to_a_float() {
        let mut rng = Rng::at(8, Draw::Probe, &[]);
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (min, max, count) in [([0.0; 3], [1.0; 3], 1), ([-0.5, 7.0, 1e5], [0.25, 7.1, 1e5 + 3.0], 300)] {
                let domain = Domain { min, max, boundary };
                let torus = VolumeTorus::new(domain, count);
                for k in 0..300 {
                    let mut share = || if k % 3 == 0 { (rng.unit() * 1.999).floor() } else { rng.unit() };
                    let point: [f32; 3] = std::array::from_fn(|axis| {
                        let at = (min[axis] + share() * (max[axis] - min[axis])) as f32;
                        at.max(rounded_up(min[axis])).min(rounded_down(max[axis]).next_down())
                    });
                    let left = torus.leave(torus.enter(point));
                    assert!(domain.contains(point) && domain.contains(left), "{point:?} {left:?}");
                    let offset = domain.offset(point.map(f64::from), left.map(f64::from));
                    for axis in 0..3 {
                        let most = 2e-9 * (max[axis] - min[axis]) * 8.0
                            + f64::from(point[axis].abs().next_up() - point[axis].abs());
                        assert!(offset[axis].abs() <= most, "{point:?} {left:?}");
                    }
                }
            }
        }
    }
}
