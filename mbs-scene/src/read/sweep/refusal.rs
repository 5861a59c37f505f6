//! Refusals of sweeps: of a file with its place, of code with the path.

use super::SweepFault;
use crate::read::ReadError;
use core::fmt;

/// Refusal of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepRefusal {
    /// Refusal of what its file says, with the place there.
    File(ReadError),
    /// Refusal of numbers that code gives.
    Numbers {
        /// Path of the numbers; empty where there are none.
        path: String,
        /// Fault of the path or of a number.
        fault: SweepFault,
    },
}

impl From<ReadError> for SweepRefusal {
    fn from(error: ReadError) -> Self {
        Self::File(error)
    }
}

impl fmt::Display for SweepRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(error) => error.fmt(f),
            Self::Numbers { path, fault } if path.is_empty() => fault.fmt(f),
            Self::Numbers { path, fault } => write!(f, "{path}: {fault}"),
        }
    }
}

impl core::error::Error for SweepRefusal {}
