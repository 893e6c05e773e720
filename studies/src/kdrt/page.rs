//! The page, in Markdown.

use std::fmt::Write;

use azulejo::MAXIMAL_DENSITY;

use super::pictures::{STAGES, stage_times};
use super::statistics::{ANNULUS, CONTRAST_RANGE, GROUPS, Peak, Statistics};
use super::times::{LeafTimes, Times};
use super::{Effort, Sampler};
use crate::verdict::verdict;
use azulejo_cli::summary::Summary;
use azulejo_cli::text::{grouped, rounded};

/// The thesis's figures for its leaf sizes: table 2.2 in percent, and million samples per second on its CPU (Core
/// i7-4930K) and GPU (GTX 1080) from the captions of fig. 2.16 to 2.19.
const THESIS: [[f64; 3]; 4] = [[63.0, 1.84, 10.56], [21.0, 3.37, 13.15], [9.0, 5.66, 16.75], [5.0, 6.76, 18.14]];

/// What a peak is measured by.
type Figure = fn(&Peak) -> &Summary;

/// What peaks are measured by.
const PEAKS: [(&str, Figure); 2] = [("power", |peak| &peak.power), ("power over its annulus", |peak| &peak.over_mean)];

/// How far the density of the default leaf size may be from that of an unbiased set, in percent.
const DENSITY_GOAL: f64 = 0.5;

/// The text of the page.
pub fn text(effort: &Effort, statistics: &[Statistics], times: &Times) -> String {
    let parts = [
        introduction(),
        goals(statistics),
        bias(effort, statistics),
        spectra(statistics, times),
        shares(times),
        time_against_samples(times),
        time_by_stage(times),
    ];
    parts.join("\n")
}

fn introduction() -> String {
    "Thesis: Wang 2019, chapter 2. `r` is the radius, the smallest distance; frequencies are in units of √density. Times are \
     the least of three, on a machine that may have had other work.\n"
        .to_owned()
}

/// By how many percent a set is denser than an unbiased one.
fn excess(density: f64) -> f64 {
    100.0 * (density / MAXIMAL_DENSITY - 1.0)
}

fn decibels(ratio: f64) -> f64 {
    10.0 * ratio.log10()
}

fn goals(statistics: &[Statistics]) -> String {
    let mut text = "## Goals\n\n\
        | goal | leaves | found | |\n|---|---|---|---|\n"
        .to_owned();
    let (reference, tiled) = (&statistics[0], statistics[1..].iter().filter(|one| one.is_tiled));
    let is_default = |one: &&Statistics| one.sampler == Sampler::Leaves(azulejo::kdrt::DEFAULT_LEAF_SIZE);
    let others = || tiled.clone().filter(|one| !is_default(one));
    for one in tiled.clone().filter(is_default).chain(others()) {
        let (name, is_default) = (one.sampler.name(), is_default(&one));
        let excess = excess(one.density.mean);
        if is_default {
            let error = 100.0 * one.density.error / MAXIMAL_DENSITY;
            let is_met = excess.abs() <= DENSITY_GOAL;
            let goal = format!("density within {DENSITY_GOAL} % of {MAXIMAL_DENSITY:.5} / r²");
            _ = writeln!(text, "| {goal} | {name} | {excess:+.2} ± {error:.2} % | {} |", verdict(is_met));
        }
        let Summary { low, high, .. } = reference.contrast;
        let is_met = (low..=high).contains(&one.contrast.mean);
        let goal = format!("contrast in the reference's range, {low:.4} to {high:.4}");
        _ = writeln!(text, "| {goal} | {name} | {:.4} | {} |", one.contrast.mean, verdict(is_met));
        for (what, figure) in PEAKS {
            let pairs = std::iter::zip(&one.peaks, &reference.peaks).map(|(own, other)| (figure(own), figure(other)));
            let (own, largest) = pairs
                .max_by(|a, b| (a.0.mean / a.1.high).total_cmp(&(b.0.mean / b.1.high)))
                .map_or((0.0, 0.0), |(own, other)| (own.mean, other.high));
            let goal = format!("no peak of {what} above the reference's largest, {largest:.2}");
            _ = writeln!(text, "| {goal} | {name} | {own:.2} | {} |", verdict(own <= largest));
        }
    }
    text.push_str(
        "\nWhat is behind them. Density: where two leaves meet, what elimination leaves and filling adds is denser than an \
         unbiased set; the excess falls as 1 / leaf size. Contrast: parts of the pattern are seen again; its excess falls as \
         (leaf side / pattern side)². Peaks over their annulus: all seams lie along the axes, which leaves a faint cross, most \
         at 0.5 to 0.7 √density, where there is little power.\n",
    );
    for one in statistics[1..].iter().filter(|one| !one.is_tiled) {
        _ = writeln!(text, "\nLeaves of {} need a larger pattern than this plane: not tiled.", one.sampler.name());
    }
    text
}

fn bias(effort: &Effort, statistics: &[Statistics]) -> String {
    let mut text = format!(
        "## Bias\n\n\
         Sets of about {} samples on the unit torus, {} of each kind, with the same r. The density of an unbiased maximal \
         set is N·r² = {MAXIMAL_DENSITY:.5} (the jamming limit of random sequential placement, 0.5470735 · 4/π; ± is the \
         standard error of the mean). *Contrast* is the variance of a set's periodogram over its squared mean, in annuli \
         of {ANNULUS}, averaged over all frequencies from {} to {}: 1 without order over long distances, more where parts \
         repeat. It is the mean of all sets, with their range. Of the mean spectrum of all sets: how far its radial mean is \
         from the reference's at most (the first ring has a power of about 1.75), and its anisotropy over the same \
         frequencies ({:.1} dB without any).\n\n\
         | leaves | N·r² | over unbiased | contrast | radial mean | anisotropy |\n|---|---|---|---|---|---|\n",
        grouped(effort.count as usize),
        GROUPS * effort.sets_per_group,
        CONTRAST_RANGE.start,
        CONTRAST_RANGE.end,
        decibels(1.0 / (GROUPS * effort.sets_per_group) as f64),
    );
    for one in statistics {
        let Statistics { density, contrast, .. } = one;
        _ = writeln!(
            text,
            "| {} | {:.5} ± {:.5} | {:+.2} % | {:.4} ({:.4} to {:.4}) | {:.3} | {:.2} dB |",
            name(one),
            density.mean,
            density.error,
            excess(density.mean),
            contrast.mean,
            contrast.low,
            contrast.high,
            one.difference,
            decibels(one.anisotropy),
        );
    }
    _ = write!(
        text,
        "\n*Peaks* are the largest power on the axes, where seams are, and on the harmonics of what is regular: the fill \
         blocks, at most 4.8 r wide before jitter, and the cells, at most r/√2. Of the mean spectrum of {} sets; the mean of {GROUPS} such \
         groups, with their range.\n",
        effort.sets_per_group,
    );
    for (what, figure) in PEAKS {
        _ = write!(text, "\n| {what}, leaves | axes | fill blocks | cells |\n|---|---|---|---|\n");
        for one in statistics {
            let cell = |Summary { mean, low, high, .. }: &Summary| format!("{mean:.2} ({low:.2} to {high:.2})");
            let [axes, blocks, cells] = one.peaks.each_ref().map(|peak| cell(figure(peak)));
            _ = writeln!(text, "| {} | {axes} | {blocks} | {cells} |", name(one));
        }
    }
    text
}

fn name(one: &Statistics) -> String {
    let is_as_asked = one.sampler == Sampler::Maximal || one.is_tiled;
    one.sampler.name() + if is_as_asked { "" } else { " (not tiled)" }
}

fn spectra(statistics: &[Statistics], times: &Times) -> String {
    let mut text = format!(
        "## Spectra and rates (thesis fig. 2.15 to 2.19)\n\n\
         Million samples per second, for sets of about {}; the pattern is made anew in each call. The thesis's machine was \
         a Core i7-4930K of 2013 with a GTX 1080, and its reference ran on that GPU.\n\n\
         | leaves | thesis, CPU | thesis, GPU | one thread | {} threads |\n|---|---|---|---|---|\n\
         | reference | | 4.3 | {:.2} | |\n",
        grouped(times.reference[0] as usize),
        times.threads,
        times.reference[0] / times.reference[1] / 1e6,
    );
    for (leaf, [_, cpu, gpu]) in times.leaves.iter().zip(THESIS) {
        let [one, all] = leaf.rates.map(|rate| rounded(rate / 1e6, 3));
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
    for (row, [samples, _]) in times.leaves[0].one_thread.iter().enumerate() {
        _ = write!(text, "| {}", grouped(*samples as usize));
        times.leaves.iter().for_each(|leaf| _ = write!(text, " | {}", rounded(1e3 * leaf.one_thread[row][1], 3)));
        text.push_str(" |\n");
    }
    text + "\n![Time against samples](kdrt/times.png)\n"
}

fn time_by_stage(times: &Times) -> String {
    let samples = times.leaves.iter().map(|leaf| leaf.stages.samples).max().unwrap_or(0);
    let mut text = format!(
        "## Time by stage (thesis fig. 2.13)\n\n\
         Nanoseconds per sample on one thread, for sets of about {}. In the thesis elimination and the first insertion take \
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
