//! Output files that are there whole or not at all.

mod temporary;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use azulejo::{Error, Result};

use temporary::Temporary;
pub use temporary::remove_on_signals;

/// A file to be written at the end of a command. It is written beside its place and renamed when it is whole.
pub struct Output {
    /// As the user gave it, for messages.
    path: PathBuf,
    /// The file itself if `path` is a link to it.
    target: PathBuf,
}

impl Output {
    /// Finds out before the work whether there can be a file at `path`, and leaves no trace.
    pub fn at(path: &Path) -> Result<Self> {
        let output = Self { path: path.into(), target: fs::canonicalize(path).unwrap_or_else(|_| path.into()) };
        output.probe().map_err(|error| output.error(error))?;
        Ok(output)
    }

    fn probe(&self) -> io::Result<()> {
        match fs::metadata(&self.target) {
            Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if !found.is_file() => Ok(()),
            _ if self.target.file_name().is_none() => Err(io::ErrorKind::InvalidInput.into()),
            _ => tempfile::tempfile_in(self.directory()).map(|_| ()),
        }
    }

    fn directory(&self) -> &Path {
        self.target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
    }

    fn error(&self, source: io::Error) -> Error {
        Error::Io { path: self.path.clone(), source }
    }

    /// Writes the file; on an error nothing is there that was not there before.
    pub fn write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<()> {
        self.try_write(content).map_err(|error| self.error(error))
    }

    fn try_write(&self, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
        // A pipe or a device cannot be replaced by a rename, and has no half.
        if fs::metadata(&self.target).is_ok_and(|found| !found.is_file()) {
            return fill(&File::options().write(true).open(&self.target)?, content);
        }
        let temporary = Temporary::new(self.directory())?;
        fill(temporary.file(), content)?;
        temporary.persist(&self.target)
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
