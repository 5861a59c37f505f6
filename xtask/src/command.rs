//! The command `mbs`, built as a job needs it.

use crate::process::{self, cargo, root, target_dir};
use std::io::{IsTerminal, stderr};
use std::path::PathBuf;

/// How it is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Build {
    /// In release mode, in `f64` alone: half the work of the others, for a first run.
    Double,
    /// In release mode, with all precisions.
    All,
    /// As it is published and measured: with all precisions, optimised as a whole.
    Dist,
}

/// Builds the command, with cargo's progress when standard error is a terminal; its path.
///
/// # Errors
///
/// What cargo came to.
pub fn built(build: Build) -> Result<PathBuf, String> {
    let profile = if build == Build::Dist { "dist" } else { "release" };
    let mut command = cargo();
    command.args(["build", "--profile", profile, "--package", "mbs-cli", "--bin", "mbs"]);
    if build == Build::Double {
        command.arg("--no-default-features");
    }
    if !stderr().is_terminal() {
        command.arg("--quiet");
    }
    process::run(command.current_dir(root()))?;
    Ok(target_dir().join(profile).join("mbs"))
}
