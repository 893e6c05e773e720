//! Given points, around which sets are made.

use azulejo::Given;

/// The points of a file, with a clearance each or with that of the set.
#[derive(Default)]
pub struct Around<const AXES: usize> {
    positions: Vec<[f32; AXES]>,
    clearances: Option<Vec<f64>>,
}

impl<const AXES: usize> Around<AXES> {
    /// Points with the clearances that their file has, if it has any and not all are to have the same.
    pub fn new(positions: Vec<[f32; AXES]>, of_file: Option<Vec<f64>>, same: Option<f64>) -> Self {
        let same = same.map(|clearance| vec![clearance; positions.len()]);
        Self { positions, clearances: same.or(of_file) }
    }

    pub fn given(&self) -> Given<'_, AXES> {
        Given { positions: &self.positions, clearances: self.clearances.as_deref() }
    }

    /// The points for a set of `classes` classes.
    pub fn of_classes(&self, classes: usize) -> OfClasses<'_, AXES> {
        let repeated = |clearances: &Vec<f64>| {
            clearances.iter().flat_map(|&clearance| std::iter::repeat_n(clearance, classes)).collect()
        };
        OfClasses { positions: &self.positions, clearances: self.clearances.as_ref().map(repeated) }
    }
}

/// Points with the same clearance from all classes.
pub struct OfClasses<'a, const AXES: usize> {
    positions: &'a [[f32; AXES]],
    clearances: Option<Vec<f64>>,
}

impl<const AXES: usize> OfClasses<'_, AXES> {
    pub fn given(&self) -> Given<'_, AXES> {
        Given { positions: self.positions, clearances: self.clearances.as_deref() }
    }
}
