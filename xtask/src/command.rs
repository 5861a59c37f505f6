//! The command `mbs`, built as a job needs it.

use crate::process::{self, cargo, root, target_dir};
use std::io::{IsTerminal, stderr};
use std::path::PathBuf;
use std::process::Command;

/// How it is built, in release mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Build {
    /// Build in `f64` alone: half the work of the other, for a first run.
    Double,
    /// Build with all precisions.
    All,
}

/// A command of cargo on the command `mbs`, with cargo's progress when standard error is a terminal.
pub fn cargo_on(subcommand: &str, build: Build) -> Command {
    let mut command = cargo();
    command.args([subcommand, "--release", "--package", "mbs-cli", "--bin", "mbs"]);
    command.arg("--manifest-path").arg(root().join("Cargo.toml"));
    command.arg("--target-dir").arg(target_dir());
    if build == Build::Double {
        command.arg("--no-default-features");
    }
    if !stderr().is_terminal() {
        command.arg("--quiet");
    }
    command
}

/// Builds the command with all precisions; its path.
///
/// # Errors
///
/// What cargo came to.
pub fn built() -> Result<PathBuf, String> {
    process::run(&mut cargo_on("build", Build::All))?;
    Ok(target_dir().join("release").join("mbs"))
}
