//! The text of the page.

use std::fmt::Write;

use azulejo_cli::text::{grouped, rounded};

use super::Scene;
use super::others::Asked;
use super::picture::Slab;
use super::tables::{Outcome, Row, Table};
use crate::goals::row;

const HOW: &str = "Times are those of processors, user and system together, on one thread, since others use the machine, \
    too: they vary less than times on the wall, but still by what others do to caches and clocks. Calls of others that took less than 0.1 s are \
    timed on the wall. What is compared took turns.\n";

const GOALS: &str = "*Measured* is the median of the rounds, and the *range* is theirs: a \
    goal is met where every round meets it, not met where none does, and otherwise not decided. Of densities, memory and \
    distances *measured* is the worst, which decides. AVX-512 is taken where the processor has it; times of AVX2, of which the goal is \
    2.5 µs a sample, are not measured: the library takes the widest instructions and has no switch for others.";

const COLUMNS: &str = "* *µs*: processor time of a sample, the least of all rounds; *spread*: how much more the slowest round \
    took. No start of a program, no import and no file.\n\
    * *N·r³*: samples per volume, by the radius that was asked for; *conflicts*: pairs of samples nearer than that, in double \
    precision.\n\
    * *uncovered*: the share of random places of the volume that are farther than the radius from all samples; *farthest*: the \
    worst place, in radii, of cuboids everywhere, of meshes among the random places.\n\
    * *ρ*: the smallest distance over that of neighbours in the densest packing of as many samples; *cover*: the distance of \
    the worst place over the same. Those that are asked for a number promise no radius, and are judged by these.\n";

/// The peers that were not run, and the reasons.
const ELSEWHERE: &str = "* **Any dimension**: fast_poisson, poisson, poisson-diskus, tph_poisson and scipy also sample boxes of four and more \
    dimensions; azulejo does not.\n\
    * **Pure Rust**: fast_poisson, poisson and poisson-diskus need no C library; azulejo needs Embree unless it is built \
    without.\n\
    * **Clouds**: Open3D and point-cloud-utils thin points that exist; `azulejo::thin` does that, too, on other pages.\n";

pub fn text(scene: &Scene, goals: &[row::Row], tables: &[Table], slab: &Slab, fluid: Option<&str>) -> String {
    let mut page = "\n".to_owned();
    page += "\n## Where others win\n\nBy the tables below, against azulejo's maximal sets:\n\n";
    let lines: Vec<String> = tables.iter().flat_map(won).collect();
    if lines.is_empty() {
        let is_known = tables.iter().flat_map(|table| &table.rows).any(|row| !row.is_ours);
        page += if is_known { "* nowhere.\n" } else { "* not known: no package of others was run.\n" };
    }
    page += &lines.concat();
    page += &format!("\nWhat the tables do not show:\n\n{ELSEWHERE}\n## How it was measured\n\n{HOW}\n");
    page += &row::section("Goals", GOALS, goals);
    if scene.effort.largest == 0.0 {
        page += "\nThat times grow linearly up to 10,000,000 samples was not measured in this run.\n";
    }
    let turns = scene.effort.turns;
    page += &format!("\n## Beside others\n\nRounds of each call, in turns: {turns}.\n\n{COLUMNS}\n");
    tables.iter().for_each(|table| write_table(&mut page, table));
    page += &absent(tables);
    let (name, Slab { samples, radius, inside, surface }) = (scene.mesh.0, slab);
    let of = rounded(*radius, 3);
    let (samples, inside, surface) = (grouped(*samples), grouped(*inside), grouped(*surface));
    page += &format!(
        "\n## Inside of the {name}\n\n![a cut through the {name}](volume/slab.png)\n\nA maximal set of {samples} samples at a \
         radius of {of}, the surface first. Drawn are those within half a radius of the middle: {inside} inside (blue), \
         {surface} on the surface (ochre).\n\n"
    );
    if scene.holes > 0 {
        page += &format!(
            "The {} holes of the {name} are closed first, for all: only closed meshes have a certain inside.\n\n",
            scene.holes
        );
    }
    page += fluid.unwrap_or("## Fluid at rest\n\nNot measured: the option `--python` was not given.\n");
    page
}

fn task(table: &Table) -> String {
    let (count, radius) = (grouped(table.count), rounded(table.radius, 4));
    match table.mesh {
        None => format!("The unit cube, not periodic, about {count} samples, radius {radius}"),
        Some(mesh) => format!("Inside of the {mesh}, about {count} samples, radius {radius}"),
    }
}

fn write_table(page: &mut String, table: &Table) {
    let mut line = |text: String| writeln!(page, "{text}").expect("a string takes all");
    line(format!("### {}\n", task(table)));
    line("| | µs | spread | samples | N·r³ | conflicts | uncovered | farthest | ρ | cover |".to_owned());
    line("|---|---|---|---|---|---|---|---|---|---|".to_owned());
    for row in &table.rows {
        line(match &row.result {
            Err(reason) => format!("| {} | *failed: {reason}* |", row.title),
            Ok(outcome) => format!("| {} | {} |", row.title, cells(table, row.asked, outcome)),
        });
    }
    line(String::new());
}

fn density(table: &Table, outcome: &Outcome) -> f64 {
    outcome.judged.samples as f64 * table.radius.powi(3) / table.volume
}

fn cells(table: &Table, asked: Asked, outcome: &Outcome) -> String {
    let judged = &outcome.judged;
    let promised = match asked {
        Asked::Count => "- | - | - | -".to_owned(),
        Asked::Radius => format!(
            "{:.4} | {} | {} | {:.4}",
            density(table, outcome),
            grouped(judged.conflicts),
            percent(judged.uncovered),
            judged.farthest / table.radius
        ),
    };
    format!(
        "{} | {:.0} % | {} | {promised} | {:.3} | {:.3}",
        rounded(outcome.least, 3),
        100.0 * outcome.spread,
        grouped(judged.samples),
        judged.smallest / judged.packed,
        judged.farthest / judged.packed
    )
}

fn percent(share: f64) -> String {
    format!("{} %", rounded(100.0 * share, 2))
}

/// In what rows of others are better than azulejo's first one, the maximal set.
fn won(table: &Table) -> Vec<String> {
    let done =
        |row: &Row| row.result.as_ref().ok().map(|outcome| (outcome.least, density(table, outcome), outcome.judged));
    let Some((time, dense, own)) = table.rows.iter().find(|row| row.is_ours).and_then(done) else { return Vec::new() };
    let mut lines = Vec::new();
    for row in table.rows.iter().filter(|row| !row.is_ours) {
        let Some((other_time, other_dense, other)) = done(row) else { continue };
        let mut say = |what: String| lines.push(format!("* {}: {what} ({}).\n", row.title, task(table)));
        if other_time < time {
            let conflicts = match other.conflicts {
                count if row.asked == Asked::Radius && count > 0 => format!(", with {} conflicts", grouped(count)),
                _ => String::new(),
            };
            say(format!("{} µs a sample, not {}{conflicts}", rounded(other_time, 3), rounded(time, 3)));
        }
        if row.asked == Asked::Radius && other.conflicts == 0 && other_dense > dense {
            say(format!("N·r³ of {other_dense:.4} without conflict, not {dense:.4}"));
        }
        let (cover, own_cover) = (other.farthest / other.packed, own.farthest / own.packed);
        if cover < own_cover {
            say(format!("the worst place at {cover:.3} of the packing distance, not {own_cover:.3}"));
        }
        let (rho, own_rho) = (other.smallest / other.packed, own.smallest / own.packed);
        if rho > own_rho {
            say(format!("ρ of {rho:.3}, not {own_rho:.3}"));
        }
    }
    lines
}

/// Those that are not in the tables.
fn absent(tables: &[Table]) -> String {
    let mut text = String::new();
    for table in tables.iter().filter(|table| !table.slow.is_empty()) {
        text += &format!("To save time, not run for {} samples: {}.\n", grouped(table.count), table.slow.join(", "));
    }
    let mut missing: Vec<&str> = tables.iter().flat_map(|table| table.absent.iter().copied()).collect();
    missing.dedup();
    missing.sort_unstable();
    missing.dedup();
    if !missing.is_empty() {
        text += &format!("Not run, as the programs that run them were not given: {}.\n", missing.join("; "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::judged::Judged;
    use super::*;

    fn row(title: &str, is_ours: bool, least: f64, samples: usize, conflicts: usize) -> Row {
        let judged = Judged { samples, conflicts, uncovered: 0.0, farthest: 0.1, smallest: 0.1, packed: 0.12 };
        let result = Ok(Outcome { least, spread: 0.1, judged });
        Row { title: title.to_owned(), is_ours, asked: Asked::Radius, result }
    }

    #[test]
    fn a_peer_wins_where_it_is_better_and_only_there() {
        let rows = vec![
            row("own", true, 2.0, 700, 0),
            row("fast", false, 1.0, 600, 0),
            row("dense", false, 3.0, 800, 0),
            row("conflicting", false, 3.0, 900, 1),
        ];
        let table =
            Table { mesh: None, count: 1000, radius: 0.1, volume: 1.0, rows, slow: Vec::new(), absent: Vec::new() };
        let lines = won(&table);
        assert_eq!(lines.len(), 2, "{lines:?}");
        assert!(lines[0].starts_with("* fast: 1 µs a sample, not 2 (The unit cube"));
        assert!(lines[1].starts_with("* dense: N·r³ of 0.8000 without conflict, not 0.7000"));
        let mut page = String::new();
        write_table(&mut page, &table);
        assert!(page.contains("| fast | 1 | 10 % | 600 | 0.6000 | 0 | 0 % | 1.0000 | 0.833 | 0.833 |"), "{page}");
    }
}
