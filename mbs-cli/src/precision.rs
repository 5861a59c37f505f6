//! Precisions that the command line names, and precisions that a build lacks.

use crate::refusal::Refusal;
use crate::status::UNBUILT;
use mbs::{Precision, PrecisionError};
use std::process::ExitCode;

/// Message and hint for double-double numbers in commands other than `run` and `compare`.
pub(crate) const NO_PAIRS: [&str; 2] = ["precision `dd` is for `mbs run`", "leave --precision out"];

/// The environment variable of a caller that builds a missing precision itself. Then a missing precision gives only an exit status, without
/// a message.
const BUILDER: &str = "MBS_BUILDER";

/// The precision of a name, if the name is known.
pub(crate) fn named(name: &Option<String>) -> Option<Precision> {
    Precision::ALL.into_iter().find(|p| Some(p.name()) == name.as_deref())
}

/// Reports the precision that this build lacks, unless the caller will build it.
pub(crate) fn unbuilt(precision: Precision) -> ExitCode {
    if std::env::var_os(BUILDER).is_none() {
        Refusal::scene(&PrecisionError::NotBuilt(precision)).report();
    }
    ExitCode::from(UNBUILT)
}
