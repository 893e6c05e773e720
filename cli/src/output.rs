//! The output of commands: files, complete or not at all, and results on the standard output.

mod report;
mod temporary;
mod writing;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use azulejo::{Error, Result};

pub use report::Report;
use temporary::Temporary;
pub use temporary::remove_on_signals;
pub use writing::{Replacing, Writing};

/// A file to be written at the end of a command: as a temporary file in the same directory, renamed once complete.
pub struct Output {
    /// As the user gave it, for messages.
    path: PathBuf,
    target: Target,
    /// False if a file that exists is left as it is.
    replaces: bool,
    /// True if the report is JSON.
    json: bool,
}

enum Target {
    /// The standard output.
    Stdout,
    /// A file, and not a link to it.
    File(PathBuf),
}

impl Output {
    /// Checks before the work whether a file can be written at `path`, and leaves no trace.
    pub fn at(path: &Path) -> Result<Self> {
        let target = match path {
            _ if path == Path::new("-") => Target::Stdout,
            _ => Target::File(fs::canonicalize(path).unwrap_or_else(|_| path.into())),
        };
        let output = Self { path: path.into(), target, replaces: true, json: false };
        output.target.probe().map_err(|error| output.error(error))?;
        Ok(output)
    }

    /// [`Output::at`] for output of one format alone: a path that ends in another extension is refused.
    pub fn of_format(extension: &str, path: &Path) -> Result<Self> {
        match path.extension() {
            Some(other) if !other.eq_ignore_ascii_case(extension) => {
                let reason = format!("the extension is not .{extension}, the only format of this file");
                Err(Error::Format { path: path.into(), reason })
            }
            _ => Self::at(path),
        }
    }

    /// The same, which replaces a file that exists or refuses it.
    fn replacing(self, replaces: bool) -> Result<Self> {
        match &self.target {
            Target::File(path) if !replaces && !self.target.is_stream() && path.exists() => Err(self.error(exists())),
            _ => Ok(Self { replaces, ..self }),
        }
    }

    /// The same with a report as JSON or as text.
    fn reported(self, json: bool) -> Self {
        Self { json, ..self }
    }

    fn error(&self, source: io::Error) -> Error {
        Error::Io { path: self.path.clone(), source }
    }

    /// Writes the file; an error leaves no new file behind. It is no failure if the reader of a pipe stops early.
    pub fn write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<()> {
        match self.try_write(content) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe && self.target.is_stream() => Ok(()),
            written => written.map_err(|error| self.error(error)),
        }
    }

    fn try_write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
        match &self.target {
            Target::Stdout => fill(&stdout()?, content),
            // A pipe or a device cannot be replaced by a rename.
            Target::File(path) if self.target.is_stream() => fill(&File::options().write(true).open(path)?, content),
            Target::File(path) => {
                let temporary = Temporary::new(directory(path))?;
                fill(temporary.file(), content)?;
                if self.replaces { temporary.persist(path) } else { temporary.persist_new(path) }
            }
        }
    }

    /// Prints one line about what was written. If that went to the standard output itself, a pipe or a device, text is
    /// left out, and JSON goes to the standard error. It does not matter if the line cannot be printed.
    pub fn report(&self, report: &Report) {
        _ = match (self.json, self.target.is_stream()) {
            (false, false) => writeln!(io::stdout(), "{}", report.line(&self.path)),
            (false, true) => Ok(()),
            (true, false) => writeln!(io::stdout(), "{}", report.json(&self.path)),
            (true, true) => writeln!(io::stderr(), "{}", report.json(&self.path)),
        };
    }
}

impl Target {
    /// True if the output goes to the standard output, a pipe or a device.
    fn is_stream(&self) -> bool {
        match self {
            Self::Stdout => true,
            Self::File(path) => fs::metadata(path).is_ok_and(|found| !found.is_file()),
        }
    }

    fn probe(&self) -> io::Result<()> {
        let Self::File(path) = self else { return Ok(()) };
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if !found.is_file() => Ok(()),
            _ if path.file_name().is_none() => Err(io::ErrorKind::InvalidInput.into()),
            _ => tempfile::tempfile_in(directory(path)).map(|_| ()),
        }
    }
}

fn exists() -> io::Error {
    io::Error::new(io::ErrorKind::AlreadyExists, "exists already; --force replaces it")
}

fn directory(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The standard output as a file, written from its current position.
fn stdout() -> io::Result<File> {
    #[cfg(unix)]
    let handle = std::os::fd::AsFd::as_fd(&io::stdout()).try_clone_to_owned()?;
    #[cfg(windows)]
    let handle = std::os::windows::io::AsHandle::as_handle(&io::stdout()).try_clone_to_owned()?;
    Ok(handle.into())
}

/// Writes a result to the standard output. It is no failure if the reader stops early.
pub fn print(text: &[u8]) -> Result<()> {
    let mut stdout = io::stdout();
    match stdout.write_all(text).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::Io { path: "standard output".into(), source: error })
        }
        _ => Ok(()),
    }
}

fn fill(file: &File, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::with_capacity(1 << 18, file);
    content(&mut writer)?;
    writer.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn is_written_whole_or_not_at_all() {
        let directory = tempfile::tempdir().unwrap();
        let output = Output::at(&directory.path().join("a")).unwrap();
        assert!(names(directory.path()).is_empty());
        let failure = |writer: &mut BufWriter<&File>| {
            writer.write_all(b"half")?;
            Err(io::Error::other("no more"))
        };
        let message = output.write(failure).unwrap_err().to_string();
        assert!(message.ends_with("a: no more"), "{message}");
        assert!(names(directory.path()).is_empty());
        output.write(|writer| writer.write_all(b"first")).unwrap();
        assert!(output.write(failure).is_err());
        assert_eq!(fs::read(directory.path().join("a")).unwrap(), b"first");
        assert_eq!(names(directory.path()), ["a"]);
    }

    #[test]
    fn refuses_at_once_what_cannot_be_written() {
        let directory = tempfile::tempdir().unwrap();
        let refused = |path: &Path| Output::at(path).err().expect("refused").to_string();
        assert!(refused(directory.path()).ends_with("is a directory"));
        assert!(refused(&directory.path().join("no/where")).contains("where: "));
        assert!(Output::at(Path::new("")).is_err());
        let refused = Output::of_format("png", &directory.path().join("a.jpg")).err().expect("refused").to_string();
        assert!(refused.ends_with("a.jpg: the extension is not .png, the only format of this file"), "{refused}");
        assert!(["a.PNG", "a"].iter().all(|name| Output::of_format("png", &directory.path().join(name)).is_ok()));
    }

    #[cfg(unix)]
    #[test]
    fn goes_through_links_and_into_devices() {
        let directory = tempfile::tempdir().unwrap();
        let [file, link] = ["file", "link"].map(|name| directory.path().join(name));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        Output::at(&link).unwrap().write(|writer| writer.write_all(b"new")).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        Output::at(Path::new("/dev/null")).unwrap().write(|writer| writer.write_all(b"new")).unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
