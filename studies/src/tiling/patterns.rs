//! The size of the pattern and R_leaf together: time and statistics (thesis §2.5.2, which leaves it as future work).

use std::fmt::Write;

use azulejo::kdrt::stages::{Fixed, sample_varied};
use azulejo::{Boundary, Context, Domain, MAXIMAL_DENSITY, Result, kdrt};

use super::claims::{Claim, Part, cell};
use super::spectra::{LIMIT, RANGE, Reference, contrast, spectrum};
use super::study::{Figure, Study, excess, mean_of, times};
use crate::kdrt::{LEAF_SIZES, Sampler, radius};
use crate::verdict::Mean;
use azulejo_cli::progress::watched;
use azulejo_cli::text::grouped;

/// The sides of patterns, in radii. The second has about the 8192 samples that the thesis would hardcode (§2.5.1).
const SIDES: [f64; 4] = [54.0, 108.0, 200.0, 320.0];

/// The figures of a set, and its seconds.
struct Set {
    excess: f64,
    contrast: f64,
    deviation: f64,
    pattern: f64,
    tiling: f64,
    samples: usize,
}

struct Row {
    side: f64,
    leaf_size: f64,
    sets: Vec<Set>,
}

pub fn section(study: &Study) -> Result<Part> {
    let (count, sets, sides) = study.effort((1e5, 12, &SIDES[..]), (4e4, 2, &SIDES[2..3]));
    let (one, torus, radius) = (Context::new(1)?, Domain::unit(Boundary::Periodic), radius(count));
    let kinds = sides.iter().flat_map(|&side| LEAF_SIZES.map(|leaf_size| (side, leaf_size)));
    let fitting = kinds.filter(|(side, leaf_size)| *side >= 2.0 * leaf_size);
    let mut rows: Vec<_> = fitting.map(|(side, leaf_size)| Row { side, leaf_size, sets: Vec::new() }).collect();
    let mut unbiased = Vec::new();
    watched("patterns", |progress| {
        let reference = Reference::measure(study.context, count, 100..100 + sets)?;
        let set = |samples: &[[f32; 2]], [pattern, tiling]: [f64; 2]| -> Result<Set> {
            let spectrum = spectrum(study.context, samples, count, LIMIT)?;
            Ok(Set {
                excess: excess(samples.len(), radius),
                contrast: contrast(&spectrum)?,
                deviation: reference.deviation(&spectrum)?,
                pattern,
                tiling,
                samples: samples.len(),
            })
        };
        for seed in 0..sets {
            unbiased.push(set(&Sampler::Maximal.sample(study.context, count, seed)?, [0.0; 2])?);
            for row in &mut rows {
                let options = kdrt::Options::new(radius).domain(torus).leaf_size(row.leaf_size).seed(seed);
                let varied = sample_varied(&one, &options, row.side, Fixed::Nothing)?;
                row.sets.push(set(&varied.samples, [varied.pattern, varied.tiling].map(|time| time.as_secs_f64()))?);
            }
            _ = progress((seed + 1) as f64 / sets as f64);
        }
        Ok(())
    })?;
    Ok(Part { text: text(count, sets, &unbiased, &rows), claims: claims(sides, &rows), facts: Vec::new() })
}

/// Leaves are compared on the widest pattern: all fit.
fn claims(sides: &[f64], rows: &[Row]) -> Vec<Claim> {
    let of = |side: f64, leaf_size: f64, figure: Figure<Set>| -> Option<Mean> {
        let row = rows.iter().find(|row| (row.side, row.leaf_size) == (side, leaf_size))?;
        Some(mean_of(&row.sets, figure))
    };
    let less = |what: String, low: Option<Mean>, high: Option<Mean>| Some(Claim::less(what, low?, high?));
    let deviation: Figure<Set> = |set| set.deviation;
    let contrast: Figure<Set> = |set| set.contrast;
    let (small, large) = (LEAF_SIZES[1], LEAF_SIZES[3]);
    let (narrowest, widest) = (sides[0], sides[sides.len() - 1]);
    let claims = [
        less(
            format!(
                "deviation of the radial mean: {small}r below {large}r (§2.5.2: \"the larger the R_leaf, the more regularity\")"
            ),
            of(widest, small, deviation),
            of(widest, large, deviation),
        ),
        less(
            format!("contrast: {small}r below {large}r, with the same pattern of {widest}r"),
            of(widest, small, contrast),
            of(widest, large, contrast),
        ),
        less(
            format!("contrast at {small}r: a pattern of {widest}r below one of {narrowest}r"),
            of(widest, small, contrast),
            of(narrowest, small, contrast).filter(|_| narrowest < widest),
        ),
    ];
    claims.into_iter().flatten().collect()
}

fn text(count: f64, sets: u64, unbiased: &[Set], rows: &[Row]) -> String {
    let mut text = format!(
        "## Size of the pattern and of the leaves (thesis §2.5.2)\n\n\
         The thesis \"tested limited combinations of pattern size and R_leaf\" without figures. {sets} sets of about {} of each, by the \
         library with other patterns than it would choose; a pattern must hold the largest leaf. *Excess* of the density over an unbiased set's, \
         in percent, and its *spread*, the standard deviation of the sets, to which the pattern's own chance is passed on. Contrast in {} to {} √density is 1 where no part repeats; \
         *deviation* is how far the radial mean is from the reference's, root mean square of the power. Times are of one thread: \
         milliseconds of the pattern, nanoseconds per sample of the rest.\n\n\
         | pattern | its samples | R_leaf | excess | spread | contrast | deviation | pattern, ms | rest, ns |\n\
         |---|---|---|---|---|---|---|---|---|\n",
        grouped(count as usize),
        RANGE.start,
        RANGE.end,
    );
    let figures = |sets: &[Set]| {
        let excess = mean_of(sets, |set| set.excess);
        let spread = excess.error * (sets.len() as f64).sqrt();
        let [contrast, radial] = [mean_of(sets, |set| set.contrast), mean_of(sets, |set| set.deviation)];
        format!("{} | {spread:.3} | {} | {}", cell(&excess), cell(&contrast), cell(&radial))
    };
    _ = writeln!(text, "| none | - | reference | {} | - | - |", figures(unbiased));
    for Row { side, leaf_size, sets } in rows {
        let seconds = |of: Figure<Set>| sets.iter().map(of).collect::<Vec<_>>();
        _ = writeln!(
            text,
            "| {side}r | {} | {leaf_size}r | {} | {} | {} |",
            grouped((side * side * MAXIMAL_DENSITY) as usize),
            figures(sets),
            times(&seconds(|set| set.pattern), 1e3),
            times(&seconds(|set| set.tiling / set.samples as f64), 1e9),
        );
    }
    text
}
