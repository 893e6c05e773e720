//! `azulejo volume`: maximal Poisson-disk sets of a cuboid, or of the inside of a mesh, of one radius or of radii on a grid.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::volume::adaptive::{self, Radius};
use azulejo::volume::{Amount, InsideOptions, Options, Surface, sample, sample_inside};
use azulejo::{Boundary, Context, Domain, Error, Points, Progress, Result};
use clap::Args;

use super::around::Around;
use super::{Common, Sequence, count, covered, of_radii, of_radius, report};
use crate::domain::CuboidArgs;
use crate::formats::points::PointTable;
use crate::formats::{blame, read_given, read_grid};
use crate::input;
use crate::output::Report;
use crate::progress::watched;
use crate::text::rounded;

/// The density of a set of a volume.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct Density {
    /// The smallest distance between samples: above 0, and at least 64 float spacings at the largest coordinate.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// The exact number of samples, such as 65536 or 1e6: the radius is found.
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    count: Option<usize>,
    /// An array of NumPy, .npy, of shape (z, y, x): radii above 0 on a grid over the cuboid, or over the box around the mesh, linear
    /// between them along each axis. The first and the last along an axis lie on the faces. The distance of two samples is
    /// at least the mean of their radii. The output has the radius of each sample, except in XYZ and raw floats.
    #[arg(long, value_name = "FILE", conflicts_with_all = OF_ONE_RADIUS)]
    radius_from: Option<PathBuf>,
}

/// The arguments that adaptive sampling refuses.
const OF_ONE_RADIUS: [&str; 7] = ["order", "quotient", "given", "clearance", "leaf_size", "surface_first", "thickness"];

#[derive(Args)]
pub struct Volume {
    #[command(flatten)]
    density: Density,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    domain: CuboidArgs,
    /// A mesh, OBJ, PLY or STL, whose inside is sampled in place of a cuboid. Holes are closed by caps. The box around it is the
    /// domain of the output.
    #[arg(long, value_name = "MESH", conflicts_with_all = ["domain", "bounded"])]
    inside: Option<PathBuf>,
    /// A maximal set of the surface of the mesh comes first, and the inside is filled around it. It takes a radius, and any
    /// order.
    #[arg(long, requires = "inside", conflicts_with = "count")]
    surface_first: bool,
    /// Places inside the mesh may stay open that are nearer to its surface than sqrt(3) times this many radii: 1/256 to 1/2
    /// [default: 0.0625].
    #[arg(long, value_name = "T", requires = "inside", allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Only places that are no farther from the surface than this, at least 1/256 of a radius [default: 0: all of the inside].
    #[arg(long, value_name = "D", requires = "inside", allow_negative_numbers = true)]
    thickness: Option<f64>,
    /// The order of the samples. In progressive order the output has the rank of each sample, except in XYZ and raw
    /// floats.
    #[arg(long, value_enum, default_value = "any")]
    order: Sequence,
    /// Progressive order: every prefix of 100 samples and more covers the cuboid within this times its last rank, 1.02 to
    /// 1.5 [default: 2^(1/8)].
    #[arg(long, value_name = "Q", requires = "order", allow_negative_numbers = true)]
    quotient: Option<f64>,
    /// Existing points, x y z each: a .ply, .npy, .csv, .xyz or .raw file. They stay, cover the volume within their
    /// clearance, and are not written. The clearance of a point is in the column `clearance` or, without one, `radius`;
    /// without either it is the radius of the set, and a count needs clearances.
    #[arg(long, visible_alias = "around", value_name = "FILE")]
    given: Option<PathBuf>,
    /// The clearance of all points of `--given`, in place of the columns of their file.
    #[arg(long, value_name = "C", requires = "given", allow_negative_numbers = true)]
    clearance: Option<f64>,
    /// Tiles the cuboid by copies of a small set, in leaves whose sides are at least this many radii, 6 or more: faster from
    /// about 20 on, and up to 1 % denser. 0: not tiled. It takes a radius, and any order.
    #[arg(long, value_name = "L", default_value_t = 0.0, conflicts_with = "inside", allow_negative_numbers = true)]
    leaf_size: f64,
}

/// The samples, their domain, and what is reported about them.
struct Made {
    samples: Points<3>,
    domain: Domain<3>,
    /// The radius of all samples, unless they have radii of their own.
    radius: Option<f64>,
    about: Report,
    seconds: f64,
}

impl Volume {
    pub fn run(&self, context: &Context) -> Result<()> {
        let output = self.common.destination.open_points()?;
        let around = self.around()?;
        let made = match (&self.density.radius_from, &self.inside) {
            (Some(grid), _) => self.adaptive(context, grid),
            (None, Some(path)) => self.inside(context, path, &around),
            (None, None) => self.cuboid(context, &around),
        };
        let Made { samples, domain, radius, about, seconds } =
            made.map_err(|error| match self.given.as_ref().or(self.density.radius_from.as_ref()) {
                Some(path) => blame(path, error),
                None => error,
            })?;
        let table = PointTable {
            radii: &samples.radii,
            ranks: &samples.ranks,
            class_radii: radius.as_slice(),
            ..PointTable::of(&samples.positions)
        };
        output.write_points(&domain, &table)?;
        report(&output.output, samples.len(), about, seconds);
        Ok(())
    }

    fn amount(&self) -> Amount {
        match self.density.count {
            Some(count) => Amount::Count(count),
            None => Amount::Radius(self.density.radius.unwrap_or(f64::NAN)),
        }
    }

    fn cuboid(&self, context: &Context, around: &Around<3>) -> Result<Made> {
        let (options, domain) = (Options::of(self.amount()), self.domain.or_unit());
        let options = options
            .domain(domain)
            .seed(self.common.seed)
            .order(self.order.into())
            .quotient(self.quotient.unwrap_or(options.quotient))
            .given(around.given())
            .leaf_size(self.leaf_size);
        let (samples, done) = watched("volume", |progress| sample(context, &options, Some(progress)))?;
        let about = of_radius(done.radius).and(covered(done.radius, done.covering_radius));
        Ok(Made { samples, domain, radius: Some(done.radius), about, seconds: done.seconds })
    }

    fn inside(&self, context: &Context, path: &Path, around: &Around<3>) -> Result<Made> {
        let mesh = Arc::new(input::mesh_at_origin(path)?);
        let options = InsideOptions::of(self.amount());
        let options = options
            .surface(if self.surface_first { Surface::First } else { Surface::Open })
            .tolerance(self.tolerance.unwrap_or(options.tolerance))
            .thickness(self.thickness.unwrap_or(options.thickness))
            .seed(self.common.seed)
            .order(self.order.into())
            .quotient(self.quotient.unwrap_or(options.quotient))
            .given(around.given());
        let made = watched("volume", |progress| sample_inside(context, &mesh, &options, Some(progress)));
        let (samples, done) = made.map_err(|error| blame_mesh(path, error))?;
        let surface = match done.surface_samples {
            0 => String::new(),
            count => format!("{count} on the surface"),
        };
        let about = of_radius(done.radius).and(covered(done.radius, done.covering_radius));
        let about = about.fact("surface_samples", done.surface_samples, surface);
        let about = about.fact("depth", done.depth, format!("open up to {} below the surface", rounded(done.depth, 4)));
        Ok(Made { samples, domain: box_around(&mesh), radius: Some(done.radius), about, seconds: done.seconds })
    }

    /// A set of radii on a grid, of the cuboid or of the inside of the mesh.
    fn adaptive(&self, context: &Context, grid: &Path) -> Result<Made> {
        let grid = read_grid(grid)?;
        let (radius, seed) = (Radius::Grid { values: &grid.values, size: grid.size }, self.common.seed);
        let (samples, done, domain) = match &self.inside {
            None => {
                let domain = self.domain.or_unit();
                let options = adaptive::Options::new(radius).domain(domain).seed(seed);
                let sample = |progress: &Progress| adaptive::sample(context, &options, Some(progress));
                let (samples, done) = watched("volume", sample)?;
                (samples, done, domain)
            }
            Some(path) => {
                let mesh = Arc::new(input::mesh_at_origin(path)?);
                let options = adaptive::InsideOptions::new(radius).seed(seed);
                let options = options.tolerance(self.tolerance.unwrap_or(options.tolerance));
                let sample = |progress: &Progress| adaptive::sample_inside(context, &mesh, &options, Some(progress));
                let (samples, done) = watched("volume", sample).map_err(|error| blame_mesh(path, error))?;
                (samples, done, box_around(&mesh))
            }
        };
        let about = of_radii(&samples.radii);
        Ok(Made { samples, domain, radius: None, about, seconds: done.seconds })
    }

    /// The given points.
    fn around(&self) -> Result<Around<3>> {
        let Some(path) = &self.given else { return Ok(Around::default()) };
        let given = read_given(path, [0.0; 3])?;
        Ok(Around::new(given.positions, given.clearances, self.clearance))
    }
}

/// The box around a mesh.
fn box_around(mesh: &Mesh) -> Domain<3> {
    let (low, high) = mesh.bounds();
    let [min, max] = [low, high].map(|corner| corner.map(f64::from));
    Domain { min, max, boundary: Boundary::Bounded }
}

/// An error about a mesh, with its file.
fn blame_mesh(path: &Path, error: Error) -> Error {
    match error {
        Error::InvalidArgument { argument: "mesh", reason } => Error::Format { path: path.to_owned(), reason },
        other => other,
    }
}
