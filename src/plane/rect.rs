//! Rectangles of lattice points, and of other things counted along two axes.

/// A rectangle of lattice points, `min` inclusive, `max` exclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rect {
    pub min: [i32; 2],
    pub max: [i32; 2],
}

impl Rect {
    pub fn contains(&self, point: [i32; 2]) -> bool {
        (0..2).all(|axis| self.min[axis] <= point[axis] && point[axis] < self.max[axis])
    }

    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            min: [self.min[0].max(other.min[0]), self.min[1].max(other.min[1])],
            max: [self.max[0].min(other.max[0]), self.max[1].min(other.max[1])],
        }
    }

    /// The smallest rectangle that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        Self {
            min: [self.min[0].min(other.min[0]), self.min[1].min(other.min[1])],
            max: [self.max[0].max(other.max[0]), self.max[1].max(other.max[1])],
        }
    }

    pub fn is_empty(&self) -> bool {
        (0..2).any(|axis| self.min[axis] >= self.max[axis])
    }

    /// The rectangle with its edges moved outwards, or inwards by a negative margin.
    pub fn grown(&self, margin: i32) -> Self {
        Self { min: self.min.map(|x| x - margin), max: self.max.map(|x| x + margin) }
    }

    pub fn translated(&self, by: [i32; 2]) -> Self {
        let shift = |corner: [i32; 2]| std::array::from_fn(|axis| corner[axis] + by[axis]);
        Self { min: shift(self.min), max: shift(self.max) }
    }

    pub fn length(&self, axis: usize) -> i32 {
        self.max[axis] - self.min[axis]
    }
}
