//! `azulejo surface`: maximal Poisson-disk sets of meshes, of one radius or of a radius for each vertex.

use std::path::PathBuf;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Radius};
use azulejo::{Context, Error, MAXIMAL_DENSITY, Progress, Result, SurfaceSamples, psp};
use clap::{Args, ValueEnum};

use super::attributes::{MeshFile, mask_of_text};
use super::{Common, compared, count, report};
use crate::formats::surface::SurfaceTable;
use crate::progress::watched;
use crate::text::rounded;

/// The density of a set of a surface.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct Density {
    /// The smallest distance between samples.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The approximate number of samples, such as 65536 or 1e6: the radius is that of a maximal set of this size on a
    /// plane of the same area. Usually 2 to 10 % fewer fit, and down to half as many where parts of the surface are
    /// nearer to each other than the radius.
    #[arg(long, value_name = "N", value_parser = count::<u64>)]
    count: Option<u64>,
    /// The name of a vertex attribute of a PLY mesh that holds the radius there, for adaptive sampling. The distance of two
    /// samples is at least the mean of their radii. The output has the radius of each sample, except in XYZ.
    #[arg(long, value_name = "ATTRIBUTE")]
    radius_from: Option<String>,
}

#[derive(Args)]
pub struct Surface {
    /// The mesh: OBJ, PLY or STL.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    #[command(flatten)]
    density: Density,
    /// The name of a face attribute of a PLY mesh. Faces where it is 0 are not sampled.
    #[arg(long, value_name = "ATTRIBUTE")]
    mask: Option<String>,
    /// A text file with a number for each triangle, separated by white space: 1 to sample it, 0 to leave it out. A
    /// polygon counts as the triangles of its fan.
    #[arg(long, value_name = "FILE", conflicts_with = "mask")]
    mask_file: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
    /// How often to project patterns from three directions before the gaps are filled [default: 0, or 1 with --no-fill].
    #[arg(long, value_name = "N", conflicts_with = "radius_from")]
    iterations: Option<u32>,
    /// Do not fill the gaps that the projections leave.
    #[arg(long, conflicts_with = "radius_from")]
    no_fill: bool,
    /// Which normals the samples get.
    #[arg(long, value_enum, default_value = "geometric")]
    normals: Normals,
    /// Which candidates come first where two are too close.
    #[arg(long, value_enum, default_value = "squareness", conflicts_with = "radius_from")]
    priority: Priority,
    /// What finds the points of the mesh that the patterns are projected to.
    #[arg(long, value_enum, default_value = "embree", conflicts_with = "radius_from")]
    engine: Engine,
}

#[derive(Clone, Copy, ValueEnum)]
enum Priority {
    /// Candidates that their projector faces more squarely. This is faster.
    Squareness,
    /// Candidates of the projector with the lower number, as in the thesis. This halves the bias.
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
    /// The normals of their triangles.
    Geometric,
    /// The normals of the mesh's corners or vertices, interpolated; the file must have some.
    Interpolated,
}

/// Samples, their radii if they differ, and what is said of them.
struct Made {
    samples: SurfaceSamples,
    radii: Option<Vec<f64>>,
    about: String,
    seconds: f64,
}

impl Surface {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open_surface()?;
        let file = MeshFile::read(&self.mesh)?;
        let mesh = self.masked(&file)?;
        if self.normals == Normals::Interpolated && !mesh.has_normals() {
            let reason = format!("{} has none to be interpolated", self.mesh.display());
            return Err(Error::InvalidArgument { argument: "--normals", reason });
        }
        let Made { samples, radii, about, seconds } = match &self.density.radius_from {
            Some(attribute) => self.adaptive(context, &mesh, &file, attribute)?,
            None => self.uniform(context, mesh)?,
        };
        let normals = match self.normals {
            Normals::Geometric => &samples.normals,
            Normals::Interpolated => &samples.interpolated_normals,
        };
        output.write_surface(&SurfaceTable { samples: &samples, normals, radii: radii.as_deref() })?;
        report(&output.output, samples.len(), &about, seconds);
        Ok(())
    }

    /// The mesh without the triangles that are to be left out.
    fn masked(&self, file: &MeshFile) -> Result<Mesh> {
        let mesh = file.mesh()?;
        match (&self.mask, &self.mask_file) {
            (Some(attribute), _) => mesh.with_mask(file.face_mask(attribute)?),
            (None, Some(path)) => mesh.with_mask(mask_of_text(path)?).map_err(|error| match error {
                Error::InvalidArgument { reason, .. } => Error::Format { path: path.clone(), reason },
                other => other,
            }),
            (None, None) => Ok(mesh),
        }
    }

    /// Samples of one radius.
    fn uniform(&self, context: &Context, mesh: Mesh) -> Result<Made> {
        let of_count = |count: u64| (MAXIMAL_DENSITY * mesh.area() / count as f64).sqrt();
        let radius = self.density.radius.or(self.density.count.map(of_count)).unwrap_or(f64::NAN);
        let options = psp::Options::new(radius)
            .iterations(self.iterations)
            .maximal(!self.no_fill)
            .seed(self.common.seed)
            .priority(self.priority.into())
            .engine(self.engine.into());
        let mesh = Arc::new(mesh);
        let (samples, done) = watched("surface", |progress| psp::sample(context, &mesh, &options, Some(progress)))?;
        let asked = self.density.count.map(|count| compared(samples.len(), count)).unwrap_or_default();
        let about = format!("{asked}radius {}", rounded(radius, 4));
        Ok(Made { samples, radii: None, about, seconds: done.seconds })
    }

    /// Samples whose radii are interpolated from the radii of the vertices.
    fn adaptive(&self, context: &Context, mesh: &Mesh, file: &MeshFile, attribute: &str) -> Result<Made> {
        let radii: Vec<_> = file.vertex_attribute(attribute)?.into_iter().map(|radius| radius as f32).collect();
        let options = adaptive::Options::new(Radius::PerVertex(&radii)).seed(self.common.seed);
        let sample = |progress: &Progress| adaptive::sample(context, mesh, &options, Some(progress));
        let (made, done) = watched("surface", sample).map_err(|error| match error {
            Error::InvalidArgument { argument: "vertex_radii", reason } => file.error(attribute, &reason),
            other => other,
        })?;
        let ends = |choose: fn(f64, f64) -> f64| made.radii.iter().copied().reduce(choose).unwrap_or(f64::NAN);
        let [least, largest] = [ends(f64::min), ends(f64::max)].map(|radius| rounded(radius, 4));
        let about = format!("radii {least} to {largest}");
        Ok(Made { samples: made.samples, radii: Some(made.radii), about, seconds: done.seconds })
    }
}
