//! A torus of eight periods along each axis, on which a few points of a small torus are triangulated with their copies.
//!
//! On a torus that is only a few spacings wide, a point has several copies of another for neighbours, or copies of
//! itself, and an edge is as long as a period. No edge of the Delaunay triangulation is longer (`geometry/delaunay.rs`),
//! so on eight periods all are shorter than a quarter, and all offsets unambiguous. The copies are not stored: a name
//! in a ring is a point and a number of periods ([`Copies`]), and a flip turns all copies of an edge at once.
//!
//! Points wander across the seam of their torus. On the cover they go on, so that the periods between neighbours stay
//! what they are.
//!
//! The triangulation is made point by point (Lawson 1977): the triangle of a point is found by a walk towards it, which
//! ends in any Delaunay triangulation (Devillers et al. 2002), and divided; then edges are flipped.

use crate::dcr::torus::{Torus, TorusPoint, nudge};
use crate::dcr::uniform::rings::{Edge, PERIOD_BITS, Patch, Rings};

/// The length of the nudges on the cover, in those of the torus: many of its units.
const NUDGES: f64 = 1000.0;

/// The points on the torus of eight periods.
pub struct Cover {
    /// The torus of one period.
    base: Torus,
    /// The coordinates in 2^-32 of a period, with all periods that the points have wandered.
    unwrapped: Vec<[i64; 2]>,
    /// The points, in 2^-32 of eight periods.
    pub places: Vec<TorusPoint>,
}

impl Cover {
    /// The points of a torus, in the first period of the cover.
    pub fn new(base: &Torus, places: &[TorusPoint]) -> Self {
        let unwrapped: Vec<_> = places.iter().map(|place| place.map(i64::from)).collect();
        Self { base: *base, places: unwrapped.iter().map(|&place| covering(place)).collect(), unwrapped }
    }

    /// The points, nudged so that of four on one circle, as points and their mirror images are, no diagonal is preferred.
    pub fn nudged(&self) -> Vec<TorusPoint> {
        let torus = self.torus();
        let nudge = |point: u32| (nudge(point) * NUDGES).as_vec2();
        (0..).zip(&self.places).map(|(point, &place)| torus.displaced(place, nudge(point))).collect()
    }

    /// The torus of one period.
    pub fn base(&self) -> &Torus {
        &self.base
    }

    /// The torus of eight periods.
    pub fn torus(&self) -> Torus {
        self.base.covering(PERIOD_BITS)
    }

    /// Moves the points to these places, each by less than half a period.
    pub fn follow(&mut self, places: &[TorusPoint]) {
        for ((unwrapped, on_cover), place) in self.unwrapped.iter_mut().zip(&mut self.places).zip(places) {
            for (whole, &fraction) in unwrapped.iter_mut().zip(place) {
                *whole += i64::from(fraction.wrapping_sub(*whole as u32).cast_signed());
            }
            *on_cover = covering(*unwrapped);
        }
    }
}

impl Cover {
    /// The same rings on the torus of one period; none if an edge is so long there
    /// that its double would be ambiguous, or if neighbours are copies of one point.
    pub fn rings_on_torus(&self, rings: &Rings) -> Option<Rings> {
        let (copies, torus, (_, longest)) = (rings.copies(), self.torus(), self.base.unit_and_longest());
        let is_short = |point: usize, name: u32| {
            let offset = torus.offset_f32(self.places[point], copies.place(&self.places, name)).abs().to_array();
            offset[0] <= longest[0] && offset[1] <= longest[1]
        };
        if !(0..rings.len()).all(|point| rings.ring(point).iter().all(|&name| is_short(point, name))) {
            return None;
        }
        let rings = rings.without_copies();
        (0..rings.len()).all(|point| rings.agree(point)).then_some(rings)
    }
}

/// The point of the cover. Halves are rounded to even numbers, so that mirror images stay mirror images.
fn covering(unwrapped: [i64; 2]) -> TorusPoint {
    const BELOW_HALF: i64 = (1 << (PERIOD_BITS - 1)) - 1;
    unwrapped.map(|x| ((x + BELOW_HALF + ((x >> PERIOD_BITS) & 1)) >> PERIOD_BITS) as u32)
}

/// Inserts a point into the triangulation of those before it, and returns the edges that may have to be flipped. None
/// if it coincides with another, or has no slots.
pub fn insert(whole: &mut Patch, places: &[TorusPoint], point: u32) -> Option<Vec<Edge>> {
    let copies = whole.copies();
    let at = |name: u32| copies.place(places, name);
    let target = at(point);
    let is_right = |a: u32, b: u32| doubled_area([at(a), at(b), target]) < 0;
    // The points are in the order of a curve: the one before is near.
    let first = point - 1;
    let [mut a, mut b] = [first, *whole.ring(first).first()?];
    if is_right(a, b) {
        (a, b) = (b, a);
    }
    // No walk visits a triangle twice.
    for _ in 0..2 * places.len() * EIGHT_PERIODS {
        let [c, _] = whole.apices([a, b])?;
        if is_right(b, c) {
            a = c;
        } else if is_right(c, a) {
            b = c;
        } else {
            let corners = [a, b, c];
            if corners.into_iter().any(|corner| at(corner) == target) {
                return None;
            }
            whole.divide(corners, point).ok()?;
            return Some(vec![[a, b], [b, c], [c, a]]);
        }
    }
    None
}

/// The number of copies of a point on the cover.
const EIGHT_PERIODS: usize = 1 << (2 * PERIOD_BITS);

/// Twice the area of a triangle, in units of the cover: above 0 if its corners are in counter-clockwise order. Exact
/// for edges up to two periods.
fn doubled_area([a, b, c]: [TorusPoint; 3]) -> i64 {
    let along = |to: TorusPoint, axis: usize| i64::from(to[axis].wrapping_sub(a[axis]).cast_signed());
    along(b, 0) * along(c, 1) - along(b, 1) * along(c, 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    use glam::Vec2;

    use crate::dcr::uniform::rings::Copies;
    use crate::points::{Boundary, Domain};

    fn torus(boundary: Boundary) -> Torus {
        Torus::new(Domain { min: [0.0; 2], max: [2.0, 1.0], boundary }, 9)
    }

    /// Points that are carried across the seam keep their offsets from others, over any number of periods.
    #[test]
    fn points_go_on_across_the_seam() {
        let base = torus(Boundary::Periodic);
        let mut places = vec![[1 << 31, 1 << 30], [5, 7]];
        let mut cover = Cover::new(&base, &places);
        let start = cover.torus().offset_f32(cover.places[0], cover.places[1]);
        let step = Vec2::new(0.3, -0.2);
        for steps in 1..=20 {
            places[1] = base.moved(places[1], step);
            cover.follow(&places);
            let gone = cover.torus().offset_f32(cover.places[0], cover.places[1]) - start;
            assert!(gone.distance(steps as f32 * step) < 1e-4, "{steps}: {gone}");
        }
    }

    /// A point and its image are as far from the boundary, wherever rounding puts them.
    #[test]
    fn mirror_images_stay_mirror_images() {
        let base = torus(Boundary::Bounded);
        for x in (16..64).chain((1 << 31) - 64..=(1 << 31) - 16) {
            let places = base.with_images(&[[x, x + 3]]);
            let (cover, copies) = (Cover::new(&base, &places), Copies::MANY);
            let distances = cover.torus().image_distances(cover.places[0]);
            let nearest = |image: u32, axis: usize| {
                let offset = |periods: [i32; 2]| {
                    let place = copies.place(&cover.places, copies.copy(image, periods));
                    cover.torus().offset_f32(cover.places[0], place).to_array()
                };
                let before: [i32; 2] = std::array::from_fn(|other| -i32::from(other == axis));
                [offset([0, 0]), offset(before)].into_iter().min_by(|a, b| a[axis].abs().total_cmp(&b[axis].abs()))
            };
            assert_eq!(nearest(1, 0), Some([distances[0], 0.0]), "{x}");
            assert_eq!(nearest(2, 1), Some([0.0, distances[1]]), "{x}");
        }
    }

    /// Inserts points one after the other without flips; the corners of the triangle that each divides.
    fn divided(places: &[TorusPoint]) -> Vec<Option<Vec<Edge>>> {
        let cover = Cover::new(&torus(Boundary::Periodic), places);
        let mut rings = Rings::of_first(places.len());
        let mut whole = rings.patches(places.len()).next().unwrap();
        (1..places.len() as u32).map(|point| insert(&mut whole, &cover.places, point)).collect()
    }

    #[test]
    fn points_divide_their_triangle_and_coincident_ones_are_refused() {
        let [quarter, half] = [1 << 30, 1 << 31];
        // On the diagonal, below it in one of its halves, and where one is.
        let divided = divided(&[[0, 0], [half, half], [half + quarter, quarter], [half, half]]);
        assert!(divided[0].is_some() && divided[1].is_some() && divided[2].is_none());
        let cover = Cover::new(&torus(Boundary::Periodic), &[[0, 0], [half, quarter]]);
        let mut rings = Rings::of_first(2);
        let mut whole = rings.patches(2).next().unwrap();
        assert_eq!(insert(&mut whole, &cover.places, 1).unwrap().len(), 3);
        assert!((0..2).all(|point| rings.agree(point)) && rings.edges() == 6 && rings.degree(1) == 3);
    }
}
