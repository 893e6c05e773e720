//! `azulejo-studies sums`: SHA-256 sums of what some sixty calls of the library return, to be compared before and after a
//! change that shall change nothing: each of them depends on its arguments alone, not on the number of threads.

mod analysis;
mod meshes;
mod plane;
mod print;
mod relaxation;
mod surface;

use azulejo::{Context, Result};
use clap::Args;

#[derive(Args)]
pub struct Sums {}

impl Sums {
    pub fn run(&self, context: &Context) -> Result<()> {
        let sets = plane::print(context)?;
        relaxation::print(context, &sets)?;
        let surface = surface::print(context)?;
        analysis::print(context, &sets, &surface)
    }
}
