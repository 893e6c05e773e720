//! Temporary files that neither a failure nor a signal leaves behind.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// The temporary files of this process. The lock is held while one is made, renamed or removed, so that the list is
/// correct whenever a signal comes.
static FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn files() -> MutexGuard<'static, Vec<PathBuf>> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file that is removed when this is dropped, unless it was persisted.
pub struct Temporary(Option<NamedTempFile>);

impl Temporary {
    pub fn new(directory: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".azulejo-");
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut files = files();
        let file = builder.tempfile_in(directory)?;
        files.push(file.path().into());
        Ok(Self(Some(file)))
    }

    pub fn file(&self) -> &File {
        self.0.as_ref().expect("it is there until it is persisted or dropped").as_file()
    }

    /// Renames the file to `target`, and replaces what is there.
    pub fn persist(mut self, target: &Path) -> io::Result<()> {
        self.end(|file| file.persist(target).map(drop).map_err(|error| error.error))
    }

    /// Renames the file to `target`, where nothing may be.
    pub fn persist_new(mut self, target: &Path) -> io::Result<()> {
        self.end(|file| file.persist_noclobber(target).map(drop).map_err(|error| error.error))
    }

    fn end(&mut self, end: impl FnOnce(NamedTempFile) -> io::Result<()>) -> io::Result<()> {
        let mut files = files();
        let Some(file) = self.0.take() else { return Ok(()) };
        files.retain(|path| path != file.path());
        end(file)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // If the file cannot be removed there is nothing else to try.
        _ = self.end(NamedTempFile::close);
    }
}

/// From now on SIGINT, SIGTERM and SIGXFSZ (a file above the limit of the shell) remove the temporary files before they
/// end the process as they do by default. SIGHUP is left alone, because nohup has it ignored.
#[cfg(unix)]
pub fn remove_on_signals() -> io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::iterator::Signals;

    let mut signals = Signals::new([SIGINT, SIGTERM, SIGXFSZ])?;
    std::thread::spawn(move || {
        for signal in signals.forever() {
            // The lock is kept: no file is made any more.
            let files = files();
            files.iter().for_each(|file| _ = std::fs::remove_file(file));
            _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
    Ok(())
}

#[cfg(not(unix))]
/// Does nothing: only on Unix signals are received.
pub fn remove_on_signals() -> io::Result<()> {
    Ok(())
}
