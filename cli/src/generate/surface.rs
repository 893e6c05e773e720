//! `azulejo surface`: maximal Poisson-disk sets of meshes, of one radius, of a radius for each vertex, or of several
//! classes.

use std::path::PathBuf;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Density as MeshDensity, Radius, Scale};
use azulejo::{Classes, Context, Error, Given, Points, Progress, Result, psp};
use clap::{Args, ValueEnum};
use serde_json::json;

use super::around::Around;
use super::attributes::{MeshFile, mask_of_text};
use super::{Common, Sequence, count, covered, of_radii, of_radius, report};
use crate::formats::surface::SurfaceTable;
use crate::formats::{blame, read_given};
use crate::output::Report;
use crate::progress::watched;
use crate::text::rounded;

/// The density of a set of a surface.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct Density {
    /// The smallest distance between samples: above 0, and at least 64 float spacings at the largest coordinate.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The exact number of samples, such as 65536 or 1e6: the radius is found. The gaps are always filled, without
    /// iterations.
    #[arg(long, value_name = "N", value_parser = count::<usize>, conflicts_with_all = ["iterations", "no_fill"])]
    count: Option<usize>,
    /// Several classes of samples with their own radii, such as 1,0.5,0.25. The distance of samples of two classes
    /// follows from their radii (Wei 2010). The output has the class of each sample, from 0 on, except in XYZ. With
    /// --density-from they are the radii at density 1.
    #[arg(long, value_name = "R,..", value_delimiter = ',', allow_negative_numbers = true, conflicts_with_all = NOT_OF_CLASSES)]
    classes: Option<Vec<f64>>,
    /// The name of a vertex attribute of a PLY mesh that holds the radius there, for adaptive sampling. The distance of
    /// two samples is at least the mean of their radii. The output has the radius of each sample, except in XYZ.
    #[arg(long, value_name = "ATTRIBUTE")]
    radius_from: Option<String>,
}

/// The arguments that adaptive sampling refuses.
const OF_ONE_RADIUS: [&str; 2] = ["radius_from", "density_from"];

/// The arguments that give the density of a single class.
const OF_ONE_CLASS: [&str; 3] = ["radius", "count", "radius_from"];

/// The arguments that sets of several classes refuse.
const NOT_OF_CLASSES: [&str; 5] = ["iterations", "no_fill", "projectors", "priority", "engine"];

#[derive(Args)]
pub struct Surface {
    /// The mesh: OBJ, PLY, STL, OFF or GLB.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    #[command(flatten)]
    density: Density,
    /// The factor of the radii between samples of different classes, 0 or more; 1 gives those of Wei 2010. A smaller
    /// factor gives each class more samples, and lets two classes come nearer to each other.
    #[arg(long, value_name = "F", default_value_t = 1.0, allow_negative_numbers = true, conflicts_with_all = OF_ONE_CLASS)]
    class_factor: f64,
    /// The names of face attributes of a PLY mesh, one for each class, such as is_wet,is_steep: faces where it is 0 get
    /// no samples of the class.
    #[arg(long, value_name = "ATTRIBUTE,..", value_delimiter = ',', conflicts_with_all = OF_ONE_CLASS)]
    class_masks: Option<Vec<String>>,
    /// The name of a vertex attribute of a PLY mesh that holds the density there, in any unit, 0 or more; where it is 0
    /// there are no samples. --radius is the radius at density 1, and so are those of --classes; --count the number of
    /// samples, which is exact in progressive order and approximate otherwise. The output has the radius of each sample,
    /// except in XYZ.
    #[arg(long, value_name = "ATTRIBUTE", conflicts_with = "radius_from")]
    density_from: Option<String>,
    /// The name of a face attribute of a PLY mesh. Faces where it is 0 are not sampled.
    #[arg(long, value_name = "ATTRIBUTE")]
    mask: Option<String>,
    /// A text file with a number for each triangle, separated by white space: 1 to sample it, 0 to leave it out. A
    /// polygon counts as the triangles of its fan.
    #[arg(long, value_name = "FILE", conflicts_with = "mask")]
    mask_file: Option<PathBuf>,
    /// Existing points, x y z each: a .ply, .npy, .csv, .xyz or .raw file. They stay, cover the area within their
    /// clearance, and are not written. The clearance of a point is in the column `clearance` or, without one, `radius`;
    /// without either it is the radius of the set.
    #[arg(long, value_name = "FILE")]
    given: Option<PathBuf>,
    /// The clearance of all points of `--given`, in place of the columns of their file.
    #[arg(long, value_name = "C", requires = "given", allow_negative_numbers = true)]
    clearance: Option<f64>,
    /// Samples on triangles whose normals have a smaller cosine ignore each other: both sides of a thin wall are
    /// sampled. From -1, which is off, to 1. Faces must be wound consistently.
    #[arg(long, value_name = "COSINE", default_value_t = -1.0, allow_negative_numbers = true)]
    cosine: f64,
    #[command(flatten)]
    common: Common,
    /// The number of projections of patterns onto the whole mesh before gaps are filled [default: 1 where it takes less
    /// time or with --no-fill, otherwise 0].
    #[arg(long, value_name = "N", conflicts_with_all = OF_ONE_RADIUS)]
    iterations: Option<u32>,
    /// Leaves the gaps that remain after the iterations.
    #[arg(long, conflicts_with_all = OF_ONE_RADIUS)]
    no_fill: bool,
    /// The order of the samples. In progressive order the output has the rank of each sample, except in XYZ: with
    /// --radius-from the factor of the radii of a prefix, with --density-from the radius at density 1.
    #[arg(long, value_enum, default_value = "any", conflicts_with_all = ["iterations", "no_fill"])]
    order: Sequence,
    /// Progressive order: every prefix of 100 samples and more covers the mesh within this times its last rank, 1.02 to
    /// 1.5 [default: 2^(1/8)].
    #[arg(long, value_name = "Q", requires = "order", allow_negative_numbers = true)]
    quotient: Option<f64>,
    /// The normals of the samples.
    #[arg(long, value_enum, default_value = "geometric")]
    normals: Normals,
    /// The projectors of an iteration.
    #[arg(long, value_enum, default_value = "local", conflicts_with_all = OF_ONE_RADIUS)]
    projectors: Projectors,
    /// The candidate that is kept of two that conflict.
    #[arg(long, value_enum, default_value = "squareness", conflicts_with_all = OF_ONE_RADIUS)]
    priority: Priority,
    /// The engine that finds the points of the mesh to which patterns are projected.
    #[arg(long, value_enum, default_value = "auto", conflicts_with_all = OF_ONE_RADIUS)]
    engine: Engine,
}

#[derive(Clone, Copy, ValueEnum)]
enum Projectors {
    /// One for each part of the mesh that faces about one direction.
    Local,
    /// Three orthogonal ones for the whole mesh, as in the thesis.
    Global,
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
    /// The rasteriser for local projectors, Embree for global ones where a build has it.
    Auto,
    /// Ray packets.
    Embree,
    /// Triangles drawn over the patterns.
    Rasteriser,
}

impl From<Projectors> for psp::Projectors {
    fn from(projectors: Projectors) -> Self {
        match projectors {
            Projectors::Local => Self::Local,
            Projectors::Global => Self::Global,
        }
    }
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
            Engine::Auto => Self::Auto,
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

/// The samples, their radii if they differ, and what is reported about them.
struct Made {
    samples: Points<3>,
    radii: Option<Vec<f64>>,
    /// The radius of each class, or of all samples, where `radii` has none.
    class_radii: Vec<f64>,
    about: Report,
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
        let origin = mesh.origin();
        let around = self.around(origin)?;
        let made = match (&self.density.radius_from, &self.density_from) {
            _ if self.density.classes.is_some() => self.of_classes(context, mesh, &file, &around),
            (Some(attribute), _) => self.adaptive(context, &mesh, &file, (attribute, None), around.given()),
            (None, Some(attribute)) => {
                let scale = match (self.density.radius, self.density.count) {
                    (Some(radius), _) => Scale::Radius(radius),
                    (None, count) => Scale::Count(count.unwrap_or_default() as f64),
                };
                self.adaptive(context, &mesh, &file, (attribute, Some(scale)), around.given())
            }
            (None, None) => self.uniform(context, mesh, around.given()),
        };
        let Made { samples, radii, class_radii, about, seconds } = made.map_err(|error| match &self.given {
            Some(path) => blame(path, error),
            None => error,
        })?;
        let normals = match self.normals {
            Normals::Geometric => &samples.normals,
            Normals::Interpolated => &samples.interpolated_normals,
        };
        output.write_surface(&SurfaceTable {
            samples: &samples,
            normals,
            radii: radii.as_deref(),
            class_radii: &class_radii,
            origin,
        })?;
        report(&output.output, samples.len(), about, seconds);
        Ok(())
    }

    /// The given points.
    fn around(&self, origin: [f64; 3]) -> Result<Around<3>> {
        let Some(path) = &self.given else { return Ok(Around::default()) };
        let given = read_given(path, origin)?;
        Ok(Around::new(given.positions, given.clearances, self.clearance))
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
    fn uniform(&self, context: &Context, mesh: Mesh, given: Given<3>) -> Result<Made> {
        let radius = if self.density.count.is_some() { 0.0 } else { self.density.radius.unwrap_or(f64::NAN) };
        let options = psp::FlatOptions::new(radius)
            .count(self.density.count.unwrap_or(0))
            .order(self.order.into())
            .quotient(self.quotient.unwrap_or(psp::DEFAULT_QUOTIENT))
            .iterations(self.iterations)
            .maximal(!self.no_fill)
            .seed(self.common.seed)
            .projectors(self.projectors.into())
            .priority(self.priority.into())
            .engine(self.engine.into())
            .given(given)
            .cosine(self.cosine);
        let mesh = Arc::new(mesh);
        let (samples, done) = watched("surface", |progress| options.sample(context, &mesh, Some(progress)))?;
        let coverage = done.covering_radius.map(|coverage| covered(done.radius, coverage));
        let about = of_radius(done.radius).and(coverage.unwrap_or_default());
        Ok(Made { samples, radii: None, class_radii: vec![done.radius], about, seconds: done.seconds })
    }

    /// The bits of the classes that each triangle may have.
    fn class_masks(&self, file: &MeshFile, classes: usize) -> Result<Option<Vec<u32>>> {
        let Some(attributes) = &self.class_masks else { return Ok(None) };
        if attributes.len() != classes {
            let reason = format!("{} attributes for {classes} classes", attributes.len());
            return Err(Error::InvalidArgument { argument: "--class-masks", reason });
        }
        let masks = attributes.iter().map(|attribute| file.face_mask(attribute)).collect::<Result<Vec<_>>>()?;
        let of_triangle = |triangle: usize| {
            let allowed = (0..).zip(&masks).filter(|(_, mask)| mask[triangle]);
            allowed.fold(0, |bits, (class, _)| bits | 1u32 << class)
        };
        Ok(Some((0..masks.first().map_or(0, Vec::len)).map(of_triangle).collect()))
    }

    /// Samples of several classes, by their own radii, on the triangles of their masks; if there is a density, by multiples
    /// of these radii that follow from it.
    fn of_classes(&self, context: &Context, mesh: Mesh, file: &MeshFile, around: &Around<3>) -> Result<Made> {
        let own = self.density.classes.as_deref().unwrap_or_default();
        let classes = Classes::of_radii(own, self.class_factor)?;
        let masks = self.class_masks(file, own.len())?;
        let around = around.of_classes(own.len());
        let attribute = self.density_from.as_deref();
        let density = attribute.map(|attribute| file.vertex_values(attribute)).transpose()?;
        let unit = density
            .as_ref()
            .map(|values| Radius::Density { density: MeshDensity::PerVertex(values), scale: Scale::Radius(1.0) });
        let options = psp::ClassOptions::default()
            .order(self.order.into())
            .quotient(self.quotient.unwrap_or(psp::DEFAULT_QUOTIENT))
            .seed(self.common.seed)
            .given(around.given())
            .cosine(self.cosine)
            .unit(unit);
        let mesh = Arc::new(mesh);
        let sample = |progress: &Progress| {
            psp::sample_classes(context, &mesh, &options, &classes, masks.as_deref(), Some(progress))
        };
        let made = watched("surface", sample);
        let (mut samples, done) = made.map_err(|error| file.blame(attribute, error))?;
        let radius = |(&class, unit): (&u32, f64)| own[class as usize] * unit;
        let radii =
            attribute.map(|_| samples.classes.iter().zip(std::mem::take(&mut samples.radii)).map(radius).collect());
        let count = |class: usize| samples.classes.iter().filter(|&&other| other as usize == class).count();
        let at_density = if attribute.is_some() { " at density 1" } else { "" };
        let each = |class: usize| format!("{} of radius {}{at_density}", count(class), rounded(own[class], 4));
        let texts = (0..own.len()).map(each).collect::<Vec<_>>().join(", ");
        let object = |class: usize| json!({ "samples": count(class), "radius": own[class] });
        let about = Report::default().fact("classes", (0..own.len()).map(object).collect::<Vec<_>>(), texts);
        Ok(Made { samples, radii, class_radii: own.to_vec(), about, seconds: done.seconds })
    }

    /// Samples whose radii are interpolated from an attribute of the vertices or, with a scale, follow from the density
    /// that it is.
    fn adaptive(
        &self,
        context: &Context,
        mesh: &Mesh,
        file: &MeshFile,
        (attribute, scale): (&str, Option<Scale>),
        given: Given<3>,
    ) -> Result<Made> {
        let values = file.vertex_values(attribute)?;
        let radius = match scale {
            None => Radius::PerVertex(&values),
            Some(scale) => Radius::Density { density: MeshDensity::PerVertex(&values), scale },
        };
        let options = adaptive::Options::new(radius)
            .order(self.order.into())
            .quotient(self.quotient.unwrap_or(psp::DEFAULT_QUOTIENT))
            .seed(self.common.seed)
            .cosine(self.cosine)
            .given(given);
        let sample = |progress: &Progress| adaptive::sample(context, mesh, &options, Some(progress));
        let made = watched("surface", sample);
        let (mut made, done) = made.map_err(|error| file.blame(Some(attribute), error))?;
        let about = of_radii(&made.radii);
        let about = match (scale, done.radius) {
            (Some(_), radius) if radius > 0.0 => {
                about.fact("radius_at_density_1", radius, format!("{} at density 1", rounded(radius, 4)))
            }
            _ => about,
        };
        let radii = std::mem::take(&mut made.radii);
        Ok(Made { samples: made, radii: Some(radii), class_radii: Vec::new(), about, seconds: done.seconds })
    }
}
