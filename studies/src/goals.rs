//! `azulejo-studies goals`: the performance targets of version 0.2 whose figures are on no other page.

mod clouds;
mod files;
mod fill;
mod given;
pub mod memory;
mod plane;
mod relaxation;
pub mod row;
mod starts;

use std::path::PathBuf;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Result};
use clap::Args;

use crate::args::{MeshArgs, PageArgs};
use crate::psp::scenes::sphere;
use crate::repeated::ROUNDS;
use azulejo_cli::progress::watched;

/// The first line of the page.
const SUBJECT: &str = "The speed and memory asked of azulejo 0.2 for planes, meshes, files, relaxation, given \
    samples and clouds, and what was reached on the day below.";

#[derive(Args)]
pub struct Goals {
    #[command(flatten)]
    page: PageArgs,
    #[command(flatten)]
    meshes: MeshArgs,
    /// Fill the dragon with about so many samples on one thread, print the MB that it took, and write no page: the
    /// study runs this in a process of its own, to measure its memory.
    #[arg(long, hide = true, value_name = "N", requires = "dragon")]
    memory: Option<f64>,
}

/// The size of the study.
#[derive(Clone, Copy)]
pub struct Effort {
    /// The number of calls of each kind, in turns with those that it is compared with.
    pub rounds: usize,
    /// The part of the samples, points and triangles of each goal.
    pub part: f64,
}

const FULL: Effort = Effort { rounds: ROUNDS, part: 1.0 };
const QUICK: Effort = Effort { rounds: 2, part: 0.005 };

impl Effort {
    /// A number of the goals, or a part of it.
    pub fn of(&self, count: f64) -> f64 {
        (count * self.part).max(50.0).round()
    }
}

/// The context of the parts of the study.
pub struct Study {
    pub effort: Effort,
    pub one: Context,
    pub two: Context,
    /// The bunny, or a sphere where it was not given, with its name.
    pub small: (&'static str, Arc<Mesh>),
    pub dragon: Option<Dragon>,
}

/// The dragon and its file.
pub struct Dragon {
    pub path: PathBuf,
    pub mesh: Arc<Mesh>,
}

/// Measures, and gives its text, from its `##` title on.
type Section = fn(&Study) -> Result<String>;

/// The parts of the page.
const SECTIONS: [(&str, Section); 7] = [
    ("plane", plane::section),
    ("fill", fill::section),
    ("files", files::section),
    ("relaxation", relaxation::section),
    ("starts", starts::section),
    ("given", given::section),
    ("clouds", clouds::section),
];

const INTRODUCTION: &str = "Performance targets of 0.2, one thread if nothing else is said. *Measured* is the median \
    of 7 rounds, in which calls that are held against each other take turns, and the *range* is theirs: a goal is met where \
    every round meets it, not met where none does, and otherwise not decided. Of memory and of several starts *measured* is the \
    worst, which decides. Nothing else should run on the machine.\n";

/// The pages of the other goals.
const ELSEWHERE: &str = "## Goals on other pages\n\n\
    * [kdrt.md](kdrt.md): KDRT's excess of density, and the time of its fill.\n\
    * [psp.md](psp.md): rates of projection, threads, bias of both ways to a maximal set.\n\
    * [dcr.md](dcr.md): what relaxed sets on meshes reach, and tones of densities.\n\
    * [order.md](order.md): prefixes and times of progressive order; sets of exactly N samples, and what they lose.\n\
    * [classes.md](classes.md): times of several classes against one class, windows of classes.\n\
    * [peers.md](peers.md): times and memory beside others.\n\n\
    AVX2 and portable code beside AVX-512 are not measured: the library takes the widest instructions of the processor, and \
    has no switch for others.\n";

impl Goals {
    pub fn run(&self, context: &Context) -> Result<()> {
        let dragon = match &self.meshes.dragon {
            Some(path) => Some(Dragon { path: path.clone(), mesh: Arc::new(Mesh::load(path)?) }),
            None => None,
        };
        if let (Some(count), Some(dragon)) = (self.memory, &dragon) {
            println!("{}", memory::of_fill(dragon, count)?);
            return Ok(());
        }
        let files = self.page.open("goals")?;
        let small = match &self.meshes.bunny {
            Some(path) => ("bunny", Arc::new(Mesh::load(path)?)),
            None => ("sphere", sphere()?),
        };
        let effort = if self.page.quick { QUICK } else { FULL };
        let study = Study { effort, one: Context::new(1)?, two: Context::new(2)?, small, dragon };
        let mut text = INTRODUCTION.to_owned();
        for (name, option) in [("bunny", self.meshes.bunny.is_none()), ("dragon", study.dragon.is_none())]
            .into_iter()
            .filter_map(|(name, is_absent)| is_absent.then_some((name, format!("--{name} MESH"))))
        {
            let instead = if name == "bunny" { "a sphere stands for it" } else { "its rows are left out" };
            text += &format!("\n**The {name} was not given (`{option}`): {instead}.**\n");
        }
        for (name, section) in SECTIONS {
            text += &format!("\n{}", watched(name, |_| section(&study))?);
        }
        files.write("Goals, measured", SUBJECT, context.num_threads(), &(text + "\n" + ELSEWHERE))
    }
}
