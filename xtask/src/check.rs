//! `cargo xtask test`: every check of this repository.

use crate::debian;
use crate::documentation;
use crate::nostd;
use crate::package;
use crate::pages;
use crate::pick;
use crate::process::{self, cargo, run};
use crate::python;
use crate::summary::{LeftOut, Outcome, Summary};
use std::process::{Command, ExitCode, Stdio};

/// Crates with features, and the sets of them that must build on the host.
const FEATURES: [(&str, &[&str]); 7] = [
    ("mbs-math", &["", "alloc"]),
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
    // Of the elements: those with rows, those without, and all.
    (
        "mbs-recursive",
        &[
            "",
            "couplings,rolling,sums",
            "couplings,curves",
            "lines,sums",
            "rotors,signals",
            "alloc",
            "alloc,mbs-core/tire",
            "alloc,mbs-core/effects",
        ],
    ),
    (
        "mbs-nostd",
        &[
            "",
            "mbs-core/tire",
            "mbs-core/polynomial,mbs-core/speed-hold",
            "mbs-core/effects",
            "couplings,rotors",
            "couplings,curves",
            "rolling",
            "lines,signals,sums",
            "elements",
            "export",
            "export,mbs-core/effects",
        ],
    ),
    ("mbs", &["", "f32", "dd"]),
    ("mbs-cli", &["", "f32", "dd"]),
    ("lab", &["jobs,effects"]),
];

/// What is left out of the checks, and what is added to them.
#[derive(Debug, Clone, Copy, Default)]
pub struct Scope {
    /// Without lints, documentation, fuzz, pages and counts.
    pub is_quick: bool,
    /// A check that lacks a tool fails.
    pub is_strict: bool,
    /// The jobs too that take hours.
    pub is_long: bool,
}

/// Runs every check and prints the summary; exit status 1 if one failed.
pub fn test(scope: Scope) -> ExitCode {
    let mut summary = Summary::new(scope.is_strict);
    checks(scope.is_quick, &mut summary);
    if scope.is_long {
        long(&mut summary);
    }
    let result = summary.complete();
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

type Check = fn() -> Result<Outcome, String>;

/// Whether a quick list has a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum IfQuick {
    Runs,
    Skipped,
}

type Listed = (&'static str, Check, IfQuick);

/// What is built and run first, in order.
const BUILT_FIRST: [Listed; 4] = [
    ("format", format, IfQuick::Runs),
    ("lints", lints, IfQuick::Skipped),
    // Before the tests: it leaves a lean `mbs` where later jobs look for the whole one, which the tests build.
    ("features", features, IfQuick::Runs),
    ("tests", tests, IfQuick::Runs),
];

/// Then two lists beside each other: each alone leaves a core idle half of the time. What they use of the target folder of the tests is built
/// there by now, with the features of the tests.
const THEN: [&[Listed]; 2] = [
    &[
        ("fuzz", fuzz, IfQuick::Skipped),
        ("pages", pages::check, IfQuick::Skipped),
        ("documentation", documentation::check, IfQuick::Skipped),
        ("counts", counts, IfQuick::Skipped),
    ],
    &[
        ("check-nostd", nostd::check, IfQuick::Runs),
        ("pick", pick::check, IfQuick::Runs),
        ("python", python::check, IfQuick::Skipped),
    ],
];

fn checks(is_quick: bool, summary: &mut Summary) {
    listed(&BUILT_FIRST, is_quick, summary);
    summary.beside(THEN.map(|list| move |part: &mut Summary| listed(list, is_quick, part)));
}

fn listed(list: &[Listed], is_quick: bool, summary: &mut Summary) {
    for (name, check, if_quick) in list {
        if is_quick && *if_quick == IfQuick::Skipped {
            summary.skip(name, "--quick");
        } else {
            summary.check(name, check);
        }
    }
}

/// Seconds of the long fuzzing.
const LONG_FUZZ: &str = "1800";

/// The long list: what each of the checks above has in a short form, whole, and what takes other programs.
fn long(summary: &mut Summary) {
    let jobs: [(&str, &[&str]); 7] = [
        ("check-nostd, whole", &["check-nostd"]),
        ("races", &["races"]),
        ("gauntlet, whole", &["gauntlet"]),
        ("fuzz, long", &["fuzz", "--seconds", LONG_FUZZ]),
        ("choice", &["choice"]),
        ("report", &["report"]),
        ("peers", &["peers", "--quick"]),
    ];
    summary.check("packages", package::check);
    summary.check("notebooks", python::notebooks);
    for (name, words) in jobs {
        let job = || passed(Command::new(std::env::current_exe().unwrap_or_default()).args(words));
        summary.check(name, job);
    }
}

/// Folders whose files are modules by a macro: cargo does not find them by itself.
const BY_MACRO: [&str; 2] = ["mbs-core/src/effects", "mbs-core/src/outputs/quantity"];

fn format() -> Result<Outcome, String> {
    let mut args: Vec<String> = ["fmt", "--all", "--check", "--"].map(str::to_owned).to_vec();
    for folder in BY_MACRO {
        let files = std::fs::read_dir(process::root().join(folder)).map_err(|e| e.to_string())?;
        args.extend(files.flatten().map(|file| file.path().display().to_string()));
    }
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    component("fmt", "rustfmt", &args)
}

fn lints() -> Result<Outcome, String> {
    let args = ["--all-targets", "--quiet", "--", "--deny", "warnings"];
    component("clippy", "clippy", &[&["clippy", "--workspace"], &args[..]].concat())
}

fn tests() -> Result<Outcome, String> {
    passed(cargo().args(["test", "--workspace", "--no-fail-fast"]))
}

/// The first texts of fuzzing, the same on every machine that is fast enough: two to six minutes, ten at most.
fn fuzz() -> Result<Outcome, String> {
    lab(&["fuzz", "--seconds", "600", "--count", "4000"])
}

fn counts() -> Result<Outcome, String> {
    match debian::find("valgrind", "valgrind") {
        Ok(()) => lab(&["counts"]),
        Err(left_out) => Ok(Outcome::LeftOut(left_out)),
    }
}

/// Has `lab` do a job, built as the tests are; the last line that it prints is the remark.
fn lab(words: &[&str]) -> Result<Outcome, String> {
    let mut lab = Command::new(process::tested("lab", "short")?);
    let out = lab.args(words).current_dir(process::root()).stderr(Stdio::inherit()).output();
    let out = out.map_err(|e| format!("cannot start `{}`: {e}", process::line(&lab)))?;
    let text = String::from_utf8_lossy(&out.stdout);
    if !out.status.success() {
        return Err(format!("`{}`: {}\n{text}", process::line(&lab), out.status));
    }
    Ok(Outcome::Passed(text.lines().last().unwrap_or_default().to_owned()))
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

/// Checks crates with each of their feature sets alone, with lints where they are installed.
fn features() -> Result<Outcome, String> {
    let lints = process::output(cargo().args(["clippy", "--version"])).is_some();
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
    // The repository's first commands are built so: what asks for more must be known by its exit status. Nothing long runs, and level 0 builds
    // in a tenth of the time.
    let lean = ["test", "--quiet", "--package", "mbs-cli", "--no-default-features"];
    let lean = [&lean[..], &["--test", "command", "lean::"]].concat();
    run(cargo().args(lean).env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").current_dir(process::root()))?;
    // What is compared with other programs stands outside the workspace: nothing else would show that it still fits.
    let ours = ["check", "--quiet", "--locked", "--manifest-path", "lab/peers/ours/Cargo.toml"];
    run(cargo()
        .args(ours)
        .args(["--target-dir", "target/peers/check"])
        .current_dir(process::root()))?;
    let names = |sets: &[&str]| {
        let names = sets.iter().map(|set| if set.is_empty() { "none" } else { set });
        names.collect::<Vec<_>>().join(", ")
    };
    let remarks = FEATURES.map(|(package, sets)| format!("{package} with {}", names(sets)));
    Ok(Outcome::Passed(remarks.join("; ")))
}
