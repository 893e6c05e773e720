//! azulejo beside others: the same task, in turns.

use azulejo::dcr::volume::{Options as RelaxOptions, relax};
use azulejo::volume::{InsideOptions, Options, Surface, sample, sample_inside};
use azulejo::{Boundary, Domain, Interior, Result};

use super::Scene;
use super::clock::timed;
use super::goals::radius;
use super::judged::{self, Judged, at_places};
use super::others::{Asked, CUBOIDS, INSIDES, Peer, Work};
use crate::reference::stream;

/// The work of a sampler on a task, or the reason why there is none.
pub struct Row {
    pub title: String,
    pub is_ours: bool,
    pub asked: Asked,
    pub result: std::result::Result<Outcome, String>,
}

pub struct Outcome {
    /// Processor microseconds of a sample: the least of all rounds, and the most over it.
    pub least: f64,
    pub spread: f64,
    pub judged: Judged,
}

/// The work of all on one task.
pub struct Table {
    /// The mesh whose inside is filled.
    pub mesh: Option<&'static str>,
    pub count: usize,
    pub radius: f64,
    pub volume: f64,
    pub rows: Vec<Row>,
    /// The titles of those that were left out to save time, and of those whose program was not given.
    pub slow: Vec<&'static str>,
    pub absent: Vec<&'static str>,
}

/// A call of azulejo's: its title, what is asked and what makes the samples.
type Ours<'a> = (&'static str, Asked, &'a dyn Fn() -> Result<Vec<[f32; 3]>>);

/// The calls of azulejo's on one thread in a row, so that the shortest can be timed.
const IN_A_ROW: f64 = 1e5;

fn cuboid() -> Domain<3> {
    Domain { min: [0.0; 3], max: [1.0; 3], boundary: Boundary::Bounded }
}

/// The unit cube without periodic boundary, about so many samples.
pub fn of_cuboid(scene: &Scene, count: usize) -> Result<Table> {
    let (one, radius) = (&scene.one, radius(1.0, count as f64));
    let maximal = || Ok(sample(one, &Options::new(radius).domain(cuboid()).seed(1), None)?.0.positions);
    let exact = || Ok(sample(one, &Options::by_count(count).domain(cuboid()).seed(1), None)?.0.positions);
    let mut unit = stream(1);
    let start: Vec<[f32; 3]> = (0..count).map(|_| std::array::from_fn(|_| unit())).collect();
    let relaxed = || Ok(relax(one, &RelaxOptions::new(cuboid()), &start, None)?.0);
    let ours: [Ours; 3] = [
        ("**azulejo** maximal", Asked::Radius, &maximal),
        ("**azulejo** exactly so many", Asked::Count, &exact),
        ("**azulejo** random points, relaxed in 100 steps", Asked::Count, &relaxed),
    ];
    let judge = |points: &[[f64; 3]]| judged::of_cuboid(scene.all, points, radius, scene.effort.probes);
    table(scene, None, (count, radius, 1.0), &ours, &CUBOIDS, &judge)
}

/// The inside of the mesh, about so many samples.
pub fn inside(scene: &Scene, count: usize) -> Result<Table> {
    let (name, mesh) = &scene.mesh;
    let places = places_inside(scene, 1)?;
    let (low, high) = mesh.bounds();
    let whole: f64 = low.iter().zip(&high).map(|(low, high)| f64::from(high - low)).product();
    let volume = whole * places.len() as f64 / scene.effort.probes as f64;
    let radius = radius(volume, count as f64);
    let filled = |options: &InsideOptions| Ok(sample_inside(&scene.one, mesh, options, None)?.0.positions);
    let open = || filled(&InsideOptions::new(radius).seed(1));
    let first = || filled(&InsideOptions::new(radius).surface(Surface::First).seed(1));
    let exact = || filled(&InsideOptions::by_count(count).seed(1));
    let ours: [Ours; 3] = [
        ("**azulejo** maximal", Asked::Radius, &open),
        ("**azulejo** maximal, the surface first", Asked::Radius, &first),
        ("**azulejo** exactly so many", Asked::Count, &exact),
    ];
    let judge = |points: &[[f64; 3]]| Ok(at_places(points, radius, &places, volume));
    table(scene, Some(name), (count, radius, volume), &ours, &INSIDES, &judge)
}

/// Random places inside of the mesh, of so many probes of the box around it.
pub fn places_inside(scene: &Scene, seed: u64) -> Result<Vec<[f64; 3]>> {
    let mesh = &scene.mesh.1;
    let (low, high) = mesh.bounds();
    let mut unit = stream(seed);
    let mut place = || std::array::from_fn(|axis| low[axis] + unit() * (high[axis] - low[axis]));
    let places: Vec<[f32; 3]> = (0..scene.effort.probes).map(|_| place()).collect();
    let is_inside = Interior::of(mesh).contains_each(scene.all, &places, None)?;
    Ok(places
        .iter()
        .zip(is_inside)
        .filter(|(_, is_inside)| *is_inside)
        .map(|(place, _)| place.map(f64::from))
        .collect())
}

fn table(
    scene: &Scene,
    mesh: Option<&'static str>,
    (count, radius, volume): (usize, f64, f64),
    ours: &[Ours],
    peers: &'static [Peer],
    judge: &dyn Fn(&[[f64; 3]]) -> Result<Judged>,
) -> Result<Table> {
    let file = mesh.is_some().then_some(scene.file.as_path());
    let run = |peer: &Peer| scene.programs.run(peer, count, radius, file);
    let (quick, slow): (Vec<&Peer>, Vec<&Peer>) = peers.iter().partition(|peer| count <= peer.most);
    let mut own: Vec<Vec<Work>> = ours.iter().map(|_| Vec::new()).collect();
    let mut others: Vec<Option<std::result::Result<Vec<Work>, String>>> =
        quick.iter().map(|_| Some(Ok(Vec::new()))).collect();
    for _ in 0..scene.effort.turns {
        for ((_, _, call), works) in ours.iter().zip(&mut own) {
            works.push(repeated(count, call)?);
        }
        for (peer, works) in quick.iter().zip(&mut others) {
            let Some(Ok(done)) = works else { continue };
            match run(peer) {
                None => *works = None,
                Some(Ok(work)) => done.push(work),
                Some(Err(error)) => *works = Some(Err(error.to_string())),
            }
        }
    }
    let mut rows = Vec::new();
    for ((title, asked, _), works) in ours.iter().zip(own) {
        let result = Ok(outcome(works, judge)?);
        rows.push(Row { title: (*title).to_owned(), is_ours: true, asked: *asked, result });
    }
    let mut absent = Vec::new();
    for (peer, works) in quick.iter().zip(others) {
        let Some(works) = works else {
            absent.push(peer.title);
            continue;
        };
        let result = match works {
            Ok(works) => Ok(outcome(works, judge)?),
            Err(reason) => Err(reason),
        };
        rows.push(Row { title: peer.title.to_owned(), is_ours: false, asked: peer.asked, result });
    }
    let slow = slow.iter().map(|peer| peer.title).collect();
    Ok(Table { mesh, count, radius, volume, rows, slow, absent })
}

/// A call, several times in a row where it is short: its mean processor time.
fn repeated(count: usize, call: &dyn Fn() -> Result<Vec<[f32; 3]>>) -> Result<Work> {
    let times = (IN_A_ROW / count as f64).ceil().clamp(1.0, 20.0) as usize;
    let (points, seconds) = timed(|| {
        for _ in 1..times {
            call()?;
        }
        call()
    })?;
    Ok((seconds / times as f64, points.iter().map(|point| point.map(f64::from)).collect()))
}

/// All rounds of a sampler; each makes the same set, or its like: the last is judged.
fn outcome(works: Vec<Work>, judge: &dyn Fn(&[[f64; 3]]) -> Result<Judged>) -> Result<Outcome> {
    let times = || works.iter().map(|(seconds, points)| 1e6 * seconds / points.len().max(1) as f64);
    let (least, most) = (times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max));
    let judged = judge(&works.last().expect("a round").1)?;
    Ok(Outcome { least, spread: most / least - 1.0, judged })
}
