//! `azulejo-studies volume`: sets of cuboids and of the inside of meshes, against their goals and beside those of others.

mod clock;
mod closed;
mod goals;
mod judged;
mod others;
mod page;
mod picture;
mod tables;

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Error, Result};
use azulejo_cli::progress::watched;
use clap::Args;

use crate::args::PageArgs;
use crate::psp::scenes::sphere;
use crate::repeated::ROUNDS;
use closed::Closed;

/// The first line of the page.
const SUBJECT: &str = "Maximal Poisson-disk sets of cuboids and of the inside of meshes, and relaxed sets: what a \
    sample takes, how dense sets are, whether any two samples conflict and what is left uncovered; beside packages \
    of others on the same tasks, in the same run.";

#[derive(Args)]
pub struct Study {
    #[command(flatten)]
    page: PageArgs,
    /// The Stanford bunny: OBJ, PLY or STL; a sphere if it is not given.
    #[arg(long, value_name = "MESH")]
    bunny: Option<PathBuf>,
    #[command(flatten)]
    programs: others::Programs,
    /// Samples of the sets that are held against the goals.
    #[arg(long, value_name = "N", default_value_t = 1e6)]
    count: f64,
    /// Samples of the largest set, whose time per sample is compared with theirs; 0 leaves it out.
    #[arg(long, value_name = "N", default_value_t = 1e7)]
    largest: f64,
    /// Points that are relaxed.
    #[arg(long, value_name = "N", default_value_t = 1e5)]
    relaxed: f64,
    /// Rounds of the sets that are held against the goals; fewer than 7 decide nothing.
    #[arg(long, value_name = "N", default_value_t = ROUNDS)]
    rounds: usize,
    /// Rounds of the packages of others and of azulejo beside them.
    #[arg(long, value_name = "N", default_value_t = 3)]
    turns: usize,
    /// Sets of each kind as fluid at rest.
    #[arg(long, value_name = "N", default_value_t = 3)]
    fluids: usize,
    /// Fill a torus with about so many samples on one thread, print the bytes per sample that it took, and write no
    /// page: the study runs this in a process of its own, to measure its memory.
    #[arg(long, hide = true, value_name = "N")]
    memory: Option<f64>,
}

/// The size of the study.
#[derive(Clone, Copy)]
pub struct Effort {
    /// The number of calls of each kind, in turns with those that they are compared with.
    pub rounds: usize,
    /// The same for packages of others.
    pub turns: usize,
    /// Samples of the sets that are held against the goals, of the largest one, and points that are relaxed.
    pub count: f64,
    pub largest: f64,
    pub relaxed: f64,
    /// Samples of the sets of the tables: of cuboids, and of the inside of a mesh.
    pub boxes: [usize; 2],
    pub insides: [usize; 2],
    /// Random places that tell which share is uncovered.
    pub probes: usize,
    /// The samples of the set of which a slab is drawn.
    pub pictured: f64,
}

/// The context of the parts of the study.
pub struct Scene<'a> {
    pub effort: Effort,
    pub one: Context,
    pub all: &'a Context,
    /// The bunny, or a sphere where it was not given, with its name: closed, and the number of its holes that were.
    pub mesh: (&'static str, Arc<Mesh>),
    pub holes: usize,
    /// The file of the closed mesh.
    pub file: PathBuf,
    pub programs: &'a others::Programs,
}

impl Study {
    pub fn run(&self, context: &Context) -> Result<()> {
        if let Some(count) = self.memory {
            println!("{}", goals::bytes_per_sample(count)?);
            return Ok(());
        }
        let files = self.page.open("volume")?;
        let (name, mesh) = match &self.bunny {
            Some(path) => ("bunny", Arc::new(Mesh::load(path)?)),
            None => ("sphere", sphere()?),
        };
        let closed = Closed::of(mesh)?;
        let scene = Scene {
            effort: self.effort(),
            one: Context::new(1)?,
            all: context,
            mesh: (name, closed.mesh.clone()),
            file: closed.write()?,
            holes: closed.holes,
            programs: &self.programs,
        };
        let rows = watched("goals", |_| goals::rows(&scene))?;
        let mut tables = Vec::new();
        for count in scene.effort.boxes {
            tables.push(watched("cuboid", |_| tables::of_cuboid(&scene, count))?);
        }
        for count in scene.effort.insides {
            tables.push(watched("inside", |_| tables::inside(&scene, count))?);
        }
        let slab = watched("slab", |_| picture::draw(&scene, &files.picture("slab")?))?;
        let fluid = watched("fluid", |_| others::fluid(&self.programs, self.page.quick, self.fluids))?;
        fs::remove_file(&scene.file).map_err(|source| Error::Io { path: scene.file.clone(), source })?;
        let text = page::text(&scene, &rows, &tables, &slab, fluid.as_deref());
        files.write("Volumes, measured", SUBJECT, context.num_threads(), &text)
    }

    fn effort(&self) -> Effort {
        let &Self { count, largest, relaxed, rounds, turns, .. } = self;
        if self.page.quick {
            return Effort {
                rounds: 2,
                turns: 1,
                count: 3000.0,
                largest: 6000.0,
                relaxed: 1000.0,
                boxes: [500, 1000],
                insides: [300, 500],
                probes: 2000,
                pictured: 4000.0,
            };
        }
        Effort {
            rounds,
            turns,
            count,
            largest,
            relaxed,
            boxes: [10_000, 100_000],
            insides: [1_000, 100_000],
            probes: 400_000,
            pictured: 40_000.0,
        }
    }
}
