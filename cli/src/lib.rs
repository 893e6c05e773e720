//! The command-line tool of azulejo as a library: [`main`] is the whole program.
//!
//! The public modules are what `azulejo-studies`, the program that writes the pages of `docs/`, uses as well: pictures,
//! files that are written whole or not at all, meshes that are made, and figures of sets. They are not a stable
//! interface.

mod analyze;
mod domain;
pub mod draw;
mod formats;
mod generate;
mod input;
mod mask;
mod merge;
#[cfg(test)]
mod option_table;
pub mod output;
mod photo;
mod ply;
pub mod procedural;
mod program;
pub mod progress;
pub mod quality;
pub mod sheet;
mod shell;
pub mod stipple;
pub mod summary;
pub mod text;
mod thin;

pub use program::{exit_code, main};
