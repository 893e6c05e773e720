//! Who is measured, on what, and the runs.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use azulejo::mesh::Mesh;

use crate::judge::{Place, Verdict, judge};
use crate::timing::Cost;

/// The jamming limit: N * radius^2 / area of a maximal set.
const DENSITY: f64 = 0.69656;

/// Short calls are made so many times, each in a process of its own, and the middle one counts.
const REPEATS: usize = 5;
/// What is short, in seconds.
const SHORT: f64 = 2.0;

#[derive(Clone, Copy, PartialEq)]
enum Language {
    Rust,
    Python,
}

struct Peer {
    /// As the tables call it.
    title: &'static str,
    name: &'static str,
    language: Language,
    /// It makes no more samples than this within minutes.
    most: usize,
}

const fn peer(title: &'static str, name: &'static str, language: Language, most: usize) -> Peer {
    Peer { title, name, language, most }
}

use Language::{Python, Rust};

const PLANES: [Peer; 8] = [
    peer("**azulejo** KDRT, one thread", "azulejo_plane_1", Rust, usize::MAX),
    peer("**azulejo** KDRT", "azulejo_plane", Rust, usize::MAX),
    peer("**azulejo** maximal, one thread", "azulejo_maximal", Rust, usize::MAX),
    peer("bluenoise", "bluenoise", Rust, usize::MAX),
    peer("poisson, Bridson", "poisson_bridson", Rust, usize::MAX),
    peer("poisson, Ebeida", "poisson_ebeida", Rust, usize::MAX),
    peer("fast_poisson", "fast_poisson", Rust, usize::MAX),
    peer("scipy PoissonDisk", "poisson_disk", Python, 100_000),
];

const RELAXATIONS: [Peer; 3] = [
    peer("**azulejo** DCR, 100 steps", "azulejo_relaxed", Rust, usize::MAX),
    peer("point-cloud-utils lloyd_2d, 100 steps", "lloyd_plane", Python, usize::MAX),
    peer("scipy Halton, optimization=\"lloyd\"", "halton_lloyd", Python, usize::MAX),
];

const SURFACES: [Peer; 8] = [
    peer("**azulejo** PSP, one thread", "azulejo_surface_1", Rust, usize::MAX),
    peer("**azulejo** PSP", "azulejo_surface", Rust, usize::MAX),
    peer("Open3D sample_points_poisson_disk", "open3d_elimination", Python, usize::MAX),
    peer("PyMeshLab generate_sampling_poisson_disk", "meshlab", Python, usize::MAX),
    peer("point-cloud-utils sample_mesh_poisson_disk", "cloud_poisson_disk", Python, usize::MAX),
    peer("point-cloud-utils sample_mesh_lloyd", "cloud_lloyd", Python, usize::MAX),
    peer("libigl blue_noise", "igl_blue_noise", Python, usize::MAX),
    peer("trimesh sample_surface_even", "trimesh_even", Python, usize::MAX),
];

/// What a peer made of a task, or why it did not.
pub struct Row {
    pub title: &'static str,
    pub result: Result<(Cost, Verdict), String>,
}

/// The peers' work on one task.
pub struct Table {
    pub kind: Kind,
    /// The samples that the task is about.
    pub count: usize,
    pub radius: f64,
    pub rows: Vec<Row>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Plane,
    Relaxation,
    Surface,
}

/// Runs all.
pub fn run_all(python: &Path, mesh_file: &Path) -> Result<Vec<Table>, Box<dyn Error>> {
    let mesh = Mesh::load(mesh_file)?;
    let square = |kind, peers, count| run_table(kind, peers, count, python, None, &Place::Square, 1.0);
    let surface = |count| {
        run_table(Kind::Surface, &SURFACES, count, python, Some(mesh_file), &Place::Surface(&mesh), mesh.area())
    };
    Ok(vec![
        square(Kind::Plane, &PLANES, 1_000)?,
        square(Kind::Plane, &PLANES, 100_000)?,
        square(Kind::Plane, &PLANES, 1_000_000)?,
        square(Kind::Relaxation, &RELAXATIONS, 10_000)?,
        surface(10_000)?,
        surface(100_000)?,
    ])
}

fn run_table(
    kind: Kind,
    peers: &[Peer],
    count: usize,
    python: &Path,
    mesh: Option<&Path>,
    place: &Place,
    area: f64,
) -> Result<Table, Box<dyn Error>> {
    let radius = (DENSITY * area / count as f64).sqrt();
    let mut rows = Vec::new();
    for peer in peers.iter().filter(|peer| count <= peer.most) {
        eprintln!("{count}: {}", peer.name);
        let result = run_peer(peer, count, radius, python, mesh, place).map_err(|error| error.to_string());
        rows.push(Row { title: peer.title, result });
    }
    Ok(Table { kind, count, radius, rows })
}

fn run_peer(
    peer: &Peer,
    count: usize,
    radius: f64,
    python: &Path,
    mesh: Option<&Path>,
    place: &Place,
) -> Result<(Cost, Verdict), Box<dyn Error>> {
    let out = std::env::temp_dir().join(format!("azulejo-peers-{}.f64", std::process::id()));
    let mut costs: Vec<Cost> = Vec::new();
    while costs.is_empty() || (costs.len() < REPEATS && costs[0].seconds < SHORT) {
        costs.push(run_once(peer, count, radius, python, mesh, &out)?);
    }
    costs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let verdict = judge(&out, place, radius);
    std::fs::remove_file(&out)?;
    Ok((costs[costs.len() / 2], verdict?))
}

fn run_once(
    peer: &Peer,
    count: usize,
    radius: f64,
    python: &Path,
    mesh: Option<&Path>,
    out: &PathBuf,
) -> Result<Cost, Box<dyn Error>> {
    let mut command = match peer.language {
        Rust => {
            let mut command = Command::new(std::env::current_exe()?);
            command.arg("one");
            command
        }
        Python => {
            let mut command = Command::new(python);
            command.arg("studies/peers/peers.py");
            command
        }
    };
    command.args([peer.name, &count.to_string(), &radius.to_string()]).arg(out).args(mesh);
    let output = command.output()?;
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        return Err(complaint.lines().last().unwrap_or("no word").to_owned().into());
    }
    // Some libraries print, too: what counts is the last line.
    let printed = String::from_utf8(output.stdout)?;
    let numbers: Vec<f64> = printed.lines().last().unwrap_or_default().split(' ').flat_map(str::parse).collect();
    match numbers[..] {
        [seconds, busy, megabytes] => Ok(Cost { seconds, busy, megabytes }),
        _ => Err(format!("{} printed {printed:?}", peer.name).into()),
    }
}
