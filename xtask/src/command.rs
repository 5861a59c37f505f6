//! Builds of the command `mbs` for the jobs.

use crate::process::{self, cargo, root, target_dir};
use std::io::{IsTerminal, stderr};
use std::path::PathBuf;
use std::process::Command;

/// Features of a build of the command in release mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Build {
    /// Build in `f64` alone, for a first run: it takes half as long as the other.
    Double,
    /// Build with all precisions.
    All,
}

/// A subcommand of cargo for the command `mbs`. It shows cargo's progress if standard error is a terminal.
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

/// Builds the command with all precisions. Returns its path.
///
/// # Errors
///
/// The command of cargo and its exit status, if it fails.
pub fn built() -> Result<PathBuf, String> {
    process::run(&mut cargo_on("build", Build::All))?;
    Ok(target_dir().join("release").join("mbs"))
}
