//! The arguments of all commands that write files.

use std::path::Path;

use azulejo::Result;
use clap::Args;

use super::Output;

/// The rule for files that exist.
#[derive(Args, Clone, Copy)]
pub struct Replacing {
    /// Replace files that exist. Without, they are left as they are and the command is refused.
    #[arg(long, display_order = 800)]
    force: bool,
}

impl Replacing {
    /// [`Output::at`], which refuses a file that exists unless it is to be replaced.
    pub fn at(self, path: &Path) -> Result<Output> {
        Output::at(path)?.replacing(self.force)
    }

    /// [`Output::of_format`], which refuses a file that exists unless it is to be replaced.
    pub fn of_format(self, extension: &str, path: &Path) -> Result<Output> {
        Output::of_format(extension, path)?.replacing(self.force)
    }
}

/// The way in which files are written and reported.
#[derive(Args, Clone, Copy)]
pub struct Writing {
    #[command(flatten)]
    replacing: Replacing,
    /// Print the report as JSON, an object on a line for each file: on the standard error if the file itself goes to the
    /// standard output, a pipe or a device.
    #[arg(long, display_order = 801)]
    json: bool,
}

impl Writing {
    /// [`Replacing::at`], reported as the user wants.
    pub fn at(self, path: &Path) -> Result<Output> {
        Ok(self.replacing.at(path)?.reported(self.json))
    }

    /// [`Replacing::of_format`], reported as the user wants.
    pub fn of_format(self, extension: &str, path: &Path) -> Result<Output> {
        Ok(self.replacing.of_format(extension, path)?.reported(self.json))
    }
}
