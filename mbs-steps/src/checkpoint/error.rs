//! Errors of a checkpoint that cannot be resumed.

use crate::settings::SettingsError;
use core::fmt::{self, Display, Formatter};
use std::io;

/// Reason why a checkpoint cannot be resumed.
#[derive(Debug)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be read.
    Io(io::Error),
    /// Directory that another process uses for a run.
    Busy,
    /// The file is no checkpoint.
    NotACheckpoint,
    /// The checkpoint was written by the given other version of mbs.
    Version(String),
    /// The length of the file differs from the length stated in its header.
    Torn {
        /// Number of bytes after the header, as stated in the header.
        stated: u64,
        /// Number of bytes found after the header. If the file is longer than stated, it is the stated number plus one.
        found: u64,
    },
    /// The checksum of the bytes differs from the stored checksum, so the file was changed after it was written.
    Checksum,
    /// The bytes are complete, but are no state of this scene.
    Misfit,
    /// The checkpoint belongs to another scene; the list has the parts of the scene that differ.
    Scene(Vec<&'static str>),
    /// The checkpoint belongs to a run with another value of a setting.
    Setting {
        /// Name of the setting, as on the command line.
        key: &'static str,
        /// Value of the setting in the checkpoint.
        was: String,
        /// Value of the setting for the resumed run.
        is: String,
    },
    /// The given settings are invalid, independent of the checkpoint.
    Settings(SettingsError),
    /// The checkpoint was saved from a `Simulation`, so it has no recorded run.
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
