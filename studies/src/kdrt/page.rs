//! The page, in Markdown.

use std::fmt::Write;

use azulejo::MAXIMAL_DENSITY;

use super::pictures::{STAGES, stage_times};
use super::statistics::{ANNULUS, CONTRAST_RANGE, Peak, Statistics};
use super::times::{LeafTimes, Times};
use super::{Effort, Sampler};
use crate::repeated;
use crate::timing::Rounds;
use crate::verdict::{Difference, LEVEL, Mean, chance, holm, judged, unless_different, verdict};
use azulejo_cli::summary::Summary;
use azulejo_cli::text::grouped;

/// The thesis's figures for its leaf sizes: table 2.2 in percent, and million samples per second on its CPU (Core
/// i7-4930K) and GPU (GTX 1080) from the captions of fig. 2.16 to 2.19.
const THESIS: [[f64; 3]; 4] = [[63.0, 1.84, 10.56], [21.0, 3.37, 13.15], [9.0, 5.66, 16.75], [5.0, 6.76, 18.14]];

/// The values of a quantity, one of each set or group of sets.
type Figure = fn(&Peak) -> &[f64];

/// The figures of peaks of the spectrum.
const PEAKS: [(&str, Figure); 3] = [
    ("largest power", |peak| &peak.power),
    ("largest power over its annulus", |peak| &peak.over_mean),
    ("mean power over annuli", |peak| &peak.level),
];

/// The frequencies of [`Statistics::peaks`].
const PLACES: [&str; 3] = ["axes", "fill blocks", "cells"];

/// The largest difference of the density at the default leaf size from that of an unbiased set, in percent: the goals
/// of the first version, and of 0.2.
const DENSITY_GOALS: [f64; 2] = [0.5, 0.2];

/// The nanoseconds per sample that its fill may take.
const FILL_GOAL: f64 = 15.0;

/// The text of the page.
pub fn text(effort: &Effort, statistics: &[Statistics], times: &Times) -> String {
    let parts = [
        introduction(),
        goals(statistics) + &fill_goal(times),
        bias(effort, statistics),
        spectra(statistics, times),
        shares(times),
        time_against_samples(times),
        time_by_stage(times),
    ];
    parts.join("\n")
}

fn introduction() -> String {
    "Thesis: Wang 2019, chapter 2. `r` is the radius, the smallest distance; frequencies are in units of √density. Times \
     and rates are medians of some rounds in which all leaf sizes take turns, with their range in brackets, on a machine that may \
     have had other work. Sets are of the unit torus, from their radius to the samples in memory.\n"
        .to_owned()
}

/// By how many percent a set is denser than an unbiased one.
fn excess(density: f64) -> f64 {
    100.0 * (density / MAXIMAL_DENSITY - 1.0)
}

fn decibels(ratio: f64) -> f64 {
    10.0 * ratio.log10()
}

/// A quantity of the sets of one leaf size beside the reference's, and the chance of so large a difference.
struct Comparison<'a> {
    goal: String,
    leaves: &'a Statistics,
    own: Mean,
    reference: Mean,
    difference: Option<Difference>,
    chance: f64,
}

impl<'a> Comparison<'a> {
    /// Contrast may differ neither way.
    fn of_contrast(leaves: &'a Statistics, reference: &Statistics) -> Self {
        let [own, reference] = [leaves, reference].map(|one| Mean::of(&one.contrast));
        let difference = own.above(&reference);
        let chance = difference.map_or(1.0, |difference| difference.chance_of_farther());
        Self { goal: "contrast as the reference's".to_owned(), leaves, own, reference, difference, chance }
    }

    /// Nothing may stand out more.
    fn of_peaks(leaves: &'a Statistics, reference: &Statistics) -> Vec<Self> {
        let kinds =
            PLACES.iter().enumerate().flat_map(|(i, place)| PEAKS.map(|(what, figure)| (i, place, what, figure)));
        let comparison = |(i, place, what, figure): (usize, &&str, &str, Figure)| {
            let [own, reference] = [leaves, reference].map(|one| Mean::of(figure(&one.peaks[i])));
            let difference = own.above(&reference);
            let chance = difference.map_or(1.0, |difference| difference.chance_of_larger());
            Self { goal: format!("{what}, {place}, not above"), leaves, own, reference, difference, chance }
        };
        kinds.filter(|(i, ..)| !leaves.peaks[*i].power.contains(&0.0)).map(comparison).collect()
    }
}

fn goals(statistics: &[Statistics]) -> String {
    let (reference, tiled) = (&statistics[0], statistics[1..].iter().filter(|one| one.is_tiled));
    let comparisons: Vec<_> = tiled
        .clone()
        .flat_map(|one| {
            [Comparison::of_contrast(one, reference)].into_iter().chain(Comparison::of_peaks(one, reference))
        })
        .collect();
    let chances = holm(&comparisons.iter().map(|comparison| comparison.chance).collect::<Vec<_>>());
    let mut text = format!(
        "## Goals\n\n\
         The sets of each leaf size beside those of the reference, mean against mean: ± is the standard error, *n* the number of \
         sets or of groups of sets, *t* the difference over its standard error (Welch), *p* the chance of as large a one \
         between samplers that do not differ, corrected for all {} comparisons of the table (Holm). A goal is not met where p \
         is at most {LEVEL}. Elsewhere no difference was shown, which does not say that there is none: it is as sharp as the \
         errors are small. The quantities are explained under *Bias*.\n\n\
         | goal | leaves | reference | n | found | n | t | p | |\n|---|---|---|---|---|---|---|---|---|\n",
        comparisons.len(),
    );
    for (comparison, &p) in comparisons.iter().zip(&chances) {
        let Comparison { goal, leaves, own, reference, difference, .. } = comparison;
        let t = difference.map_or("-".to_owned(), |difference| format!("{:+.1}", difference.t));
        let (name, found, other) = (leaves.sampler.name(), cell(own), cell(reference));
        let [n, m] = [reference, own].map(|mean| mean.count);
        _ = writeln!(
            text,
            "| {goal} | {name} | {other} | {n} | {found} | {m} | {t} | {} | {} |",
            chance(p),
            unless_different(p),
        );
    }
    let is_default = |one: &&Statistics| one.sampler == Sampler::Leaves(azulejo::kdrt::DEFAULT_LEAF_SIZE);
    for one in tiled.filter(is_default) {
        DENSITY_GOALS.into_iter().for_each(|goal| text += &density_goal(one, goal));
    }
    for one in statistics[1..].iter().filter(|one| !one.is_tiled) {
        _ = writeln!(text, "\nLeaves of {} need a larger pattern than this plane: not tiled.", one.sampler.name());
    }
    text
}

/// The density of the default leaf size: within the goal, beyond it, or too near to it for the errors.
fn density_goal(one: &Statistics, goal: f64) -> String {
    let excess = Mean::of(&one.density.iter().map(|&density| excess(density)).collect::<Vec<_>>());
    let distance = Mean { mean: excess.mean.abs(), ..excess }.above_number(goal);
    let chance_within = distance.map_or(0.5, |difference| difference.chance_of_larger());
    let verdict = match chance_within {
        chance if chance >= 1.0 - LEVEL => verdict(true),
        chance if chance <= LEVEL => verdict(false),
        _ => judged(None),
    };
    format!(
        "\nDensity of leaves of {} within {goal} % of {MAXIMAL_DENSITY:.5} / r²: {:+.3} ± {:.3} %, n = {}, t = {:+.1} \
         from the limit, {verdict} (one-sided, at {LEVEL} either way).\n",
        one.sampler.name(),
        excess.mean,
        excess.error,
        excess.count,
        distance.map_or(0.0, |difference| difference.t),
    )
}

/// The time of the fill of the default leaf size.
fn fill_goal(times: &Times) -> String {
    let default = times.leaves.iter().find(|leaf| leaf.leaf_size == azulejo::kdrt::DEFAULT_LEAF_SIZE);
    let Some(LeafTimes { leaf_size, stages, .. }) = default.filter(|leaf| leaf.stages.filled > 0) else {
        return String::new();
    };
    let nanoseconds = stages.fill.as_nanos() as f64 / stages.samples as f64;
    format!(
        "\nFill of leaves of {leaf_size}r in at most {FILL_GOAL} ns per sample of the set: {nanoseconds:.2} ns, {}. Two threads over one at \
         10,000,000 samples are in [goals.md](goals.md).\n",
        verdict(nanoseconds <= FILL_GOAL),
    )
}

/// A mean with its standard error.
fn cell(Mean { mean, error, .. }: &Mean) -> String {
    format!("{mean:.5} ± {error:.5}")
}

/// By which power of the leaf size an excess goes, from the smallest leaves to the largest.
fn exponent(statistics: &[Statistics], excess: impl Fn(&Statistics) -> f64) -> Option<f64> {
    let tiled: Vec<_> = statistics.iter().filter(|one| one.is_tiled).collect();
    let size = |one: &Statistics| if let Sampler::Leaves(size) = one.sampler { size } else { f64::NAN };
    let (first, last) = (tiled.first()?, tiled.last()?);
    let exponent = (excess(last) / excess(first)).ln() / (size(last) / size(first)).ln();
    exponent.is_finite().then_some(exponent)
}

fn bias(effort: &Effort, statistics: &[Statistics]) -> String {
    let mut text = format!(
        "## Bias\n\n\
         Sets of about {} samples on the unit torus, {} of each kind, with the same r. The density of an unbiased maximal \
         set is N·r² = {MAXIMAL_DENSITY:.5} (the jamming limit of random sequential placement, 0.5470735 · 4/π; ± is the \
         standard error of the mean). *Contrast* is the variance of a set's periodogram over its squared mean, in annuli \
         of {ANNULUS}, averaged over all frequencies from {} to {}: 1 without order over long distances, more where parts \
         repeat. It is the mean of all sets, with its standard error and their range. Of the mean spectrum of all sets: how far its radial mean is \
         from the reference's at most (the first ring has a power of about 1.75), and its anisotropy over the same \
         frequencies ({:.1} dB without any).\n\n\
         | leaves | N·r² | over unbiased | contrast | radial mean | anisotropy |\n|---|---|---|---|---|---|\n",
        grouped(effort.count as usize),
        effort.groups * effort.sets_per_group,
        CONTRAST_RANGE.start,
        CONTRAST_RANGE.end,
        decibels(1.0 / (effort.groups * effort.sets_per_group) as f64),
    );
    for one in statistics {
        let (density, contrast) = (Summary::of(&one.density), Summary::of(&one.contrast));
        _ = writeln!(
            text,
            "| {} | {:.5} ± {:.5} | {:+.2} % | {:.4} ± {:.4} ({:.4} to {:.4}) | {:.3} | {:.2} dB |",
            name(one),
            density.mean,
            density.error,
            excess(density.mean),
            contrast.mean,
            contrast.error,
            contrast.low,
            contrast.high,
            one.difference,
            decibels(one.anisotropy),
        );
    }
    if let Some(exponent) = exponent(statistics, |one| excess(Mean::of(&one.density).mean)) {
        _ = writeln!(
            text,
            "\nFrom the smallest leaves to the largest the excess of density goes as leaf size to the power {exponent:.2}; seams, \
             whose length per area goes as 1 / leaf size, would give -1."
        );
    }
    _ = write!(
        text,
        "\n*Power* is taken on the axes, where seams are, and on the harmonics of what is regular: the fill blocks, at most \
         4.8 r wide before jitter, and the cells, at most r/√2. The *largest* is that of the mean spectrum of {} sets, one of \
         each of {} such groups; the *mean over annuli* is that of each set, of all these frequencies, each over the mean \
         of its annulus. Means with their standard errors and ranges.\n",
        effort.sets_per_group, effort.groups,
    );
    for (what, figure) in PEAKS {
        _ = write!(text, "\n| {what}, leaves | {} |\n|---|---|---|---|\n", PLACES.join(" | "));
        for one in statistics {
            let cells = one.peaks.each_ref().map(|peak| {
                let Summary { low, high, .. } = Summary::of(figure(peak));
                format!("{} ({low:.3} to {high:.3})", cell(&Mean::of(figure(peak))))
            });
            _ = writeln!(text, "| {} | {} |", name(one), cells.join(" | "));
        }
    }
    text
}

fn name(one: &Statistics) -> String {
    let is_as_asked = one.sampler == Sampler::Maximal || one.is_tiled;
    one.sampler.name() + if is_as_asked { "" } else { " (not tiled)" }
}

/// Million samples per second.
fn rate(timed: &Rounds) -> String {
    repeated::cell(&timed.per_sample().map(|seconds| 1e-6 / seconds), 3)
}

fn spectra(statistics: &[Statistics], times: &Times) -> String {
    let mut text = format!(
        "## Spectra and rates (thesis fig. 2.15 to 2.19)\n\n\
         Million samples per second, for sets of about {}; the pattern is made anew in each call. Other pages have other \
         calls: [order.md](order.md) sets with ranks, [classes.md](classes.md) fewer samples, \
         [tiling.md](archive/tiling.md) other seeds, [peers.md](peers.md) bounded sets, each in a process of its own. The thesis's machine was \
         a Core i7-4930K of 2013 with a GTX 1080, and its reference ran on that GPU.\n\n\
         | leaves | thesis, CPU | thesis, GPU | one thread | {} threads |\n|---|---|---|---|---|\n\
         | reference | | 4.3 | {} | |\n",
        grouped(times.reference.samples),
        times.threads,
        rate(&times.reference),
    );
    for (leaf, [_, cpu, gpu]) in times.leaves.iter().zip(THESIS) {
        let [one, all] = [&leaf.one_thread[times.timed], &leaf.all_threads].map(rate);
        _ = writeln!(text, "| {}r | {cpu} | {gpu} | {one} | {all} |", leaf.leaf_size);
    }
    for one in statistics {
        let name = one.sampler.name();
        _ = write!(text, "\n![Spectrum, radial mean and anisotropy of the {name} sets](kdrt/spectrum-{name}.png)\n");
    }
    text
}

fn shares(times: &Times) -> String {
    let mut text = "## Share of samples processed (thesis table 2.2)\n\n\
        The thesis counts the samples that take part in elimination and insertion; here, the points of the pattern laid \
        in leaves that are near enough to a seam to be tested.\n\n\
        | leaves | thesis | tested | eliminated | filled, of all samples |\n|---|---|---|---|---|\n"
        .to_owned();
    for (LeafTimes { leaf_size, stages, .. }, [share, ..]) in times.leaves.iter().zip(THESIS) {
        let percent = |part: u64, whole: u64| 100.0 * part as f64 / whole.max(1) as f64;
        _ = writeln!(
            text,
            "| {leaf_size}r | {share} % | {:.1} % | {:.1} % | {:.1} % |",
            percent(stages.tested, stages.clipped),
            percent(stages.eliminated, stages.clipped),
            percent(stages.filled, stages.samples),
        );
    }
    text
}

fn time_against_samples(times: &Times) -> String {
    let mut text = "## Time against samples (thesis fig. 2.11)\n\n\
        Milliseconds on one thread, with the making of the pattern. Sets that are not larger than their pattern are not \
        tiled.\n\n| samples"
        .to_owned();
    times.leaves.iter().for_each(|leaf| _ = write!(text, " | {}r", leaf.leaf_size));
    _ = writeln!(text, " |\n|---{}|", "|---".repeat(times.leaves.len()));
    for (row, Rounds { samples, .. }) in times.leaves[0].one_thread.iter().enumerate() {
        _ = write!(text, "| {}", grouped(*samples));
        let milliseconds = |leaf: &LeafTimes| leaf.one_thread[row].scaled(1e3);
        times.leaves.iter().for_each(|leaf| _ = write!(text, " | {}", repeated::cell(&milliseconds(leaf), 3)));
        text.push_str(" |\n");
    }
    text + "\n![Time against samples](kdrt/times.png)\n"
}

fn time_by_stage(times: &Times) -> String {
    let samples = times.leaves.iter().map(|leaf| leaf.stages.samples).max().unwrap_or(0);
    let mut text = format!(
        "## Time by stage (thesis fig. 2.13)\n\n\
         Nanoseconds per sample on one thread, of one call with clocks between its stages, for sets of about {}. In the thesis elimination and the first insertion take \
         the longest.\n\n| leaves | {} | all |\n|---{}|---|\n",
        grouped(samples as usize),
        STAGES.join(" | "),
        "|---".repeat(STAGES.len()),
    );
    for leaf in &times.leaves {
        let stages = stage_times(&leaf.stages);
        let all: Vec<_> = stages.iter().chain([&stages.iter().sum()]).map(|time| format!("{time:.2}")).collect();
        _ = writeln!(text, "| {}r | {} |", leaf.leaf_size, all.join(" | "));
    }
    text + "\n![Time by stage](kdrt/stages.png)\n"
}
