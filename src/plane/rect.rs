//! Rectangles of lattice points, and of other things counted along two axes; cuboids of three.

/// A rectangle of lattice points, or a cuboid if `D` is 3: `min` inclusive, `max` exclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rect<const D: usize = 2> {
    pub min: [i32; D],
    pub max: [i32; D],
}

impl<const D: usize> Rect<D> {
    pub fn contains(&self, point: [i32; D]) -> bool {
        (0..D).all(|axis| self.min[axis] <= point[axis] && point[axis] < self.max[axis])
    }

    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            min: std::array::from_fn(|axis| self.min[axis].max(other.min[axis])),
            max: std::array::from_fn(|axis| self.max[axis].min(other.max[axis])),
        }
    }

    /// The smallest rectangle that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        Self {
            min: std::array::from_fn(|axis| self.min[axis].min(other.min[axis])),
            max: std::array::from_fn(|axis| self.max[axis].max(other.max[axis])),
        }
    }

    pub fn is_empty(&self) -> bool {
        (0..D).any(|axis| self.min[axis] >= self.max[axis])
    }

    /// The rectangle with its edges moved outwards, or inwards by a negative margin.
    pub fn grown(&self, margin: i32) -> Self {
        Self { min: self.min.map(|x| x - margin), max: self.max.map(|x| x + margin) }
    }

    pub fn translated(&self, by: [i32; D]) -> Self {
        let shift = |corner: [i32; D]| std::array::from_fn(|axis| corner[axis] + by[axis]);
        Self { min: shift(self.min), max: shift(self.max) }
    }

    pub fn length(&self, axis: usize) -> i32 {
        self.max[axis] - self.min[axis]
    }
}
