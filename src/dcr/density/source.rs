//! Where a density comes from: an image or a function.

use crate::error::{Error, Result};

/// A density for every position of the domain; called from several threads at once, unless the context has only one.
pub type DensityFunction<'a> = dyn Fn([f64; 2]) -> f64 + Sync + 'a;

/// The density that points shall have at each position, in any unit: twice the density gives the same set.
///
/// Densities are 0 or above and finite, and not 0 everywhere. Where they are 0 no points are wanted, and points that
/// start there leave.
#[derive(Clone, Copy)]
pub enum Density<'a> {
    /// An image that is stretched over the domain, linear between the centres of its pixels.
    Image {
        /// The pixels, row by row; the first row lies along the lower side (`min[1]`) of the domain.
        values: &'a [f32],
        /// Pixels in a row; at least 1.
        width: usize,
        /// Rows; at least 1.
        height: usize,
    },
    /// A density for each position. It is called once for each position of a lattice of 100 to 200 positions per point,
    /// all before the first step.
    Function(&'a DensityFunction<'a>),
}

impl Density<'_> {
    /// Refuses images whose size is not that of their values, and pixels that are not a density.
    pub(super) fn check(&self) -> Result<()> {
        let Self::Image { values, width, height } = *self else { return Ok(()) };
        for (argument, length) in [("width", width), ("height", height)] {
            if length == 0 {
                return Err(Error::invalid(argument, "0 is not at least 1"));
            }
        }
        if width.checked_mul(height) != Some(values.len()) {
            let reason = format!("{} values are not those of an image of {width} by {height}", values.len());
            return Err(Error::invalid("density", reason));
        }
        match values.iter().position(|&value| !is_density(value.into())) {
            None => Ok(()),
            Some(i) => {
                let reason =
                    format!("pixel ({}, {}) is {:?}, not 0 or above and finite", i % width, i / width, values[i]);
                Err(Error::invalid("density", reason))
            }
        }
    }
}

/// Whether a number is a density that floats can hold.
pub(super) fn is_density(value: f64) -> bool {
    (0.0..=f32::MAX.into()).contains(&value)
}
