//! Samples that are given, around which a set is filled.

use crate::check;
use crate::error::{Error, Result};

/// Why clearances are required beside a count.
pub(crate) const WITH_A_COUNT: &str = "are required with a count, as no radius stands for them";

/// Samples that exist already, each with a *clearance*. A set that is filled around them keeps its samples at least the
/// clearance from each of them, and covers every place that is farther than the clearance from all of them.
///
/// Given samples are never moved, dropped or compared with each other; they may lie anywhere, in any number, and are
/// not among the samples that a call returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given<'a, const AXES: usize> {
    /// The positions, finite.
    pub positions: &'a [[f32; AXES]],
    /// The clearance of each, finite and 0 or more, in the units of the positions; `None`: all have the radius of the
    /// set. A sample whose clearance is 0 has no effect. In sets of several [`Classes`](crate::Classes) of the plane
    /// there is a row for each sample, with its clearance from each class; `None`: each class's own radius.
    pub clearances: Option<&'a [f64]>,
}

impl<const AXES: usize> Default for Given<'_, AXES> {
    /// No samples.
    fn default() -> Self {
        Self { positions: &[], clearances: None }
    }
}

impl<'a, const AXES: usize> Given<'a, AXES> {
    /// Samples that keep the radius of the set from new ones.
    pub fn at(positions: &'a [[f32; AXES]]) -> Self {
        Self { positions, clearances: None }
    }

    /// Samples with a clearance each.
    pub fn with_clearances(positions: &'a [[f32; AXES]], clearances: &'a [f64]) -> Self {
        Self { positions, clearances: Some(clearances) }
    }

    /// The clearance of one of them, where that of a set is `radius`.
    pub fn clearance(&self, index: usize, radius: f64) -> f64 {
        self.clearances.map_or(radius, |clearances| clearances[index])
    }

    /// The clearance of each sample from a class, in sets of several classes: their clearances have a row for each
    /// sample and in it a number for each class.
    pub(crate) fn clearances_of_class(&self, class: usize, classes: usize) -> Option<Vec<f64>> {
        self.clearances.map(|clearances| clearances.iter().skip(class).step_by(classes).copied().collect())
    }

    /// [`Given::check`] where there is a row of clearances for several classes.
    pub(crate) fn check_classes(&self, classes: usize) -> Result<()> {
        if let Some(clearances) = self.clearances {
            if Some(clearances.len()) != self.positions.len().checked_mul(classes) {
                let reason =
                    format!("{} for {} positions and {classes} classes", clearances.len(), self.positions.len());
                return Err(Error::invalid("given_clearances", reason));
            }
            check_clearances(clearances)?;
        }
        Self::at(self.positions).check()
    }

    /// Refuses samples without clearances where no radius stands for them, for a reason.
    pub(crate) fn require_clearances(&self, reason: &'static str) -> Result<()> {
        match self.clearances {
            None if !self.positions.is_empty() => Err(Error::invalid("given_clearances", reason)),
            _ => Ok(()),
        }
    }

    /// Refuses values out of range, by their index.
    pub(crate) fn check(&self) -> Result<()> {
        if let Some(clearances) = self.clearances {
            if clearances.len() != self.positions.len() {
                let reason = format!("{} for {} positions", clearances.len(), self.positions.len());
                return Err(Error::invalid("given_clearances", reason));
            }
            check_clearances(clearances)?;
        }
        check::finite("given_positions", "", self.positions)
    }
}

/// Refuses clearances that are out of range, by their index.
fn check_clearances(clearances: &[f64]) -> Result<()> {
    match clearances.iter().position(|clearance| !(0.0..f64::INFINITY).contains(clearance)) {
        None => Ok(()),
        Some(index) => {
            let reason = format!("[{index}] is {:?}; it must be 0 or more and finite", clearances[index]);
            Err(Error::invalid("given_clearances", reason))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_range_is_refused_by_its_index() {
        let positions = [[0.0, 1.0], [2.0, f32::NAN]];
        let said = |given: Given<2>| given.check().unwrap_err().to_string();
        assert_eq!(said(Given::at(&positions)), "given_positions: [1] is [2.0, NaN], not finite");
        let with = |clearances| Given::with_clearances(&positions[..1], clearances);
        assert_eq!(said(with(&[])), "given_clearances: 0 for 1 positions");
        assert_eq!(said(with(&[-0.5])), "given_clearances: [0] is -0.5; it must be 0 or more and finite");
        assert_eq!(said(with(&[f64::NAN])), "given_clearances: [0] is NaN; it must be 0 or more and finite");
        assert!(with(&[0.0]).check().is_ok() && Given::at(&positions[..1]).check().is_ok());
        assert_eq!((Given::at(&positions).clearance(1, 3.0), with(&[0.25]).clearance(0, 3.0)), (3.0, 0.25));
    }
}
