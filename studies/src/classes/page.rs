//! The page, in Markdown.

use std::fmt::Write;

use super::mixes::{FACTORS, density};
use super::relaxed::{Figures, Relaxed, Set};
use super::sets::{Maker, Measured, Tie, ends};
use super::times::{PLANE, Times, WINDOW_GOAL, Windows};
use super::{Effort, Results};
use crate::repeated::cell;
use crate::timing::Rounds;
use azulejo_cli::text::grouped;

/// The text of the page.
pub fn text(effort: &Effort, results: &Results, has_dragon: bool) -> String {
    let parts = [
        introduction(effort),
        goals(effort, results),
        shares(&results.sets),
        ties(&results.ties),
        spectra(&results.sets),
        beside_wei(&results.sets),
        relaxed(&results.relaxed),
        times(effort, results),
        pictures(has_dragon),
    ];
    parts.join("\n")
}

fn introduction(effort: &Effort) -> String {
    format!(
        "Source: Wei 2010, \"Multi-class blue noise sampling\". Sets of several classes on the unit torus, {} of each kind, in \
         which the class of the smallest own radius would alone have about {} samples. Own radii are in units of the largest; \
         *by √½* are radii each of which is √½ of the one before. The distance between two classes is Wei's, times a \
         *factor*. A *share* is the number of samples of a class over that of a set of this class alone. A range is that of \
         the classes of a set.\n",
        effort.sets,
        grouped(effort.count as usize),
    )
}

fn goals(effort: &Effort, results: &Results) -> String {
    let mut text = format!(
        "## Goals\n\nHow many times as long a sample takes as one of a single class of the smallest own radius, in the same run, on \
         one thread; Wei's cross radii. The median of {} rounds, with their range: a goal is met where every round meets it, \
         not met where none does, and otherwise not decided.\n\n| goal | found |\n|---|---|\n",
        effort.rounds
    );
    let mut ratio = |what: &str, times: &[Times], one: fn(&Times) -> Option<&Rounds>| {
        for times in times {
            let Some(one) = one(times) else { continue };
            let found = times.classes.per_sample().over(&one.per_sample());
            let (name, goal) = (times.mix.name, times.goal);
            let verdict = found.verdict(|found| found <= goal);
            _ = writeln!(text, "| {what}, own radii {name}; goal: at most {goal} | {}, {verdict} |", cell(&found, 3));
        }
    };
    ratio("plane, against filling one class", &results.plane, |times| times.filled.as_ref());
    ratio("plane, against tiling one class", &results.plane, |times| Some(&times.one));
    if let Some(bunny) = &results.bunny {
        ratio("bunny", bunny, |times| Some(&times.one));
    }
    let Windows { samples, milliseconds } = &results.windows;
    _ = writeln!(
        text,
        "| ms of a window of {} samples of three classes in a kept plane; goal: at most {WINDOW_GOAL} | {}, {} |",
        grouped(samples.round() as usize),
        cell(milliseconds, 3),
        milliseconds.verdict(|milliseconds| milliseconds <= WINDOW_GOAL),
    );
    text
}

/// The sets of the library.
fn own(sets: &[Measured]) -> impl Iterator<Item = (&Measured, f64)> {
    sets.iter().filter_map(|one| match one.maker {
        Maker::Azulejo(factor) => Some((one, factor)),
        Maker::Wei => None,
    })
}

fn shares(sets: &[Measured]) -> String {
    let mut text = "## Shares\n\nThe share of each class, from the largest own radius to the smallest. *All* is the number of all \
        samples over that of a maximal set whose radius is the smallest distance that two samples may have.\n\n\
        | own radii | factor | shares | all |\n|---|---|---|---|\n"
        .to_owned();
    for (one, factor) in own(sets) {
        _ = writeln!(text, "| {} | {factor} | {} | {:.2} |", one.mix.name, listed(&one.shares), all(one));
    }
    text
}

fn listed(shares: &[f64]) -> String {
    shares.iter().map(|share| format!("{share:.2}")).collect::<Vec<_>>().join(" / ")
}

/// The number of all samples over that of a maximal set of the smallest distance.
fn all(one: &Measured) -> f64 {
    let smallest = one.classes.radii().iter().copied().fold(f64::INFINITY, f64::min);
    one.union.count() / density(smallest)
}

fn ties(ties: &[Tie]) -> String {
    let mut text = "## Where radii become equal\n\nClasses of equal own radii are filled together, others one after the other: so \
        shares jump there. Two classes, factor 1.\n\n| own radii | shares |\n|---|---|\n"
        .to_owned();
    for tie in ties {
        _ = writeln!(text, "| 1 and {} | {} |", tie.second, listed(&tie.shares));
    }
    text + "\n![Shares of two classes against the radius of the second](classes/ties.png)\n"
}

const COLUMNS: &str =
    "ρ, classes | ρ, all | P, classes | P, all | ν, classes | ν, all | anisotropy, classes | anisotropy, all";

fn spectra(sets: &[Measured]) -> String {
    let mut text = format!(
        "## Spectra\n\n*ρ* is the smallest distance in units of the hexagonal one, *P* the mean power below ¼ √density, 1 in random \
         sets; of the mean spectrum: *ν* the effective Nyquist frequency in units of √density (Heck et al. 2013), - where there is none, *anisotropy* \
         in decibels over that of isotropic sets, from 0.5 to 2 √density. Frequencies of a class are in units of the root of its own \
         density.\n\n| own radii | factor | {COLUMNS} |\n{}|\n",
        "|---".repeat(10)
    );
    for (one, factor) in own(sets) {
        _ = writeln!(text, "| {} | {factor} | {} |", one.mix.name, figures(one));
    }
    text + "\n![Radial power of the classes and of all samples, factor 1](classes/spectra.png)\n"
}

/// The columns of a set.
fn figures(one: &Measured) -> String {
    let pair = |[low, high]: [f64; 2], all: f64, number: fn(f64) -> String| {
        let classes =
            if number(low) == number(high) { number(low) } else { format!("{} to {}", number(low), number(high)) };
        format!("{classes} | {}", number(all))
    };
    // Below all others where a spectrum has none.
    let nyquist = |blue: &crate::blue::Blue| blue.nyquist.unwrap_or(f64::NEG_INFINITY);
    [
        pair(one.range(|blue| blue.rho), one.union.rho, |x| format!("{x:.3}")),
        pair(one.range(|blue| blue.low_power), one.union.low_power, |x| format!("{x:.3}")),
        pair(
            one.range(nyquist),
            nyquist(&one.union),
            |x| {
                if x.is_finite() { format!("{x:.2}") } else { "-".to_owned() }
            },
        ),
        pair(one.range(|blue| blue.anisotropy), one.union.anisotropy, |x| format!("{x:+.1}")),
    ]
    .join(" | ")
}

fn relaxed(sets: &[Relaxed]) -> String {
    let mut text = "## Relaxed\n\nThe same sets (factor 1) relaxed with classes (`dcr::relax_classes`): the smallest distance *ρ* and the \
        covering radius in units of the hexagonal distance, of all samples and of each class by itself. *As one*: all samples \
        relaxed without regard to classes, which is the limit for *all*.\n\n\
        | own radii | ρ, all | cover, all | ρ, classes | cover, classes | as one |\n|---|---|---|---|---|---|\n"
        .to_owned();
    let change = |before: f64, after: f64| format!("{before:.3} → {after:.3}");
    let (mut better, mut closer) = (0, 0);
    for Relaxed { mix, before, after, alone } in sets {
        let of_classes = |value: fn(&Figures) -> f64| {
            let [before, after] = [before, after].map(|set| set.range(value));
            format!("{:.3} to {:.3} → {:.3} to {:.3}", before[0], before[1], after[0], after[1])
        };
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.3}, {:.3} |",
            mix.name,
            change(before.union.rho, after.union.rho),
            change(before.union.covering_radius, after.union.covering_radius),
            of_classes(|figures| figures.rho),
            of_classes(|figures| figures.covering_radius),
            alone.rho,
            alone.covering_radius,
        );
        let worst = |set: &Set| set.range(|figures| figures.covering_radius)[1].max(set.union.covering_radius);
        let nearest = |set: &Set| set.range(|figures| figures.rho)[0].min(set.union.rho);
        better += usize::from(worst(after) < worst(before));
        closer += usize::from(nearest(after) < nearest(before));
    }
    _ = writeln!(
        text,
        "\nThe largest of the covering radii falls in {better} of {0} mixes; the smallest of the values of ρ falls in {closer} of {0}.",
        sets.len()
    );
    text
}

fn beside_wei(sets: &[Measured]) -> String {
    let mut text = format!(
        "## Beside Wei's sets\n\nWei shows spectra as pictures; this page quotes no number of his, as none was at hand. Instead his \
         multi-class dart throwing was written anew from the description in the paper (`studies/src/classes/wei.rs`) and is run \
         here, with his cross radii, on the same own radii. Its darts end after a hundred for each sample that the classes would \
         have alone, and its sets are not maximal. It fills all classes evenly; azulejo takes the largest radii first. In the \
         first row of each pair is azulejo with factor 1.\n\n| own radii | | shares | all | {COLUMNS} |\n{}|\n",
        "|---".repeat(12)
    );
    let is_beside = |one: &&Measured| one.maker == Maker::Wei || one.maker == Maker::Azulejo(FACTORS[0]);
    for one in sets.iter().filter(is_beside) {
        let maker = if one.maker == Maker::Wei { "Wei" } else { "azulejo" };
        let (name, shares, all) = (one.mix.name, listed(&one.shares), all(one));
        _ = writeln!(text, "| {name} | {maker} | {shares} | {all:.2} | {} |", figures(one));
    }
    let pairs = || sets.iter().filter(is_beside).collect::<Vec<_>>();
    let compared = |what: &str, value: fn(&Measured) -> f64, higher: bool| {
        let pairs = pairs();
        let better = pairs.chunks_exact(2).filter(|pair| (value(pair[0]) > value(pair[1])) == higher);
        format!("* {what} in {} of {} mixes.\n", better.count(), pairs.len() / 2)
    };
    text.push_str("\nOf the two, azulejo has\n\n");
    text.push_str(&compared("more samples in all", |one| one.union.count(), true));
    text.push_str(&compared("the larger smallest share", |one| ends(one.shares.iter().copied())[0], true));
    text.push_str(&compared("less power of all samples below ¼ √density", |one| one.union.low_power, false));
    text.push_str(&compared("less power of its worst class there", |one| one.range(|blue| blue.low_power)[1], false));
    text
}

fn times(effort: &Effort, results: &Results) -> String {
    let mut text = format!(
        "## Times\n\nNanoseconds per sample on one thread, medians of {} rounds in which all are made in turn, with their range; the smallest class \
         alone would have about {} samples. *Tiled* is a plain set of KDRT, *filled* a set of the flat quadtree, both of the \
         smallest own radius.\n\n| | own radii | samples | classes | one, tiled | one, filled |\n|---|---|---|---|---|---|\n",
        effort.rounds,
        grouped(effort.timed as usize),
    );
    let nanoseconds = |timed: &Rounds| cell(&timed.per_sample().map(|seconds| 1e9 * seconds), 3);
    let bunny = results.bunny.iter().flatten().map(|times| ("bunny", times));
    for (place, times) in results.plane.iter().map(|times| ("plane", times)).chain(bunny) {
        let one = nanoseconds(&times.one);
        let [tiled, filled] = match &times.filled {
            Some(filled) => [one, nanoseconds(filled)],
            None => ["-".to_owned(), one],
        };
        _ = writeln!(
            text,
            "| {place} | {} | {} | {} | {tiled} | {filled} |",
            times.mix.name,
            grouped(times.classes.samples),
            nanoseconds(&times.classes),
        );
    }
    if results.bunny.is_none() {
        text.push_str("\nThe bunny is left out: it was not given (`--bunny`).\n");
    }
    let Windows { samples, milliseconds } = &results.windows;
    _ = writeln!(
        text,
        "\nWindows of {} samples of the classes 1, ½, ¼ in a kept plane of about {} take {} ms, the mean of {} places.",
        grouped(samples.round() as usize),
        grouped(PLANE as usize),
        cell(milliseconds, 3),
        effort.windows,
    );
    text
}

fn pictures(has_dragon: bool) -> String {
    let mut text = "## Pictures\n\nOwn radii 1, ½, ¼; the largest class in cobalt, then ochre and green.\n\n\
        ![Three classes in the plane](classes/plane.png)\n\n"
        .to_owned();
    text.push_str(
        "Balls in black, cyan, magenta and yellow dots (`azulejo stipple --cmyk`): the density of each ink is that of the image, and \
         each is filled around the dots of those before it.\n\n![Balls in dots of four inks](classes/inks.png)\n\n",
    );
    text.push_str(match has_dragon {
        true => "![Three classes on the dragon](classes/dragon.png)\n",
        false => "The dragon is left out: it was not given (`--dragon`).\n",
    });
    text
}
