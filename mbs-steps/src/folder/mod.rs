//! A directory of results: locked while a process writes it, and replaced by results that are whole.
//!
//! Files are written into `.part` within the directory, synced, and renamed into their places when all are there. The JSON object comes
//! last, and has the sizes and checksums of the tables. A process that is killed before leaves the results as they were. One that is
//! killed between two renames leaves a mixture, which [`Folder::mixed`] finds by the sums.

mod error;
mod lock;
mod mixed;
mod part;

pub use error::FolderError;
pub use part::{Part, WriteError, write_file};

#[doc(hidden)]
pub use part::write_whole;

use crate::fingerprint::Fingerprint;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// Name of the directory in which results are written before they are whole.
pub const PART: &str = ".part";

/// The id of results that depend on these texts: the scene, say, and how it is run.
#[must_use]
pub fn id(texts: &[&str]) -> String {
    let mut all = Fingerprint::new();
    for text in texts.iter().chain(&[env!("CARGO_PKG_VERSION")]) {
        // with their lengths, so that none runs into the next
        all.add(&(text.len() as u64).to_le_bytes());
        all.add(text.as_bytes());
    }
    format!("{:016x}", all.get())
}

/// A directory that this process alone writes results into, until it is dropped.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Directories that were made for it, the deepest first.
    made: Vec<PathBuf>,
    lock: Option<File>,
}

impl Folder {
    /// Locks a directory, made if missing, for results in these files. Nothing that is in it is touched.
    ///
    /// # Errors
    /// [`FolderError`] where another process writes there, or nothing can be written.
    pub fn open(path: &Path, files: &[&str]) -> Result<Self, FolderError> {
        if path.is_file() {
            return Err(FolderError::IsFile);
        }
        let is_missing = |at: &&Path| !at.as_os_str().is_empty() && !at.exists();
        let made = path.ancestors().take_while(is_missing).map(Path::to_owned).collect();
        fs::create_dir_all(path)?;
        let mut folder = Self { path: path.to_owned(), made, lock: None };
        folder.lock = Some(lock::take(path)?);
        match files.iter().map(|file| path.join(file)).find(|file| file.is_dir()) {
            Some(taken) => Err(FolderError::Taken(taken)),
            None => Ok(folder),
        }
    }

    /// Path of the directory.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The first file of a directory that does not belong to the results of its JSON object, with the name of that object. It was changed, or a
    /// process was killed between two renames.
    #[must_use]
    pub fn mixed(path: &Path) -> Option<[String; 2]> {
        mixed::find(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if self.lock.take().is_some() {
            lock::remove(&self.path);
        }
        // What was made for results that never came goes again; what has something in it stays.
        for made in &self.made {
            if fs::remove_dir(made).is_err() {
                return;
            }
        }
    }
}
