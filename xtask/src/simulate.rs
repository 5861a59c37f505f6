//! `cargo xtask simulate`: `mbs run` in release mode, with its exit status.

use crate::process;
use std::ffi::OsString;
use std::io::{IsTerminal, stderr};
use std::process::ExitCode;

/// Builds `mbs` in release mode (with cargo's progress when standard error is a terminal), then runs `mbs run ARGS`.
pub fn simulate(args: &[OsString]) -> ExitCode {
    let mut build = process::cargo();
    build.args(["build", "--release", "--package", "mbs", "--bin", "mbs"]);
    if !stderr().is_terminal() {
        build.arg("--quiet");
    }
    if let Err(why) = process::run(&mut build) {
        eprintln!("cargo xtask simulate: {why}");
        return ExitCode::FAILURE;
    }

    let mut mbs = process::cargo();
    mbs.args(["run", "--quiet", "--release", "--package", "mbs", "--bin", "mbs", "--", "run"]);
    process::hand_over(mbs.args(args))
}
