//! The jobs `cargo xtask mbs` and `cargo xtask simulate`: they run the command `mbs` in release mode, and return its exit status.

use crate::command::{Build, cargo_on};
use crate::process::hand_over;
use std::ffi::{OsStr, OsString};
use std::process::ExitCode;

/// The environment variable that lets the command omit its message about a missing precision.
const BUILDER: &str = "MBS_BUILDER";
/// Exit status of the command if its build lacks a precision.
const UNBUILT: u8 = 3;

/// Builds `mbs` with `f64` alone and runs it. If the arguments need another precision, `mbs` ends at once; it is then built with all
/// precisions and run again.
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
