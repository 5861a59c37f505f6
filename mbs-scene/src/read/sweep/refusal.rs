//! Errors of sweeps in a file or in code. An error of a file has the place in it; an error of numbers from code has the path.

use super::SweepFault;
use crate::read::ReadError;
use core::fmt;

/// Error of a sweep that is not valid.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepRefusal {
    /// An error of the sweep's file, with the place in it.
    File(ReadError),
    /// An error of numbers that code gives.
    Numbers {
        /// Path of the numbers; empty when the error belongs to no path.
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
            Self::Numbers { path, fault } => write!(f, "`{path}`: {fault}"),
        }
    }
}

impl core::error::Error for SweepRefusal {}
