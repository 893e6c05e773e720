//! The files of a page: its text, and a folder of its pictures beside it.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use azulejo::{Error, Result};
use azulejo_cli::output::Output;
use jiff::Timestamp;
use jiff::tz::TimeZone;

/// A page that is being made.
pub struct Files {
    name: &'static str,
    quick: bool,
    page: Output,
    pictures: PathBuf,
}

impl Files {
    /// The page of this name in a directory, which is made.
    pub fn open(directory: &Path, name: &'static str, quick: bool) -> Result<Self> {
        make(directory)?;
        let page = Output::at(&directory.join(format!("{name}.md")))?;
        Ok(Self { name, quick, page, pictures: directory.join(name) })
    }

    /// The picture of this name. The page calls it `<page>/<name>.png`; the folder is made.
    pub fn picture(&self, name: &str) -> Result<Output> {
        make(&self.pictures)?;
        Output::at(&self.pictures.join(format!("{name}.png")))
    }

    /// Writes the page: its title and subject, date, command and machine, and the text.
    pub fn write(&self, title: &str, subject: &str, threads: usize, text: &str) -> Result<()> {
        let (name, quick) = (self.name, if self.quick { " --quick" } else { "" });
        let space = if text.starts_with('\n') { "" } else { " " };
        let (date, processor) = (Timestamp::now().to_zoned(TimeZone::UTC).date(), processor());
        self.page.write(|writer| {
            writeln!(writer, "# {title}\n\n{subject}\n")?;
            write!(writer, "Written by `cargo run --release -p azulejo-studies -- {name}{quick}` on {date}, ")?;
            write!(writer, "on {threads} threads of {processor}.{space}{text}")
        })
    }
}

fn make(directory: &Path) -> Result<()> {
    fs::create_dir_all(directory).map_err(|source| Error::Io { path: directory.to_owned(), source })
}

/// The name of the processor, where the system tells it.
fn processor() -> String {
    let about = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or("an unknown processor", |(_, name)| name).to_owned()
}
