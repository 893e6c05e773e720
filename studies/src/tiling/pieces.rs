//! Nine sets become one (thesis §2.4.4 and fig. 2.14), and what that costs.

use std::collections::BTreeSet;
use std::fmt::Write;

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::spacing::smallest_distance_2d;
use azulejo::kdrt::{MergeOptions, MergeReport, Piece, merge};
use azulejo::{Boundary, Context, Domain, Result, maximal};

use super::claims::{Claim, Fact, Part, cell, number};
use super::study::{Figure, Study, mean_of, timed, times};
use crate::kdrt::radius;
use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::{SERIES, SLATE};
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::progress::watched;
use azulejo_cli::text::{grouped, rounded};

/// Pieces along a side.
const SIDE: usize = 3;

/// The most that merging may take of the time of making the pieces, in percent: "only very small overhead".
const OVERHEAD: f64 = 10.0;

/// The largest distance of a position from all samples beyond the radius, relative to it, that is rounding to floats.
const ROUNDING: f64 = 1e-3;

/// One round: nine sets and one, each by the unbiased sampler.
struct Round {
    /// Seconds on one thread: of the pieces, of their merging, of the one set.
    pieces: f64,
    merge: f64,
    whole: f64,
    /// Seconds of the pieces and their merging on all threads.
    parallel: f64,
    report: MergeReport,
    /// Samples of the one set.
    samples: usize,
    smallest: f64,
    covering: f64,
}

/// The square, and its parts.
fn domains() -> (Domain, Vec<Domain>) {
    let corner = |i: usize| i as f64 / SIDE as f64;
    let part = |i: usize| {
        let (column, row) = (i % SIDE, i / SIDE);
        let (min, max) = ([corner(column), corner(row)], [corner(column + 1), corner(row + 1)]);
        Domain { min, max, boundary: Boundary::Bounded }
    };
    (Domain::unit(Boundary::Bounded), (0..SIDE * SIDE).map(part).collect())
}

/// The pieces and the result of a merge.
struct Merged {
    sets: Vec<Vec<[f32; 2]>>,
    samples: Vec<[f32; 2]>,
    report: MergeReport,
    /// Seconds of the sets and of merging.
    seconds: [f64; 2],
}

fn merged(context: &Context, radius: f64, seed: u64) -> Result<Merged> {
    let (domain, parts) = domains();
    let (single, threads) = (Context::new(1)?, context.num_threads());
    let quiet = |_| std::ops::ControlFlow::Continue(());
    let (sets, making) = timed(|| {
        let make = |i: usize| {
            let seed = seed * (SIDE * SIDE) as u64 + i as u64;
            maximal::sample(&single, &maximal::Options::new(radius).domain(parts[i]).seed(seed), None)
                .map(|set| set.positions)
        };
        in_parallel(threads, parts.len(), &quiet, make)?.into_iter().collect::<Result<Vec<_>>>()
    })?;
    let piece = |(part, samples): (&Domain, _)| Piece { samples, min: part.min, max: part.max };
    let pieces: Vec<_> = parts.iter().zip(sets.iter().map(Vec::as_slice)).map(piece).collect();
    let options = MergeOptions::new(radius).domain(domain).seed(seed).maximal_pieces(true);
    let ((samples, report), merging) = timed(|| merge(context, &options, &pieces, &[], None))?;
    Ok(Merged { sets, samples: samples.positions, report, seconds: [making, merging] })
}

pub fn section(study: &Study) -> Result<Part> {
    let (count, rounds) = study.effort((1e6, 10), (2e4, 2));
    let (one, radius) = (Context::new(1)?, radius(count));
    let (domain, _) = domains();
    let mut all = Vec::new();
    watched("pieces", |progress| {
        for seed in 0..rounds {
            let Merged { samples, report, seconds: [pieces, merge], .. } = merged(&one, radius, seed)?;
            let parallel = merged(study.context, radius, seed)?.seconds.iter().sum();
            let options = maximal::Options::new(radius).domain(domain).seed(seed);
            let (direct, whole) = timed(|| maximal::sample(&one, &options, None))?;
            all.push(Round {
                pieces,
                merge,
                whole,
                parallel,
                report,
                samples: direct.len(),
                smallest: smallest_distance_2d(study.context, &domain, &samples, None)? / radius,
                covering: covering_radius_2d(study.context, &domain, &samples, None)? / radius,
            });
            _ = progress((seed + 1) as f64 / rounds as f64);
        }
        Ok(())
    })?;
    draw(study)?;
    let claims = vec![
        Claim::less(
            format!(
                "percent of the time of nine sets that merging takes (§2.4.4: \"only very small overhead\"; {OVERHEAD} here)"
            ),
            mean_of(&all, |round| 100.0 * round.merge / round.pieces),
            number(OVERHEAD),
        ),
        Claim::less(
            "percent of samples lost by merging (fig. 2.14: \"only minor loss of samples\"; 1 here)",
            mean_of(&all, loss),
            number(1.0),
        ),
    ];
    let smallest = all.iter().map(|round| round.smallest).fold(f64::INFINITY, f64::min);
    let covering = all.iter().map(|round| round.covering).fold(0.0, f64::max);
    let fact = Fact {
        what: format!("nine sets merged: conflict-free, and maximal up to {ROUNDING:e} r"),
        found: format!("distances from {smallest:.6} r, all places within {covering:.6} r"),
        is_met: smallest >= 1.0 && covering <= 1.0 + ROUNDING,
    };
    Ok(Part { text: text(study, count, &all), claims, facts: vec![fact] })
}

/// Percent of the samples of the pieces by which the merged set has fewer.
fn loss(round: &Round) -> f64 {
    let MergeReport { kept, eliminated, inserted, .. } = round.report;
    100.0 * (eliminated as f64 - inserted as f64) / (kept + eliminated) as f64
}

/// A merged set of few samples: a colour for each piece, new samples dark.
fn draw(study: &Study) -> Result<()> {
    let Merged { sets, samples, report, .. } = merged(study.context, radius(4000.0), 1)?;
    let rect = Rect { x: 20.0, y: 20.0, width: 960.0, height: 960.0 };
    let mut canvas = Canvas::new(1000.0, 1000.0, 1000);
    let place = |sample: &[f32; 2]| [rect.x + sample[0] * rect.width, rect.y + (1.0 - sample[1]) * rect.height];
    let left: BTreeSet<_> = samples.iter().map(|sample| sample.map(f32::to_bits)).collect();
    for (i, set) in sets.iter().enumerate() {
        let is_kept = |sample: &&[f32; 2]| left.contains(&sample.map(f32::to_bits));
        canvas.discs(set.iter().filter(is_kept).map(place), 4.0, SERIES[(i + i / SIDE) % 3], rect);
        canvas.discs(set.iter().filter(|sample| !is_kept(sample)).map(place), 1.6, SLATE, rect);
    }
    canvas.discs(samples[report.kept..].iter().map(place), 5.0, [20, 20, 20], rect);
    canvas.frame(rect, 1.0, SLATE);
    canvas.write(&study.files.picture("pieces")?)
}

fn text(study: &Study, count: f64, all: &[Round]) -> String {
    let seconds = |of: Figure<Round>| times(&all.iter().map(of).collect::<Vec<_>>(), 1e3);
    let figure = |of: Figure<Round>| cell(&mean_of(all, of));
    let mut text = format!(
        "## Nine sets merged (thesis §2.4.4 and fig. 2.14)\n\n\
         Nine bounded sets by the unbiased sampler, on one thread, become one of about {} by `kdrt::merge`; beside them one set of the \
         same sampler. {} rounds. The thesis says \"only very small overhead\" and \"only minor loss of samples in the margin area\", \
         without figures. In the picture, of a smaller set, samples of pieces are coloured, those eliminated small and grey, new ones dark.\n\n\
         ![Nine sets merged](tiling/pieces.png)\n\n\
         | | |\n|---|---|\n",
        grouped(count as usize),
        all.len(),
    );
    let share = |part: usize, report: &MergeReport| 100.0 * part as f64 / (report.kept + report.eliminated) as f64;
    let eliminated = mean_of(all, |round| share(round.report.eliminated, &round.report));
    let inserted = mean_of(all, |round| share(round.report.inserted, &round.report));
    let rows = [
        ("nine sets, one thread, ms", seconds(|round| round.pieces)),
        ("merging them, one thread, ms", seconds(|round| round.merge)),
        ("merging over nine sets, percent", figure(|round| 100.0 * round.merge / round.pieces)),
        ("one set, one thread, ms", seconds(|round| round.whole)),
        ("nine sets and merging over one set, one thread", figure(|round| (round.pieces + round.merge) / round.whole)),
        ("one set over nine sets and merging, all threads", figure(|round| round.whole / round.parallel)),
        ("eliminated, percent", cell(&eliminated)),
        ("inserted, percent", cell(&inserted)),
        ("lost, percent", figure(loss)),
        (
            "samples over those of one set, percent",
            figure(|round| 100.0 * ((round.report.kept + round.report.inserted) as f64 / round.samples as f64 - 1.0)),
        ),
    ];
    rows.iter().for_each(|(name, found)| _ = writeln!(text, "| {name} | {found} |"));
    _ = writeln!(
        text,
        "\nAll threads are {}; their ratio is a speed-up. The seams of nine squares are {} r long.",
        study.context.num_threads(),
        rounded(2.0 * (SIDE - 1) as f64 / radius(count), 3),
    );
    text
}
