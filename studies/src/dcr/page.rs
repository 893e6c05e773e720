//! The page of the report, in Markdown.

use std::fmt::Write;

use azulejo::dcr::Neighbourhood;

use super::Effort;
use super::bounded;
use super::measured::Measured;
use super::others;
use super::sets::{FIRST_SEED, METHODS};
use crate::verdict::{self, Difference, LEVEL, Mean, chance};
use azulejo_cli::quality::Quality;
use azulejo_cli::text::{grouped, rounded};

/// A figure, and whether a higher or a lower value is better for a set with even distances and no more order than they
/// need.
struct Figure {
    name: &'static str,
    of: fn(&Quality) -> f64,
    higher_is_better: bool,
}

/// The figures in which methods are compared.
const FIGURES: [Figure; 6] = [
    Figure { name: "ρ", of: |set| set.rho, higher_is_better: true },
    Figure { name: "cover", of: |set| set.cover, higher_is_better: false },
    Figure { name: "ψ6", of: |set| set.order, higher_is_better: false },
    Figure { name: "P", of: |set| set.low_power, higher_is_better: false },
    Figure { name: "obtuse", of: |set| set.obtuse, higher_is_better: false },
    Figure { name: "edge CV²", of: |set| set.edge_variation, higher_is_better: false },
];

/// The text of the page.
pub fn text(
    effort: &Effort,
    measured: &[Measured],
    others: &[others::Measured],
    bounded: &[bounded::Measured],
) -> String {
    let introduction = format!(
        "Thesis: Wang 2019, chapter 4. Sets of the unit torus, and under *Bounded* of the unit square with a boundary, from seed {FIRST_SEED} on; no \
         setting was chosen by what these seeds gave. Figures are means over the sets of a size, ± their standard error, which of a single set is not known. Seconds are those of one call, on a machine that may \
         have had other work.\n\n\
         Lengths are in units of d_max = √(2 A / (√3 N)), the distance of neighbours in the hexagonal arrangement. *ρ* is the \
         smallest distance of a set, *least* the smallest in any of the sets; *nearest* is the mean distance to the nearest \
         neighbour; *cover* the largest distance of a place from the set. *ψ6* is the bond order of the Delaunay \
         neighbours: 1 in a hexagonal lattice, 0.36 in random sets. *P* is the mean power below ¼ √density, 1 in \
         random sets. *Obtuse* is the share of obtuse triangles; *edge CV²* the variance of the edge lengths over their \
         squared mean.\n",
    );
    let parts = [
        introduction,
        goals(measured, others),
        METHODS.map(|method| section(method.name, effort, measured)).join("\n"),
        boundaries(effort, bounded),
    ];
    parts.join("\n")
}

/// Against push-pull, figure by figure.
fn goals(measured: &[Measured], others: &[others::Measured]) -> String {
    let mut comparisons = Vec::new();
    let is_judged = |one: &&Measured| !one.method.is_thesis && one.method.neighbourhood == Neighbourhood::Delaunay;
    for one in measured.iter().filter(is_judged) {
        let is_same = |other: &&others::Measured| {
            other.method == others::Method::PushPull && other.count == one.count && other.start == one.start
        };
        for (other, figure) in others.iter().filter(is_same).flat_map(|other| FIGURES.iter().map(move |it| (other, it)))
        {
            let [own, push_pull] = [figure.of_sets(one), Mean::of(&other.figures(figure.of))];
            let (better, worse) = if figure.higher_is_better { (&own, &push_pull) } else { (&push_pull, &own) };
            let difference = better.above(worse);
            comparisons.push(Comparison { one, figure, own, push_pull, difference });
        }
    }
    let verdicts = verdict::claims(&comparisons.iter().map(|it| it.difference).collect::<Vec<_>>());
    let mut text = format!(
        "## Goal\n\n\
         The momentum method with Delaunay neighbours shall be better than push-pull in every figure, from the same starts; see \
         *Others* for what push-pull aims at. *t* is the difference in favour of the \
         momentum method over its standard error (Welch), *p* the chance of as large a one between methods that do not differ, \
         corrected for all {} comparisons of the table (Holm): the goal is met where p is at most {LEVEL}, not met where that of the opposite is, and otherwise not decided.\n\n\
         | points | start | figure | momentum | sets | push-pull | sets | t | p | |\n{}|\n",
        comparisons.len(),
        "|---".repeat(10),
    );
    for (comparison, (p, verdict)) in comparisons.iter().zip(verdicts) {
        let Comparison { one, figure, own, push_pull, difference } = comparison;
        let cell = |mean: &Mean| format!("{} | {}", mean.cell(4), mean.count);
        let t = difference.map_or("-".to_owned(), |difference| format!("{:+.1}", difference.t));
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {t} | {} | {} |",
            grouped(one.count),
            one.start.name(),
            figure.name,
            cell(own),
            cell(push_pull),
            chance(p),
            verdict,
        );
    }
    let judged: Vec<_> = comparisons.iter().map(|comparison| comparison.one.count).collect();
    let left: Vec<_> =
        measured.iter().filter(is_judged).map(|one| one.count).filter(|it| !judged.contains(it)).collect();
    if let Some(&least) = left.iter().min() {
        _ = writeln!(
            text,
            "\nSets of {} points and more are not judged: push-pull was not run on them.",
            grouped(least)
        );
    }
    text
}

/// A figure of the momentum method's sets and of push-pull's.
struct Comparison<'a> {
    one: &'a Measured,
    figure: &'a Figure,
    own: Mean,
    push_pull: Mean,
    /// By how much the momentum method is better.
    difference: Option<Difference>,
}

impl Figure {
    fn of_sets(&self, one: &Measured) -> Mean {
        Mean::of(&one.sets.iter().map(self.of).collect::<Vec<_>>())
    }
}

fn section(name: &str, effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## {}{}\n\n\
         | points | sets | start | ρ | least | nearest | cover | ψ6 | P | obtuse | edge CV² | steps | seconds |\n{}|\n",
        name[..1].to_uppercase(),
        &name[1..],
        "|---".repeat(13),
    );
    let of_method = || measured.iter().filter(|one| one.method.name == name);
    for one in of_method() {
        let mean = |figure: fn(&Quality) -> f64| Mean::of(&one.sets.iter().map(figure).collect::<Vec<_>>());
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.3} | {} | {} | {} | {} | {} % | {} | {:.0} | {} |",
            grouped(one.count),
            one.sets.len(),
            one.start.name(),
            mean(|set| set.rho).cell(3),
            one.summary(|set| set.rho).low,
            mean(|set| set.mean_distance).cell(3),
            mean(|set| set.cover).cell(3),
            mean(|set| set.order).cell(3),
            mean(|set| set.low_power).cell(2),
            mean(|set| 100.0 * set.obtuse).cell(3),
            mean(|set| set.edge_variation).cell(4),
            one.steps,
            rounded(one.seconds, 2),
        );
    }
    if let Some((count, _)) = effort.momentum.iter().find(|(count, _)| of_method().all(|one| one.count != *count)) {
        _ = writeln!(text, "\nSets of {} points and more are left out: they take too long.", grouped(*count));
    }
    let pictured = grouped(effort.pictured);
    for one in of_method().take(1) {
        _ = writeln!(
            text,
            "\n![{pictured} points, at random before, and their spectrum](dcr/{}.png)",
            one.method.picture()
        );
    }
    text
}

/// The section on sets along a boundary.
fn boundaries(effort: &Effort, measured: &[bounded::Measured]) -> String {
    let mut text = format!(
        "## Bounded\n\n\
         Sets of the unit square with a boundary, by the momentum method, and maximal sets as KDRT makes them. *On boundary* is the \
         largest distance of a place on the boundary from the set. Densities are those within 1 to 4 d_max of the boundary, over \
         that of the inside, which begins at {} d_max; *spacing* is the mean distance to the nearest neighbour within 1 d_max \
         of the boundary over that inside.\n\n\
         | method | points | sets | start | ρ | least | cover | largest | on boundary | to 1 | to 2 | to 3 | to 4 | spacing |\n{}|\n",
        bounded::STRIPS,
        "|---".repeat(14),
    );
    for one in measured {
        let mean = |figure: &dyn Fn(&bounded::Quality) -> f64| {
            Mean::of(&one.sets.iter().map(figure).collect::<Vec<_>>()).cell(3)
        };
        let densities: Vec<_> = (0..bounded::STRIPS).map(|strip| mean(&|set| set.densities[strip])).collect();
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.3} | {} | {:.3} | {} | {} | {} |",
            one.name(),
            grouped(one.count),
            one.sets.len(),
            one.start.name(),
            mean(&|set| set.rho),
            one.summary(|set| set.rho).low,
            mean(&|set| set.cover),
            one.summary(|set| set.cover).high,
            mean(&|set| set.boundary_cover),
            densities.join(" | "),
            mean(&|set| set.spacing),
        );
    }
    let pictured = grouped(effort.pictured);
    _ = writeln!(text, "\n![A corner of the square, of sets of {pictured} points from KDRT](dcr/corners.png)");
    text
}
