//! The use of each of the two randomnesses (thesis §2.5.2 and fig. 2.20).

use std::fmt::Write;

use azulejo::analysis::spectrum::Periodogram;
use azulejo::kdrt::stages::{Fixed, sample_varied};
use azulejo::{Boundary, Domain, Result, kdrt};

use super::claims::{Claim, Part, cell};
use super::spectra::{ANNULUS, CURVE_ANNULUS, contrast, spectrum};
use super::study::{Figure, Study, mean_of};
use crate::kdrt::pictures::draw_power;
use crate::kdrt::radius;
use crate::verdict::Mean;
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::progress::watched;
use azulejo_cli::text::grouped;

/// The ratios of the areas of plane and pattern.
const RATIOS: [f64; 2] = [16.0, 64.0];

const LEAF_SIZE: f64 = kdrt::DEFAULT_LEAF_SIZE;

/// The randomness that is taken away, and the name of what is left.
const KINDS: [(Fixed, &str); 3] =
    [(Fixed::Nothing, "both"), (Fixed::Clips, "subdivision only"), (Fixed::Splits, "clipping only")];

struct Set {
    contrast: f64,
    /// The largest power over its annulus at the harmonics of leaves that are all alike.
    peak: f64,
    spectrum: Periodogram,
}

struct Row {
    ratio: f64,
    fixed: Fixed,
    name: &'static str,
    sets: Vec<Set>,
}

/// Leaves along a side of the plane if every split is in the middle, for a side of so many radii.
fn leaves_along(side: f64) -> i64 {
    1 << (side / LEAF_SIZE).log2().floor() as u32
}

pub fn section(study: &Study) -> Result<Part> {
    let (count, sets) = study.effort((1e5, 8), (7.4e4, 2));
    let (torus, radius) = (Domain::unit(Boundary::Periodic), radius(count));
    let along = leaves_along(1.0 / radius);
    let kinds: Vec<_> = RATIOS.iter().flat_map(|&ratio| KINDS.map(|(fixed, name)| (ratio, fixed, name))).collect();
    let made = watched("randomness", |progress| {
        in_parallel(study.context.num_threads(), kinds.len() * sets, progress, |i| -> Result<Set> {
            let (ratio, fixed, _) = kinds[i / sets];
            let context = azulejo::Context::new(1)?;
            let options = kdrt::Options::new(radius).domain(torus).leaf_size(LEAF_SIZE).seed((i % sets) as u64);
            let side = 1.0 / radius / ratio.sqrt();
            let samples = sample_varied(&context, &options, side, fixed)?.samples;
            let spectrum = spectrum(&context, &samples, count, FREQUENCY_LIMIT + CURVE_ANNULUS)?;
            let limit = (spectrum.size() / 2) as i64 / along;
            let harmonics = (1..=limit).flat_map(|k| [[k * along, 0], [0, k * along]]);
            Ok(Set { contrast: contrast(&spectrum)?, peak: spectrum.peak(ANNULUS, harmonics)?, spectrum })
        })
    })?;
    let mut made = made.into_iter();
    let mut rows = Vec::new();
    for (ratio, fixed, name) in kinds {
        rows.push(Row { ratio, fixed, name, sets: made.by_ref().take(sets).collect::<Result<_>>()? });
    }
    draw(study, &rows)?;
    Ok(Part { text: text(count, &rows), claims: claims(&rows), facts: Vec::new() })
}

/// The randomness that is removed, the name of its effect, and the figure of a set.
type Kind = (Fixed, &'static str, Figure<Set>);

fn claims(rows: &[Row]) -> Vec<Claim> {
    let of = |ratio: f64, fixed: Fixed, figure: Figure<Set>| -> Option<Mean> {
        let row = rows.iter().find(|row| row.ratio == ratio && row.fixed == fixed)?;
        Some(mean_of(&row.sets, figure))
    };
    let kinds: [Kind; 2] = [
        (Fixed::Clips, "contrast: both below subdivision only", |set| set.contrast),
        (Fixed::Splits, "peak at the grid of leaves: both below clipping only", |set| set.peak),
    ];
    let claim = |ratio: f64, (fixed, what, figure): Kind| {
        let (both, one) = (of(ratio, Fixed::Nothing, figure)?, of(ratio, fixed, figure)?);
        Some(Claim::less(format!("{what}, {ratio}x (fig. 2.20)"), both, one))
    };
    RATIOS.iter().flat_map(|&ratio| kinds.map(|kind| claim(ratio, kind))).flatten().collect()
}

fn draw(study: &Study, rows: &[Row]) -> Result<()> {
    let mut canvas = Canvas::new(1290.0, 880.0, 1290);
    for (i, row) in rows.iter().enumerate() {
        let [column, line] = [i % KINDS.len(), i / KINDS.len()].map(|place| place as f32);
        let square = Rect { x: 90.0 + 410.0 * column, y: 56.0 + 430.0 * line, width: 300.0, height: 300.0 };
        let first = &row.sets[0].spectrum;
        draw_power(&mut canvas, square, first, row.name, &format!("{}x", row.ratio));
    }
    canvas.write(&study.files.picture("randomness")?)
}

fn text(count: f64, rows: &[Row]) -> String {
    let mut text = format!(
        "## The two randomnesses (thesis §2.5.2 and fig. 2.20)\n\n\
         Sets of about {} samples with leaves of {LEAF_SIZE}r, {} of each kind, on planes 16 and 64 times as large as their patterns, as in \
         the thesis. *Subdivision only* shows the same part of the pattern in all leaves, *clipping only* splits every node in its middle. \
         The thesis shows spectra: that the first \"can cause serious bias problem\", and artifacts of the second at 64x. *Contrast* is 1 where no part repeats; \
         *peak* is the largest power over that of its annulus at the harmonics of the grid that leaves form if all are split in the \
         middle.\n\n\
         ![Spectra of one set of each kind](tiling/randomness.png)\n\n\
         | plane / pattern | random | contrast | peak |\n|---|---|---|---|\n",
        grouped(count as usize),
        rows[0].sets.len(),
    );
    for Row { ratio, name, sets, .. } in rows {
        let [contrast, peak] = [mean_of(sets, |set| set.contrast), mean_of(sets, |set| set.peak)];
        _ = writeln!(text, "| {ratio}x | {name} | {} | {} |", cell(&contrast), cell(&peak));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_are_halved_while_both_halves_are_long_enough() {
        assert_eq!([39.0, 40.0, 79.0, 80.0, 379.0].map(leaves_along), [1, 2, 2, 4, 16]);
    }
}
