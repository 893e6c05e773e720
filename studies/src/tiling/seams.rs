//! The share of a set that the seams touch, beside the bound of thesis eq. 2.4.

use std::fmt::Write;

use azulejo::kdrt::stages::{Stages, measure};
use azulejo::{Boundary, Domain, Result, kdrt};

use super::claims::{Claim, Part, cell, number};
use super::study::{Figure, Study, excess, mean_of};
use crate::chart::{curve, dots, legend, range, single};
use crate::kdrt::radius;
use azulejo_cli::draw::palette::SERIES;
use azulejo_cli::draw::plot::Axis;
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::progress::watched;
use azulejo_cli::text::grouped;

/// R_leaf in radii with the thesis's percentage of samples that are processed (table 2.2), where it has one.
const LEAVES: [(f64, Option<f64>); 5] =
    [(6.0, Some(63.0)), (10.0, None), (20.0, Some(21.0)), (40.0, Some(9.0)), (80.0, Some(5.0))];

/// The share of the area where elimination and insertion happen, in percent, for tiles of N radii.
fn bound(n: f64) -> f64 {
    100.0 * (2.0 * n + 1.0) / ((n + 1.0) * (n + 1.0))
}

/// The sets of one size of leaves: what happened in each, in percent.
struct Leaves {
    size: f64,
    processed: Option<f64>,
    sets: Vec<Set>,
}

struct Set {
    tested: f64,
    eliminated: f64,
    inserted: f64,
    excess: f64,
}

impl Set {
    fn measure(leaf_size: f64, count: f64, seed: u64) -> Result<Self> {
        let radius = radius(count);
        let options =
            kdrt::Options::new(radius).domain(Domain::unit(Boundary::Periodic)).leaf_size(leaf_size).seed(seed);
        let Stages { samples, clipped, tested, eliminated, filled, .. } = measure(&options)?;
        let percent = |part: u64, whole: u64| 100.0 * part as f64 / whole.max(1) as f64;
        Ok(Self {
            tested: percent(tested, clipped),
            eliminated: percent(eliminated, clipped),
            inserted: percent(filled, samples),
            excess: excess(samples as usize, radius),
        })
    }
}

pub fn section(study: &Study) -> Result<Part> {
    let (count, sets) = study.effort((2e5, 16), (8e4, 2));
    let measured = watched("seams", |progress| {
        in_parallel(study.context.num_threads(), LEAVES.len() * sets, progress, |i| {
            Set::measure(LEAVES[i / sets].0, count, (i % sets) as u64)
        })
    })?;
    let mut measured = measured.into_iter();
    let mut all = Vec::new();
    for (size, processed) in LEAVES {
        all.push(Leaves { size, processed, sets: measured.by_ref().take(sets).collect::<Result<_>>()? });
    }
    draw(study, &all)?;
    let claims = all.iter().flat_map(|Leaves { size, sets, .. }| {
        let claim = |what: &str, figure: Figure<Set>| {
            let what = format!("{what}, {size}r, below the bound of eq. 2.4");
            Claim::less(what, mean_of(sets, figure), number(bound(*size)))
        };
        [
            claim("percent of samples that are inserted", |set| set.inserted),
            claim("percent of excess of density", |set| set.excess),
        ]
    });
    Ok(Part { text: text(count, sets, &all), claims: claims.collect(), facts: Vec::new() })
}

fn draw(study: &Study, all: &[Leaves]) -> Result<()> {
    let series: [(&str, Figure<Leaves>); 4] = [
        ("bound, eq. 2.4", |leaves| bound(leaves.size)),
        ("inserted", |leaves| mean_of(&leaves.sets, |set| set.inserted).mean),
        ("eliminated", |leaves| mean_of(&leaves.sets, |set| set.eliminated).mean),
        ("excess of density", |leaves| mean_of(&leaves.sets, |set| set.excess).mean.max(1e-3)),
    ];
    let values = series.iter().flat_map(|(_, value)| all.iter().map(value));
    let y = Axis::logarithmic("percent", range(values, 1.6));
    let x = Axis::logarithmic("smallest leaf / r", range(all.iter().map(|leaves| leaves.size), 1.2));
    let (mut canvas, panel) = single(x, y);
    for (row, ((name, value), colour)) in series.iter().zip(SERIES).enumerate() {
        let points = || all.iter().map(|leaves| [leaves.size, value(leaves)]);
        curve(&mut canvas, &panel, points(), 2.6, colour);
        dots(&mut canvas, &panel, points(), 4.5, colour);
        legend(&mut canvas, [600.0, 92.0 + 28.0 * row as f32], name, 2.6, colour);
    }
    panel.axes(&mut canvas);
    panel.title(&mut canvas, "What the seams touch", "");
    canvas.write(&study.files.picture("seams")?)
}

fn text(count: f64, sets: usize, all: &[Leaves]) -> String {
    let mut text = format!(
        "## Bias at the seams (thesis eq. 2.4 and table 2.2)\n\n\
         The thesis bounds its bias by the share of the area where elimination and insertion happen, (2N + 1) / (N + 1)² for \
         tiles of N radii. Percent of the samples, means of {sets} sets of about {}: *tested* are the points of the pattern laid near enough to \
         a seam to be tested, *eliminated* those of them that go, *inserted* the new samples of the result. *Excess* is that of \
         the density over {:.5} / r². The thesis's own share of samples that are processed (table 2.2) is above its \
         bound where it is marked.\n\n\
         | R_leaf | bound, eq. 2.4 | thesis, processed | tested | eliminated | inserted | excess |\n|---|---|---|---|---|---|---|\n",
        grouped(count as usize),
        azulejo::MAXIMAL_DENSITY,
    );
    for Leaves { size, processed, sets } in all {
        let bound = bound(*size);
        let processed =
            processed.map_or("-".to_owned(), |share| format!("{share}{}", if share > bound { " (above)" } else { "" }));
        let figure = |of: Figure<Set>| cell(&mean_of(sets, of));
        _ = writeln!(
            text,
            "| {size}r | {bound:.2} | {processed} | {} | {} | {} | {} |",
            figure(|set| set.tested),
            figure(|set| set.eliminated),
            figure(|set| set.inserted),
            figure(|set| set.excess),
        );
    }
    let (first, last) = (&all[0], &all[all.len() - 1]);
    let exponent = |value: Figure<Leaves>| (value(last) / value(first)).ln() / (last.size / first.size).ln();
    _ = write!(
        text,
        "\nThe thesis calls the bound inversely proportional to N. From the smallest leaves to the largest it goes as N to the \
         power {:.2}, and the inserted samples as N to the power {:.2}.\n\n![What the seams touch](tiling/seams.png)\n",
        exponent(|leaves| bound(leaves.size)),
        exponent(|leaves| mean_of(&leaves.sets, |set| set.inserted).mean),
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_is_below_ten_percent_from_nineteen_on() {
        // "Will be less than 10 percent with N > 19", says the thesis.
        assert!(bound(19.0) < 10.0 && bound(18.0) > 10.0);
        assert!((bound(1.0) - 75.0).abs() < 1e-12);
    }
}
