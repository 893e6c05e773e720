//! The page.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use crate::judge::Verdict;
use crate::peers::{Asked, Kind, Outcome, ROUNDS, Row, Table};

const INTRODUCTION: &str = "\
Each call ran in a process of its own, one after the other. *Seconds* is the time of the call alone: no start of a program, no \
import, no file, no making of threads; the least of all rounds. *Spread* is how much longer \
the slowest round took. *Threads* is the time of processors over that time. *MB* is what memory grew by at most. What was returned was judged in double precision as it was returned.

Peers that were asked for a number, not a radius, promise no radius: they are judged by their own spacing and coverage.

* *N / ref*: samples over those of azulejo's set at the same radius; more is denser.
* *Conflicts*: pairs of samples closer than the radius.
* *Gaps*: connected places farther than the radius from every sample, by more than 6 times the spacing of floats at the largest \
coordinate; *farthest* is the worst place, in radii. A set is maximal if there is no gap.
* *ρ*: the smallest distance over that of the hexagonal arrangement of as many samples; *cover*: the distance of the worst place \
over the same.
";

const FEATURES: &str = "\
What the tables do not show:

* **Other dimensions**: fast_poisson, poisson and scipy sample boxes of four and more dimensions; azulejo has planes, surfaces \
and volumes.
* **Pure Rust**: bluenoise, fast_poisson and poisson need no C library; azulejo needs Embree unless it is built without.
* **Volumes, geodesic distance**: PyMeshLab and point-cloud-utils can measure along the surface; azulejo measures straight.
* **What comes with it**: each of the Python packages is a library for much more than samples.
* **What was not run**: CGAL's `poisson_eliminate`, which the CGAL of no registry in reach has yet (Debian's is 5.5, that \
 of PyPI 6.0; it came with 6.1), and the author's own code of sample elimination, which is no package.";

/// The first line of the page.
const SUBJECT: &str = "Samplers of the plane, of meshes and of clouds by azulejo and by other packages, on the same tasks: \
    time, memory, conflicts and gaps.";

pub fn page(tables: &[Table], mesh: &Path, packages: &str) -> Result<String, Box<dyn Error>> {
    let mut page = String::new();
    writeln!(page, "# azulejo beside its peers\n\n{SUBJECT}\n")?;
    writeln!(
        page,
        "Written by `studies/peers/run.sh` on {}, on {} threads of {}, a machine that others use, too. Crates: those of \
         `studies/peers/Cargo.lock`; Python: {}.\n",
        told("date", &["+%F"])?,
        std::thread::available_parallelism()?,
        processor()?,
        packages.split(' ').map(|package| package.replace("==", " ")).collect::<Vec<_>>().join(", "),
    )?;
    writeln!(page, "The peers of a table took turns, {ROUNDS} rounds of them. {INTRODUCTION}")?;
    for table in tables {
        write_table(&mut page, table, mesh)?;
    }
    writeln!(page, "## Where a peer is better\n")?;
    writeln!(page, "By the tables above, with azulejo on all threads or on one, whichever serves it better:\n")?;
    let mut any = false;
    for line in tables.iter().flat_map(won) {
        any = true;
        writeln!(page, "* {line}")?;
    }
    if !any {
        writeln!(page, "* nowhere.")?;
    }
    writeln!(page, "\n{FEATURES}{}", tables.iter().filter_map(|table| absent(table, tables)).collect::<String>())?;
    Ok(page)
}

/// Says which peers were left out of a table, with their times in the tables of fewer samples.
fn absent(table: &Table, tables: &[Table]) -> Option<String> {
    let named = |title: &&str| {
        let smaller = tables.iter().filter(|one| one.kind == table.kind && one.count < table.count);
        let outcome = |one: &Table| {
            let row = one.rows.iter().find(|row| row.title == *title)?;
            Some((one.count, row.result.as_ref().ok()?.cost.seconds))
        };
        let known = smaller.filter_map(outcome).max_by_key(|(count, _)| *count);
        let time = known.map(|(count, seconds)| format!(" ({} s for {})", significant(seconds), grouped(count)));
        format!("{title}{}", time.unwrap_or_default())
    };
    let names: Vec<_> = table.absent.iter().map(named).collect();
    let (last, others) = names.split_last()?;
    let names = if others.is_empty() { last.clone() } else { format!("{} and {last}", others.join("; ")) };
    let (count, what) = (grouped(table.count), kind(table.kind));
    Some(format!(" For {count} {what}, to save time, also these were not: {names}."))
}

/// The unit of a count.
fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Surface => "samples on the mesh",
        Kind::Cloud => "points of a cloud",
        Kind::Plane | Kind::Relaxation => "samples in the plane",
    }
}

fn told(program: &str, arguments: &[&str]) -> Result<String, Box<dyn Error>> {
    Ok(String::from_utf8(Command::new(program).args(arguments).output()?.stdout)?.trim().to_owned())
}

fn processor() -> Result<String, Box<dyn Error>> {
    let file = std::fs::read_to_string("/proc/cpuinfo")?;
    let line = file.lines().find(|line| line.starts_with("model name"));
    Ok(line.and_then(|line| line.split(": ").nth(1)).unwrap_or("an unknown processor").to_owned())
}

fn task(table: &Table, mesh: &Path) -> String {
    let count = grouped(table.count);
    match table.kind {
        Kind::Plane => format!("The unit square, about {count} samples, radius {:.5}", table.radius),
        Kind::Relaxation => format!("The unit square, {count} points, relaxed"),
        Kind::Surface => {
            let name = mesh.file_stem().unwrap_or_default().to_string_lossy();
            format!("The mesh `{name}`, about {count} samples, radius {:.5}", table.radius)
        }
        Kind::Cloud => format!("A cloud of {} points, thinned to {count}", grouped(10 * table.count)),
    }
}

fn write_table(page: &mut String, table: &Table, mesh: &Path) -> std::fmt::Result {
    writeln!(page, "## {}\n", task(table, mesh))?;
    if table.kind == Kind::Relaxation {
        writeln!(page, "*ψ6* is the bond order.\n")?;
        writeln!(page, "| | seconds | spread | samples/s | threads | MB | ρ | cover | ψ6 |")?;
        writeln!(page, "|---|---|---|---|---|---|---|---|---|")?;
    } else if table.kind == Kind::Cloud {
        writeln!(
            page,
            "Random points of the mesh. *ρ* is that of the selected points on its area; *cover* the distance of the point \
             of the cloud that is farthest from them, over their smallest distance; *tenth* the same for the first tenth of \
             them, where they have an order. Those that take a radius got {:.5}.\n",
            table.radius
        )?;
        writeln!(page, "| | seconds | spread | points/s | threads | MB | points | ρ | cover | tenth |")?;
        writeln!(page, "|---|---|---|---|---|---|---|---|---|---|")?;
    } else {
        writeln!(
            page,
            "| | seconds | spread | samples/s | threads | MB | samples | N / ref | conflicts | gaps | farthest | ρ | cover |"
        )?;
        writeln!(page, "|---|---|---|---|---|---|---|---|---|---|---|---|---|")?;
    }
    let reference = reference(table);
    for row in &table.rows {
        match &row.result {
            Err(reason) => writeln!(page, "| {} | *failed: {reason}* |", row.title)?,
            Ok(outcome) => {
                write!(page, "| {} | {} |", row.title, cost_cells(outcome))?;
                writeln!(page, " {} |", worth_cells(table, row.asked, &outcome.verdict, reference))?;
            }
        }
    }
    writeln!(page)
}

/// The samples of azulejo's first set.
fn reference(table: &Table) -> f64 {
    table.rows.iter().find_map(|row| Some(row.result.as_ref().ok()?.verdict.samples as f64)).unwrap_or(f64::NAN)
}

fn cost_cells(outcome: &Outcome) -> String {
    let Outcome { cost, slowest, verdict } = outcome;
    let rate = verdict.samples as f64 / cost.seconds;
    let spread = 100.0 * (slowest / cost.seconds - 1.0);
    let threads = if cost.seconds < 0.05 { "".to_owned() } else { format!("{:.1}", cost.busy / cost.seconds) };
    let (seconds, rate) = (significant(cost.seconds), grouped(rate as usize));
    format!("{seconds} | {spread:.0} % | {rate} | {threads} | {:.0}", cost.megabytes)
}

fn worth_cells(table: &Table, asked: Asked, verdict: &Verdict, reference: f64) -> String {
    let (rho, cover) = (verdict.smallest / verdict.hexagonal, verdict.farthest / verdict.hexagonal);
    if table.kind == Kind::Relaxation {
        return format!("{rho:.3} | {cover:.3} | {:.3}", verdict.bond_order.unwrap_or(f64::NAN));
    }
    if table.kind == Kind::Cloud {
        let cover = verdict.farthest / verdict.smallest;
        let tenth = verdict.of_first_tenth.map_or("-".to_owned(), |tenth| format!("{tenth:.3}"));
        return format!("{} | {rho:.3} | {cover:.3} | {tenth}", grouped(verdict.samples));
    }
    let samples = grouped(verdict.samples);
    if asked == Asked::Count {
        return format!("{samples} | - | - | - | - | {rho:.3} | {cover:.3}");
    }
    format!(
        "{samples} | {:.3} | {} | {} | {:.4} | {rho:.3} | {cover:.3}",
        verdict.samples as f64 / reference,
        grouped(verdict.conflicts),
        grouped(verdict.gaps),
        verdict.farthest / table.radius,
    )
}

/// In what a peer is better than every row of azulejo's.
fn won(table: &Table) -> Vec<String> {
    let is_ours = |row: &&Row| row.title.contains("azulejo");
    let better = |name: &str, unit: &str, key: &dyn Fn(&Outcome) -> f64| {
        let value = |row: &Row| row.result.as_ref().ok().map(key);
        let ours = table.rows.iter().filter(is_ours).filter_map(value).fold(f64::INFINITY, f64::min);
        let rows = table.rows.iter().filter(|row| !is_ours(row));
        rows.filter_map(|row| value(row).filter(|&value| value < ours).map(|value| (row.title, value)))
            .filter_map(|(title, value)| {
                let (value, ours) = (significant(value.abs()), significant(ours.abs()));
                let (count, what) = (grouped(table.count), kind(table.kind));
                // A difference below the printed digits is no advantage.
                (value != ours).then(|| format!("{title}: {name} {value}{unit}, not {ours}{unit} ({count} {what})"))
            })
            .collect::<Vec<_>>()
    };
    let mut lines =
        better("seconds per million samples", "", &|one| one.cost.seconds / one.verdict.samples as f64 * 1e6);
    lines.extend(better("memory", " MB", &|one| one.cost.megabytes.max(1.0)));
    lines.extend(better("ρ", "", &|one| -one.verdict.smallest / one.verdict.hexagonal));
    lines.extend(better("farthest place", " of the hexagonal distance", &|one| {
        one.verdict.farthest / one.verdict.hexagonal
    }));
    if matches!(table.kind, Kind::Plane | Kind::Surface) {
        lines.extend(better("samples without conflict", "", &|one| match one.verdict.conflicts {
            0 => -(one.verdict.samples as f64),
            _ => f64::INFINITY,
        }));
    }
    lines
}

/// Three significant digits.
fn significant(value: f64) -> String {
    let digits = 2 - value.log10().floor().clamp(-9.0, 2.0) as i32;
    format!("{value:.*}", digits.max(0) as usize)
}

/// Thousands apart.
fn grouped(value: usize) -> String {
    let digits = value.to_string();
    let head = digits.len() % 3;
    let groups = std::iter::once(&digits[..head])
        .chain(digits.as_bytes()[head..].chunks(3).map(|g| str::from_utf8(g).expect("digits")));
    groups.filter(|group| !group.is_empty()).collect::<Vec<_>>().join(",")
}
