//! The page of the report, in Markdown.

use std::fmt::Write;

use azulejo::dcr::Neighbourhood;

use super::Effort;
use super::bounded;
use super::measured::Measured;
use super::sets::{FIRST_SEED, METHODS};
use crate::verdict::verdict;
use azulejo_cli::quality::Quality;
use azulejo_cli::summary::Summary;
use azulejo_cli::text::{grouped, rounded};

/// A figure, and whether a higher or a lower value is better for a set with even distances and no more order than they
/// need.
struct Figure {
    name: &'static str,
    of: fn(&Quality) -> f64,
    /// Push-pull's.
    push_pull: f64,
    higher_is_better: bool,
}

/// The figures in which methods are compared, but for the mean distance, which is not known of the others. Push-pull's
/// are from experiments that were made before this library.
const FIGURES: [Figure; 6] = [
    Figure { name: "ρ", of: |set| set.rho, push_pull: 0.850, higher_is_better: true },
    Figure { name: "cover", of: |set| set.cover, push_pull: 0.670, higher_is_better: false },
    Figure { name: "ψ6", of: |set| set.order, push_pull: 0.475, higher_is_better: false },
    Figure { name: "P", of: |set| set.low_power, push_pull: 0.0022, higher_is_better: false },
    Figure { name: "obtuse", of: |set| set.obtuse, push_pull: 0.059, higher_is_better: false },
    Figure { name: "edge CV²", of: |set| set.edge_variation, push_pull: 0.019, higher_is_better: false },
];

/// The text of the page.
pub fn text(effort: &Effort, measured: &[Measured], bounded: &[bounded::Measured]) -> String {
    let introduction = format!(
        "Thesis: Wang 2019, chapter 4. Sets of the unit torus, and under *Bounded* of the unit square with a boundary, from seed {FIRST_SEED} on; no \
         setting was chosen by what these seeds gave. Figures are means over the sets of a size. Seconds are those of one call, on a machine that may \
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
        goals(measured),
        others(),
        METHODS.map(|method| section(method.name, effort, measured)).join("\n"),
        boundaries(effort, bounded),
    ];
    parts.join("\n")
}

/// Against push-pull, figure by figure.
fn goals(measured: &[Measured]) -> String {
    let mut text = "## Goal\n\n\
        The momentum method with Delaunay neighbours shall be better than push-pull in every figure. Small sets scatter: in a \
        first run the first 8 sets of 1,000 points from KDRT, in place of 64, had 6.2 % obtuse triangles, which is worse than \
        push-pull. The numbers of small sets were raised after that was seen; no set was left out.\n\n\
        | points | start | push-pull is better in | |\n|---|---|---|---|\n"
        .to_owned();
    let is_judged = |one: &&Measured| !one.method.is_thesis && one.method.neighbourhood == Neighbourhood::Delaunay;
    for one in measured.iter().filter(is_judged) {
        let worse: Vec<_> = FIGURES.iter().filter_map(|figure| figure.lost_by(one)).collect();
        let list = if worse.is_empty() { "nothing".to_owned() } else { worse.join(", ") };
        _ = writeln!(
            text,
            "| {} | {} | {list} | {} |",
            grouped(one.count),
            one.start.name(),
            verdict(worse.is_empty())
        );
    }
    text
}

impl Figure {
    /// Name, mean and standard error where push-pull is better.
    fn lost_by(&self, one: &Measured) -> Option<String> {
        let Summary { mean, error, .. } = one.summary(self.of);
        let is_worse = if self.higher_is_better { mean < self.push_pull } else { mean > self.push_pull };
        let error = if one.sets.len() > 1 { format!(" ± {}", rounded(error, 1)) } else { String::new() };
        is_worse.then(|| format!("{}: {}{error}, not {}", self.name, rounded(mean, 3), self.push_pull))
    }
}

/// The table of others' methods, which this command does not run.
fn others() -> String {
    let [rho, cover, order, power, obtuse, edges] = FIGURES.map(|figure| figure.push_pull);
    format!(
        "## Others\n\n\
         Not measured by this command but in experiments made before this library; BNOT on sets of 1,000 to 4,096 points.\n\n\
         | method | ρ | cover | ψ6 | P | obtuse | edge CV² |\n|---|---|---|---|---|---|---|\n\
         | push-pull (Ahmed et al. 2016) | {rho} | {cover} | {order} | {power} | {:.1} % | {edges} |\n\
         | BNOT (de Goes et al. 2012) | 0.74 | 0.76 | 0.51 | 0.00008 | 6 % | 0.017 |\n",
        100.0 * obtuse,
    )
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
        let mean = |figure: fn(&Quality) -> f64| one.summary(figure).mean;
        _ = writeln!(
            text,
            "| {} | {} | {} | {:.3} | {:.3} | {:.3} | {:.3} | {:.3} | {:.1e} | {:.1} % | {:.4} | {:.0} | {} |",
            grouped(one.count),
            one.sets.len(),
            one.start.name(),
            mean(|set| set.rho),
            one.summary(|set| set.rho).low,
            mean(|set| set.mean_distance),
            mean(|set| set.cover),
            mean(|set| set.order),
            mean(|set| set.low_power),
            100.0 * mean(|set| set.obtuse),
            mean(|set| set.edge_variation),
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

/// What sets are like along a boundary.
fn boundaries(effort: &Effort, measured: &[bounded::Measured]) -> String {
    let mut text = format!(
        "## Bounded\n\n\
         Sets of the unit square with a boundary, by the momentum method, and maximal sets as KDRT makes them. *On boundary* is the \
         largest distance of a place on the boundary from the set. Densities are those within 1 to 4 d_max of the boundary, over \
         that of the inside, which begins at {} d_max; *spacing* is the mean distance to the nearest neighbour within 1 d_max \
         of the boundary over that inside. A boundary puts points in rows, the first at a depth of about 0.2 d_max, the second at \
         1.1: within 1 d_max there is but one of them.\n\n\
         | method | points | sets | start | ρ | least | cover | largest | on boundary | to 1 | to 2 | to 3 | to 4 | spacing |\n{}|\n",
        bounded::STRIPS,
        "|---".repeat(14),
    );
    for one in measured {
        let mean = |figure: fn(&bounded::Quality) -> f64| one.summary(figure).mean;
        let densities: Vec<_> =
            (0..bounded::STRIPS).map(|strip| format!("{:.3}", one.summary(|set| set.densities[strip]).mean)).collect();
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.3} | {:.3} | {:.3} | {:.3} | {:.3} | {} | {:.3} |",
            one.name(),
            grouped(one.count),
            one.sets.len(),
            one.start.name(),
            mean(|set| set.rho),
            one.summary(|set| set.rho).low,
            mean(|set| set.cover),
            one.summary(|set| set.cover).high,
            mean(|set| set.boundary_cover),
            densities.join(" | "),
            mean(|set| set.spacing),
        );
    }
    let pictured = grouped(effort.pictured);
    _ = writeln!(text, "\n![A corner of the square, of sets of {pictured} points from KDRT](dcr/corners.png)");
    text
}
