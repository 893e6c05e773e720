//! The images that are drawn in dots; they are computed here.

use azulejo::{Context, Result};

use crate::psp::adaptive::knot_in_grey;
use azulejo_cli::progress::watched;
use azulejo_cli::stipple::darkness::Darkness;

/// Width and height in pixels.
const SIDE: usize = 512;

/// All images, by name.
pub fn all(context: &Context, quick: bool) -> Result<[(&'static str, Darkness); 3]> {
    let detail = if quick { 160 } else { 1280 };
    let knot = watched("knot", |progress| knot_in_grey(context, detail, SIDE, progress))?;
    let knot = Darkness::new(knot.into_iter().map(|dark| dark as f32).collect(), SIDE);
    Ok([("ramp", drawn(ramp)), ("sphere", drawn(sphere)), ("knot", knot)])
}

/// The image of a function of the unit square, y downwards.
fn drawn(dark: fn([f32; 2]) -> f32) -> Darkness {
    let at = |pixel: usize| [pixel % SIDE, pixel / SIDE].map(|index| (index as f32 + 0.5) / SIDE as f32);
    Darkness::new((0..SIDE * SIDE).map(|pixel| dark(at(pixel))).collect(), SIDE)
}

/// From white, nearly, to black.
fn ramp([x, _]: [f32; 2]) -> f32 {
    x.max(0.02)
}

/// A sphere that is lit from the upper left, before a shadow with a sharp edge, on white.
fn sphere([x, y]: [f32; 2]) -> f32 {
    let [across, down] = [x, y].map(|place| (place - 0.5) / 0.38);
    let towards = 1.0 - across * across - down * down;
    if towards > 0.0 {
        let lit = -0.5 * across - 0.6 * down + 0.62 * towards.sqrt();
        0.9 * (1.0 - lit.clamp(0.0, 1.0))
    } else if y > 0.7 {
        0.15
    } else {
        0.0
    }
}
