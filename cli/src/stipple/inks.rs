//! Dots in the four inks of a printer: several classes whose densities are those of an image, each around the others.
//!
//! The inks are laid down one after the other, black first: each is a maximal Poisson-disk set whose density is the
//! ink's (PSP), with the dots of the inks before as given samples. Their clearance is the cross radius of Wei 2010,
//! "Multi-class blue noise sampling" (§3), at the density of all inks there: dots of all inks are well spread together.

use std::f64::consts::PI;

use azulejo::{Context, Given, MAXIMAL_DENSITY, Progress, Result};

use super::darkness::Darkness;
use super::dots::{LIGHTEST, poisson};

/// The number of inks, in the order in which they are laid down: black, cyan, magenta, yellow.
pub const INKS: usize = 4;

/// The components of the light (red, green and blue) that an ink absorbs.
pub const ABSORBS: [[bool; 3]; INKS] = [[true; 3], [true, false, false], [false, true, false], [false, false, true]];

/// The factor on Wei's cross radii: with 1 the inks take a fifth of each other's dots where they are dense.
const FACTOR: f64 = 0.75;

/// An ink is laid down anew, at a density that makes up for what the dots of others took from it, until its number of
/// dots is this near to the one that it should have, but no more often than [`TRIES`].
const NEAR: f64 = 0.01;
const TRIES: u32 = 4;

/// Dots of several inks.
#[derive(Default)]
pub struct Dots {
    /// Their centres.
    pub centres: Vec<[f32; 2]>,
    /// The ink of each, as its place in [`ABSORBS`].
    pub inks: Vec<u32>,
}

/// About `count` dots, shared out among the inks by the area that each is to cover, and their radius.
pub fn dots(
    context: &Context,
    inks: &[Darkness; INKS],
    count: usize,
    seed: u64,
    progress: &Progress,
) -> Result<(Dots, f64)> {
    let total: f64 = inks.iter().map(Darkness::ink).sum();
    let radius = (total / (PI * count as f64)).sqrt();
    let clearance = |&[x, y]: &[f32; 2]| {
        let dark: f64 = inks.iter().map(|ink| ink.at(x as usize, y as usize)).sum();
        FACTOR * radius * (MAXIMAL_DENSITY * PI / dark.max(LIGHTEST)).sqrt()
    };
    let mut dots = Dots::default();
    let (mut clearances, mut done) = (Vec::new(), 0.0);
    for (ink, darkness) in inks.iter().enumerate() {
        let share = darkness.ink() / total;
        let wanted = share * count as f64;
        // Fewer than one dot in the whole picture.
        if wanted < 0.5 {
            continue;
        }
        let own = |part: f64| progress(done + share * part);
        let centres =
            lay(context, darkness, wanted, (&dots.centres, &clearances), seed.wrapping_add(ink as u64), &own)?;
        clearances.extend(centres.iter().map(clearance));
        dots.inks.extend(std::iter::repeat_n(ink as u32, centres.len()));
        dots.centres.extend(centres);
        done += share;
    }
    Ok((dots, radius))
}

/// The dots of an ink around others with clearances.
fn lay(
    context: &Context,
    ink: &Darkness,
    wanted: f64,
    (others, clearances): (&[[f32; 2]], &[f64]),
    seed: u64,
    progress: &Progress,
) -> Result<Vec<[f32; 2]>> {
    let others: Vec<[f32; 3]> = others.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let given = Given::with_clearances(&others, clearances);
    let (mut asked, mut attempt) = (wanted, 0);
    loop {
        let told = |part: f64| progress((f64::from(attempt) + part) / f64::from(TRIES));
        let dots = poisson(context, ink, asked, given, seed, &told)?;
        attempt += 1;
        if (dots.len() as f64 / wanted - 1.0).abs() <= NEAR || attempt == TRIES {
            return Ok(dots);
        }
        asked *= wanted / dots.len().max(1) as f64;
    }
}
