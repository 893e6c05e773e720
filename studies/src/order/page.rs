//! The page, in Markdown.

use std::fmt::Write;

use super::prefixes::{Direct, Prefixes, part_counts};
use super::surfaces::{self, Exact, Surface};
use super::times::Times;
use super::{Effort, QUOTIENTS, Results};
use crate::blue::Blue;
use crate::verdict::verdict;
use azulejo_cli::summary::Summary;
use azulejo_cli::text::{grouped, rounded};

/// The excess of the covering radius over its bound that is rounding: float spacings.
const ROUNDING: f64 = 1e-4;

/// Samples per second in the plane, and times as long as a plain set on a mesh: both of the default quotient and the
/// largest sets.
const RATE_GOAL: f64 = 1e6;
const MESH_GOAL: f64 = 4.0;

/// The anisotropy of isotropic sets, as many as are measured here, is within this.
const ISOTROPIC: f64 = 0.5;

/// Why windows have the quotient of all others, where the project once planned another.
const WINDOWS: &str = "## The quotient of windows\n\nWindows of kept planes have the same quotient by default as whole sets, 2^(1/8), not \
    2^(1/4), with which they would be faster (*Times*): with defaults that differ a window would not be a part of the whole \
    set that the same options give ([why](design/rejected.md#plane)). Who wants speed sets the quotient for both.\n";

/// The text of the page.
pub fn text(effort: &Effort, results: &Results) -> String {
    let parts = [
        introduction(effort),
        goals(results),
        distances(results),
        on_mesh(effort, &results.surface),
        WINDOWS.to_owned(),
        spectra(effort, &results.prefixes, &results.direct),
        times(effort, results),
        "## A set\n\n![Prefixes of a set, quotient 2^(1/8)](order/prefixes.png)\n".to_owned(),
    ];
    parts.join("\n")
}

fn introduction(effort: &Effort) -> String {
    format!(
        "A progressive set is made of nested levels; the radius of each is a *quotient* times that of the next, but about two \
         times for the first 100 samples. Any of its prefixes is a well-spread set as well. Sets of about {} samples on the \
         unit torus, {} of each quotient; *direct* sets were made with the number of the prefix (`kdrt::sample_count`).\n",
        grouped(effort.count as usize),
        effort.sets,
    )
}

fn goals(results: &Results) -> String {
    let mut text = "## Goals\n\n| goal | found | |\n|---|---|---|\n".to_owned();
    for one in &results.prefixes {
        let (name, quotient, worst) = (one.quotient.name, one.quotient.value, one.ratio.high);
        let is_met = worst <= quotient * (1.0 + ROUNDING);
        _ = writeln!(
            text,
            "| quotient {name}: covering radius / smallest distance at most {quotient:.4} in all prefixes below, up to {ROUNDING} of it for rounding \
             | {worst:.4} | {} |",
            verdict(is_met)
        );
    }
    text += &goals_on_mesh(&results.surface);
    for one in &results.prefixes {
        let worst = one.blue.iter().map(|blue| blue.anisotropy.abs()).fold(0.0, f64::max);
        _ = writeln!(
            text,
            "| quotient {}: anisotropy of the prefixes below within {ISOTROPIC} dB | {worst:.1} dB | {} |",
            one.quotient.name,
            verdict(worst <= ISOTROPIC)
        );
    }
    let name = QUOTIENTS[0].name;
    if let Some(times) = results.plane.last() {
        let rate = 1.0 / times.ordered[0].per_sample();
        let (goal, found, count) = (rounded(RATE_GOAL / 1e6, 3), rounded(rate / 1e6, 3), grouped(times.count as usize));
        let is_met = verdict(rate >= RATE_GOAL);
        _ = writeln!(
            text,
            "| plane, {count} samples, quotient {name}: {goal} million per second | {found} | {is_met} |"
        );
    }
    let (mesh, times) = &results.mesh;
    if let Some(times) = times.last() {
        let (found, count) = (times.ratio(0), grouped(times.count as usize));
        let is_met = verdict(found <= MESH_GOAL);
        _ = writeln!(
            text,
            "| {mesh}, {count} samples, quotient {name}: at most {MESH_GOAL} × the time per sample of a plain set | {found:.2} × | {is_met} |"
        );
    }
    text
}

/// Prefixes on the mesh, and sets of exactly so many samples there.
fn goals_on_mesh(Surface { mesh, prefixes, exact }: &Surface) -> String {
    let mut text = String::new();
    for one in prefixes {
        let (name, quotient, worst) = (one.quotient.name, one.quotient.value, one.ratio.high);
        _ = writeln!(
            text,
            "| {mesh}, quotient {name}: covering radius / smallest distance at most {quotient:.4} in all prefixes below, up to {ROUNDING} of \
             it for rounding | {worst:.4} | {} |",
            verdict(worst <= quotient * (1.0 + ROUNDING))
        );
    }
    let [right, sets] = [exact.iter().map(|one| one.right).sum::<usize>(), exact.iter().map(|one| one.sets).sum()];
    _ = writeln!(text, "| {mesh}, sets of exactly N samples have N | {right} of {sets} | {} |", verdict(right == sets));
    let beyond = exact.iter().map(|one| one.beyond).fold(f64::NEG_INFINITY, f64::max);
    _ = writeln!(
        text,
        "| {mesh}, the same: covering radius at most the bound in the report, up to {ROUNDING} of it for rounding | {:.4} of \
         it | {} |",
        1.0 + beyond,
        verdict(beyond <= ROUNDING)
    );
    text
}

fn on_mesh(effort: &Effort, Surface { mesh, prefixes, exact }: &Surface) -> String {
    let mut text = format!(
        "## On a mesh\n\nThe same of sets of about {} samples on the {mesh}, {} of each quotient, over {} prefixes of each set. \
         Distances are straight ones through space; d_max is that of a plane of the mesh's area.\n\n\
         | quotient | N·r² / area | ratio, largest | ratio, mean | ρ, least | ρ, mean |\n|---|---|---|---|---|---|\n",
        grouped(effort.count as usize),
        effort.sets,
        surfaces::PREFIXES,
    );
    for one in prefixes {
        let [high, mean, low, rho] =
            [one.ratio.high, one.ratio.mean, one.rho.low, one.rho.mean].map(|x| format!("{x:.3}"));
        _ = writeln!(text, "| {} | {:.3} | {high} | {mean} | {low} | {rho} |", one.quotient.name, one.density);
    }
    _ = write!(
        text,
        "\nSets of exactly N samples, {} of each N. What they lose of maximality is the ratio above 1; *bound* is that of the \
         covering radius in the report, over the radius there.\n\n\
         | N | sets with N | ratio, largest | ratio, mean | bound, largest | bound, mean | ρ, least | ρ, mean |\n\
         |---|---|---|---|---|---|---|---|\n",
        effort.sets,
    );
    for Exact { count, right, rho, ratio, bound, .. } in exact {
        let cells = [ratio.high, ratio.mean, bound.high, bound.mean, rho.low, rho.mean].map(|x| format!("{x:.3}"));
        _ = writeln!(text, "| {} | {right} | {} |", grouped(*count), cells.join(" | "));
    }
    text
}

fn distances(results: &Results) -> String {
    let mut text = "## Distances\n\nOver 50 prefixes of each set, from 100 samples on, evenly on a logarithmic scale. *Ratio* is the \
        covering radius over the smallest distance, *ρ* the smallest distance in units of the hexagonal one. N·r² is that of \
        the whole set.\n\n| quotient | N·r² | ratio, largest | ratio, mean | ρ, least | ρ, mean |\n|---|---|---|---|---|---|\n"
        .to_owned();
    let row = |name: &str, density: &str, ratio: &Summary, rho: &Summary| {
        let [high, mean, low, rho] = [ratio.high, ratio.mean, rho.low, rho.mean].map(|x| format!("{x:.3}"));
        format!("| {name} | {density} | {high} | {mean} | {low} | {rho} |\n")
    };
    for one in &results.prefixes {
        text.push_str(&row(one.quotient.name, &format!("{:.3}", one.density), &one.ratio, &one.rho));
    }
    let Direct { ratio, rho, .. } = &results.direct;
    text + &row("direct", "-", ratio, rho)
}

fn spectra(effort: &Effort, prefixes: &[Prefixes], direct: &Direct) -> String {
    let mut text = "## Spectra of prefixes\n\n*P* is the mean power below ¼ √density, 1 in random sets; of the mean spectrum: *ν* the \
        effective Nyquist frequency in units of √density (Heck et al. 2013), *anisotropy* in decibels over that of \
        isotropic sets, from 0.5 to 2 √density, *from direct* the largest difference from the radial power of the direct sets.\n\n\
        | samples | quotient | ρ | P | ν | anisotropy | from direct |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    for (part, count) in part_counts(effort).into_iter().enumerate() {
        let reference = &direct.blue[part];
        let ordered = prefixes.iter().map(|one| (one.quotient.name, &one.blue[part]));
        for (name, blue) in [("direct", reference)].into_iter().chain(ordered) {
            let Blue { rho, low_power, nyquist, anisotropy, .. } = blue;
            let nyquist = nyquist.map_or("-".to_owned(), |nyquist| format!("{nyquist:.3}"));
            let difference = blue.difference(reference);
            _ = writeln!(
                text,
                "| {} | {name} | {rho:.3} | {low_power:.3} | {nyquist} | {anisotropy:+.1} dB | {difference:.2} |",
                grouped(count),
            );
        }
    }
    text + "\n![Radial power of prefixes over that of direct sets](order/spectra.png)\n"
}

fn times(effort: &Effort, results: &Results) -> String {
    let quotients = QUOTIENTS.map(|quotient| quotient.name).join(" | ");
    let mut text = format!(
        "## Times\n\nNanoseconds per sample on one thread, the least of {} rounds in which all are made in turn, and how many times as \
         long as a plain set. *Window* is a window of about {} samples in a kept plane of {}, whose coarsest level reaches over the \
         plane.\n\n| | samples | plain | {quotients} |\n|---|---|---|---|---|---|\n",
        effort.rounds,
        grouped(effort.window as usize),
        grouped(effort.plane as usize),
    );
    let (mesh, on_mesh) = &results.mesh;
    let plane = results.plane.iter().map(|times| ("plane", times));
    let all = plane.chain(on_mesh.iter().map(|times| (*mesh, times))).chain([("window", &results.window)]);
    for (place, times) in all {
        let nanoseconds = |seconds: f64| rounded(1e9 * seconds, 3);
        let ordered =
            |i: usize| format!("{} ({} ×)", nanoseconds(times.ordered[i].per_sample()), rounded(times.ratio(i), 3));
        let cells: Vec<_> = (0..QUOTIENTS.len()).map(ordered).collect();
        let plain = nanoseconds(times.plain.per_sample());
        _ = writeln!(text, "| {place} | {} | {plain} | {} |", grouped(times.plain.samples), cells.join(" | "));
    }
    let Times { plain, ordered, .. } = &results.window;
    let milliseconds = |seconds: f64| rounded(1e3 * seconds, 3);
    let ordered = ordered.iter().zip(QUOTIENTS);
    let ordered: Vec<_> =
        ordered.map(|(timed, q)| format!("{} ms with {}", milliseconds(timed.seconds), q.name)).collect();
    _ = writeln!(text, "\nThe window takes {} ms in any order, {}.", milliseconds(plain.seconds), ordered.join(", "));
    text
}
