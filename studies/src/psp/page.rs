//! The page, in Markdown.

use std::fmt::Write;

use azulejo::psp::{self, TOLERANCE};

use super::bias::{Bias, NEIGHBOURS, TILTS};
use super::growth::Moment;
use super::rates::{ATTEMPTS, Again, ITERATIONS};
use super::scenes::Missing;
use super::{Effort, Measured};
use crate::verdict::{Mean, verdict};
use azulejo_cli::text::{grouped, rounded};

/// Goals: million samples per second on the bunny, after one iteration and maximal; all threads over one, for each of them,
/// which is 1.7 for two; the time of the fill over that of the iteration.
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
        gives a little more than unbiased darts (*Density of maximal sets*). Times are the \
        lesser of two on a machine that may have had other work.\n";
    let absent =
        |one: &Missing| format!("\n**The {} was not given (`{} MESH`) and is left out.**\n", one.name, one.option);
    let parts = [
        introduction.to_owned(),
        missing.iter().map(absent).collect(),
        goals(effort, measured, threads),
        scenes(effort, measured),
        rates(measured),
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

/// What a cell of a table says of a scene.
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

fn millions(rate: f64) -> String {
    rounded(rate / 1e6, 3)
}

fn goals(effort: &Effort, measured: &[Measured], threads: usize) -> String {
    let usual = |one: &Measured| one.rates.by_iterations[1];
    // Goals of rates were set for the bunny.
    let judged = |one: &Measured, is_met: bool| {
        if one.scene.name == "bunny" { format!(", {}", verdict(is_met)) } else { String::new() }
    };
    let range = |seconds: &[f64]| {
        let bounds =
            [seconds.iter().copied().fold(f64::INFINITY, f64::min), seconds.iter().copied().fold(0.0, f64::max)];
        bounds.map(|bound| rounded(bound, 3)).join(" to ")
    };
    let speed_up_goal = SPEED_UP_GOAL * threads as f64;
    let rows: [(String, Cell); 8] = [
        (format!("first iteration, M samples/s; goal on the bunny: {ITERATED_GOAL}"), &|one| {
            let rate = usual(one).iterated_rate();
            millions(rate) + &judged(one, rate >= 1e6 * ITERATED_GOAL)
        }),
        (format!("maximal, M samples/s; goal on the bunny: {MAXIMAL_GOAL}"), &|one| {
            let rate = usual(one).rate();
            millions(rate) + &judged(one, rate >= 1e6 * MAXIMAL_GOAL)
        }),
        ("one thread, seconds".to_owned(), &|one| range(&one.rates.speed_up.one_thread)),
        (format!("{threads} threads, seconds"), &|one| range(&one.rates.speed_up.all_threads)),
        (format!("{threads} threads over one, least seconds; goal: {}", rounded(speed_up_goal, 3)), &|one| {
            let factor = one.rates.speed_up.factor();
            format!("{factor:.2} ×, {}", verdict(factor >= speed_up_goal))
        }),
        (format!("fill over first iteration, in time; goal: {FILL_GOAL}"), &|one| {
            let factor = usual(one).filled.seconds / usual(one).iterated.seconds;
            format!("{factor:.2}, {}", verdict(factor <= FILL_GOAL))
        }),
        (
            format!("samples that a second fill adds; promise: none farther than r and {TOLERANCE} float spacings"),
            &|one| {
                let Again { samples, beyond } = one.rates.again;
                let farthest = if samples == 0 { String::new() } else { format!(" at r and {beyond:.3} spacings") };
                format!("{samples}{farthest}, {}", verdict(samples == 0 || beyond <= TOLERANCE))
            },
        ),
        (format!("uncovered of {} random points", grouped(effort.probes as usize)), &|one| {
            format!("{}, {}", one.growth.filled.uncovered, verdict(one.growth.filled.uncovered == 0.0))
        }),
    ];
    format!(
        "## Goals\n\nSets of about {} samples: one iteration, then filled. Threads are compared by {ATTEMPTS} attempts on one and as \
         many on all, in turns. That a maximal set leaves nothing uncovered \
         is decided patch by patch by the fill itself, which ends when no patch is left; a second fill, which looks at \
         the whole surface again, may find only what rounding can hide, and random points are a third look.\n\n{}",
        grouped(effort.samples as usize),
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

fn rates(measured: &[Measured]) -> String {
    let mut text = "## Rate against radius (thesis fig. 3.14)\n\n\
        Million samples per second on all threads, with the building of scene and pattern. The radius is in parts of the \
        diagonal of the mesh's box. Of its GPU the thesis says: up to 11.5 with one iteration on the bunny at a radius of \
        0.0001 (§3.4.2), but up to 11.1 under the picture of the bunny (fig. 3.7); 6.6 under that of the Dragon, the Happy \
        Buddha and the Asian Dragon, \"more than 12.6 million triangles all at once\", without saying on which of them or at \
        what radius (fig. 3.8); 5.4 in Sponza (fig. 3.9); 4.3 with three iterations (fig. 3.1).\n\n\
        | scene | radius | first iteration | samples, maximal | maximal |\n|---|---|---|---|---|\n"
        .to_owned();
    for one in measured {
        let (low, high) = one.scene.mesh.bounds();
        let diagonal = glam::Vec3::from(low).distance(glam::Vec3::from(high));
        for stages in &one.rates.by_count {
            _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} |",
                one.scene.name,
                rounded(stages.radius / f64::from(diagonal), 2),
                millions(stages.iterated_rate()),
                grouped(stages.filled.samples as usize),
                millions(stages.rate()),
            );
        }
    }
    text + "\n![Rate against samples](psp/rates.png)\n"
}

fn growth(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Growth (thesis fig. 3.8, 3.12 and 3.13)\n\nSets of about {} samples. *Rate* is what there is over the \
         time so far, in million samples per second; *uncovered* is in parts per million of the surface. Left by \
         squareness, right by projector, the thesis's priority.\n",
        grouped(effort.growth as usize)
    );
    for one in measured {
        _ = write!(
            text,
            "\n| {} | rate | relative radius | uncovered | | rate | relative radius | uncovered |\n|---|---|---|---|---|---|---|---|\n",
            one.scene.name
        );
        let cells = |moment: &Moment| {
            let Moment { seconds, samples, rho, uncovered, .. } = moment;
            format!("{} | {rho:.4} | {}", millions(samples / seconds), rounded(1e6 * uncovered, 3))
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
        first.map_or("not reached".to_owned(), |moment| rounded(moment.seconds, 3))
    };
    let mut text =
        "Seconds to a relative radius, by the iterations of the tables above. The thesis calls 0.9 enough for most \
        uses and 0.98 close to maximal; its fig. 3.15 compares others' methods so, as does the next section.\n\n| scene, method | 0.9 | 0.95 | 0.98 |\n|---|---|---|---|\n"
            .to_owned();
    for one in measured {
        let [squareness, projector] = &one.growth.iterated;
        let methods = [("squareness", &squareness[..]), ("projector", projector), ("filled", &[one.growth.filled])];
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
                let stages = one.rates.by_iterations[iterations as usize];
                format!("{:.3} ({:.3} + {:.3})", stages.seconds(), stages.iterated.seconds, stages.filled.seconds)
            }
        })
        .collect();
    let rows: Vec<_> =
        ITERATIONS.zip(&cells).map(|(iterations, cell)| (format!("{}", 3 * iterations), cell as Cell)).collect();
    format!(
        "## Directions before filling\n\nSeconds to a maximal set of about {} samples, by the number of directions from \
         which patterns are projected before the rest is filled: all (iterations + fill). The default is 0, on every mesh and \
         with every radius, see *Density of maximal sets*. Iterations have to be asked for.\n\n{}\n{}",
        grouped(effort.samples as usize),
        table("directions", measured, &rows),
        measured.iter().map(fastest).collect::<Vec<_>>().join(" ") + "\n",
    )
}

/// With how many directions a scene took the least time.
fn fastest(one: &Measured) -> String {
    let stages = ITERATIONS.zip(&one.rates.by_iterations);
    let least =
        stages.min_by(|a, b| a.1.seconds().total_cmp(&b.1.seconds())).map_or(0, |(iterations, _)| 3 * iterations);
    format!("The {} took the least time with {least} directions.", one.scene.name)
}

fn priority(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Priority of the candidates\n\nWhere candidates of an iteration conflict, the *squarer* one wins, that which its \
         projector faces most squarely, or that of the *projector* with the lower number, as in the thesis. Of about {} samples: \
         what one iteration finds and what there is when the rest is filled, over the samples of the reference, in brackets \
         the square root, which is the relative radius; and the seconds to the end.\n\n\
         | scene, priority | one iteration | filled | seconds |\n|---|---|---|---|\n",
        grouped(effort.samples as usize)
    );
    for Measured { scene, rates, .. } in measured {
        let share = |report: psp::Report| {
            let share = report.samples as f64 / rates.by_iterations[0].filled.samples as f64;
            format!("{share:.3} ({:.3})", share.sqrt())
        };
        let priorities = [("squareness", rates.by_iterations[1]), ("projector", rates.by_projector)];
        for (priority, stages) in priorities.into_iter().chain([("reference", rates.by_iterations[0])]) {
            let (found, filled) = (share(stages.iterated), share(stages.filled));
            _ = writeln!(text, "| {}, {priority} | {found} | {filled} | {:.3} |", scene.name, stages.seconds());
        }
    }
    for Measured { scene, rates, .. } in measured {
        let (squareness, projector) = (rates.by_iterations[1], rates.by_projector);
        let more = |is_more: bool| if is_more { "more" } else { "no more" };
        _ = write!(
            text,
            "\nOn the {} by squareness, the default, one iteration finds {} than by projector, the filled set has {}, and it \
             takes {} time.",
            scene.name,
            more(squareness.iterated.samples > projector.iterated.samples),
            more(squareness.filled.samples > projector.filled.samples),
            more(squareness.seconds() > projector.seconds()),
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
        Sponza stands beside the hall.\n\n\
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
            millions(rays.closest),
            millions(rays.all),
        );
    }
    text
}
