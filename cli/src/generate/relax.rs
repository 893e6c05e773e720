//! `azulejo relax`: sets of the plane and samples of meshes, relaxed.

use std::path::{Path, PathBuf};
use std::time::Instant;

use azulejo::dcr::{self, Neighbourhood, surface};
use azulejo::{Context, Error, Progress, Result};
use clap::{Args, ValueEnum};

use super::{Common, report};
use crate::domain::DomainArgs;
use crate::formats::surface::SurfaceTable;
use crate::formats::{Input, ON_MESH, blame};
use crate::input;
use crate::progress::watched;
use crate::text::rounded;

#[derive(Args)]
pub struct Relax {
    /// The set: a .ply, .npy, .csv, .xyz or .raw file; with --mesh, a .ply, .npy or .csv file that `azulejo surface` wrote.
    #[arg(value_name = "POINTS")]
    input: PathBuf,
    #[command(flatten)]
    format: Input,
    #[command(flatten)]
    common: Common,
    /// The mesh that the samples lie on and stay on: OBJ, PLY or STL.
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
    /// The neighbours in the Delaunay triangulation.
    Delaunay,
    /// The nearest few points.
    Nearest,
}

impl Relax {
    pub fn run(&self, context: &Context) -> Result<()> {
        match &self.mesh {
            Some(mesh) => self.run_on(context, mesh),
            None => self.run_in_plane(context),
        }
    }

    fn run_in_plane(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open_plane()?;
        let set = self.format.read_plane(&self.input, ON_MESH)?;
        let domain = self.domain.of(&set).ok_or_else(|| Error::Format {
            path: self.input.clone(),
            reason: "does not name its domain, and does not fill the unit square: give --domain".to_owned(),
        })?;
        let neighbourhood = match self.neighbourhood {
            Neighbours::Delaunay => Neighbourhood::Delaunay,
            Neighbours::Nearest => Neighbourhood::Nearest,
        };
        let mut options = dcr::Options::new(domain, neighbourhood);
        options.seed = self.common.seed;
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let relax = |progress: &Progress| dcr::relax(context, &options, &set.points, Some(progress));
        let (relaxed, done) = watched("relax", relax).map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        output.write_plane(&domain, &relaxed)?;
        report(&output.output, relaxed.len(), &about(done.iterations, done.smallest_distance), seconds);
        Ok(())
    }

    /// Relaxation on a mesh.
    fn run_on(&self, context: &Context, mesh: &Path) -> Result<()> {
        let output = self.common.destination.open_surface()?;
        let set = self.format.read_samples(&self.input)?;
        let mesh = input::mesh(mesh)?;
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
        output.write_surface(&SurfaceTable { samples: &relaxed, normals: &relaxed.normals, radii: None })?;
        report(&output.output, relaxed.len(), &about(done.iterations, done.smallest_distance), seconds);
        Ok(())
    }
}

/// What is said of a relaxation.
fn about(steps: u32, smallest_distance: f64) -> String {
    format!("{steps} steps, smallest distance {}", rounded(smallest_distance, 4))
}
