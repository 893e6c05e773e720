//! `azulejo-studies order`: sets in progressive order: what their prefixes are like, and what the order costs.

mod page;
mod pictures;
mod prefixes;
mod surfaces;
mod times;

use std::f64::consts::SQRT_2;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Result};
use clap::Args;

use crate::args::{MeshArgs, PageArgs};
use crate::psp::scenes::sphere;
use azulejo_cli::progress::watched;
use prefixes::{Direct, Prefixes};
use surfaces::Surface;
use times::Times;

/// The first line of the page.
const SUBJECT: &str = "What progressive order costs: how well spread the prefixes of such sets are, beside sets \
    made with as many samples directly, and what time they take.";

/// A quotient of the radii of two levels.
#[derive(Clone, Copy, PartialEq)]
pub struct Quotient {
    pub name: &'static str,
    pub value: f64,
}

/// The quotients that are measured, of which the first is the default.
pub const QUOTIENTS: [Quotient; 3] = [
    Quotient { name: "2^(1/8)", value: azulejo::kdrt::DEFAULT_QUOTIENT },
    Quotient { name: "2^(1/4)", value: 1.189_207_115_002_721 },
    Quotient { name: "√2", value: SQRT_2 },
];

#[derive(Args)]
pub struct Study {
    #[command(flatten)]
    page: PageArgs,
    #[command(flatten)]
    meshes: MeshArgs,
}

/// The size of the study.
pub struct Effort {
    /// Samples of the sets whose prefixes are measured, and sets of each kind.
    pub count: f64,
    pub sets: u64,
    /// Samples of the sets on a mesh that have exactly so many.
    pub exact: &'static [usize],
    /// Samples of the sets that are timed, and how often they are.
    pub counts: &'static [f64],
    pub rounds: usize,
    /// Samples of a window, and of the plane that it is of.
    pub window: f64,
    pub plane: f64,
}

const FULL: Effort = Effort {
    count: 2e4,
    sets: 5,
    exact: &[100, 1000, 10_000, 100_000],
    counts: &[1e4, 1e5, 1e6],
    rounds: 3,
    window: times::WINDOW,
    plane: times::PLANE,
};
const QUICK: Effort =
    Effort { count: 1e3, sets: 2, exact: &[100, 500], counts: &[1e3], rounds: 1, window: 1e2, plane: 1e4 };

/// All that was measured.
struct Results {
    prefixes: Vec<Prefixes>,
    direct: Direct,
    surface: Surface,
    plane: Vec<Times>,
    /// The name of the mesh, and its times.
    mesh: (&'static str, Vec<Times>),
    window: Times,
}

impl Study {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("order")?;

        let (name, mesh) = match &self.meshes.bunny {
            Some(path) => ("bunny", Arc::new(Mesh::load(path)?)),
            None => ("sphere", sphere()?),
        };
        let results = Results {
            prefixes: watched("prefixes", |progress| Prefixes::all(context, &effort, progress))?,
            direct: watched("direct", |_| Direct::measure(context, &effort))?,
            surface: watched("surface", |progress| Surface::measure(context, (name, &mesh), &effort, progress))?,
            plane: watched("plane", |_| Times::plane(&effort))?,
            mesh: (name, watched("mesh", |_| Times::mesh(&mesh, &effort))?),
            window: watched("window", |_| Times::window(&effort))?,
        };

        pictures::draw_spectra(&effort, &results.prefixes, &results.direct, &files.picture("spectra")?)?;
        pictures::draw_prefixes(&effort, &results.prefixes[0], &files.picture("prefixes")?)?;
        files.write("Progressive order, measured", SUBJECT, context.num_threads(), &page::text(&effort, &results))
    }
}
