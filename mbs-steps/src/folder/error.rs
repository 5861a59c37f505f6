//! Reasons why results cannot be written into a directory.

use core::fmt::{self, Display, Formatter};
use std::io;
use std::path::PathBuf;

/// Reason why results cannot be written into a directory.
#[derive(Debug)]
#[non_exhaustive]
pub enum FolderError {
    /// The directory is locked by a process that writes into it. The value is the number of that process, if it can be read.
    Busy(Option<u32>),
    /// A directory has the name of a file of the results.
    Taken(PathBuf),
    /// A file has the name of the directory.
    IsFile,
    /// The directory cannot be created or written.
    Io(io::Error),
}

impl Display for FolderError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Busy(Some(process)) => write!(f, "it is being written by process {process}"),
            Self::Busy(None) => write!(f, "it is being written by another process"),
            Self::Taken(path) => write!(f, "`{}` is a directory", path.display()),
            Self::IsFile => write!(f, "that is a file"),
            Self::Io(error) => write!(f, "{error}"),
        }
    }
}

impl FolderError {
    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Busy(_) => "wait for it, or give another directory with --out",
            Self::Taken(_) => {
                "a file of the results goes there: give another directory with --out, or remove it"
            }
            Self::IsFile => "results are several files: give a directory with --out",
            Self::Io(_) => "give a directory that can be made or written with --out",
        }
    }
}

impl core::error::Error for FolderError {}

impl From<io::Error> for FolderError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}
