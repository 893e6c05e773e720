//! `azulejo-studies psp`: the tables and figures of thesis chapter 3, measured again.

pub mod adaptive;
mod bias;
mod density;
mod growth;
mod others;
mod page;
mod pictures;
mod rates;
mod rays;
pub mod scenes;
mod variants;

use std::path::PathBuf;

use azulejo::{Context, Progress, Result};
use clap::Args;

use crate::args::{MeshArgs, PageArgs};
use crate::repeated::ROUNDS;
use azulejo_cli::progress::watched;
use bias::Bias;
use growth::Growth;
use rates::Rates;
use rays::Rays;
use scenes::{Scene, scenes};

/// The first line of the page.
const SUBJECT: &str = "Sets on meshes, projected and filled: rates, bias and spectra, beside the thesis's figures \
    and methods of others.";

#[derive(Args)]
pub struct Psp {
    #[command(flatten)]
    page: PageArgs,
    #[command(flatten)]
    meshes: MeshArgs,
    /// A further mesh, named like its file; may be given several times.
    #[arg(long = "mesh", value_name = "MESH")]
    further: Vec<PathBuf>,
}

/// The size of the study.
pub struct Effort {
    /// Samples on the sphere and on the planes where bias is measured, and sets of each kind.
    pub bias: f64,
    pub planes: f64,
    pub seeds: u64,
    /// Sets of each way whose density is measured.
    pub sets: u64,
    /// Random points by which uncovered surface is estimated.
    pub probes: u64,
    /// Samples of the sets that are timed, and of others for the rate by radius.
    pub samples: f64,
    pub counts: &'static [f64],
    /// The rounds of sets that verdicts and sentences are about, and those of others.
    pub judged_rounds: usize,
    pub rounds: usize,
    /// Samples of the sets whose growth is watched, and after which iterations.
    pub growth: f64,
    pub marks: &'static [u32],
    /// Samples of the sets beside which methods of others are measured: fewer, as their darts take long.
    pub others: f64,
    /// Rays along each axis.
    pub rays: f64,
    /// The detail of the hall.
    pub detail: u32,
    /// Samples and width of the pictures.
    pub pictured: f64,
    pub pixels: u32,
}

const FULL: Effort = Effort {
    bias: 1e5,
    planes: 24_800.0,
    seeds: 4,
    sets: 40,
    probes: 1_000_000,
    samples: 1e6,
    counts: &[1e4, 3.2e4, 1e5, 3.2e5, 1e6, 3.2e6],
    judged_rounds: ROUNDS,
    rounds: 3,
    growth: 3e5,
    marks: &[1, 2, 3, 5, 10, 20, 30, 50],
    others: 1e5,
    rays: 1e6,
    detail: 48,
    pictured: 4e4,
    pixels: 1000,
};

const QUICK: Effort = Effort {
    bias: 4e3,
    planes: 1e3,
    seeds: 2,
    sets: 3,
    probes: 20_000,
    samples: 5e3,
    counts: &[2e3, 5e3],
    judged_rounds: 2,
    rounds: 2,
    growth: 3e3,
    marks: &[1, 2, 3],
    others: 3e3,
    rays: 5e3,
    detail: 8,
    pictured: 5e3,
    pixels: 400,
};

/// The measurements on a scene.
pub struct Measured {
    pub scene: Scene,
    pub rates: Rates,
    pub growth: Growth,
    pub rays: Rays,
}

impl Measured {
    fn of(context: &Context, scene: Scene, effort: &Effort, progress: &Progress) -> Result<Self> {
        let rates = Rates::measure(context, &scene, effort, &|done| progress(0.6 * done))?;
        let growth = Growth::measure(context, &scene, effort, &|done| progress(0.6 + 0.35 * done))?;
        let rays = Rays::measure(context, &scene, effort.rays)?;
        Ok(Self { scene, rates, growth, rays })
    }
}

impl Psp {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("psp")?;

        let (found, missing) = scenes(self.meshes.bunny.as_deref(), self.meshes.dragon.as_deref(), effort.detail)?;
        let density = watched("density", |progress| density::measure(context, &found, &effort, progress))?;
        let mut measured = Vec::new();
        let in_parts = found.iter().find(|scene| scene.name == "dragon").map(scenes::in_parts);
        let further = self.further.iter().map(|path| scenes::further(path));
        for scene in found.into_iter().map(Ok).chain(in_parts).chain(further) {
            let scene = scene?;
            measured.push(watched(scene.name.clone(), |progress| Measured::of(context, scene, &effort, progress))?);
        }
        let others = watched("others", |_| others::section(context, &measured[0].scene, &effort))?;
        let bias = watched("bias", |progress| Bias::measure(context, &effort, progress))?;

        pictures::draw_rates(&measured, &files.picture("rates")?)?;
        pictures::draw_growth(&measured, &files.picture("growth")?)?;
        pictures::draw_facing(&bias, &files.picture("facing")?)?;
        pictures::draw_spectra(&bias, &files.picture("spectra")?)?;
        pictures::draw_differences(&bias, &files.picture("differences")?)?;
        for Measured { scene, .. } in &measured {
            pictures::draw_scene(context, scene, &effort, &files.picture(&scene.name)?)?;
        }
        let threads = context.num_threads();
        let text = page::text(threads, &effort, &measured, &missing, &others, &density::section(&density), &bias);
        let text = text + "\n" + &adaptive::section(context, &files, self.page.quick)?;
        files.write("PSP, measured", SUBJECT, threads, &text)
    }
}
