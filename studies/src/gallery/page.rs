//! The page of the gallery, in Markdown.

use std::fmt::Write;

use super::Effort;
use super::measured::Measured;
use azulejo_cli::text::{grouped, rounded};

/// The text of the page.
pub fn text(effort: &Effort, measured: &[Measured]) -> String {
    [introduction(effort), spectra(), figures(measured), plates(effort, measured)].join("\n")
}

fn introduction(effort: &Effort) -> String {
    format!(
        "Thesis: Wang 2019, fig. 4.16, 4.17 and 2.12.\n\n\
         Each set has {} points on the unit torus, or about as many. *Random* points are independent, *jittered* ones lie \
         anywhere in the cells of a grid, *Halton* ones follow his sequence of the bases 2 and 3, each set where the one \
         before ends. *Flat quadtree* is the unbiased maximal Poisson-disk set (Ebeida et al. 2012), *KDRT* the tiled one \
         (chapter 2). DCR (chapter 4) starts from random points; *momentum* and *thesis* are its two methods. There are {} sets \
         of each, of the thesis's methods {}.\n",
        grouped(effort.side * effort.side),
        effort.sets,
        effort.slow_sets,
    )
}

fn spectra() -> String {
    "## Points and spectra (thesis fig. 4.16 and 4.17)\n\n\
     From above: a part of the first set; the mean power spectrum of all sets, 1 for white noise, all ink from 4 on; its radial \
     mean; its anisotropy, 0 dB where a set is the same in all directions.\n\n\
     ![Random, jittered, Halton, flat quadtree, KDRT](gallery/samplers.png)\n\n\
     ![DCR: the momentum method and the thesis's, with Delaunay and nearest neighbours](gallery/relaxed.png)\n"
        .to_owned()
}

fn figures(measured: &[Measured]) -> String {
    let mut text = "## Figures\n\n\
        Means over the sets ± their standard errors, as in [docs/dcr.md](dcr.md), whose sets have other seeds and numbers: *ρ* is the smallest distance, *nearest* the mean distance to the \
        nearest neighbour, *cover* the largest distance of a place from the set, in units of the distance in the hexagonal \
        arrangement; *ψ6* is the bond order, *P* the mean power below ¼ √density. Of the mean spectrum: *ν* is the effective \
        Nyquist frequency in units of √density, *Ω* the oscillation (Heck et al. 2013).\n\n\
        | sampler | ρ | nearest | cover | ψ6 | P | obtuse | ν | Ω |\n|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for one in measured {
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} % | {} | {} |",
            one.sampler.name(),
            one.mean(|set| set.rho).cell(3),
            one.mean(|set| set.mean_distance).cell(3),
            one.mean(|set| set.cover).cell(3),
            one.mean(|set| set.order).cell(3),
            one.mean(|set| set.low_power).cell(2),
            one.mean(|set| 100.0 * set.obtuse).cell(3),
            or_dash(one.nyquist),
            or_dash(one.oscillation),
        );
    }
    text
}

fn or_dash(value: f64) -> String {
    if value.is_nan() { "-".to_owned() } else { rounded(value, 3) }
}

fn plates(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Zone plate (thesis fig. 2.12, third row)\n\n\
         sin(x² + y²) in pictures of {0} by {0} pixels, with one sample per pixel on average, seen through a Gaussian of half \
         a pixel. The frequency is 0 in the lower left corner and grows evenly to one wave per pixel on the far sides: a \
         picture can show the inner half, the rest should be grey. The exact picture is known in closed form. Errors are root \
         mean squares, in units of the plate's amplitude, where the frequency is below half a wave per pixel and where it is \
         above; means over the sets.\n\n\
         ![The plate, exact and by each sampler](gallery/zone-plate.png)\n\n\
         | sampler | error, low frequencies | error, high frequencies |\n|---|---|---|\n",
        effort.side
    );
    for one in measured {
        let [low, high] = [one.error(|errors| errors.low), one.error(|errors| errors.high)].map(|mean| mean.cell(4));
        _ = writeln!(text, "| {} | {low} | {high} |", one.sampler.name());
    }
    text
}
