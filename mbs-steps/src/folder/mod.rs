//! A directory of results: locked while a process writes it, and replaced only by complete results.
//!
//! Files are written into `.part` within the directory and synced. When all files are complete, they are renamed to their final names. The
//! JSON object comes last; it has the sizes and checksums of the tables. A process that is killed before the renames leaves the old results
//! unchanged. A process that is killed between two renames leaves a mixture, which [`Folder::mixed`] detects by the checksums.

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

/// Name of the directory into which incomplete results are written.
pub const PART: &str = ".part";

/// Returns an identifier of results that depend on these texts, for example on the scene and the method of the run.
#[must_use]
pub fn id(texts: &[&str]) -> String {
    let mut all = Fingerprint::new();
    for text in texts.iter().chain(&[env!("CARGO_PKG_VERSION")]) {
        // Each text follows its length, so that different splits of the same characters give different identifiers.
        all.add(&(text.len() as u64).to_le_bytes());
        all.add(text.as_bytes());
    }
    format!("{:016x}", all.get())
}

/// Directory into which only this process writes results, until the value is dropped.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Directories that were created for the results, the deepest first.
    made: Vec<PathBuf>,
    lock: Option<File>,
}

impl Folder {
    /// Locks a directory into which results with these file names are written, and creates it if it does not exist. Existing files are not
    /// changed.
    ///
    /// # Errors
    /// [`FolderError`] if another process writes there, or if the directory cannot be written.
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

    /// Returns the first file of a directory that does not belong to the results of its JSON object, with the name of that object. Such a
    /// file was changed, or a process was killed between two renames.
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
        // If no results were written, the directories that were created are removed, unless they contain other files.
        for made in &self.made {
            if fs::remove_dir(made).is_err() {
                return;
            }
        }
    }
}
