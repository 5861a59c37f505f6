//! A checkpoint that cannot be resumed.

use crate::settings::SettingsError;
use core::fmt::{self, Display, Formatter};
use std::io;

/// Reason why a checkpoint cannot be resumed.
#[derive(Debug)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be read.
    Io(io::Error),
    /// A directory in which another process keeps a run.
    Busy,
    /// The file is something else.
    NotACheckpoint,
    /// The checkpoint was written by another version of mbs, which is given here.
    Version(String),
    /// The file has other than the bytes it says.
    Torn {
        /// Bytes after the head, as it says.
        stated: u64,
        /// Bytes there are, or one more than stated where there are more.
        found: u64,
    },
    /// The sum over its bytes is another: they have changed since they were written.
    Checksum,
    /// The bytes are whole, but do not make a state of this scene.
    Misfit,
    /// The checkpoint belongs to another scene; these parts of it differ.
    Scene(Vec<&'static str>),
    /// The checkpoint belongs to a run with another setting.
    Setting {
        /// Name of the setting, as on the command line.
        key: &'static str,
        /// Value of the setting in the checkpoint.
        was: String,
        /// Value of the setting now.
        is: String,
    },
    /// The settings that are given are refused, whatever the checkpoint.
    Settings(SettingsError),
    /// The checkpoint was saved from a `Simulation`; there is no recorded run in it.
    NoRun,
}

impl CheckpointError {
    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Io(_) => "give a file that can be read".to_owned(),
            Self::Busy => "wait for it, or give another directory with --out".to_owned(),
            Self::NotACheckpoint => "give the checkpoint.mbs of a run".to_owned(),
            Self::Version(found) => format!(
                "continue with mbs {found}, or begin anew with --restart: another version may round otherwise"
            ),
            Self::Torn { .. } | Self::Checksum | Self::Misfit => {
                "begin anew with --restart, or give an earlier copy of the file".to_owned()
            }
            Self::Scene(_) => {
                "continue with the scene as it was, or begin anew with --restart".to_owned()
            }
            Self::Setting { key, was, .. } if was.is_empty() => {
                format!("leave --{key} out, or begin anew with --restart")
            }
            Self::Setting { key, was, .. } => {
                format!("leave --{key} out or give {was}, or begin anew with --restart")
            }
            Self::Settings(error) => error.hint(),
            Self::NoRun => "take it back with Simulation::restore".to_owned(),
        }
    }
}

impl Display for CheckpointError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "the checkpoint cannot be read: {error}"),
            Self::Busy => write!(f, "another process keeps a run in the directory"),
            Self::NotACheckpoint => write!(f, "this is no checkpoint"),
            Self::Version(found) => write!(
                f,
                "the checkpoint was written by mbs {found}, and this is {}",
                env!("CARGO_PKG_VERSION")
            ),
            Self::Torn { stated, found } if found > stated => {
                write!(f, "the checkpoint is longer than the {stated} bytes it says")
            }
            Self::Torn { stated, found } => {
                write!(f, "the checkpoint is torn: {found} of its {stated} bytes are there")
            }
            Self::Checksum => write!(f, "the checkpoint is damaged: its checksum does not hold"),
            Self::Misfit => write!(f, "the checkpoint has no state of this scene in it"),
            Self::Scene(parts) => write!(
                f,
                "the checkpoint is of another scene: {} {} not as it was",
                parts.join(", "),
                if parts.len() == 1 { "is" } else { "are" }
            ),
            Self::Setting { key, was, is } => {
                let said =
                    |x: &str| if x.is_empty() { "left out".to_owned() } else { x.to_owned() };
                write!(
                    f,
                    "the checkpoint is of a run with other settings: {key} was {}, and is {}",
                    said(was),
                    said(is)
                )
            }
            Self::Settings(error) => write!(f, "{error}"),
            Self::NoRun => write!(f, "the checkpoint has a state in it, and no recorded run"),
        }
    }
}

impl core::error::Error for CheckpointError {}

impl From<io::Error> for CheckpointError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}
