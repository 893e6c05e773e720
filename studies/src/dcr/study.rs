//! The context of the sections that follow the tables of the methods.

use std::path::Path;

use azulejo::dcr::{Method, Neighbourhood, Options, Thesis};
use azulejo::{Context, Domain, Result};

use crate::files::Files;
use azulejo_cli::draw::rows::in_parallel;
use azulejo_cli::output::Output;
use azulejo_cli::progress::watched;

/// The context of a section.
pub struct Study<'a> {
    pub context: &'a Context,
    /// The files of the page.
    pub files: &'a Files,
    /// True if few and small sets suffice.
    pub quick: bool,
    /// The files of meshes, where they were given.
    pub bunny: Option<&'a Path>,
    pub dragon: Option<&'a Path>,
}

impl Study<'_> {
    /// The picture of this name, a PNG file.
    pub fn picture(&self, name: &str) -> Result<Output> {
        self.files.picture(name)
    }

    /// `[work(0), .., work(count - 1)]`, each on one thread, as many at a time as there are threads: one relaxation by
    /// the thesis's algorithm has little to share.
    pub fn each<T: Send>(
        &self,
        what: &'static str,
        count: usize,
        work: impl Fn(&Context, usize) -> Result<T> + Sync,
    ) -> Result<Vec<T>> {
        let single = Context::new(1)?;
        let threads = self.context.num_threads();
        watched(what, |progress| in_parallel(threads, count, progress, |i| work(&single, i)))?.into_iter().collect()
    }
}

/// The thesis's algorithm with these settings.
pub fn thesis_options(thesis: Thesis, neighbourhood: Neighbourhood, domain: Domain, seed: u64) -> Options {
    Options::thesis(domain, neighbourhood).method(Method::Thesis(thesis)).seed(seed)
}
