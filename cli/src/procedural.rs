//! `azulejo mesh`: procedural meshes.

pub mod knot;
pub mod shapes;

use std::path::PathBuf;

use azulejo::{Error, Result};
use clap::{Args, ValueEnum};

use crate::output::{Report, Writing};
use crate::ply;
use shapes::Soup;

#[derive(Args)]
pub(crate) struct Procedural {
    /// The shape.
    #[arg(value_enum)]
    shape: Shape,
    /// The mesh: a binary PLY file.
    #[arg(short, long, value_name = "FILE.ply")]
    output: PathBuf,
    #[command(flatten)]
    writing: Writing,
    /// The level of detail: the number of quads along the knot, around the sphere, around the hole of the torus and
    /// around each column of the hall [default: 1280, 256, 256 and 40].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=20_000))]
    detail: Option<u32>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Shape {
    /// A trefoil knot with a quilted relief: a closed surface, its box about 2 wide.
    Knot,
    /// A sphere of radius 1.
    Sphere,
    /// A torus of radii 1 and 0.4.
    Torus,
    /// A closed hall with columns, arches and drapes, 4 long, 1 high, its walls facing inwards: many surfaces behind
    /// one another. Draw it with --cutaway.
    Hall,
}

impl Shape {
    /// The default detail, and the greatest: some 200 million triangles.
    fn details(self) -> (u32, u32) {
        match self {
            Self::Knot => (1280, 20_000),
            Self::Sphere | Self::Torus => (256, 14_000),
            Self::Hall => (40, 1000),
        }
    }

    fn make(self, detail: u32) -> Soup {
        match self {
            Self::Knot => knot::knot(detail),
            Self::Sphere => shapes::sphere(detail),
            Self::Torus => shapes::torus(detail, detail / 2),
            Self::Hall => hall(detail),
        }
    }
}

impl Procedural {
    pub(crate) fn run(&self) -> Result<()> {
        let output = self.writing.of_format("ply", &self.output)?;
        let (default, greatest) = self.shape.details();
        let detail = self.detail.unwrap_or(default);
        if detail > greatest {
            let reason = format!("{detail} is too fine for this shape; the limit is {greatest}");
            return Err(Error::InvalidArgument { argument: "--detail", reason });
        }
        let (positions, triangles) = self.shape.make(detail);
        ply::write_mesh(&output, &positions, &triangles, [0.0; 3])?;
        let (vertices, triangles) = (positions.len(), triangles.len());
        output.report(&Report::default().count("vertices", vertices, "vertices").count(
            "triangles",
            triangles,
            "triangles",
        ));
        Ok(())
    }
}

/// The hall, which stands on z, turned to stand on y, as pictures have it.
pub fn hall(detail: u32) -> Soup {
    let (mut positions, triangles) = shapes::hall(detail);
    positions.iter_mut().for_each(|position| *position = [position[0], position[2], -position[1]]);
    (positions, triangles)
}
