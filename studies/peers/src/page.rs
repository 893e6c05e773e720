//! The page.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use crate::judge::Verdict;
use crate::peers::{Kind, Row, Table};
use crate::timing::Cost;

const INTRODUCTION: &str = "\
Each call ran in a process of its own, one after the other. *Seconds* is the time of the call alone: no start of a program, no \
import, no file, no making of threads; short calls were made five times, and the middle one counts. *Threads* is the time of \
processors over that time. *MB* is what memory grew by at most. What was returned was judged in double precision as it was returned.

* *N / ref*: samples over those of azulejo's set at the same radius; more is denser.
* *Conflicts*: pairs of samples closer than the radius.
* *Gaps*: connected places farther than the radius from every sample, by more than 6 times the spacing of floats at the largest \
coordinate; *farthest* is the worst place, in radii. A set is maximal if there is no gap.
* *ρ*: the smallest distance over that of the hexagonal arrangement of as many samples.
";

const FEATURES: &str = "\
What the tables do not show:

* **Other dimensions**: fast_poisson, poisson and scipy sample boxes of three and more dimensions; azulejo has planes and surfaces.
* **Nothing to install**: bluenoise, fast_poisson and poisson are plain Rust, build for WebAssembly and need no C library; azulejo \
needs Embree, and is tested on x86-64 Linux alone.
* **A given count on a mesh**: Open3D and point-cloud-utils' Lloyd return exactly as many samples as asked for; azulejo's PSP takes \
a radius. (In the plane azulejo takes either.)
* **Volumes, point clouds, geodesic distance**: Open3D, PyMeshLab and point-cloud-utils thin out point clouds, and PyMeshLab and \
point-cloud-utils can measure along the surface; azulejo measures straight.
* **What comes with it**: each of the Python packages is a library for much more than samples.
";

pub fn page(tables: &[Table], mesh: &Path, packages: &str) -> Result<String, Box<dyn Error>> {
    let mut page = String::new();
    writeln!(page, "# azulejo beside its peers\n")?;
    writeln!(
        page,
        "Written by `studies/peers/run.sh` on {}, on {} threads of {}, a machine that others use, too. Crates: those of \
         `studies/peers/Cargo.lock`; Python: {}.\n",
        told("date", &["+%F"])?,
        std::thread::available_parallelism()?,
        processor()?,
        packages.split(' ').map(|package| package.replace("==", " ")).collect::<Vec<_>>().join(", "),
    )?;
    writeln!(page, "{INTRODUCTION}")?;
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
    write!(page, "\n{FEATURES}")?;
    Ok(page)
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
    }
}

fn write_table(page: &mut String, table: &Table, mesh: &Path) -> std::fmt::Result {
    writeln!(page, "## {}\n", task(table, mesh))?;
    if table.kind == Kind::Relaxation {
        writeln!(page, "*Cover* is the farthest place in units of the hexagonal distance, ψ6 the bond order.\n")?;
        writeln!(page, "| | seconds | samples/s | threads | MB | ρ | cover | ψ6 |\n|---|---|---|---|---|---|---|---|")?;
    } else {
        writeln!(
            page,
            "| | seconds | samples/s | threads | MB | samples | N / ref | conflicts | gaps | farthest | ρ |"
        )?;
        writeln!(page, "|---|---|---|---|---|---|---|---|---|---|---|")?;
    }
    let reference = reference(table);
    for row in &table.rows {
        match &row.result {
            Err(reason) => writeln!(page, "| {} | *failed: {reason}* |", row.title)?,
            Ok((cost, verdict)) => {
                write!(page, "| {} | {} |", row.title, cost_cells(cost, verdict))?;
                writeln!(page, " {} |", worth_cells(table, verdict, reference))?;
            }
        }
    }
    writeln!(page)
}

/// The samples of azulejo's first set.
fn reference(table: &Table) -> f64 {
    table.rows.iter().find_map(|row| Some(row.result.as_ref().ok()?.1.samples as f64)).unwrap_or(f64::NAN)
}

fn cost_cells(cost: &Cost, verdict: &Verdict) -> String {
    let rate = verdict.samples as f64 / cost.seconds;
    let threads = if cost.seconds < 0.05 { "".to_owned() } else { format!("{:.1}", cost.busy / cost.seconds) };
    format!("{} | {} | {threads} | {:.0}", significant(cost.seconds), grouped(rate as usize), cost.megabytes)
}

fn worth_cells(table: &Table, verdict: &Verdict, reference: f64) -> String {
    let rho = verdict.smallest / verdict.hexagonal;
    if table.kind == Kind::Relaxation {
        let cover = verdict.farthest / verdict.hexagonal;
        return format!("{rho:.3} | {cover:.3} | {:.3}", verdict.bond_order.unwrap_or(f64::NAN));
    }
    format!(
        "{} | {:.3} | {} | {} | {:.4} | {rho:.3}",
        grouped(verdict.samples),
        verdict.samples as f64 / reference,
        grouped(verdict.conflicts),
        grouped(verdict.gaps),
        verdict.farthest / table.radius,
    )
}

/// In what a peer is better than every row of azulejo's.
fn won(table: &Table) -> Vec<String> {
    let is_ours = |row: &&Row| row.title.contains("azulejo");
    let better = |name: &str, unit: &str, key: &dyn Fn(&(Cost, Verdict)) -> f64| {
        let value = |row: &Row| row.result.as_ref().ok().map(key);
        let ours = table.rows.iter().filter(is_ours).filter_map(value).fold(f64::INFINITY, f64::min);
        let rows = table.rows.iter().filter(|row| !is_ours(row));
        rows.filter_map(|row| value(row).filter(|&value| value < ours).map(|value| (row.title, value)))
            .map(|(title, value)| {
                let what = if table.kind == Kind::Surface { "samples on the mesh" } else { "samples in the plane" };
                let (value, ours) = (significant(value.abs()), significant(ours.abs()));
                format!("{title}: {name} {value}{unit}, not {ours}{unit} ({} {what})", grouped(table.count))
            })
            .collect::<Vec<_>>()
    };
    let mut lines =
        better("seconds per million samples", "", &|(cost, verdict)| cost.seconds / verdict.samples as f64 * 1e6);
    lines.extend(better("memory", " MB", &|(cost, _)| cost.megabytes.max(1.0)));
    lines.extend(better("ρ", "", &|(_, verdict)| -verdict.smallest / verdict.hexagonal));
    lines.extend(better("farthest place", " of the hexagonal distance", &|(_, verdict)| {
        verdict.farthest / verdict.hexagonal
    }));
    if table.kind != Kind::Relaxation {
        lines.extend(better("samples without conflict", "", &|(_, verdict)| match verdict.conflicts {
            0 => -(verdict.samples as f64),
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
        .chain(digits[head..].as_bytes().chunks(3).map(|g| str::from_utf8(g).expect("digits")));
    groups.filter(|group| !group.is_empty()).collect::<Vec<_>>().join(",")
}
