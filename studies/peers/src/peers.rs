//! Who is measured, on what, and the runs.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use azulejo::mesh::Mesh;
use rand_09::rngs::SmallRng;
use rand_09::{Rng, SeedableRng};

use crate::judge::{Place, Verdict, judge};
use crate::timing::Cost;

/// The jamming limit: N * radius^2 / area of a maximal set.
pub const DENSITY: f64 = 0.69656;

/// The peers of a table take turns so many times, each call in a process of its own, and the best counts.
pub const ROUNDS: usize = 3;

#[derive(Clone, Copy, PartialEq)]
enum Language {
    Rust,
    Python,
    /// With a Python of its own, since its package needs other versions.
    Blender,
}

/// The task of a peer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// A smallest distance, which is then a promise.
    Radius,
    /// A number of samples.
    Count,
    /// A number of samples, in an order of which each beginning is well spread.
    Order,
}

struct Peer {
    /// As the tables call it.
    title: &'static str,
    name: &'static str,
    language: Language,
    asked: Asked,
    /// It is left out of tasks of more samples than this, to save time.
    most: usize,
}

const fn peer(title: &'static str, name: &'static str, language: Language, asked: Asked, most: usize) -> Peer {
    Peer { title, name, language, asked, most }
}

use Asked::{Count, Order, Radius};
use Language::{Blender, Python, Rust};

const PLANES: [Peer; 8] = [
    peer("**azulejo** KDRT, one thread", "azulejo_plane_1", Rust, Radius, usize::MAX),
    peer("**azulejo** KDRT", "azulejo_plane", Rust, Radius, usize::MAX),
    peer("**azulejo** maximal, one thread", "azulejo_maximal", Rust, Radius, usize::MAX),
    peer("bluenoise", "bluenoise", Rust, Radius, usize::MAX),
    peer("poisson, Bridson", "poisson_bridson", Rust, Radius, usize::MAX),
    peer("poisson, Ebeida", "poisson_ebeida", Rust, Radius, 100_000),
    peer("fast_poisson", "fast_poisson", Rust, Radius, 100_000),
    peer("scipy PoissonDisk", "poisson_disk", Python, Radius, 100_000),
];

const RELAXATIONS: [Peer; 4] = [
    peer("**azulejo** DCR, 100 steps", "azulejo_relaxed", Rust, Count, usize::MAX),
    peer("point-cloud-utils lloyd_2d, 100 steps", "lloyd_plane", Python, Count, usize::MAX),
    peer("blue-sampler nufft (for a torus)", "blue_sampler", Python, Count, usize::MAX),
    peer("scipy Halton, optimization=\"lloyd\"", "halton_lloyd", Python, Count, usize::MAX),
];

const SURFACES: [Peer; 10] = [
    peer("**azulejo** PSP, one thread", "azulejo_surface_1", Rust, Radius, usize::MAX),
    peer("**azulejo** PSP", "azulejo_surface", Rust, Radius, usize::MAX),
    peer("**azulejo** PSP, exactly so many", "azulejo_counted", Rust, Count, usize::MAX),
    peer("Open3D sample_points_poisson_disk", "open3d_elimination", Python, Count, usize::MAX),
    peer("PyMeshLab generate_sampling_poisson_disk", "meshlab", Python, Radius, usize::MAX),
    peer("point-cloud-utils sample_mesh_poisson_disk", "cloud_poisson_disk", Python, Radius, usize::MAX),
    peer("point-cloud-utils sample_mesh_lloyd", "cloud_lloyd", Python, Count, usize::MAX),
    peer("libigl blue_noise", "igl_blue_noise", Python, Radius, usize::MAX),
    peer("Blender Distribute Points on Faces, Poisson disk", "blender", Blender, Radius, usize::MAX),
    peer("trimesh sample_surface_even", "trimesh_even", Python, Radius, usize::MAX),
];

const CLOUDS: [Peer; 9] = [
    peer("**azulejo** thin, farthest-first, one thread", "azulejo_farthest_1", Rust, Order, usize::MAX),
    peer("**azulejo** thin, farthest-first", "azulejo_farthest", Rust, Order, usize::MAX),
    peer("fpsample bucket_fps_kdline_sampling", "fpsample_kdline", Python, Order, usize::MAX),
    peer("Open3D farthest_point_down_sample", "open3d_farthest", Python, Count, 10_000),
    peer(
        "Open3D sample_points_poisson_disk of the cloud (Yuksel 2015)",
        "open3d_elimination_of_cloud",
        Python,
        Count,
        usize::MAX,
    ),
    peer("Sample elimination (Yuksel 2015), written from the paper", "elimination", Rust, Count, usize::MAX),
    peer("The same, with its progressive order", "elimination_ordered", Rust, Order, usize::MAX),
    peer("**azulejo** thin, by radius, one thread", "azulejo_greedy_1", Rust, Radius, usize::MAX),
    peer("point-cloud-utils downsample_point_cloud_poisson_disk", "cloud_thinned", Python, Radius, usize::MAX),
];

/// The outcome of a task, or the reason why there is none.
pub struct Row {
    pub title: &'static str,
    pub asked: Asked,
    pub result: Result<Outcome, String>,
}

/// The outcome of a task.
pub struct Outcome {
    /// The least of all rounds, of each quantity.
    pub cost: Cost,
    /// The time of the slowest round.
    pub slowest: f64,
    pub verdict: Verdict,
}

/// The peers' work on one task.
pub struct Table {
    pub kind: Kind,
    /// The samples that the task is about.
    pub count: usize,
    pub radius: f64,
    pub rows: Vec<Row>,
    /// The titles of peers that were left out, to save time.
    pub absent: Vec<&'static str>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Plane,
    Relaxation,
    Surface,
    /// Thinning a cloud of ten times as many points.
    Cloud,
}

/// The Pythons that have the packages.
#[derive(clap::Args)]
pub struct Pythons {
    /// The one with most of them.
    #[arg(long)]
    python: PathBuf,
    /// The one with Blender.
    #[arg(long)]
    blender: PathBuf,
}

/// Runs all.
pub fn run_all(pythons: &Pythons, mesh_file: &Path) -> Result<Vec<Table>, Box<dyn Error>> {
    let mesh = Mesh::load(mesh_file)?;
    let square = |kind, peers, count| run_table(kind, peers, count, pythons, None, &Place::Square, 1.0);
    let surface = |count| {
        run_table(Kind::Surface, &SURFACES, count, pythons, Some(mesh_file), &Place::Surface(&mesh), mesh.area())
    };
    let cloud = |count: usize| {
        let file = std::env::temp_dir().join(format!("azulejo-cloud-{}.f64", std::process::id()));
        let points = write_cloud(&mesh, 10 * count, &file)?;
        let place = Place::Cloud(&points, mesh.area());
        let table = run_table(Kind::Cloud, &CLOUDS, count, pythons, Some(&file), &place, mesh.area());
        std::fs::remove_file(&file)?;
        table
    };
    Ok(vec![
        square(Kind::Plane, &PLANES, 1_000)?,
        square(Kind::Plane, &PLANES, 100_000)?,
        square(Kind::Plane, &PLANES, 1_000_000)?,
        square(Kind::Relaxation, &RELAXATIONS, 10_000)?,
        surface(10_000)?,
        surface(100_000)?,
        cloud(10_000)?,
        cloud(100_000)?,
    ])
}

/// A file with random points of a mesh, evenly on its surface: raw doubles.
fn write_cloud(mesh: &Mesh, count: usize, file: &Path) -> Result<Vec<[f64; 3]>, Box<dyn Error>> {
    let mut random = SmallRng::seed_from_u64(1);
    let mut ends = Vec::with_capacity(mesh.triangles().len());
    let mut total = 0.0;
    for triangle in 0..mesh.triangles().len() as u32 {
        total += mesh.triangle_area(triangle);
        ends.push(total);
    }
    let mut point = || {
        let place = random.random::<f64>() * total;
        let triangle = ends.partition_point(|&end| end <= place).min(ends.len() - 1);
        let [u, v]: [f32; 2] = random.random();
        let uv = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
        mesh.point(triangle as u32, uv).map(f64::from)
    };
    let points: Vec<[f64; 3]> = (0..count).map(|_| point()).collect();
    std::fs::write(file, points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>())?;
    Ok(points)
}

fn run_table(
    kind: Kind,
    peers: &[Peer],
    count: usize,
    pythons: &Pythons,
    mesh: Option<&Path>,
    place: &Place,
    area: f64,
) -> Result<Table, Box<dyn Error>> {
    let radius = (DENSITY * area / count as f64).sqrt();
    let (peers, absent): (Vec<&Peer>, Vec<&Peer>) = peers.iter().partition(|peer| count <= peer.most);
    let mut results: Vec<Result<Vec<Run>, String>> = peers.iter().map(|_| Ok(Vec::new())).collect();
    for round in 1..=ROUNDS {
        for (peer, result) in peers.iter().zip(&mut results) {
            let Ok(runs) = result else { continue };
            eprintln!("{count}: {}, round {round}", peer.name);
            match run_peer(peer, count, radius, pythons, mesh, place, runs.first().map(|run: &Run| run.1)) {
                Ok(run) => runs.push(run),
                Err(error) => *result = Err(error.to_string()),
            }
        }
    }
    let outcomes = results.into_iter().map(|result| result.map(Outcome::of));
    let row = |(peer, result): (&Peer, _)| Row { title: peer.title, asked: peer.asked, result };
    let rows = peers.into_iter().zip(outcomes).map(row).collect();
    Ok(Table { kind, count, radius, rows, absent: absent.into_iter().map(|peer| peer.title).collect() })
}

/// One call of a peer.
type Run = (Cost, Verdict);

impl Outcome {
    fn of(mut runs: Vec<Run>) -> Self {
        let least = |key: fn(&Cost) -> f64| runs.iter().map(|run| key(&run.0)).fold(f64::INFINITY, f64::min);
        let slowest = runs.iter().map(|run| run.0.seconds).fold(0.0, f64::max);
        let cost = Cost {
            seconds: least(|cost| cost.seconds),
            busy: least(|cost| cost.busy),
            megabytes: least(|cost| cost.megabytes),
        };
        Self { cost, slowest, verdict: runs.pop().expect("a round").1 }
    }
}

/// Runs a peer, and judges what it made if nothing is known of it: each round makes the same set, or its like.
fn run_peer(
    peer: &Peer,
    count: usize,
    radius: f64,
    pythons: &Pythons,
    mesh: Option<&Path>,
    place: &Place,
    known: Option<Verdict>,
) -> Result<Run, Box<dyn Error>> {
    let out = std::env::temp_dir().join(format!("azulejo-peers-{}.f64", std::process::id()));
    let cost = run_once(peer, count, radius, pythons, mesh, &out)?;
    let verdict = known.map_or_else(|| judge(&out, place, radius, peer.asked == Order), Ok);
    std::fs::remove_file(&out)?;
    Ok((cost, verdict?))
}

fn run_once(
    peer: &Peer,
    count: usize,
    radius: f64,
    pythons: &Pythons,
    mesh: Option<&Path>,
    out: &PathBuf,
) -> Result<Cost, Box<dyn Error>> {
    let mut command = match peer.language {
        Rust => {
            let mut command = Command::new(std::env::current_exe()?);
            command.arg("one");
            command
        }
        Python | Blender => {
            let python = if peer.language == Python { &pythons.python } else { &pythons.blender };
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
