//! [`Constraints::force`] by the star of a sample, sixteen neighbours at a time, in the same operations.

use glam::Vec2;

use crate::dcr::ground::constraints::{Constraints, FREE_CLEARANCE, Force, STRONGEST_PULL};
use crate::dcr::surface::view::{MOST, View};
use crate::simd::{LANES, Lanes};

/// The offsets of the neighbours of a sample, the last of them before the first too.
pub(super) struct Ring {
    offsets: [[f32; MOST + 1]; 2],
}

impl Default for Ring {
    fn default() -> Self {
        Self { offsets: [[0.0; MOST + 1]; 2] }
    }
}

impl Ring {
    /// The force by the neighbours of the star. A sample that they do not surround is only pushed, by all candidates.
    #[inline(always)]
    pub(super) fn force<L: Lanes>(&mut self, lanes: L, constraints: &Constraints, view: &View) -> Force {
        let (star, is_closed) = view.star();
        if !is_closed {
            return pushed(constraints, view);
        }
        let before = view.offset(star[star.len() - 1].into());
        [self.offsets[0][0], self.offsets[1][0]] = before.to_array();
        for (place, &neighbour) in (1..).zip(star) {
            [self.offsets[0][place], self.offsets[1][place]] = view.offset(neighbour.into()).to_array();
        }
        let mut force = Force { sum: Vec2::ZERO, clearance: f32::INFINITY };
        let mut first = 0;
        while first < star.len() {
            let count = (star.len() - first).min(LANES);
            let part = self.force_of(lanes, constraints, first, count);
            force.sum += part.sum;
            force.clearance = force.clearance.min(part.clearance);
            first += LANES;
        }
        force.clearance = force.clearance.sqrt();
        force
    }

    /// The force by `count` neighbours, and the square of the clearance.
    #[inline(always)]
    fn force_of<L: Lanes>(&self, lanes: L, constraints: &Constraints, first: usize, count: usize) -> Force {
        let one = lanes.splat(1.0);
        let at = |axis: usize, place: usize| {
            let from: &[f32; LANES] = self.offsets[axis][place..place + LANES].try_into().unwrap_or(&[0.0; LANES]);
            lanes.load(from)
        };
        let is_one = lanes.less(lanes.load(&FIRST), lanes.splat(count as f32));
        let [ax, ay, bx, by] = [at(0, first), at(1, first), at(0, first + 1), at(1, first + 1)];
        let squared_of = |x, y| lanes.add(lanes.mul(x, x), lanes.mul(y, y));
        let (a_squared, squared) = (squared_of(ax, ay), squared_of(bx, by));
        let opposite = squared_of(lanes.sub(bx, ax), lanes.sub(by, ay));
        // Twice the area of the triangle.
        let area = lanes.sub(lanes.mul(ax, by), lanes.mul(ay, bx));
        let longest = lanes.max(lanes.max(a_squared, squared), opposite);
        let height = lanes.div(lanes.mul(lanes.max(area, lanes.splat(0.0)), area), longest);
        let clearance = lanes.least(lanes.select(is_one, height, lanes.splat(f32::INFINITY)));

        let radius = constraints.conflict_radius;
        let is_near = lanes.less(squared, lanes.splat(radius * radius));
        let tension = lanes.sub(lanes.splat(radius.recip()), lanes.div(one, lanes.sqrt(squared)));
        let pushed = lanes.only(is_near, lanes.mul(lanes.splat(constraints.push), tension));
        let mut x = lanes.mul(pushed, bx);
        let mut y = lanes.mul(pushed, by);

        // The circumradius is the product of the edges over four times the area.
        let wide = lanes.mul(lanes.splat(2.0 * constraints.coverage_radius), area);
        let edges = lanes.mul(lanes.mul(a_squared, squared), opposite);
        let is_hole = lanes.less(lanes.mul(wide, wide), edges);
        if lanes.bits(is_hole) & ((1 << count) - 1) != 0 {
            let half = lanes.div(one, lanes.mul(lanes.splat(2.0), area));
            // b² perp(a) - a² perp(b), with perp(x, y) = (-y, x).
            let centre_x = lanes.mul(lanes.sub(lanes.mul(a_squared, by), lanes.mul(squared, ay)), half);
            let centre_y = lanes.mul(lanes.sub(lanes.mul(squared, ax), lanes.mul(a_squared, bx)), half);
            let distance = lanes.sqrt(squared_of(centre_x, centre_y));
            let near = lanes.div(one, distance);
            let tension = lanes.sub(lanes.splat(constraints.coverage_radius.recip()), near);
            let tension = lanes.min(tension, lanes.mul(lanes.splat(STRONGEST_PULL), near));
            let pulled = lanes.mul(lanes.splat(constraints.pull), tension);
            // Triangles without area have no centre, and by rounding some have it in the sample.
            let is_there = lanes.less(distance, lanes.splat(f32::INFINITY));
            let is_apart = lanes.less(lanes.splat(0.0), distance);
            let pulled =
                |centre| lanes.only(is_hole, lanes.only(is_there, lanes.only(is_apart, lanes.mul(pulled, centre))));
            x = lanes.add(x, pulled(centre_x));
            y = lanes.add(y, pulled(centre_y));
        }
        let sum = |x| lanes.sum(lanes.only(is_one, x));
        Force { sum: Vec2::new(sum(x), sum(y)), clearance }
    }
}

/// The force on a sample that is not surrounded.
#[inline(never)]
fn pushed(constraints: &Constraints, view: &View) -> Force {
    let push = |candidate: usize| {
        let offset = view.offset(candidate);
        constraints.push(offset, offset.length_squared())
    };
    Force { sum: (0..view.count()).map(push).sum(), clearance: FREE_CLEARANCE }
}

/// The numbers of lanes.
const FIRST: [f32; LANES] = {
    let mut numbers = [0.0; LANES];
    let mut lane = 0;
    while lane < LANES {
        numbers[lane] = lane as f32;
        lane += 1;
    }
    numbers
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dcr::surface::view::Star;
    use crate::rng::{Draw, Rng};
    use crate::simd::{Level, Work, run};
    use glam::Vec3;
    use std::f32::consts::TAU;

    /// The force on the origin by points, and that by [`Constraints::force`] or the sum of all pushes.
    struct Both<'a>(&'a Constraints, &'a [Vec2]);

    impl Work for Both<'_> {
        type Out = ([Force; 2], bool);

        fn run<L: Lanes>(self, lanes: L) -> ([Force; 2], bool) {
            let mut view = View::default();
            self.1.iter().for_each(|point| view.add(point.extend(0.0)));
            view.project(lanes, [Vec3::X, Vec3::Y]);
            view.find_star(lanes, &mut Star::default());
            let (star, is_closed) = view.star();
            let ring: Vec<Vec2> = star.iter().map(|&neighbour| view.offset(neighbour.into())).collect();
            let expected = if is_closed { self.0.force(&ring) } else { pushed(self.0, &view) };
            ([Ring::default().force(lanes, self.0, &view), expected], is_closed)
        }
    }

    #[test]
    fn forces_are_those_of_the_constraints_and_the_same_at_all_levels() {
        let (mut closed, mut many) = (0, 0);
        for case in 0..600 {
            let mut rng = Rng::at(8, Draw::Probe, &[case]);
            // Random points, and rings of many.
            let count = 1 + case as usize % 40;
            let point = |k: usize, x: f64, y: f64| match case % 3 {
                0 => Vec2::from_angle(k as f32 / count as f32 * TAU) * (0.8 + 1e-3 * x as f32),
                _ => Vec2::new(x as f32 - 0.5, y as f32 - 0.5) * (0.5 * (count as f32).sqrt()),
            };
            let points: Vec<Vec2> = (0..count).map(|k| point(k, rng.unit(), rng.unit())).collect();
            let constraints = Constraints::of_step(case as u32 % 90);
            let mut portable = None;
            for level in Level::available() {
                let ([force, expected], is_closed) = run(level, Both(&constraints, &points));
                let scale = 1.0 + expected.sum.length();
                assert!(force.sum.distance(expected.sum) < 1e-4 * scale, "{} {}", force.sum, expected.sum);
                assert!((force.clearance - expected.clearance).abs() < 1e-4);
                let bits = (force.sum.to_array().map(f32::to_bits), force.clearance.to_bits());
                assert_eq!(bits, *portable.get_or_insert(bits), "{level:?}");
                closed += usize::from(is_closed);
                many += usize::from(is_closed && case % 3 == 0 && count > LANES);
            }
        }
        assert!(closed > 300 && many > 50, "{closed} {many}");
    }
}
