//! `cargo xtask mbs` and `cargo xtask simulate`: the command `mbs` in release mode, with its exit status.

use crate::command::{Build, built};
use crate::process;
use std::ffi::{OsStr, OsString};
use std::process::{Command, ExitCode};

/// Set for the command: it need not say which precision is missing.
const BUILDER: &str = "MBS_BUILDER";
/// Its exit status when this build lacks a precision.
const UNBUILT: i32 = 3;

/// Builds `mbs` with `f64` alone and runs it. Where the arguments ask for more digits or fewer, it is built with all precisions, and run
/// again: it has done nothing before.
pub fn mbs(args: &[OsString]) -> ExitCode {
    let run = |build| {
        let mut mbs = Command::new(built(build)?);
        mbs.args(args).env(BUILDER, "1");
        let status = mbs.status();
        status.map_err(|e| format!("cannot start `{}`: {e}", process::line(&mbs)))
    };
    let status = match run(Build::Double) {
        Ok(status) if status.code() == Some(UNBUILT) => run(Build::All),
        other => other,
    };
    match status {
        Ok(status) => process::exit_code(status),
        Err(why) => {
            eprintln!("cargo xtask: {why}");
            ExitCode::FAILURE
        }
    }
}

/// `mbs run ARGS`.
pub fn simulate(args: &[OsString]) -> ExitCode {
    let run = [OsStr::new("run").to_owned()];
    mbs(&[&run, args].concat())
}
