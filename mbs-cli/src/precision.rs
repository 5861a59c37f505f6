//! Precisions that the command line names, and those that a build lacks.

use crate::refusal::Refusal;
use crate::status::UNBUILT;
use mbs::{Precision, PrecisionError};
use std::process::ExitCode;

/// Commands other than `run` and `compare` compute in numbers of the hardware.
pub(crate) const NO_PAIRS: [&str; 2] = ["precision `dd` is for `mbs run`", "leave --precision out"];

/// Set by a caller that builds what is missing: then a precision that this build lacks is no message, only an exit status.
const BUILDER: &str = "MBS_BUILDER";

/// The precision of a name, where it is one.
pub(crate) fn named(name: &Option<String>) -> Option<Precision> {
    Precision::ALL.into_iter().find(|p| Some(p.name()) == name.as_deref())
}

/// Says which precision this build lacks, to whom does not build it himself.
pub(crate) fn unbuilt(precision: Precision) -> ExitCode {
    if std::env::var_os(BUILDER).is_none() {
        Refusal::scene(&PrecisionError::NotBuilt(precision)).report();
    }
    ExitCode::from(UNBUILT)
}
