//! The classes that are measured.

use azulejo::{Classes, MAXIMAL_DENSITY, Result};

/// The factors on Wei's cross radii.
pub const FACTORS: [f64; 3] = [1.0, 0.85, 0.7];

/// Own radii, in units of the largest.
#[derive(Clone, Copy, PartialEq)]
pub struct Mix {
    pub name: &'static str,
    pub own: &'static [f64],
}

const ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The mixes: equal radii, and falling ones.
pub const MIXES: [Mix; 8] = [
    Mix { name: "1, 1", own: &[1.0, 1.0] },
    Mix { name: "1, ½", own: &[1.0, 0.5] },
    Mix { name: "1, 1, 1", own: &[1.0; 3] },
    Mix { name: "1, ½, ¼", own: &[1.0, 0.5, 0.25] },
    Mix { name: "five of 1", own: &[1.0; 5] },
    Mix { name: "five by √½", own: &[1.0, ROOT, 0.5, 0.5 * ROOT, 0.25] },
    Mix { name: "seven of 1", own: &[1.0; 7] },
    Mix { name: "seven by √½", own: &[1.0, ROOT, 0.5, 0.5 * ROOT, 0.25, 0.25 * ROOT, 0.125] },
];

/// Of which pictures are drawn.
pub const PICTURED: Mix = MIXES[3];

impl Mix {
    /// Own radii at which the class of the smallest one alone would have about `count` samples on an area.
    pub fn radii(&self, count: f64, area: f64) -> Vec<f64> {
        let smallest = self.own.iter().copied().fold(f64::INFINITY, f64::min);
        let scale = (MAXIMAL_DENSITY * area / count).sqrt() / smallest;
        self.own.iter().map(|own| own * scale).collect()
    }

    /// Wei's matrix on the unit square, with a factor on the cross radii.
    pub fn classes(&self, count: f64, factor: f64) -> Result<Classes> {
        Classes::of_radii(&self.radii(count, 1.0), factor)
    }
}

/// The number of samples per area of a maximal set of a radius.
pub fn density(radius: f64) -> f64 {
    MAXIMAL_DENSITY / (radius * radius)
}
