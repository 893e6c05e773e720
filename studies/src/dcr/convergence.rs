//! After how many steps the thesis's algorithm converges (thesis §4.4.4, the table beside fig. 4.20).

use std::fmt::Write;

use azulejo::dcr::{Convergence, Distribution, Neighbourhood, Options, Stopped, Thesis, relax};
use azulejo::{Boundary, Context, Domain, Result};

use super::sets::{FIRST_SEED, Start};
use super::study::{Study, thesis_options};
use crate::verdict::{LEVEL, Mean, chance, holm};
use azulejo_cli::summary::Summary;
use azulejo_cli::text::grouped;

/// A row of the thesis's table: iterations with and without activeness.
const THESIS: [(Start, [u32; 2]); 3] =
    [(Start::Kdrt, [132, 146]), (Start::Psp, [157, 158]), (Start::Random, [276, 299])];

/// With activeness and without.
const DISTRIBUTIONS: [Distribution; 2] = [Distribution::Activeness, Distribution::Average];

const TESTS: [Convergence; 2] = [Convergence::Variance, Convergence::Motion];

/// Step sizes and decays that are compared.
const STEPS: [(f64, f64); 5] = [(0.0125, 1.0), (0.025, 1.0), (0.05, 1.0), (0.1, 1.0), (0.1, 0.995)];

/// The section.
pub fn section(study: &Study) -> Result<String> {
    // Many sets for the claims, of fewer points than those whose step sizes are compared.
    let ((count, sets), by_size) = if study.quick { ((1000, 2), (1000, 1)) } else { ((2000, 24), (4096, 3)) };
    Ok(by_start(study, count, sets)? + "\n" + &by_step(study, by_size.0, by_size.1)?)
}

/// The end of a relaxation.
#[derive(Clone, Copy)]
struct End {
    steps: f64,
    rho: f64,
    /// True if the test was met before all steps were made.
    is_met: bool,
}

impl End {
    fn of(context: &Context, options: &Options, points: &[[f32; 2]]) -> Result<Self> {
        let (_, report) = relax(context, options, points, None)?;
        let is_met = report.stopped == Stopped::Converged;
        Ok(Self { steps: report.iterations.into(), rho: report.rho, is_met })
    }
}

/// Steps in the mean and from the fewest to the most, and in how many sets the test was never met.
fn steps(ends: &[End]) -> String {
    let Summary { mean, low, high, .. } = Summary::of(&ends.iter().map(|end| end.steps).collect::<Vec<_>>());
    let unmet = ends.iter().filter(|end| !end.is_met).count();
    let remark = if unmet > 0 { format!("; {unmet} not met") } else { String::new() };
    format!("{mean:.0} ({low:.0} to {high:.0}{remark})")
}

fn mean_rho(ends: &[End]) -> f64 {
    ends.iter().map(|end| end.rho).sum::<f64>() / ends.len() as f64
}

fn by_start(study: &Study, count: usize, sets: usize) -> Result<String> {
    let cases: Vec<_> = THESIS
        .iter()
        .flat_map(|&(start, _)| TESTS.map(|convergence| (start, convergence)))
        .flat_map(|(start, convergence)| DISTRIBUTIONS.map(|distribution| (start, convergence, distribution)))
        .collect();
    let ends = study.each("convergence", cases.len() * sets, |context, i| {
        let (start, convergence, distribution) = cases[i / sets];
        let seed = FIRST_SEED + (i % sets) as u64;
        let domain = Domain::unit(Boundary::Bounded);
        let points = start.points(context, domain, count, seed)?;
        let thesis = Thesis::default().convergence(convergence).distribution(distribution);
        End::of(context, &thesis_options(thesis, Neighbourhood::Delaunay, domain, seed), &points)
    })?;
    let mut text = format!(
        "## Steps to convergence (thesis §4.4.4)\n\n\
         The thesis's algorithm with Delaunay neighbours, radii 0.95 and 1.05, λ = 0.05, on a square that is mirrored by its \
         boundary (fig. 4.12 (b)); {} points, {sets} sets: means, and from the fewest to the most. The thesis does not say how \
         many points it had. Its test asks that the variance of the distances to the nearest point change by less than 0.1 % \
         ten times in a row; the other that points move by no more than 0.02 d_max per unit of λ, which is asked every 40 \
         steps. *ρ* is that of the sets that the thesis's test leaves. PSP's sets are those of 50 iterations, not filled.\n\n\
         | start | thesis: with α | without | its test: with α | without | ρ | ρ | by motion: with α | without |\n{}|\n",
        grouped(count),
        "|---".repeat(9),
    );
    for ((start, [with, without]), ends) in THESIS.iter().zip(ends.chunks(TESTS.len() * DISTRIBUTIONS.len() * sets)) {
        let ends: Vec<_> = ends.chunks(sets).collect();
        let [active, average, active_motion, average_motion] = [0, 1, 2, 3].map(|i| steps(ends[i]));
        let [rho, average_rho] = [0, 1].map(|i| mean_rho(ends[i]));
        _ = writeln!(
            text,
            "| {} | {with} | {without} | {active} | {average} | {rho:.3} | {average_rho:.3} | {active_motion} | {average_motion} |",
            start.name(),
        );
    }
    Ok(text + &claims(&ends, sets))
}

/// The thesis's claim, with activeness fewer steps, for each start and test.
fn claims(ends: &[End], sets: usize) -> String {
    let steps = |ends: &[End]| Mean::of(&ends.iter().map(|end| end.steps).collect::<Vec<_>>());
    let cases: Vec<_> = ends
        .chunks(DISTRIBUTIONS.len() * sets)
        .map(|ends| [&ends[..sets], &ends[sets..]].map(steps))
        .zip(THESIS.iter().flat_map(|(start, _)| TESTS.map(|test| (start.name(), test))))
        .collect();
    let differences = cases.iter().map(|([with, without], _)| with.above(without));
    let chances: Vec<_> = differences.map(|it| it.map_or(1.0, |difference| difference.chance_of_farther())).collect();
    let mut text = format!(
        "\nThe thesis has fewer steps with α than without from every start. Here, with standard errors, and p that of steps that \
         do not differ, corrected for all {} comparisons (Welch, Holm; a difference is shown where p is at most {LEVEL}):\n\n\
         | start | test | with α | without | sets | p | with α | the thesis's claim |\n{}|\n",
        cases.len(),
        "|---".repeat(8),
    );
    for (([with, without], (start, test)), p) in cases.iter().zip(holm(&chances)) {
        let test = if *test == TESTS[0] { "its own" } else { "by motion" };
        let (found, claim) = match (with.mean < without.mean, p <= LEVEL) {
            (true, true) => ("fewer steps", "reproduced"),
            (false, true) => ("more steps", "**not reproduced**: the opposite"),
            (_, false) => ("no difference shown", "not decided"),
        };
        let cell = |mean: &Mean| format!("{:.1} ± {:.1}", mean.mean, mean.error);
        _ = writeln!(
            text,
            "| {start} | {test} | {} | {} | {sets} | {} | {found} | {claim} |",
            cell(with),
            cell(without),
            chance(p)
        );
    }
    text
}

fn by_step(study: &Study, count: usize, sets: usize) -> Result<String> {
    let cases: Vec<_> = STEPS.iter().flat_map(|&step| TESTS.map(|test| (step, test))).collect();
    let ends = study.each("step sizes", cases.len() * sets, |context, i| {
        let ((step, decay), convergence) = cases[i / sets];
        let seed = FIRST_SEED + (i % sets) as u64;
        let domain = Domain::unit(Boundary::Periodic);
        let points = Start::Random.points(context, domain, count, seed)?;
        let thesis = Thesis::default().step(step).decay(decay).convergence(convergence);
        let options = thesis_options(thesis, Neighbourhood::Delaunay, domain, seed);
        End::of(context, &options.max_iterations(1500), &points)
    })?;
    let mut text = format!(
        "By the size of the step; *not met* counts sets that did not meet the test in 1,500 steps. *Path* is the sum of all λ. From random sets on the torus, with α; {} points, {sets} sets. Of a λ that decays the thesis says only that it \
         recommends one; here it is multiplied with a factor after every step.\n\n\
         | λ | its test: steps | path | ρ | by motion: steps | path | ρ |\n{}|\n",
        grouped(count),
        "|---".repeat(7),
    );
    for ((step, decay), ends) in STEPS.iter().zip(ends.chunks(TESTS.len() * sets)) {
        let lambda = if *decay < 1.0 { format!("{step}, decaying by {decay}") } else { step.to_string() };
        let cells = ends.chunks(sets).map(|ends| {
            let path = |end: &End| match *decay {
                1.0 => step * end.steps,
                decay => step * (1.0 - decay.powf(end.steps)) / (1.0 - decay),
            };
            let path = ends.iter().map(path).sum::<f64>() / sets as f64;
            format!("{} | {path:.1} | {:.3}", steps(ends), mean_rho(ends))
        });
        _ = writeln!(text, "| {lambda} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    Ok(text)
}
