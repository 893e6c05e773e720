//! `azulejo relax`: sets of the plane, of cuboids and of the inside of meshes, and samples of meshes, relaxed.

use std::path::{Path, PathBuf};
use std::time::Instant;

use azulejo::dcr::{self, CorrelationOptions, Neighbourhood, Stopped, surface, volume};
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::Density as MeshDensity;
use azulejo::{Boundary, Context, Domain, Error, Points, Progress, Result};
use clap::{Args, ValueEnum};

use super::attributes::MeshFile;
use super::spectrum::Spectrum;
use super::{Common, report};
use crate::domain::DomainArgs;
use crate::formats::points::PointTable;
use crate::formats::set::{ClassColumn, SampleSet};
use crate::formats::surface::SurfaceTable;
use crate::formats::{Input, ON_MESH, PointFile, blame};
use crate::input;
use crate::output::{Output, Report};
use crate::ply;
use crate::progress::watched;
use crate::text::{grouped, rounded};

#[derive(Args)]
pub struct Relax {
    /// The set: a .ply, .npy, .csv, .xyz or .raw file; with --mesh, a .ply, .npy or .csv file that `azulejo surface`
    /// wrote.
    #[arg(value_name = "POINTS")]
    input: PathBuf,
    #[command(flatten)]
    format: Input,
    #[command(flatten)]
    common: Common,
    /// The mesh that the samples lie on and stay on: OBJ, PLY, STL, OFF or GLB.
    #[arg(long, value_name = "MESH", conflicts_with_all = ["domain", "bounded", "neighbourhood"])]
    mesh: Option<PathBuf>,
    /// The name of a vertex attribute of a PLY mesh that holds the density there, in any unit, 0 or more; where it is 0
    /// no sample ends.
    #[arg(long, value_name = "ATTRIBUTE", requires = "mesh")]
    density_from: Option<String>,
    /// Also writes the mesh whose vertices are the relaxed samples, as PLY, and reports if it is closed, its Euler
    /// characteristic and its angles.
    #[arg(long, value_name = "FILE", requires = "mesh")]
    remesh: Option<PathBuf>,
    #[command(flatten)]
    domain: DomainArgs,
    /// The corners of the cuboid that the points fill, such as 0 0 0 1 1 1; a torus unless it is bounded.
    #[arg(
        long, num_args = 6, value_names = ["X0", "Y0", "Z0", "X1", "Y1", "Z1"], allow_negative_numbers = true,
        conflicts_with_all = ["domain", "mesh", "neighbourhood", "spectrum"]
    )]
    cuboid: Option<Vec<f64>>,
    /// The mesh that the points are inside of and do not leave: OBJ, PLY, STL, OFF or GLB.
    #[arg(
        long, value_name = "MESH",
        conflicts_with_all = ["cuboid", "domain", "bounded", "mesh", "neighbourhood", "spectrum"]
    )]
    inside: Option<PathBuf>,
    /// The number of points that stay where they are, the first ones, as `azulejo volume --surface-first` says it.
    #[arg(long, value_name = "COUNT", requires = "inside")]
    fixed: Option<usize>,
    /// The number of points that move along the surface only, the first ones.
    #[arg(long, value_name = "COUNT", requires = "inside", conflicts_with = "fixed")]
    sliding: Option<usize>,
    /// The neighbours that act on a point.
    #[arg(long, value_enum, default_value = "delaunay")]
    neighbourhood: Neighbours,
    /// Gives the set, which is periodic and of one class, this radial power instead: `step[:FREQUENCY]` is 0 up to the
    /// frequency and 1 above [0.5], `peak[:FREQUENCY[:WIDTH[:HEIGHT]]]` rises there over the width to a peak [0.6,
    /// 0.06, 1], in units of sqrt(density); FILE is a set of the plane that has it.
    #[arg(long, value_name = "step|peak|FILE", conflicts_with_all = ["mesh", "bounded", "neighbourhood"])]
    spectrum: Option<Spectrum>,
    /// Ignores the classes of the file: the points are relaxed as one set. Otherwise each class of a set of the plane
    /// is relaxed together with the union.
    #[arg(long)]
    no_classes: bool,
    /// The largest number of steps [default: 100].
    #[arg(long, value_name = "STEPS")]
    iterations: Option<u32>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Neighbours {
    /// The neighbours in the Delaunay triangulation; they keep their distance and close holes.
    Delaunay,
    /// The nearest points; they only repel.
    Nearest,
}

impl Relax {
    pub fn run(&self, context: &Context) -> Result<()> {
        if let Some(mesh) = &self.inside {
            return self.run_inside(context, mesh);
        }
        match (&self.mesh, self.cuboid.as_deref().and_then(|corners| corners.try_into().ok())) {
            (Some(mesh), _) => self.run_on(context, mesh),
            (None, Some(corners)) => self.run_in_cuboid(context, &self.domain.cuboid(corners)),
            (None, None) => self.run_in_plane(context),
        }
    }

    fn run_in_cuboid(&self, context: &Context, domain: &Domain<3>) -> Result<()> {
        let output = self.common.destination.open_points()?;
        let set = self.format.read_samples(&self.input, [0.0; 3])?;
        self.refuse_classes(&set)?;
        let mut options = volume::Options::new(*domain).seed(self.common.seed);
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let relax = |progress: &Progress| volume::relax(context, &options, &set.positions, Some(progress));
        let (relaxed, done) = watched("relax", relax).map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        let class_radii = &[done.smallest_distance];
        output.write_points(domain, &PointTable { class_radii, ..PointTable::of(&relaxed) })?;
        report(&output.output, relaxed.len(), about(done.iterations, done.smallest_distance), seconds);
        Ok(())
    }

    fn run_inside(&self, context: &Context, path: &Path) -> Result<()> {
        let output = self.common.destination.open_points()?;
        let mesh = input::mesh_at_origin(path)?;
        let set = self.format.read_samples(&self.input, [0.0; 3])?;
        self.refuse_classes(&set)?;
        let first = |count: Option<usize>, are: &str| match count {
            Some(count) if count > set.positions.len() => {
                Err(self.refused(&format!("has {} points, fewer than are {are}", set.positions.len())))
            }
            Some(count) => Ok((0..set.positions.len()).map(|index| index < count).collect::<Vec<bool>>()),
            None => Ok(Vec::new()),
        };
        let (fixed, sliding) = (first(self.fixed, "fixed")?, first(self.sliding, "sliding")?);
        let mut options = volume::InsideOptions::default().seed(self.common.seed).fixed(&fixed).sliding(&sliding);
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let relax =
            |progress: &Progress| volume::relax_inside(context, &mesh, &options, &set.positions, Some(progress));
        let (relaxed, done) = watched("relax", relax).map_err(|error| match error {
            Error::InvalidArgument { argument: "mesh", reason } => Error::Format { path: path.to_owned(), reason },
            other => blame(&self.input, other),
        })?;
        let seconds = start.elapsed().as_secs_f64();
        let (low, high) = mesh.bounds();
        let [min, max] = [low, high].map(|corner| corner.map(f64::from));
        let class_radii = &[done.smallest_distance];
        let table = PointTable { class_radii, ..PointTable::of(&relaxed) };
        output.write_points(&Domain { min, max, boundary: Boundary::Bounded }, &table)?;
        report(&output.output, relaxed.len(), about(done.iterations, done.smallest_distance), seconds);
        Ok(())
    }

    /// Refuses samples in space that have classes, unless they are to be ignored.
    fn refuse_classes(&self, set: &SampleSet) -> Result<()> {
        match self.classes(&set.classes)? {
            None => Ok(()),
            Some(_) => Err(self.refused(
                "has classes, which are relaxed in the plane only: --no-classes takes the samples for one set",
            )),
        }
    }

    fn run_in_plane(&self, context: &Context) -> Result<()> {
        let set = self.format.read_plane(&self.input, ON_MESH)?;
        let classes = self.classes(&set.classes)?;
        let output = match classes {
            Some(_) => self.common.destination.open_classes()?,
            None => self.common.destination.open_points()?,
        };
        let domain = self.domain.of(&set).ok_or_else(|| {
            self.refused("does not name its domain, and does not fill the unit square: give --domain")
        })?;
        if let Some(spectrum) = &self.spectrum {
            return self.run_to(context, spectrum, &set.points, domain, classes.is_some(), &output);
        }
        let neighbourhood = match self.neighbourhood {
            Neighbours::Delaunay => Neighbourhood::Delaunay,
            Neighbours::Nearest => Neighbourhood::Nearest,
        };
        let mut options = dcr::Options::new(domain, neighbourhood);
        options.seed = self.common.seed;
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let relax = |progress: &Progress| match classes {
            Some(classes) => {
                dcr::relax_classes(context, &options.to_delaunay("classes")?, &set.points, classes, Some(progress))
            }
            None => {
                let (relaxed, done) = dcr::relax(context, &options, &set.points, Some(progress))?;
                Ok((relaxed, done, Vec::new()))
            }
        };
        let (relaxed, done, each) = watched("relax", relax).map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        let table = PointTable {
            classes: classes.unwrap_or_default(),
            class_radii: &[done.smallest_distance],
            ..PointTable::of(&relaxed)
        };
        output.write_points(&domain, &table)?;
        let about = about(done.iterations, done.smallest_distance);
        let rho: Vec<_> = each.iter().map(|class| class.rho).collect();
        let text = format!("ρ {}", rho.iter().map(|&rho| rounded(rho, 3)).collect::<Vec<_>>().join(" / "));
        let about = if rho.is_empty() { about } else { about.fact("rho", rho, text) };
        report(&output.output, relaxed.len(), about, seconds);
        Ok(())
    }

    /// Relaxation to another spectrum.
    fn run_to(
        &self,
        context: &Context,
        spectrum: &Spectrum,
        points: &[[f32; 2]],
        domain: Domain,
        has_classes: bool,
        output: &PointFile,
    ) -> Result<()> {
        if has_classes {
            return Err(
                self.refused("has classes, for which there is no --spectrum: --no-classes takes it for one set")
            );
        }
        let target = spectrum.correlation(context, |path| {
            let set = self.format.read_plane(path, ON_MESH)?;
            let domain = self.domain.of(&set).ok_or_else(|| {
                let reason = "does not name its domain, and does not fill the unit square: give --domain";
                Error::Format { path: path.to_owned(), reason: reason.to_owned() }
            })?;
            Ok((set.points, domain))
        })?;
        let mut options = CorrelationOptions::new(domain).seed(self.common.seed);
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let (relaxed, done) =
            watched("relax", |progress| dcr::relax_to_correlation(context, &options, points, &target, Some(progress)))
                .map_err(|error| blame(&self.input, error))?;
        let seconds = start.elapsed().as_secs_f64();
        let class_radii = &[done.set.smallest_distance];
        output.write_points(&domain, &PointTable { class_radii, ..PointTable::of(&relaxed) })?;
        let is_reached = done.set.stopped == Stopped::Converged;
        let about = about(done.set.iterations, done.set.smallest_distance)
            .fact("reached", is_reached, if is_reached { "spectrum reached" } else { "spectrum not reached" })
            .fact("residual", done.residual, format!("residual {}", rounded(done.residual, 4)));
        report(&output.output, relaxed.len(), about, seconds);
        Ok(())
    }

    /// The classes that are to be kept, if there are any.
    fn classes<'a>(&self, classes: &'a ClassColumn) -> Result<Option<&'a [u32]>> {
        match classes {
            None => Ok(None),
            _ if self.no_classes => Ok(None),
            Some(Ok(classes)) => Ok(Some(classes)),
            Some(Err(reason)) => Err(self.refused(&format!("{reason}: --no-classes takes the points for one set"))),
        }
    }

    fn refused(&self, reason: &str) -> Error {
        Error::Format { path: self.input.clone(), reason: reason.to_owned() }
    }

    /// Relaxation on a mesh.
    fn run_on(&self, context: &Context, mesh: &Path) -> Result<()> {
        let output = self.common.destination.open_surface()?;
        let remeshed =
            self.remesh.as_deref().map(|path| self.common.destination.writing.of_format("ply", path)).transpose()?;
        let file = MeshFile::read(mesh)?;
        let mesh = file.mesh()?;
        let density = self.density_from.as_deref().map(|name| file.vertex_values(name)).transpose()?;
        let set = self.format.read_samples(&self.input, mesh.origin())?;
        self.refuse_classes(&set)?;
        let (triangles, barycentrics) = set.on_mesh.as_ref().ok_or_else(|| {
            self.refused("does not say on which triangle each sample is, and where: no triangle, u and v")
        })?;
        let mut options = surface::Options::default().seed(self.common.seed);
        options.max_iterations = self.iterations.unwrap_or(options.max_iterations);
        let start = Instant::now();
        let (relaxed, done) = watched("relax", |progress| match &density {
            None => surface::relax(context, &mesh, triangles, barycentrics, &options, Some(progress)),
            Some(values) => {
                let density = MeshDensity::PerVertex(values);
                let progress = Some(progress);
                surface::relax_with_density(context, &mesh, triangles, barycentrics, density, &options, progress)
            }
        })
        .map_err(|error| blame(&self.input, file.blame(self.density_from.as_deref(), error)))?;
        let seconds = start.elapsed().as_secs_f64();
        let normals = &relaxed.normals;
        output.write_surface(&SurfaceTable {
            samples: &relaxed,
            normals,
            radii: None,
            class_radii: &[done.smallest_distance],
            origin: mesh.origin(),
        })?;
        report(&output.output, relaxed.len(), about(done.iterations, done.smallest_distance), seconds);
        remeshed.map_or(Ok(()), |output| write_remeshed(context, &mesh, &relaxed, &output))
    }
}

/// Writes the mesh whose vertices are samples.
fn write_remeshed(context: &Context, mesh: &Mesh, samples: &Points<3>, output: &Output) -> Result<()> {
    let (made, done) = watched("remesh", |progress| {
        surface::remesh(context, mesh, &samples.triangles, &samples.barycentrics, Some(progress))
    })?;
    ply::write_mesh(output, made.positions(), made.triangles(), made.origin())?;
    let quality = done.quality;
    let kind = match (quality.is_closed_manifold(), quality.is_manifold()) {
        (true, _) => "closed manifold".to_owned(),
        (_, true) => format!("manifold with {} boundary edges", grouped(quality.boundary_edges as usize)),
        _ => format!(
            "{} boundary edges, {} vertices that are not manifold",
            grouped(quality.boundary_edges as usize),
            grouped(quality.non_manifold_vertices as usize)
        ),
    };
    let (least, mean, largest) = (quality.smallest_angle, quality.mean_smallest_angle, quality.largest_angle);
    let unused = format!("unused samples: {}", grouped(quality.unused_vertices as usize));
    let report = Report::default()
        .count("triangles", done.triangles as usize, "triangles")
        .fact("closed_manifold", quality.is_closed_manifold(), kind)
        .fact("boundary_edges", quality.boundary_edges, "")
        .fact("non_manifold_vertices", quality.non_manifold_vertices, "")
        .fact("euler", quality.euler, format!("Euler characteristic {}", quality.euler))
        .fact("angles", vec![least, largest], format!("angles {least:.1} to {largest:.1} degrees"))
        .fact("mean_smallest_angle", mean, format!("mean smallest {mean:.1}"))
        .fact("unused_samples", quality.unused_vertices, unused);
    output.report(&report);
    Ok(())
}

/// The report of a relaxation.
fn about(steps: u32, smallest_distance: f64) -> Report {
    let text = format!("smallest distance {}", rounded(smallest_distance, 4));
    Report::default().fact("steps", steps, format!("{steps} steps")).fact("smallest_distance", smallest_distance, text)
}
