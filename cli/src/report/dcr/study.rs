//! The sections that follow the tables of the methods.

use std::path::Path;

use azulejo::{Context, Result};

use super::density;
use crate::output::Output;

/// What a section has to work with.
pub struct Study<'a> {
    pub context: &'a Context,
    /// The folder of its pictures, beside the page; the page calls it `dcr`.
    pub pictures: &'a Path,
    /// Whether few and small sets are enough.
    pub quick: bool,
}

impl Study<'_> {
    /// The picture of this name, a PNG file.
    pub fn picture(&self, name: &str) -> Result<Output> {
        Output::at(&self.pictures.join(format!("{name}.png")))
    }
}

/// Measures, writes its pictures, and gives its text, from its `##` title on.
pub type Section = fn(&Study) -> Result<String>;

/// All sections, in the order of the page. Each is a file of its own.
pub const SECTIONS: [Section; 1] = [density::section];
