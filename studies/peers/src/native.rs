//! The peers that are written in Rust, and azulejo itself.

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::thin::{self, thin};
use azulejo::{Boundary, Context, Domain, Order, dcr, kdrt, maximal, psp};
use rand_06::SeedableRng as _;

use crate::elimination;
use crate::peers::DENSITY;
use crate::space;
use crate::timing::{Cost, timed};

/// Runs the peer of this name, writes its samples as raw doubles and prints what it cost.
pub fn run(name: &str, count: usize, radius: f64, out: &Path, mesh: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let (samples, cost) = match (name, mesh) {
        ("azulejo_plane_1", _) => plane(&Context::new(1)?, radius),
        ("azulejo_plane", _) => plane(&Context::new(0)?, radius),
        ("azulejo_maximal", _) => reference(radius),
        ("azulejo_relaxed", _) => relaxed(count),
        ("azulejo_surface_1", Some(mesh)) => surface(&Context::new(1)?, mesh, psp::Options::new(radius))?,
        ("azulejo_surface", Some(mesh)) => surface(&Context::new(0)?, mesh, psp::Options::new(radius))?,
        ("azulejo_counted", Some(mesh)) => surface(&Context::new(0)?, mesh, psp::Options::by_count(count))?,
        ("azulejo_farthest_1", Some(cloud)) => farthest(&Context::new(1)?, cloud, count)?,
        ("azulejo_farthest", Some(cloud)) => farthest(&Context::new(0)?, cloud, count)?,
        ("azulejo_greedy_1", Some(cloud)) => thinned(&Context::new(1)?, cloud, thin::Options::by_radius(radius))?,
        ("elimination", Some(cloud)) => eliminated(cloud, count, radius, false)?,
        ("elimination_ordered", Some(cloud)) => eliminated(cloud, count, radius, true)?,
        ("bluenoise", _) => bluenoise(radius),
        ("fast_poisson", _) => fast_poisson(radius),
        ("poisson_bridson", _) => poisson(radius, poisson::algorithm::Bridson),
        ("poisson_ebeida", _) => poisson(radius, poisson::algorithm::Ebeida),
        ("fast_poisson_cuboid", _) => space::fast_poisson(radius),
        ("fast_poisson_inside", Some(mesh)) => space::fast_poisson_inside(mesh, radius)?,
        ("poisson_diskus", _) => space::poisson_diskus(radius),
        ("poisson_bridson_cuboid", _) => space::poisson(radius, poisson::algorithm::Bridson),
        ("poisson_ebeida_cuboid", _) => space::poisson(radius, poisson::algorithm::Ebeida),
        _ => return Err(format!("{name} is no peer, or needs a mesh").into()),
    };
    let mut file = BufWriter::new(File::create(out)?);
    for value in samples {
        file.write_all(&value.to_le_bytes())?;
    }
    println!("{} {} {}", cost.seconds, cost.busy, cost.megabytes);
    Ok(file.flush()?)
}

pub type Run = (Vec<f64>, Cost);

/// Coordinates, one after the other.
pub fn flat<const N: usize, T: Into<f64> + Copy>((points, cost): (Vec<[T; N]>, Cost)) -> Run {
    (points.iter().flatten().map(|&value| value.into()).collect(), cost)
}

fn domain() -> Domain {
    Domain::unit(Boundary::Bounded)
}

fn plane(context: &Context, radius: f64) -> Run {
    let options = kdrt::Options::new(radius).domain(domain()).seed(1);
    flat(timed(|| kdrt::sample(context, &options, None).expect("a plane").positions))
}

fn reference(radius: f64) -> Run {
    let options = maximal::Options::new(radius).domain(domain()).seed(1);
    let context = Context::new(1).expect("one thread");
    flat(timed(|| maximal::sample(&context, &options, None).expect("a plane").positions))
}

/// From random points, as the Lloyd relaxations that it is compared with.
fn relaxed(count: usize) -> Run {
    use rand_09::{Rng, SeedableRng};
    let mut random = rand_09::rngs::SmallRng::seed_from_u64(1);
    let start: Vec<[f32; 2]> = (0..count).map(|_| random.random()).collect();
    let context = Context::new(0).expect("threads");
    let options = dcr::Options::new(domain(), dcr::Neighbourhood::Delaunay);
    flat(timed(|| dcr::relax(&context, &options, &start, None).expect("points of the domain").0))
}

fn surface(context: &Context, mesh: &Path, options: psp::Options) -> Result<Run, Box<dyn Error>> {
    let (mesh, options) = (Arc::new(Mesh::load(mesh)?), options.seed(1));
    let (sampled, cost) = timed(|| psp::sample(context, &mesh, &options, None));
    Ok(flat((sampled?.0.positions, cost)))
}

fn farthest(context: &Context, cloud: &Path, count: usize) -> Result<Run, Box<dyn Error>> {
    thinned(context, cloud, thin::Options::by_count(count).order(Order::Progressive))
}

fn points_of(cloud: &Path) -> Result<Vec<[f32; 3]>, Box<dyn Error>> {
    let bytes = std::fs::read(cloud)?;
    let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().expect("8 bytes")) as f32;
    let numbers: Vec<f32> = bytes.chunks_exact(8).map(number).collect();
    Ok(numbers.as_chunks().0.to_vec())
}

/// The radius stands for the area that the points lie on.
fn eliminated(cloud: &Path, count: usize, radius: f64, ordered: bool) -> Result<Run, Box<dyn Error>> {
    let (points, area) = (points_of(cloud)?, radius * radius * count as f64 / DENSITY);
    let (chosen, cost) = timed(|| {
        let chosen = elimination::eliminate(&points, area, count);
        if ordered { elimination::ordered(&points, area, &chosen) } else { chosen }
    });
    Ok(flat((chosen.iter().map(|&index| points[index as usize]).collect::<Vec<_>>(), cost)))
}

fn thinned(context: &Context, cloud: &Path, options: thin::Options) -> Result<Run, Box<dyn Error>> {
    let points = points_of(cloud)?;
    let (selected, cost) = timed(|| thin(context, &options, &points, None));
    let chosen = selected?.indices.iter().map(|&index| points[index as usize]).collect::<Vec<_>>();
    Ok(flat((chosen, cost)))
}

fn bluenoise(radius: f64) -> Run {
    use bluenoise::BlueNoise;
    flat(timed(|| {
        let mut points = BlueNoise::<rand_09::rngs::SmallRng>::from_seed(1.0, 1.0, radius as f32, 1);
        points.by_ref().map(|point| [point.x, point.y]).collect::<Vec<[f32; 2]>>()
    }))
}

fn fast_poisson(radius: f64) -> Run {
    flat(timed(|| fast_poisson::Poisson2D::new().with_dimensions([1.0, 1.0], radius).with_seed(1).generate()))
}

/// Its radius is that of disks that do not overlap: half of what it is elsewhere.
fn poisson<A>(radius: f64, algorithm: A) -> Run
where
    A: poisson::algorithm::Creator<f64, nalgebra::Vector2<f64>>,
{
    let random = rand_06::rngs::SmallRng::seed_from_u64(1);
    let builder = poisson::Builder::<f64, nalgebra::Vector2<f64>>::with_radius(radius / 2.0, poisson::Type::Normal);
    flat(timed(|| builder.build(random, algorithm).generate().iter().map(|p| [p.x, p.y]).collect::<Vec<[f64; 2]>>()))
}
