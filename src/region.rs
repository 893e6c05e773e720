//! A part of space in which a set is edited.

use crate::error::{Error, Result};

/// The points that lie in a box and in a ball, the boundary included. Either can be without end: [`Region::ball`] and
/// [`Region::cuboid`] have one of them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The lowest coordinates; may be minus infinity.
    pub min: [f64; 3],
    /// The highest coordinates, not below `min`; may be infinite.
    pub max: [f64; 3],
    /// The centre of the ball, finite.
    pub centre: [f64; 3],
    /// The radius of the ball, 0 or more; infinite for no ball.
    pub radius: f64,
}

impl Region {
    /// All of space.
    pub const EVERYWHERE: Self =
        Self { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY; 3], centre: [0.0; 3], radius: f64::INFINITY };

    /// A ball.
    pub fn ball(centre: [f64; 3], radius: f64) -> Self {
        Self { centre, radius, ..Self::EVERYWHERE }
    }

    /// A box.
    pub fn cuboid(min: [f64; 3], max: [f64; 3]) -> Self {
        Self { min, max, ..Self::EVERYWHERE }
    }

    /// Refuses bounds that are NaN or in the wrong order, a centre that is not finite and a radius below 0.
    pub(crate) fn check(&self) -> Result<()> {
        for axis in 0..3 {
            let (min, max) = (self.min[axis], self.max[axis]);
            if min.is_nan() || max.is_nan() || min > max {
                return Err(Error::invalid(
                    "region",
                    format!("max[{axis}] is {max:?}, not from min[{axis}] {min:?} on"),
                ));
            }
        }
        if !self.centre.iter().all(|x| x.is_finite()) {
            return Err(Error::invalid("region", format!("centre is {:?}, not finite", self.centre)));
        }
        if self.radius.is_nan() || self.radius < 0.0 {
            return Err(Error::invalid("region", format!("radius is {:?}, not 0 or more", self.radius)));
        }
        Ok(())
    }

    /// True if a position lies in it: in `f64`, without tolerance.
    pub fn contains(&self, position: [f32; 3]) -> bool {
        self.touches([position; 2])
    }

    /// True if a box, given by its lowest and its highest coordinates, has a point in the region's box and one in its
    /// ball.
    pub(crate) fn touches(&self, [low, high]: [[f32; 3]; 2]) -> bool {
        let mut squared = 0.0;
        for axis in 0..3 {
            let (low, high) = (f64::from(low[axis]), f64::from(high[axis]));
            if high < self.min[axis] || low > self.max[axis] {
                return false;
            }
            let nearest = self.centre[axis].clamp(low, high);
            squared += (nearest - self.centre[axis]) * (nearest - self.centre[axis]);
        }
        squared <= self.radius * self.radius
    }

    /// A region with all points that are within a distance of this one.
    pub(crate) fn grown(&self, by: f64) -> Self {
        Self { min: self.min.map(|x| x - by), max: self.max.map(|x| x + by), radius: self.radius + by, ..*self }
    }

    /// The corners of the smallest box around the region's box and ball.
    pub(crate) fn bounds(&self) -> [[f64; 3]; 2] {
        let low = [0, 1, 2].map(|axis| self.min[axis].max(self.centre[axis] - self.radius));
        [low, [0, 1, 2].map(|axis| self.max[axis].min(self.centre[axis] + self.radius))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn a_position_is_in_the_box_and_in_the_ball() {
        let region = Region { min: [0.0; 3], centre: [0.0; 3], radius: 1.0, ..Region::EVERYWHERE };
        assert!(region.contains([0.5; 3]) && region.contains([1.0, 0.0, 0.0]) && region.contains([0.0; 3]));
        assert!(!region.contains([0.6; 3]) && !region.contains([-0.1, 0.5, 0.5]) && !region.contains([1.1, 0.0, 0.0]));
        assert!(Region::EVERYWHERE.contains([f32::MAX; 3]) && Region::ball([1.0; 3], 0.0).contains([1.0; 3]));
    }

    /// A box of which a point is in the region touches it, and a place near it is in the grown region.
    #[test]
    fn boxes_touch_and_regions_grow_at_least_as_their_points_do() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let mut counts = [0; 2];
        for _ in 0..30_000 {
            let mut point = || [(); 3].map(|()| rng.unit());
            let (a, b, c, at, to) = (point(), point(), point(), point(), point());
            let sorted = |pick: fn(f64, f64) -> f64| [0, 1, 2].map(|axis| pick(a[axis], b[axis]));
            let (min, max) = (sorted(f64::min), sorted(f64::max));
            let region = Region { min, max, centre: c, radius: 0.4 };
            let [p, q] = [at, to].map(|point| point.map(|x| x as f32));
            let is_in = region.contains(p);
            let ends = [0, 1, 2].map(|axis| [p[axis].min(q[axis]), p[axis].max(q[axis])]);
            assert!(!is_in || region.touches([ends.map(|end| end[0]), ends.map(|end| end[1])]));
            let distance = (0..3).map(|axis| (f64::from(p[axis]) - f64::from(q[axis])).powi(2)).sum::<f64>().sqrt();
            assert!(!is_in || region.grown(distance + 1e-12).contains(q));
            let [low, high] = region.bounds();
            assert!(!is_in || (0..3).all(|axis| (low[axis]..=high[axis]).contains(&f64::from(p[axis]))));
            counts[usize::from(is_in)] += 1;
        }
        assert!(counts[1] > 100, "{counts:?}");
    }

    #[test]
    fn what_is_no_region_is_refused() {
        let said = |region: Region| region.check().unwrap_err().to_string();
        let mut region = Region::cuboid([0.0; 3], [1.0, -1.0, 1.0]);
        assert_eq!(said(region), "region: max[1] is -1.0, not from min[1] 0.0 on");
        region.max[1] = f64::NAN;
        assert_eq!(said(region), "region: max[1] is NaN, not from min[1] 0.0 on");
        assert_eq!(said(Region::ball([0.0, f64::INFINITY, 0.0], 1.0)), "region: centre is [0.0, inf, 0.0], not finite");
        assert_eq!(said(Region::ball([0.0; 3], -1.0)), "region: radius is -1.0, not 0 or more");
        assert!(Region::EVERYWHERE.check().is_ok());
    }
}
