//! The bounding box of points.

/// The lowest and the highest coordinates of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    low: [f32; 3],
    high: [f32; 3],
}

impl Extent {
    /// The extent of no points.
    pub const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The extent of some points.
    #[inline(always)]
    pub fn of<const N: usize>(points: [[f32; 3]; N]) -> Self {
        let mut extent = Self::EMPTY;
        points.into_iter().for_each(|point| extent.add(point));
        extent
    }

    /// Adds a point.
    #[inline(always)]
    pub fn add(&mut self, point: [f32; 3]) {
        self.join(&Self { low: point, high: point });
    }

    /// Extends it to include another extent.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        for axis in 0..3 {
            // No coordinate is NaN, so that one instruction suffices, unlike for `f32::min`.
            self.low[axis] = if other.low[axis] < self.low[axis] { other.low[axis] } else { self.low[axis] };
            self.high[axis] = if other.high[axis] > self.high[axis] { other.high[axis] } else { self.high[axis] };
        }
    }

    /// Cuts off the part beyond another extent.
    pub fn clip(&mut self, other: &Self) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].max(other.low[axis]);
            self.high[axis] = self.high[axis].min(other.high[axis]);
        }
    }

    /// The lowest and the highest coordinates.
    pub fn corners(&self) -> [[f32; 3]; 2] {
        [self.low, self.high]
    }

    /// True if a sample of this radius may reach anything in it: false only beyond a margin that exceeds the rounding
    /// of the coordinates and of the reach.
    #[inline]
    pub fn is_in_reach(&self, sample: [f32; 3], radius: f64) -> bool {
        let reach = (1.1 * radius) as f32;
        (0..3).all(|axis| self.low[axis] - reach <= sample[axis] && sample[axis] <= self.high[axis] + reach)
    }
}
