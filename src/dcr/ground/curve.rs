//! The points of a set in the order of a Z-curve: points that are close in the plane are close in memory.

use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::index::curve::{morton2, sorted};

/// Where the points of a set began, in the order of the curve.
pub(in crate::dcr) struct CurveOrder {
    /// The user's index of each point.
    order: Vec<u32>,
    start: Vec<TorusPoint>,
}

impl CurveOrder {
    /// Orders points of the domain. Those that coincide are parted, keyed by the seed.
    pub(in crate::dcr) fn new(torus: &Torus, points: &[[f32; 2]], seed: u64) -> Self {
        let entered = torus.enter(points, seed);
        let order = order_along_curve(&entered);
        let start = order.iter().map(|&point| entered[point as usize]).collect();
        Self { order, start }
    }

    /// The order after the points have been moved to `places` before the first step, and `places` in that order.
    pub(in crate::dcr) fn reordered(&self, places: &[TorusPoint]) -> (Self, Vec<TorusPoint>) {
        let order = order_along_curve(places);
        let of = |all: &[u32]| order.iter().map(|&point| all[point as usize]).collect();
        let at = |all: &[TorusPoint]| order.iter().map(|&point| all[point as usize]).collect();
        (Self { order: of(&self.order), start: at(&self.start) }, at(places))
    }

    /// The number of points.
    pub(in crate::dcr) fn len(&self) -> usize {
        self.order.len()
    }

    /// The user's index of a point.
    pub(in crate::dcr) fn user(&self, point: u32) -> usize {
        self.order[point as usize] as usize
    }

    /// Where the points began.
    pub(in crate::dcr) fn start(&self) -> &[TorusPoint] {
        &self.start
    }

    /// The points, which are now at `places`, in the user's order; `points` are those with which the set began. Points
    /// that have not moved are returned as they came.
    pub(in crate::dcr) fn leave(&self, torus: &Torus, places: &[TorusPoint], points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for ((&point, &start), &place) in self.order.iter().zip(&self.start).zip(places) {
            if place != start {
                relaxed[point as usize] = torus.leave(place);
            }
        }
        relaxed
    }
}

/// How far along the Z-curve each of these places is.
pub(in crate::dcr) fn along_curve(places: &[TorusPoint]) -> Vec<u64> {
    places.iter().map(|&place| morton2(place)).collect()
}

/// The order of places along the curve.
fn order_along_curve(places: &[TorusPoint]) -> Vec<u32> {
    sorted(places.iter().map(|&place| morton2(place))).into_iter().map(|(_, i)| i).collect()
}
