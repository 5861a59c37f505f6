//! `cargo xtask test`: every check of this repository, in order, up to the first failure.

use crate::counts;
use crate::documentation;
use crate::nostd;
use crate::pick;
use crate::process::{self, cargo, run};
use crate::summary::{LeftOut, Outcome, Summary};
use std::process::{Command, ExitCode};

/// Feature sets of mbs-core that must build on the host, as arguments of cargo.
const CORE_FEATURES: [(&str, &[&str]); 9] = [
    ("none", &["--no-default-features"]),
    ("alloc", &["--no-default-features", "--features", "alloc"]),
    ("std", &["--no-default-features", "--features", "std"]),
    // Laws with tables, laws that share a file, the two kinds of law, and all without scenes.
    ("polynomial", &["--no-default-features", "--features", "alloc,polynomial"]),
    ("limit", &["--no-default-features", "--features", "alloc,limit,friction"]),
    ("bushing", &["--no-default-features", "--features", "alloc,bushing,bumper"]),
    ("tire", &["--no-default-features", "--features", "alloc,tire,speed-hold"]),
    ("own-laws", &["--no-default-features", "--features", "alloc,own-laws,drag"]),
    ("effects", &["--no-default-features", "--features", "effects"]),
];

/// Runs every check and prints the summary; exit status 1 at the first failure.
pub(crate) fn test(quick: bool) -> ExitCode {
    let mut summary = Summary::default();
    let result = checks(quick, &mut summary);
    eprintln!();
    eprint!("{}", summary.text());
    match result {
        Ok(()) => {
            eprintln!("\nAll checks that ran hold.");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("\n{why}");
            ExitCode::FAILURE
        }
    }
}

/// The checks in order.
fn checks(quick: bool, summary: &mut Summary) -> Result<(), String> {
    summary.check("format", || component("fmt", "rustfmt", &["fmt", "--all", "--check"]))?;
    if quick {
        summary.skip("lints", "--quick");
    } else {
        let args =
            ["clippy", "--workspace", "--all-targets", "--quiet", "--", "--deny", "warnings"];
        summary.check("lints", || component("clippy", "clippy", &args))?;
    }
    summary.check("tests", || passed(cargo().args(["test", "--workspace"])))?;
    if quick {
        summary.skip("documentation", "--quick");
    } else {
        summary.check("documentation", documentation::check)?;
    }
    summary.check("features", || core_features(quick))?;
    summary.check("pick", pick::check)?;
    summary.check("check-nostd", nostd::check)?;
    if quick {
        summary.skip("counts", "--quick");
        Ok(())
    } else {
        summary.check("counts", counts::check)
    }
}

/// Runs a command whose success is all that counts.
fn passed(command: &mut Command) -> Result<Outcome, String> {
    run(command.current_dir(process::root())).map(|()| Outcome::Passed(String::new()))
}

/// Runs a cargo subcommand that a minimal Rust installation lacks.
fn component(subcommand: &str, name: &str, args: &[&str]) -> Result<Outcome, String> {
    if process::output(cargo().args([subcommand, "--version"])).is_none() {
        return Ok(Outcome::LeftOut(LeftOut {
            why: format!("`cargo {subcommand}` is not installed"),
            remedy: format!("Get it with `rustup component add {name}`."),
        }));
    }
    passed(cargo().args(args))
}

/// Checks mbs-core with each of its feature sets alone: with lints, or the compiler only when quick.
fn core_features(quick: bool) -> Result<Outcome, String> {
    let lints = !quick && process::output(cargo().args(["clippy", "--version"])).is_some();
    for (_, features) in CORE_FEATURES {
        let mut command = cargo();
        command.args([if lints { "clippy" } else { "check" }, "--quiet", "--package", "mbs-core"]);
        command.args(features);
        if lints {
            command.args(["--", "--deny", "warnings"]);
        }
        run(command.current_dir(process::root()))?;
    }
    let names = CORE_FEATURES.map(|(name, _)| name);
    Ok(Outcome::Passed(format!("mbs-core with {}", names.join(", "))))
}
