//! Packages of others, each call in a process of its own: programs of `studies/peers`, which say how long their call took and
//! write the samples to a file as doubles.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use azulejo::{Error, Result};
use clap::Args;

/// The scripts of `studies/peers`, from the root of the repository, in which studies run.
const PEERS: &str = "studies/peers/peers.py";
const FLUID: &str = "studies/peers/sph.py";

/// The programs that run packages of others.
#[derive(Args)]
pub struct Programs {
    /// The program of studies/peers: runs crates; they are left out if it is not given.
    #[arg(long, value_name = "PROGRAM")]
    peers: Option<PathBuf>,
    /// A Python with the packages that studies/peers/volume.sh installs; they are left out if it is not given.
    #[arg(long, value_name = "PROGRAM")]
    python: Option<PathBuf>,
    /// The program studies/peers/tph.c, built with the header tph_poisson.h; left out if it is not given.
    #[arg(long, value_name = "PROGRAM")]
    tph: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Language {
    Rust,
    Python,
    C,
}

/// The task of a sampler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// A smallest distance, which is then a promise.
    Radius,
    /// A number of samples.
    Count,
}

pub struct Peer {
    /// As the tables call it.
    pub title: &'static str,
    name: &'static str,
    language: Language,
    pub asked: Asked,
    /// It is left out of tasks of more samples than this, to save time.
    pub most: usize,
}

const fn peer(title: &'static str, name: &'static str, language: Language, asked: Asked, most: usize) -> Peer {
    Peer { title, name, language, asked, most }
}

/// Those that take so long that only small sets are asked of them.
const FEW: usize = 10_000;
const FEWEST: usize = 1_000;

pub const CUBOIDS: [Peer; 9] = [
    peer("tph_poisson, 30 attempts", "tph_30", Language::C, Asked::Radius, usize::MAX),
    peer("tph_poisson, 300 attempts", "tph_300", Language::C, Asked::Radius, usize::MAX),
    peer("fast_poisson", "fast_poisson_cuboid", Language::Rust, Asked::Radius, usize::MAX),
    peer("poisson-diskus, 30 attempts", "poisson_diskus", Language::Rust, Asked::Radius, usize::MAX),
    peer("poisson, Bridson", "poisson_bridson_cuboid", Language::Rust, Asked::Radius, usize::MAX),
    peer("poisson, Ebeida", "poisson_ebeida_cuboid", Language::Rust, Asked::Radius, FEW),
    peer("scipy PoissonDisk", "poisson_disk_cuboid", Language::Python, Asked::Radius, FEW),
    peer(
        "point-cloud-utils, of ten times as many random points",
        "cuboid_thinned",
        Language::Python,
        Asked::Radius,
        usize::MAX,
    ),
    peer(
        "Open3D voxel_down_sample, of ten times as many random points",
        "cuboid_voxels",
        Language::Python,
        Asked::Radius,
        usize::MAX,
    ),
];

pub const INSIDES: [Peer; 2] = [
    peer(
        "fast_poisson around the mesh, those outside dropped",
        "fast_poisson_inside",
        Language::Rust,
        Asked::Radius,
        usize::MAX,
    ),
    peer("trimesh volume_mesh", "trimesh_inside", Language::Python, Asked::Count, FEWEST),
];

/// The seconds of processor time below which that of crates, which is counted in hundredths, is too coarse.
const COARSE: f64 = 0.1;

/// The work of a peer: its processor seconds, on the wall where there are few of them, and its samples.
pub type Work = (f64, Vec<[f64; 3]>);

impl Programs {
    fn program(&self, language: Language) -> Option<&PathBuf> {
        match language {
            Language::Rust => self.peers.as_ref(),
            Language::Python => self.python.as_ref(),
            Language::C => self.tph.as_ref(),
        }
    }

    /// Runs a peer; `None` if its program was not given.
    pub fn run(&self, peer: &Peer, count: usize, radius: f64, mesh: Option<&Path>) -> Option<Result<Work>> {
        let program = self.program(peer.language)?;
        let mut command = Command::new(program);
        match peer.language {
            Language::Rust => command.arg("one"),
            Language::Python => command.arg(PEERS),
            Language::C => &mut command,
        };
        let out = std::env::temp_dir().join(format!("azulejo-volume-{}.f64", std::process::id()));
        command.args([peer.name, &count.to_string(), &radius.to_string()]).arg(&out).args(mesh);
        Some(work(command, program, &out))
    }
}

/// The last line of a peer: seconds, processor seconds and megabytes; and its samples.
fn work(mut command: Command, program: &Path, out: &Path) -> Result<Work> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |source| Error::Io { path, source }
    };
    let output = command.output().map_err(failed(program))?;
    let printed = String::from_utf8_lossy(&output.stdout);
    let numbers: Vec<f64> = printed.lines().last().unwrap_or_default().split(' ').flat_map(str::parse).collect();
    let [seconds, busy, _] = numbers[..] else {
        let complaint = String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or("no word").to_owned();
        return Err(failed(program)(std::io::Error::other(complaint)));
    };
    let bytes = fs::read(out).map_err(failed(out))?;
    fs::remove_file(out).map_err(failed(out))?;
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect();
    Ok((if busy < COARSE { seconds } else { busy }, numbers.as_chunks().0.to_vec()))
}

/// The text on fluids that the script writes; `None` if no Python was given.
pub fn fluid(programs: &Programs, quick: bool, sets: usize) -> Result<Option<String>> {
    let Some(python) = &programs.python else { return Ok(None) };
    let mut command = Command::new(python);
    command.arg(FLUID).args(["--sets", &sets.to_string()]).args(quick.then_some("--quick"));
    let failed = |source| Error::Io { path: FLUID.into(), source };
    let output = command.output().map_err(failed)?;
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or("no word").to_owned();
        return Err(failed(std::io::Error::other(complaint)));
    }
    Ok(Some(String::from_utf8_lossy(&output.stdout).into_owned()))
}
