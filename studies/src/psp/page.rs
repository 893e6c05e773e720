//! The page, in Markdown.

use std::fmt::Write;

use azulejo::psp::TOLERANCE;

use super::bias::{Bias, NEIGHBOURS, TILTS};
use super::growth::Moment;
use super::rates::{Again, ITERATIONS, Stages};
use super::scenes::Missing;
use super::{Effort, Measured};
use crate::repeated::{ROUNDS, Repeated, cell, lowest};
use crate::verdict::{Mean, verdict};
use azulejo_cli::text::{grouped, rounded};

/// Goals: million samples per second on the bunny, after one iteration and maximal; all threads over one, for each of
/// them, which is 1.7 for two; the time of the fill over that of the iteration.
const ITERATED_GOAL: f64 = 5.0;
const MAXIMAL_GOAL: f64 = 1.5;
const SPEED_UP_GOAL: f64 = 0.85;
const FILL_GOAL: f64 = 1.0;

/// The relative radii that the thesis names (§3.4.1): good enough for most uses, and close to maximal.
const RHO: [f64; 3] = [0.9, 0.95, 0.98];

/// The text of the page.
pub fn text(
    threads: usize,
    effort: &Effort,
    measured: &[Measured],
    missing: &[Missing],
    others: &str,
    density: &str,
    bias: &[Bias],
) -> String {
    let introduction = "Thesis: Wang 2019, chapter 3; its machine was a Core i7-7700K with a GTX 1080, on which PSP ran. `r` is the \
        radius, the smallest distance. An *iteration* is three orthogonal directions; *relative radius* is the square root \
        of the samples over those of the reference, a set that is only filled: darts into what is uncovered, cube by cube, which \
         gives a little more than unbiased darts (*Density of maximal sets*). Times \
        and rates are medians of some rounds, with their range in brackets, on a machine that may have had other work; what \
        a table compares takes turns. Embree's scene is kept, as in [figures.md](archive/figures.md), which times whole calls; \
        [peers.md](peers.md) times each call in a process of its own.\n";
    let absent =
        |one: &Missing| format!("\n**The {} was not given (`{} MESH`) and is left out.**\n", one.name, one.option);
    let parts = [
        introduction.to_owned(),
        missing.iter().map(absent).collect(),
        goals(effort, measured, threads),
        scenes(effort, measured),
        rates(effort, measured),
        growth(effort, measured),
        others.to_owned(),
        directions(effort, measured),
        priority(effort, measured),
        density.to_owned(),
        bias_by_variant(effort, bias),
        rays(measured),
    ];
    parts.join("\n")
}

/// The text of a cell of a table for a scene.
type Cell<'a> = &'a dyn Fn(&Measured) -> String;

/// A table with a column for each scene.
fn table(corner: &str, measured: &[Measured], rows: &[(String, Cell)]) -> String {
    let names: Vec<_> = measured.iter().map(|one| &*one.scene.name).collect();
    let mut text = format!("| {corner} | {} |\n|---{}|\n", names.join(" | "), "|---".repeat(names.len()));
    for (name, cell) in rows {
        let cells: Vec<_> = measured.iter().map(cell).collect();
        _ = writeln!(text, "| {name} | {} |", cells.join(" | "));
    }
    text
}

/// A rate in millions.
fn millions(rate: &Repeated) -> String {
    cell(&rate.map(|rate| rate / 1e6), 3)
}

fn goals(effort: &Effort, measured: &[Measured], threads: usize) -> String {
    // Goals of rates were set for the bunny.
    let judged = |one: &Measured, rate: &Repeated, goal: f64| match &*one.scene.name {
        "bunny" => format!("{}, {}", millions(rate), rate.verdict(|rate| rate >= 1e6 * goal)),
        _ => millions(rate),
    };
    let speed_up_goal = SPEED_UP_GOAL * threads as f64;
    let rows: [(String, Cell); 9] = [
        (format!("first iteration, M samples/s; goal: at least {ITERATED_GOAL} on the bunny"), &|one| {
            judged(one, &one.rates.usual().iterated_rate(), ITERATED_GOAL)
        }),
        (format!("maximal, M samples/s; goal: at least {MAXIMAL_GOAL} on the bunny"), &|one| {
            judged(one, &one.rates.usual().rate(), MAXIMAL_GOAL)
        }),
        ("one thread, seconds".to_owned(), &|one| cell(&one.rates.one_thread.seconds(), 3)),
        (format!("{threads} threads, seconds"), &|one| cell(&one.rates.usual().seconds(), 3)),
        (format!("{threads} threads, first call on the mesh, seconds"), &|one| rounded(one.rates.first_call, 3)),
        (format!("{threads} threads, times as fast as one; goal: at least {}", rounded(speed_up_goal, 3)), &|one| {
            let factor = one.rates.one_thread.seconds().over(&one.rates.usual().seconds());
            format!("{}, {}", cell(&factor, 3), factor.verdict(|factor| factor >= speed_up_goal))
        }),
        (format!("fill over first iteration, in time; goal: at most {FILL_GOAL}"), &|one| {
            let factor = one.rates.usual().filling.over(&one.rates.usual().iterating);
            format!("{}, {}", cell(&factor, 3), factor.verdict(|factor| factor <= FILL_GOAL))
        }),
        (format!("covering radius less r, in float spacings; goal: at most {TOLERANCE}"), &|one| {
            let Again { beyond, .. } = one.rates.again;
            format!("{beyond:.3}, {}", verdict(beyond <= TOLERANCE))
        }),
        ("samples that a second fill adds".to_owned(), &|one| one.rates.again.samples.to_string()),
    ];
    format!(
        "## Goals\n\nSets of about {} samples: one iteration, then filled; medians of {} rounds, in each of which one thread \
         and all take turns with what is under *Directions* and *Priority*. The first call on a mesh builds Embree's scene, \
         which is kept with it, and is in no round. A goal of time or rate is met where \
         every round meets it, not met where none does, and otherwise not decided: on the wrong side of a median all of \
         {ROUNDS} rounds, the fewest that decide, are in one of {} cases. That the set leaves nothing uncovered is \
         proven for the whole surface by its covering radius (`surface_covering_radius`), which may be beyond r by no more \
         than {TOLERANCE} spacings of floats at the largest coordinate; what a second fill adds is between r and that.\n\n{}",
        grouped(effort.samples as usize),
        effort.judged_rounds,
        1 << ROUNDS,
        table("", measured, &rows),
    )
}

fn scenes(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Scenes (thesis fig. 3.8 and 3.9)\n\nMaximal sets of about {} samples. The hall, a procedural stand-in for the \
         thesis's Sponza, is drawn without its ceiling and front.\n",
        grouped(effort.pictured as usize)
    );
    for Measured { scene, .. } in measured {
        let triangles = grouped(scene.mesh.triangles().len());
        _ = write!(text, "\n![The {0}, {triangles} triangles](psp/{0}.png)\n", scene.name);
    }
    text
}

fn rates(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Rate against radius (thesis fig. 3.14)\n\n\
        Million samples per second on all threads, with the making of the pattern; Embree's scene is kept with the mesh; \
        {} rounds, those of *Goals* at its number of samples. The radius is in parts of the \
        diagonal of the mesh's box. Of its GPU the thesis says: up to 11.5 with one iteration on the bunny at a radius of \
        0.0001 (§3.4.2), but up to 11.1 under the picture of the bunny (fig. 3.7); 6.6 under that of the Dragon, the Happy \
        Buddha and the Asian Dragon, \"more than 12.6 million triangles all at once\", without saying on which of them or at \
        what radius (fig. 3.8); 5.4 in Sponza (fig. 3.9); 4.3 with three iterations (fig. 3.1).\n\n\
        | scene | radius | first iteration | samples, maximal | maximal |\n|---|---|---|---|---|\n",
        effort.rounds,
    );
    for one in measured {
        let (low, high) = one.scene.mesh.bounds();
        let diagonal = glam::Vec3::from(low).distance(glam::Vec3::from(high));
        for stages in &one.rates.by_count {
            _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} |",
                one.scene.name,
                rounded(stages.radius / f64::from(diagonal), 2),
                millions(&stages.iterated_rate()),
                grouped(stages.filled as usize),
                millions(&stages.rate()),
            );
        }
    }
    text + "\n![Rate against samples](psp/rates.png)\n"
}

fn growth(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Growth (thesis fig. 3.8, 3.12 and 3.13)\n\nSets of about {} samples. *Rate* is what there is over the \
         time so far, in million samples per second; *uncovered* is in parts per million of the surface, of {} random \
         points. Left by squareness, right by projector, the thesis's priority; {} rounds.\n",
        grouped(effort.growth as usize),
        grouped(effort.probes as usize),
        effort.rounds,
    );
    for one in measured {
        _ = write!(
            text,
            "\n| {} | rate | relative radius | uncovered | | rate | relative radius | uncovered |\n|---|---|---|---|---|---|---|---|\n",
            one.scene.name
        );
        let cells = |moment: &Moment| {
            let Moment { seconds, samples, rho, uncovered, .. } = moment;
            let rate = seconds.map(|seconds| samples / seconds);
            format!("{} | {rho:.4} | {}", millions(&rate), rounded(1e6 * uncovered, 3))
        };
        let [squareness, projector] = &one.growth.iterated;
        for (a, b) in squareness.iter().zip(projector) {
            let plural = if a.iterations == 1 { "" } else { "s" };
            _ = writeln!(text, "| {} iteration{plural} | {} | | {} |", a.iterations, cells(a), cells(b));
        }
        _ = writeln!(text, "| 1 iteration, filled | {} | | | | |", cells(&one.growth.filled));
        _ = writeln!(text, "| filled only | {} | | | | |", cells(&one.growth.reference));
    }
    text.push_str("\n![Density and uncovered surface against time](psp/growth.png)\n\n");
    text + &to_quality(measured)
}

/// Seconds to a relative radius: as in thesis fig. 3.15, but without the methods of others.
fn to_quality(measured: &[Measured]) -> String {
    let reached = |moments: &[Moment], rho: f64| {
        let first = moments.iter().find(|moment| moment.rho >= rho);
        first.map_or("not reached".to_owned(), |moment| cell(&moment.seconds, 3))
    };
    let mut text =
        "Seconds to a relative radius, by the iterations of the tables above. The thesis calls 0.9 enough for most \
        uses and 0.98 close to maximal; its fig. 3.15 compares others' methods so, as does the next section, on smaller sets. *Filled* rows end \
        with our fill, which the thesis does not have; projection alone is the other two.\n\n| scene, method | 0.9 | 0.95 | 0.98 |\n|---|---|---|---|\n"
            .to_owned();
    for one in measured {
        let [squareness, projector] = &one.growth.iterated;
        let methods = [
            ("squareness", &squareness[..]),
            ("projector", projector),
            ("filled", std::slice::from_ref(&one.growth.filled)),
        ];
        for (name, moments) in methods {
            let cells = RHO.map(|rho| reached(moments, rho)).join(" | ");
            _ = writeln!(text, "| {}, {name} | {cells} |", one.scene.name);
        }
    }
    text
}

fn directions(effort: &Effort, measured: &[Measured]) -> String {
    let cells: Vec<_> = ITERATIONS
        .map(|iterations| {
            move |one: &Measured| {
                let stages = &one.rates.by_iterations[iterations as usize];
                let parts = [&stages.iterating, &stages.filling].map(|stage| rounded(stage.median(), 3));
                format!("{}: {}", cell(&stages.seconds(), 3), parts.join(" + "))
            }
        })
        .collect();
    let rows: Vec<_> =
        ITERATIONS.zip(&cells).map(|(iterations, cell)| (format!("{}", 3 * iterations), cell as Cell)).collect();
    format!(
        "## Directions before filling\n\nSeconds to a maximal set of about {} samples, by the number of directions from \
         which patterns are projected before the rest is filled: all, then iterations + fill. Of 0 and 3 directions there are {} \
         rounds, of more {}. A number of directions took the least time where its range is below all others (rank-sum test). \
         These are global projectors, which have to be asked for. By default a set begins with one iteration of local \
         projectors where that takes less time ([design/surface.md](design/surface.md#filled-or-projected)).\n\n{}\n{}",
        grouped(effort.samples as usize),
        effort.judged_rounds,
        effort.rounds,
        table("directions", measured, &rows),
        measured.iter().map(fastest).collect::<Vec<_>>().join(" ") + "\n",
    )
}

/// With how many directions a scene took the least time.
fn fastest(one: &Measured) -> String {
    let seconds: Vec<_> = one.rates.by_iterations.iter().map(Stages::seconds).collect();
    let name = &one.scene.name;
    match lowest(&seconds.iter().collect::<Vec<_>>()) {
        Some(iterations) => format!("The {name} took the least time with {} directions.", 3 * iterations),
        None => format!("With how many the {name} took the least time is not decided."),
    }
}

fn priority(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Priority of the candidates\n\nWhere candidates of an iteration conflict, the *squarer* one wins, that which its \
         projector faces most squarely, or that of the *projector* with the lower number, as in the thesis. Of about {} samples: \
         what one iteration finds and what there is when the rest is filled, over the samples of the reference, in brackets \
         the square root, which is the relative radius; and the seconds to the end, {} rounds.\n\n\
         | scene, priority | one iteration | filled | seconds |\n|---|---|---|---|\n",
        grouped(effort.samples as usize),
        effort.judged_rounds,
    );
    for Measured { scene, rates, .. } in measured {
        let share = |samples: f64| {
            let share = samples / rates.by_iterations[0].filled;
            format!("{share:.3} ({:.3})", share.sqrt())
        };
        let priorities = [("squareness", &rates.by_iterations[1]), ("projector", &rates.by_projector)];
        for (priority, stages) in priorities.into_iter().chain([("reference", &rates.by_iterations[0])]) {
            let (found, filled) = (share(stages.iterated), share(stages.filled));
            _ = writeln!(text, "| {}, {priority} | {found} | {filled} | {} |", scene.name, cell(&stages.seconds(), 3));
        }
    }
    for Measured { scene, rates, .. } in measured {
        let (squareness, projector) = (&rates.by_iterations[1], &rates.by_projector);
        let more = |is_more: bool| if is_more { "more" } else { "no more" };
        let seconds = [squareness, projector].map(Stages::seconds);
        let time = match lowest(&[&seconds[0], &seconds[1]]) {
            Some(0) => "takes less time",
            Some(_) => "takes more time",
            None => "is not decided which takes less time",
        };
        _ = write!(
            text,
            "\nOn the {} by squareness one iteration finds {} samples than by projector, and the filled set has {}; it {time}.",
            scene.name,
            more(squareness.iterated > projector.iterated),
            more(squareness.filled > projector.filled),
        );
    }
    text + "\n"
}

fn bias_by_variant(effort: &Effort, bias: &[Bias]) -> String {
    let reference = &bias[0];
    let mut text = format!(
        "## Bias (thesis fig. 3.10 and 3.11)\n\nOn a sphere, {} sets of about {} \
         samples of each kind, and {} of about {} for the reference, which have seeds of their own: samples over those of the \
         jamming limit (± standard error), their square root over the reference's, the uncovered part \
         of the surface; the lowest and the highest density by facing angle over the jamming limit, the angle between the normal \
         and the nearest projector of the first iteration; the first ring of the spectrum and how far the \
         spectrum is from the reference's at most. The spectrum is that of the differences of the samples (Wei and Wang \
         2011): the Hankel transform of their radial distribution function.\n\n\
         | variant | samples | relative radius | uncovered | density by angle | first ring | spectrum |\n|---|---|---|---|---|---|---|\n",
        effort.seeds,
        grouped(effort.bias as usize),
        reference.count.count,
        grouped(reference.variant.count(effort.bias) as usize),
    );
    let error = |mean: &Mean| format!("{:.4} ± {:.4}", mean.mean, mean.error);
    for one in bias {
        let by_density = |a: &&Mean, b: &&Mean| a.mean.total_cmp(&b.mean);
        let extremes = [one.facing.iter().min_by(by_density), one.facing.iter().max_by(by_density)];
        let extremes = extremes.map(|extreme| extreme.map_or("–".to_owned(), error)).join(" to ");
        let [frequency, power] = one.peak();
        let spectrum =
            if one.variant.is_one_piece { "–".to_owned() } else { format!("{:.3}", one.difference(reference)) };
        _ = writeln!(
            text,
            "| {} | {} | {:.4} | {:.2} % | {extremes} | {power:.3} at {frequency:.2} | {spectrum} |",
            one.variant.name(),
            error(&one.count),
            one.count.over(&reference.count).mean.sqrt(),
            100.0 * one.uncovered,
        );
    }
    text.push_str("\n![Density by facing angle](psp/facing.png)\n\n![Spectra](psp/spectra.png)\n\n");
    _ = write!(
        text,
        "On planes, whose normal has this angle to the nearest projector, of about {} samples ({} for the reference): samples over those of the \
         reference (± standard error of the ratio; for the reference, of its own mean), and how uneven neighbours ({} to {} mean \
         spacings apart) are all around: 0 if they are the same in all \
         directions, negative where there are fewer along the direction in which the pattern is stretched.\n\n| variant",
        grouped(effort.planes as usize),
        grouped(reference.variant.count(effort.planes) as usize),
        NEIGHBOURS.start,
        NEIGHBOURS.end,
    );
    TILTS.iter().for_each(|tilt| _ = write!(text, " | {tilt}°"));
    _ = writeln!(text, " |\n|---{}|", "|---".repeat(TILTS.len()));
    for one in bias {
        _ = write!(text, "| {}", one.variant.name());
        for (tilted, other) in one.planes.iter().zip(&reference.planes) {
            let ratio = match one.variant.is_one_piece {
                true => other.count.over_number(other.count.mean),
                false => tilted.count.over(&other.count),
            };
            _ = write!(text, " | {}, {:+.3}", error(&ratio), tilted.differences.elongation(NEIGHBOURS));
        }
        text.push_str(" |\n");
    }
    text + "\nThe differences of all pairs of the maximal sets: white where there is none, the full colour at 2.5 \
            times the mean density. An ellipse would be the hole of a pattern that is stretched; the table above gives how \
            uneven it is.\n\n![Differences on planes](psp/differences.png)\n"
}

fn rays(measured: &[Measured]) -> String {
    let mut text = "## Rays per second (thesis table 3.1)\n\nA pattern along each axis, in packets on all threads; the \
        thesis's Embree ran on a Core i7-4930K (6 cores) and its OptiX on a GTX 1080, its bunny had 5,000 triangles, and its \
        Sponza stands beside the hall. The least of three attempts.\n\n\
        | scene | triangles | rays | hits | to the first hit, M rays/s | to all hits, M rays/s | thesis, Embree | thesis, OptiX |\n\
        |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for Measured { scene, rays, .. } in measured {
        let [embree, optix] = match scene.thesis {
            Some(thesis) => thesis.map(|rate| rate.to_string()),
            None => ["–".to_owned(), "–".to_owned()],
        };
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {embree} | {optix} |",
            scene.name,
            grouped(scene.mesh.triangles().len()),
            grouped(rays.rays),
            grouped(rays.hits),
            rounded(rays.closest / 1e6, 3),
            rounded(rays.all / 1e6, 3),
        );
    }
    text + "| Happy Buddha | 1.08 M in the thesis | not in any registry | | | | 28 | 276 |\n"
}
