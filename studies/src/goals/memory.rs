//! The memory that a call takes, by what Linux knows of a process that makes nothing else.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use azulejo::psp::{self, Options};
use azulejo::{Context, Error, Points, Result};

use super::Dragon;
use crate::psp::scenes::radius;

const STATUS: &str = "/proc/self/status";
/// Writing 5 to it sets the peak of the resident set to what is resident.
const RESET: &str = "/proc/self/clear_refs";

/// Blocks above 64 KiB come from the system and go back to it: what was freed before a call does not serve it unseen.
pub const ALLOCATOR: [(&str, &str); 2] = [("MALLOC_MMAP_THRESHOLD_", "65536"), ("MALLOC_TRIM_THRESHOLD_", "0")];

/// The MB that a fill of the dragon takes in a process of its own.
pub fn in_a_process_of_its_own(dragon: &Dragon, count: f64) -> Result<f64> {
    let program = std::env::current_exe().map_err(|source| Error::Io { path: PathBuf::new(), source })?;
    let mut command = Command::new(&program);
    command.args(["goals", "--memory", &count.to_string(), "--dragon"]).arg(&dragon.path).envs(ALLOCATOR);
    let output = command.output().map_err(|source| Error::Io { path: program, source })?;
    let said = String::from_utf8_lossy(&output.stdout);
    said.trim().parse().map_err(|_| unknown(&String::from_utf8_lossy(&output.stderr)))
}

/// The MB that a fill of the dragon on one thread takes beside the mesh and the samples that it returns.
pub fn of_fill(Dragon { mesh, .. }: &Dragon, count: f64) -> Result<f64> {
    let context = Context::new(1)?;
    let options = Options::new(radius(mesh, count)).seed(1);
    let (samples, bytes) = grown(|| Ok(psp::sample(&context, mesh, &options, None)?.0))?;
    Ok((bytes - self::bytes(&samples) as f64) / 1e6)
}

/// The result of a call, and the bytes by which the resident set grew at most in it.
pub fn grown<T>(call: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    fs::write(RESET, "5").map_err(|source| Error::Io { path: RESET.into(), source })?;
    let before = resident("VmRSS")?;
    let result = call()?;
    Ok((result, resident("VmHWM")? - before))
}

fn bytes(samples: &Points<3>) -> usize {
    let Points { positions, normals, triangles, barycentrics, .. } = samples;
    size_of_val(&**positions) + size_of_val(&**normals) + size_of_val(&**triangles) + size_of_val(&**barycentrics)
}

/// The bytes of a field of the process's status.
fn resident(field: &str) -> Result<f64> {
    let status = fs::read_to_string(STATUS).map_err(|source| Error::Io { path: Path::new(STATUS).into(), source })?;
    let line = status.lines().find_map(|line| line.strip_prefix(field)).unwrap_or_default();
    let kilobytes = line.split_whitespace().nth(1).and_then(|number| number.parse::<f64>().ok());
    kilobytes.map(|kilobytes| 1024.0 * kilobytes).ok_or_else(|| unknown(field))
}

fn unknown(what: &str) -> Error {
    Error::Io { path: STATUS.into(), source: std::io::Error::other(what.trim().to_owned()) }
}
