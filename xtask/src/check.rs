//! `cargo xtask test`: every check of this repository, in order, up to the first failure.

use crate::counts;
use crate::documentation;
use crate::fuzz;
use crate::nostd;
use crate::pages;
use crate::pick;
use crate::process::{self, cargo, run};
use crate::summary::{LeftOut, Outcome, Summary};
use std::process::{Command, ExitCode};

/// Crates with features, and the sets of them that must build on the host.
const FEATURES: [(&str, &[&str]); 3] = [
    // Of the effects: laws with tables, laws that share a file, laws of both kinds, and all without scenes.
    (
        "mbs-core",
        &[
            "",
            "alloc",
            "std",
            "alloc,polynomial",
            "alloc,limit,friction",
            "alloc,bushing,bumper",
            "alloc,tire,speed-hold",
            "alloc,own-laws,drag",
            "effects",
        ],
    ),
    ("mbs-recursive", &["", "alloc", "alloc,tire", "alloc,effects"]),
    ("mbs-nostd", &["", "tire", "polynomial,speed-hold", "effects", "export", "export,effects"]),
];

/// Runs every check and prints the summary; exit status 1 at the first failure.
pub fn test(quick: bool) -> ExitCode {
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
        summary.skip("fuzz", "--quick");
        summary.skip("pages", "--quick");
    } else {
        summary.check("fuzz", fuzz::check)?;
        summary.check("pages", pages::check)?;
    }
    if quick {
        summary.skip("documentation", "--quick");
    } else {
        summary.check("documentation", documentation::check)?;
    }
    summary.check("features", || features(quick))?;
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

/// Checks crates with each of their feature sets alone: with lints, or the compiler only when quick.
fn features(quick: bool) -> Result<Outcome, String> {
    let lints = !quick && process::output(cargo().args(["clippy", "--version"])).is_some();
    for (package, sets) in FEATURES {
        for set in sets {
            let mut command = cargo();
            command.args([if lints { "clippy" } else { "check" }, "--quiet", "--package", package]);
            command.args(["--no-default-features", "--features", set]);
            if lints {
                command.args(["--", "--deny", "warnings"]);
            }
            run(command.current_dir(process::root()))?;
        }
    }
    let names = |sets: &[&str]| {
        let names = sets.iter().map(|set| if set.is_empty() { "none" } else { set });
        names.collect::<Vec<_>>().join(", ")
    };
    let remarks = FEATURES.map(|(package, sets)| format!("{package} with {}", names(sets)));
    Ok(Outcome::Passed(remarks.join("; ")))
}
