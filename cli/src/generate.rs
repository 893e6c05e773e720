//! `azulejo plane`, `surface` and `relax`: the samplers of the library, from files and into files.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use azulejo::dcr::{self, Neighbourhood, surface};
use azulejo::kdrt::{self, CountOptions};
use azulejo::mesh::Mesh;
use azulejo::{Context, Domain, Error, Result, psp};
use clap::{Args, ValueEnum};

use crate::domain::DomainArgs;
use crate::formats::{Coordinates, Destination, Input, PointFile, PointSet, blame};
use crate::output::Output;
use crate::progress::watched;
use crate::text::{grouped, rounded};

/// N·r²/A of a maximal Poisson-disk set: the jamming limit of random sequential placement (Zhang and Torquato 2013).
pub const MAXIMAL_DENSITY: f64 = 0.69656;

/// How dense a set of the plane shall be.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct RadiusOrCount {
    /// The smallest distance between samples.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// Exactly how many samples there shall be.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,
}

/// How dense a set of a surface shall be.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct Density {
    /// The smallest distance between samples.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// About how many samples there shall be: the radius is that of a maximal set of so many on a plane of the same
    /// area. Most often 2 to 10 % fewer fit, and down to half as many where parts of the surface are nearer to each
    /// other than the radius.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,
}

impl Density {
    fn radius(&self, area: f64) -> f64 {
        let of_count = |count: u64| (MAXIMAL_DENSITY * area / count as f64).sqrt();
        self.radius.or(self.count.map(of_count)).unwrap_or(f64::NAN)
    }
}

/// What all samplers have.
#[derive(Args)]
pub struct Common {
    #[command(flatten)]
    pub destination: Destination,
    /// Another seed gives another set of the same kind.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
}

#[derive(Args)]
#[command(mut_arg("domain", |domain| domain.help("The corners of the rectangle [default: the unit square]")))]
pub struct Plane {
    #[command(flatten)]
    density: RadiusOrCount,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    domain: DomainArgs,
    /// The size of the tiles of which the plane is made, in radii.
    #[arg(long, value_name = "RADII", default_value_t = kdrt::DEFAULT_LEAF_SIZE, allow_negative_numbers = true)]
    leaf_size: f64,
}

impl Plane {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open()?;
        let domain = self.domain.or_unit();
        let start = Instant::now();
        let (points, about) = match self.density.count {
            Some(count) => self.exactly(count, context, domain)?,
            None => self.at(self.density.radius.unwrap_or(f64::NAN), context, domain)?,
        };
        let seconds = start.elapsed().as_secs_f64();
        output.write_plane(&domain, &points)?;
        report(&output.output, points.len(), &about, seconds);
        Ok(())
    }

    /// A set of this radius, and what is to be said of it.
    fn at(&self, radius: f64, context: &Context, domain: Domain) -> Result<(Vec<[f32; 2]>, String)> {
        let options = kdrt::Options::new(radius).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let points = watched("plane", |progress| kdrt::sample(context, &options, Some(progress)))?;
        Ok((points, format!("radius {}", rounded(radius, 4))))
    }

    /// A set of this many samples, and what is to be said of it.
    fn exactly(&self, count: u64, context: &Context, domain: Domain) -> Result<(Vec<[f32; 2]>, String)> {
        let options = CountOptions::new(count).domain(domain).leaf_size(self.leaf_size).seed(self.common.seed);
        let made = watched("plane", |progress| kdrt::sample_count(context, &options, Some(progress)))?;
        let maximal = if made.report.is_maximal { "" } else { ", not maximal" };
        Ok((made.samples, format!("radius {}{maximal}", rounded(made.report.radius, 4))))
    }
}

#[derive(Args)]
pub struct Surface {
    /// The mesh: OBJ, PLY or STL.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    #[command(flatten)]
    density: Density,
    #[command(flatten)]
    common: Common,
    /// How often to project patterns from three directions.
    #[arg(long, value_name = "N", default_value_t = psp::DEFAULT_ITERATIONS)]
    iterations: u32,
    /// Leave uncovered what the projections leave uncovered.
    #[arg(long)]
    no_fill: bool,
    /// The normals of the samples.
    #[arg(long, value_enum, default_value = "geometric")]
    normals: Normals,
    /// Which candidates come first where two are too close.
    #[arg(long, value_enum, default_value = "squareness")]
    priority: Priority,
    /// What finds the places that the patterns are projected to.
    #[arg(long, value_enum, default_value = "embree")]
    engine: Engine,
}

#[derive(Clone, Copy, ValueEnum)]
enum Priority {
    /// Those that their projector faces more squarely: the faster.
    Squareness,
    /// Those of the projector with the lower number, as in the thesis: half the bias.
    Projector,
}

#[derive(Clone, Copy, ValueEnum)]
enum Engine {
    /// Ray packets.
    Embree,
    /// Triangles drawn over the patterns.
    Rasteriser,
}

impl From<Priority> for psp::Priority {
    fn from(priority: Priority) -> Self {
        match priority {
            Priority::Squareness => Self::Squareness,
            Priority::Projector => Self::Projector,
        }
    }
}

impl From<Engine> for psp::Engine {
    fn from(engine: Engine) -> Self {
        match engine {
            Engine::Embree => Self::Embree,
            Engine::Rasteriser => Self::Rasteriser,
        }
    }
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Normals {
    /// Those of their triangles.
    Geometric,
    /// Those of the mesh's corners or vertices, interpolated; the file has to have some.
    Interpolated,
}

impl Surface {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open()?;
        let mesh = Arc::new(Mesh::load(&self.mesh)?);
        if self.normals == Normals::Interpolated && !mesh.has_normals() {
            let reason = format!("{} has none to be interpolated", self.mesh.display());
            return Err(Error::InvalidArgument { argument: "--normals", reason });
        }
        let radius = self.density.radius(mesh.area());
        let options = psp::Options::new(radius)
            .iterations(self.iterations)
            .maximal(!self.no_fill)
            .seed(self.common.seed)
            .priority(self.priority.into())
            .engine(self.engine.into());
        let (samples, done) = watched("surface", |progress| psp::sample(context, &mesh, &options, Some(progress)))?;
        let normals = match self.normals {
            Normals::Geometric => &samples.normals,
            Normals::Interpolated => &samples.interpolated_normals,
        };
        output.write_surface(&samples, normals)?;
        let asked = self.density.count.map(|count| compared(samples.len(), count)).unwrap_or_default();
        let about = format!("{asked}radius {}", rounded(radius, 4));
        report(&output.output, samples.len(), &about, done.seconds);
        Ok(())
    }
}

#[derive(Args)]
pub struct Relax {
    /// The set: a .ply, .npy, .csv, .xyz or .raw file, or with --mesh a .ply or .csv file that `azulejo surface` has written.
    #[arg(value_name = "POINTS")]
    input: PathBuf,
    #[command(flatten)]
    format: Input,
    #[command(flatten)]
    common: Common,
    /// The mesh that the samples are on, and stay on: OBJ, PLY or STL.
    #[arg(long, value_name = "MESH", conflicts_with_all = ["domain", "bounded", "neighbourhood"])]
    mesh: Option<PathBuf>,
    #[command(flatten)]
    domain: DomainArgs,
    /// Which points keep each other at a distance.
    #[arg(long, value_enum, default_value = "delaunay")]
    neighbourhood: Neighbours,
    /// The largest number of steps [default: as many as the library takes].
    #[arg(long, value_name = "STEPS")]
    iterations: Option<u32>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Neighbours {
    /// Those of the Delaunay triangulation.
    Delaunay,
    /// The nearest few.
    Nearest,
}

impl Relax {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open()?;
        let set = self.format.read(&self.input, Coordinates::Plane)?;
        if let Some(mesh) = &self.mesh {
            return self.run_on(context, mesh, &set, &output);
        }
        let domain = self.domain.of(&set).ok_or_else(|| Error::Format {
            path: self.input.clone(),
            reason: match set.on_mesh {
                Some(_) => "holds samples of a mesh: give --mesh",
                None => "does not name its domain, and does not fill the unit square: give --domain",
            }
            .to_owned(),
        })?;
        let neighbourhood = match self.neighbourhood {
            Neighbours::Delaunay => Neighbourhood::Delaunay,
            Neighbours::Nearest => Neighbourhood::Nearest,
        };
        let mut options = dcr::Options::new(domain, neighbourhood);
        options.seed = self.common.seed;
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let points = set.plane_positions();
        let start = Instant::now();
        let (relaxed, done) = watched("relax", |progress| dcr::relax(context, &options, &points, Some(progress)))
            .map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        output.write_plane(&domain, &relaxed)?;
        let about = format!("{} steps, smallest distance {}", done.iterations, rounded(done.smallest_distance, 4));
        report(&output.output, relaxed.len(), &about, seconds);
        Ok(())
    }
}

/// Relaxation on a mesh.
impl Relax {
    fn run_on(&self, context: &Context, mesh: &Path, set: &PointSet, output: &PointFile) -> Result<()> {
        let mesh = Mesh::load(mesh)?;
        let (triangles, barycentrics) = set.on_mesh.as_ref().ok_or_else(|| Error::Format {
            path: self.input.clone(),
            reason: "does not say on which triangle each sample is, and where: no triangle, u and v".to_owned(),
        })?;
        let mut options = surface::Options::default().seed(self.common.seed);
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let (relaxed, done) = watched("relax", |progress| {
            surface::relax(context, &mesh, triangles, barycentrics, &options, Some(progress))
        })
        .map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        output.write_surface(&relaxed, &relaxed.normals)?;
        let about = format!("{} steps, smallest distance {}", done.iterations, rounded(done.smallest_distance, 4));
        report(&output.output, relaxed.len(), &about, seconds);
        Ok(())
    }
}

/// How near a count is to the one that was asked for; nothing where it is that.
pub fn compared(count: usize, asked: u64) -> String {
    if count as u64 == asked {
        return String::new();
    }
    let excess = count as f64 / asked as f64 - 1.0;
    let (percent, how) = (rounded(100.0 * excess.abs(), 2), if excess < 0.0 { "fewer" } else { "more" });
    format!("{percent} % {how} than asked for, ")
}

/// Says how many samples were written, and how they were made.
pub fn report(output: &Output, count: usize, about: &str, seconds: f64) {
    let samples = if count == 1 { "sample" } else { "samples" };
    output.report(&format!("{} {samples}, {about}, {seconds:.2} s", grouped(count)));
}
