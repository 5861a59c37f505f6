//! `cargo xtask mbs` and `cargo xtask simulate`: the command `mbs` in release mode, with its exit status.

use crate::command::{Build, cargo_on};
use crate::process::hand_over;
use std::ffi::{OsStr, OsString};
use std::process::ExitCode;

/// Set for the command: it need not say which precision is missing.
const BUILDER: &str = "MBS_BUILDER";
/// Exit status of the command when this build lacks a precision.
const UNBUILT: u8 = 3;

/// Builds `mbs` with `f64` alone and runs it. Where the arguments ask for more digits or fewer, it is built with all precisions, and run
/// again: it has done nothing before.
pub fn mbs(args: &[OsString]) -> ExitCode {
    let mbs = |build| {
        let mut mbs = cargo_on("run", build);
        mbs.arg("--").args(args);
        mbs
    };
    let status = hand_over(mbs(Build::Double).env(BUILDER, "1"));
    if status == ExitCode::from(UNBUILT) { hand_over(&mut mbs(Build::All)) } else { status }
}

/// Builds and runs `mbs run ARGS`.
pub fn simulate(args: &[OsString]) -> ExitCode {
    let run = [OsStr::new("run").to_owned()];
    mbs(&[&run, args].concat())
}
