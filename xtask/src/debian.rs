//! Installation of Debian packages on systems where a job may install packages.

use crate::process::{self, output, run};
use crate::summary::LeftOut;
use std::fs::File;
use std::process::Command;

/// Installs packages, as root on a system with `apt-get`.
///
/// # Errors
///
/// The reason why they cannot be installed.
pub fn install(packages: &[&str]) -> Result<(), String> {
    if output(Command::new("id").arg("-u")).as_deref() != Some("0") {
        return Err("packages can be installed as root only".to_owned());
    }
    if output(Command::new("apt-get").arg("--version")).is_none() {
        return Err("this system has no apt-get".to_owned());
    }
    // a lock file lets one process install at a time: checks run in parallel, and apt locks its lists
    let turn = process::target_dir().join("apt-turn");
    let turn = File::create(&turn).map_err(|e| format!("{}: {e}", turn.display()))?;
    turn.lock().map_err(|e| format!("no turn for apt-get: {e}"))?;
    eprintln!("   installing {} with apt-get", packages.join(", "));
    let apt = |args: &[&str]| {
        run(Command::new("apt-get").args(args).env("DEBIAN_FRONTEND", "noninteractive"))
    };
    apt(&["update", "--quiet=2"])?;
    let mut args = vec!["install", "--yes", "--quiet=2", "--no-install-recommends"];
    args.extend(packages);
    apt(&args)
}

/// Checks that a program runs here. If it is missing, its package is installed where that is possible.
///
/// # Errors
///
/// The missing program, and the reason why it is not installed.
pub fn find(program: &str, package: &str) -> Result<(), LeftOut> {
    let runs = || output(Command::new(program).arg("--version")).is_some();
    if runs() {
        return Ok(());
    }
    let refusal = install(&[package]).err();
    if runs() {
        return Ok(());
    }
    let refusal = refusal.map_or(String::new(), |refusal| format!("; {refusal}"));
    Err(LeftOut {
        why: format!("`{program}` is not installed{refusal}"),
        remedy: format!("On Debian, as root: `apt-get install --no-install-recommends {package}`."),
    })
}
