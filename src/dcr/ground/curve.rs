//! The points of a set in the order of a Z-curve: points that are close in the plane are close in memory.

use crate::dcr::ground::torus::{Torus, TorusPoint};

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
    places.iter().map(|&[x, y]| spread(x) | spread(y) << 1).collect()
}

/// The order of places along the curve.
fn order_along_curve(places: &[TorusPoint]) -> Vec<u32> {
    let mut keyed: Vec<(u64, u32)> = along_curve(places).into_iter().zip(0..).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, i)| i).collect()
}

/// The bits of a number on the even bits of a longer one.
fn spread(x: u32) -> u64 {
    let masks = [(16, 0x0000_ffff_0000_ffff), (8, 0x00ff_00ff_00ff_00ff), (4, 0x0f0f_0f0f_0f0f_0f0f)];
    let masks = masks.into_iter().chain([(2, 0x3333_3333_3333_3333), (1, 0x5555_5555_5555_5555u64)]);
    masks.fold(u64::from(x), |x, (shift, mask)| (x | x << shift) & mask)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_visits_quarter_after_quarter() {
        const HALF: u32 = 1 << 31;
        let corners = [[0, 0], [HALF, 0], [0, HALF], [HALF, HALF]];
        let places: Vec<TorusPoint> = (0..16).map(|i| corners[i % 4].map(|x| x + (i as u32 / 4) * 1000)).collect();
        let quarters: Vec<u32> = order_along_curve(&places).iter().map(|i| i % 4).collect();
        assert_eq!(quarters, [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3]);
    }
}
