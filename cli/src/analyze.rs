//! `azulejo analyze`: figures of sets, as a table, as JSON and as pictures.

mod classes;
mod figures;
mod page;
mod plane;
mod plots;
mod space;
mod surface;

use std::path::{Path, PathBuf};

use azulejo::{Context, Domain, Error, Result};
use clap::Args;
use plots::PlotArgs;

use crate::domain::{DomainArgs, OF_OR_AROUND};
use crate::formats::set::{PlaneSet, SampleSet};
use crate::formats::{Input, ON_MESH};
use crate::input;
use crate::output::print;

#[derive(Args)]
#[command(mut_arg("domain", |domain| domain.help(OF_OR_AROUND)))]
pub struct Analyze {
    /// The samples: .ply, .npy, .csv, .xyz or .raw files. Several files are sets of one kind, whose figures are
    /// averaged. Where they have a column `class` each class is measured alone, too.
    #[arg(value_name = "SAMPLES", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    input: Input,
    #[command(flatten)]
    domain: DomainArgs,
    /// The mesh that the samples lie on: OBJ, PLY, STL, OFF or GLB.
    #[arg(long, value_name = "MESH", conflicts_with_all = ["domain", "bounded"])]
    mesh: Option<PathBuf>,
    /// The corners of the cuboid that the samples fill, such as 0 0 0 1 1 1; a torus unless it is bounded.
    #[arg(
        long, num_args = 6, value_names = ["X0", "Y0", "Z0", "X1", "Y1", "Z1"], allow_negative_numbers = true,
        conflicts_with_all = ["domain", "mesh", "plots"]
    )]
    cuboid: Option<Vec<f64>>,
    /// A radius to check the sets against: compares it with smallest distance and covering radius, and counts gaps.
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// Print JSON, with the curves of the plots, instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    plots: PlotArgs,
}

/// A set and its file.
struct Set<Points> {
    path: PathBuf,
    loaded: Points,
}

impl Analyze {
    pub fn run(&self, context: &Context) -> Result<()> {
        if let Some(radius) = self.radius.filter(|radius| !(*radius > 0.0 && radius.is_finite())) {
            let reason = format!("{radius} is not a positive finite number");
            return Err(Error::InvalidArgument { argument: "--radius", reason });
        }
        let cuboid = self.cuboid.as_deref().and_then(|corners| corners.try_into().ok());
        let text = match (&self.mesh, cuboid) {
            (Some(mesh), _) => self.surface(context, mesh)?,
            (None, Some(corners)) => self.space(context, &self.domain.cuboid(corners))?,
            (None, None) => self.plane(context, &self.read(|path| self.input.read_plane(path, ON_MESH))?)?,
        };
        print(text.as_bytes())
    }

    /// Reads all sets.
    fn read<Points>(&self, read: impl Fn(&Path) -> Result<Points>) -> Result<Vec<Set<Points>>> {
        let read = |path: &PathBuf| Ok(Set { path: path.clone(), loaded: read(path)? });
        self.files.iter().map(read).collect()
    }

    fn plane(&self, context: &Context, sets: &[Set<PlaneSet>]) -> Result<String> {
        let domain = self.domain.of_or_around(&sets[0].loaded);
        let named = self.domain.of(&sets[0].loaded);
        if let Some(other) = sets.iter().find(|set| self.domain.of(&set.loaded) != named) {
            let reason = format!("has another domain than {}", sets[0].path.display());
            return Err(Error::Format { path: other.path.clone(), reason });
        }
        let directory = self.plots.open(&plots::OF_PLANE)?;
        let measured = plane::Measured::of(context, &domain, sets, self.radius)?;
        if let Some(directory) = &directory {
            plots::plane(context, &domain, sets, &measured, directory)?;
        }
        Ok(if self.json {
            page::plane_json(&domain, sets, &measured)
        } else {
            page::plane_table(&domain, sets, &measured)
        })
    }

    fn space(&self, context: &Context, domain: &Domain<3>) -> Result<String> {
        let sets: &[Set<SampleSet>] = &self.read(|path| self.input.read_samples(path, [0.0; 3]))?;
        let measured = space::Measured::of(context, domain, sets, self.radius)?;
        Ok(if self.json {
            page::space_json(domain, sets, &measured)
        } else {
            page::space_table(domain, sets, &measured)
        })
    }

    fn surface(&self, context: &Context, path: &Path) -> Result<String> {
        let mesh = input::mesh(path)?;
        let sets: &[Set<SampleSet>] = &self.read(|path| self.input.read_samples(path, mesh.origin()))?;
        let directory = self.plots.open(&plots::OF_SURFACE)?;
        let measured = surface::Measured::of(context, &mesh, sets, self.radius)?;
        if let Some(directory) = &directory {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            plots::surface(context, &name, &mesh, sets, &measured, directory)?;
        }
        Ok(if self.json {
            page::surface_json(path, &mesh, sets, &measured)
        } else {
            page::surface_table(path, &mesh, sets, &measured)
        })
    }
}
