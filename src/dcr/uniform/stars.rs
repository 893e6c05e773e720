//! Forces in the Delaunay stars of eight points at a time: [`Constraints::force`] in vectors, the same to the bit.
//!
//! The loops over eight lanes are plain; the compiler makes vectors of them.

use std::array::from_fn;
use std::ops::Range;

use crate::dcr::law::Constraints;
use crate::dcr::torus::{Torus, TorusPoint};
use crate::dcr::uniform::rings::{Copies, Rings};
use crate::simd::{Lanes, Level, Work, run};

/// The number of points that are processed at a time.
pub const EIGHT: usize = 8;

type Floats = [f32; EIGHT];

/// The last bit of the masks of suspects.
const LAST_BIT: usize = 31;

/// The distance below which, and the circumradius above which, constraints count as violated, in spacings: those that
/// the push-pull algorithm (Ahmed et al. 2016) reaches.
const TOO_CLOSE: f32 = 0.85;
const TOO_WIDE: f32 = 0.67;

/// The sum of two cotangents below which an edge may have to be flipped after its points have moved once more.
const SUSPECT: f32 = 0.05;

/// The forces on eight points in their stars.
pub struct Gathered {
    /// The forces, along `x` and along `y`.
    pub force: [Floats; 2],
    /// The least heights of the triangles around the points.
    pub clearance: Floats,
    /// 1 if no triangle is turned over or has an edge so long that its double would be ambiguous, else 0.
    is_sound: [u32; EIGHT],
    /// 1 if a neighbour, not counting own images, is too close or a triangle too wide, else 0.
    is_violated: [u32; EIGHT],
    /// Bit `k` is set if the edge to the neighbour before the `k`-th is suspect, the last bit if one of the others is.
    suspects: [u32; EIGHT],
}

/// Receives the results of gathers.
pub trait Visitor {
    /// Visits up to eight consecutive points, the first in the first lane.
    fn visit(&mut self, rings: &Rings, points: Range<usize>, gathered: &Gathered);
}

impl Gathered {
    /// True if all triangles around the first `count` points are sound.
    #[inline(always)]
    pub fn are_sound(&self, count: usize) -> bool {
        self.is_sound[..count].iter().all(|&is| is != 0)
    }

    /// The lanes, of the first `count`, in which constraints are violated.
    #[inline(always)]
    pub fn violated(&self, count: usize) -> impl Iterator<Item = usize> {
        (0..count).filter(|&lane| self.is_violated[lane] != 0)
    }

    /// Adds the suspect edges of `points` to others of higher index, so that each edge is listed by one of its ends.
    #[inline(always)]
    pub fn suspects(&self, rings: &Rings, points: Range<usize>, suspects: &mut Vec<[u32; 2]>) {
        for (point, &mask) in points.zip(&self.suspects).filter(|&(_, &mask)| mask != 0) {
            let ring = rings.ring(point);
            let others = (0..ring.len())
                .filter(|&k| mask >> k.min(LAST_BIT) & 1 == 1)
                .map(|k| ring[(k + ring.len() - 1) % ring.len()]);
            // From a point to its own copy, by both ends.
            suspects.extend(
                others.filter(|&other| point <= rings.copies().point(other)).map(|other| [point as u32, other]),
            );
        }
    }
}

/// The sums of eight points over the triangles so far.
struct Accumulator<'a> {
    constraints: &'a Constraints,
    /// The longest edges along the axes, in spacings.
    longest: [f32; 2],
    /// The distances to the points' own images across the boundary.
    images: [Floats; 2],
    degrees: [u32; EIGHT],
    force: [Floats; 2],
    /// The squares of the least heights, as numerators and denominators.
    height: [Floats; 2],
    is_sound: [u32; EIGHT],
    is_violated: [u32; EIGHT],
    suspects: [u32; EIGHT],
    /// The offset of the last neighbour, and its square.
    before: [Floats; 2],
    before_squared: Floats,
    /// Of the last triangle: twice the area, and the cosine at the neighbour before the last, times two edges.
    area: Floats,
    cosine: Floats,
}

/// The stars of all points in a triangulation of the torus.
pub struct Stars<'a> {
    pub rings: &'a Rings,
    pub torus: &'a Torus,
    pub places: &'a [TorusPoint],
    pub constraints: &'a Constraints,
}

impl Stars<'_> {
    /// Gathers for a range of points and passes the results to `visitor`.
    pub fn gather(&self, level: Level, points: Range<usize>, visitor: &mut impl Visitor) {
        match self.rings.copies().are_named() {
            false => run(level, Gather::<_, false> { stars: self, points, visitor }),
            true => run(level, Gather::<_, true> { stars: self, points, visitor }),
        }
    }

    #[inline(always)]
    fn gather_eight<const COPIES: bool>(&self, points: [usize; EIGHT]) -> Gathered {
        let &Self { rings, torus, places, constraints } = self;
        let slots: [&[u32]; EIGHT] = from_fn(|i| rings.slots_of(points[i]));
        let degrees: [u32; EIGHT] = from_fn(|i| rings.degree(points[i]) as u32);
        let here: [u64; EIGHT] = from_fn(|i| whole(places[points[i]]));
        let (unit, longest) = torus.unit_and_longest();
        let eight = Eight::<COPIES> { places, rings: slots, here, unit: unit.to_array() };
        let images: [[f32; 2]; EIGHT] = from_fn(|i| torus.image_distances(places[points[i]]));
        let images = [0, 1].map(|axis| images.map(|image| image[axis]));
        let first = eight.offsets(degrees.map(|degree| degree as usize - 2));
        let mut sums = Accumulator::new(constraints, longest, images, degrees, first);
        sums.skip(eight.offsets(degrees.map(|degree| degree as usize - 1)));
        for k in 0..degrees.into_iter().max().unwrap_or(0) {
            sums.add_triangles(eight.offsets([k as usize; EIGHT]), k);
        }
        sums.finish()
    }
}

/// [`Stars::gather`]; `COPIES` is true if names of points have copies.
struct Gather<'a, V, const COPIES: bool> {
    stars: &'a Stars<'a>,
    points: Range<usize>,
    visitor: &'a mut V,
}

impl<V: Visitor, const COPIES: bool> Work for Gather<'_, V, COPIES> {
    type Out = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) {
        let Self { stars, points, visitor } = self;
        for first in points.clone().step_by(EIGHT) {
            let eight = first..points.end.min(first + EIGHT);
            let all = from_fn(|lane| (first + lane).min(points.end - 1));
            visitor.visit(stars.rings, eight, &stars.gather_eight::<COPIES>(all));
        }
    }
}

/// Eight points and their rings.
struct Eight<'a, const COPIES: bool> {
    places: &'a [TorusPoint],
    rings: [&'a [u32]; EIGHT],
    here: [u64; EIGHT],
    unit: [f32; 2],
}

/// A point as one number: one load from memory.
#[inline(always)]
fn whole(place: TorusPoint) -> u64 {
    u64::from(place[0]) | u64::from(place[1]) << 32
}

impl<const COPIES: bool> Eight<'_, COPIES> {
    /// The offsets of the neighbours in these slots of the rings.
    #[inline(always)]
    fn offsets(&self, slots: [usize; EIGHT]) -> [Floats; 2] {
        let place = |name: u32| match COPIES {
            false => self.places[name as usize],
            true => Copies::MANY.place(self.places, name),
        };
        let there: [u64; EIGHT] = from_fn(|i| whole(place(self.rings[i][slots[i]])));
        let along = |axis: usize, i: usize| {
            let [there, here] = [there[i], self.here[i]].map(|place| (place >> (32 * axis)) as u32);
            there.wrapping_sub(here).cast_signed() as f32 * self.unit[axis]
        };
        [from_fn(|i| along(0, i)), from_fn(|i| along(1, i))]
    }
}

impl<'a> Accumulator<'a> {
    #[inline(always)]
    fn new(
        constraints: &'a Constraints,
        longest: [f32; 2],
        images: [Floats; 2],
        degrees: [u32; EIGHT],
        first: [Floats; 2],
    ) -> Self {
        Self {
            constraints,
            longest,
            images,
            degrees,
            force: [[0.0; EIGHT]; 2],
            height: [[f32::INFINITY; EIGHT], [1.0; EIGHT]],
            is_sound: [1; EIGHT],
            is_violated: [0; EIGHT],
            suspects: [0; EIGHT],
            before: first,
            before_squared: from_fn(|i| first[0][i] * first[0][i] + first[1][i] * first[1][i]),
            area: [0.0; EIGHT],
            cosine: [0.0; EIGHT],
        }
    }

    /// Proceeds to the next neighbours without gathering.
    #[inline(always)]
    fn skip(&mut self, [x, y]: [Floats; 2]) {
        for i in 0..EIGHT {
            let [before_x, before_y] = self.before.map(|before| before[i]);
            self.area[i] = before_x * y[i] - before_y * x[i];
            self.cosine[i] = self.before_squared[i] - (before_x * x[i] + before_y * y[i]);
            self.before_squared[i] = x[i] * x[i] + y[i] * y[i];
        }
        self.before = [x, y];
    }

    /// Gathers in the triangles between the last neighbours and the `k`-th.
    #[inline(always)]
    fn add_triangles(&mut self, [xs, ys]: [Floats; 2], k: u32) {
        // A copy: loads of its numbers under a condition would keep the loop from becoming vectors.
        let constraints = *self.constraints;
        let Constraints { conflict_radius, coverage_radius, .. } = constraints;
        for i in 0..EIGHT {
            let is = k < self.degrees[i];
            let (x, y) = (xs[i], ys[i]);
            let (before_x, before_y, before_squared) = (self.before[0][i], self.before[1][i], self.before_squared[i]);
            let squared = x * x + y * y;
            let opposite = (x - before_x) * (x - before_x) + (y - before_y) * (y - before_y);
            let area = before_x * y - before_y * x;

            let height = area.max(0.0) * area;
            let width = before_squared.max(squared).max(opposite);
            let lower = is & (height * self.height[1][i] < self.height[0][i] * width);
            self.height[0][i] = if lower { height } else { self.height[0][i] };
            self.height[1][i] = if lower { width } else { self.height[1][i] };
            let is_short = (x.abs() <= self.longest[0]) & (y.abs() <= self.longest[1]);
            self.is_sound[i] = if !is | ((area > 0.0) & is_short) { self.is_sound[i] } else { 0 };

            let distance = squared.sqrt();
            let is_close = is & (squared < conflict_radius * conflict_radius) & (squared != 0.0);
            let pushed = if is_close { constraints.conflict(distance) } else { 0.0 };

            let product = before_squared * squared * opposite;
            let is_wide = |radius: f32| product > (2.0 * radius * area) * (2.0 * radius * area);
            let share = (2.0 * area).recip();
            let centre_x = (squared * -before_y + before_squared * y) * share;
            let centre_y = (squared * before_x - before_squared * x) * share;
            let radius = (centre_x * centre_x + centre_y * centre_y).sqrt();
            let is_pulled = is & is_wide(coverage_radius) & (radius > 0.0) & (radius < f32::INFINITY);
            let pulled = constraints.hole(radius);
            self.force[0][i] += pushed * x;
            self.force[1][i] += pushed * y;
            self.force[0][i] += if is_pulled { pulled * centre_x } else { 0.0 };
            self.force[1][i] += if is_pulled { pulled * centre_y } else { 0.0 };

            let is_image = ((x == self.images[0][i]) & (y == 0.0)) | ((y == self.images[1][i]) & (x == 0.0));
            let violates = is & (((squared < TOO_CLOSE * TOO_CLOSE) & !is_image) | is_wide(TOO_WIDE));
            self.is_violated[i] = if violates { 1 } else { self.is_violated[i] };

            let dot = before_x * x + before_y * y;
            let excess = self.cosine[i] * area + (squared - dot) * self.area[i];
            let suspect = is & (excess < SUSPECT * (area * self.area[i]));
            self.suspects[i] |= if suspect { 1 << k.min(LAST_BIT as u32) } else { 0 };
            self.cosine[i] = before_squared - dot;
            self.area[i] = area;
            self.before_squared[i] = squared;
        }
        self.before = [xs, ys];
    }

    #[inline(always)]
    fn finish(self) -> Gathered {
        Gathered {
            force: self.force,
            clearance: from_fn(|i| (self.height[0][i] / self.height[1][i]).sqrt()),
            is_sound: self.is_sound,
            is_violated: self.is_violated,
            suspects: self.suspects,
        }
    }
}
