//! Builds that the tests of the workspace leave out: crates with each set of features, the command in `f64` alone, our side of the peers.

use crate::process::{self, cargo, output, run};
use crate::summary::Outcome;
use std::fs;
use std::path::PathBuf;

/// Crates with features, and the sets of them that must build on the host.
const FEATURES: [(&str, &[&str]); 8] = [
    ("mbs-math", &["", "alloc", "f32,dd"]),
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
            "instances",
            "instances,f32,dd",
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
            "instances",
            "instances,f32,dd",
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
    ("mbs-steps", &["", "f32", "dd"]),
    ("mbs", &[""]),
    ("mbs-cli", &["", "f32", "dd"]),
    ("lab", &["jobs,effects"]),
];

/// The variable that names the command in `f64` alone to its tests.
const LEAN: &str = "MBS_LEAN";

/// Checks crates with each of their feature sets alone, with lints where they are installed.
///
/// # Errors
///
/// The first set that fails.
pub(crate) fn check() -> Result<Outcome, String> {
    let has_lints = output(cargo().args(["clippy", "--version"])).is_some();
    let sets =
        FEATURES.iter().flat_map(|(package, sets)| sets.iter().map(move |set| (package, set)));
    for (package, set) in sets {
        let mut command = cargo();
        command.args([if has_lints { "clippy" } else { "check" }, "--quiet", "--package", package]);
        command.args(["--no-default-features", "--features", set]);
        if has_lints {
            command.args(["--", "--deny", "warnings"]);
        }
        run(command.current_dir(process::root()))?;
    }
    // What is compared with other programs stands outside the workspace: nothing else would show that it still fits.
    let mut peers = cargo();
    peers.args(["check", "--quiet", "--locked", "--manifest-path", "lab/peers/ours/Cargo.toml"]);
    run(peers.args(["--target-dir", "target/peers/check"]).current_dir(process::root()))?;
    let names = |sets: &[&str]| {
        let names = sets.iter().map(|set| if set.is_empty() { "none" } else { set });
        names.collect::<Vec<_>>().join(", ")
    };
    let remarks = FEATURES.map(|(package, sets)| format!("{package} with {}", names(sets)));
    Ok(Outcome::Passed(remarks.join("; ")))
}

/// Tests the command in `f64` alone, which the repository's first command builds: what asks for more must be known by its exit status.
///
/// # Errors
///
/// The build or the tests.
pub(crate) fn lean() -> Result<Outcome, String> {
    let mbs = lean_command()?;
    let mut tests = cargo();
    tests.args([
        "test",
        "--workspace",
        "--quiet",
        "--test",
        "command",
        "--",
        "--ignored",
        "lean::",
    ]);
    run(tests.env(LEAN, mbs).current_dir(process::root()))?;
    Ok(Outcome::Passed(String::new()))
}

/// Crates of the command that the profile of the tests raises above its own level.
const RAISED: [&str; 3] = ["mbs-nostd", "mbs-scene", "mbs-steps"];

/// Builds the command in `f64` alone; its path. Nothing long runs, so that all of ours is at level 0: a fifth of the work of a release.
fn lean_command() -> Result<PathBuf, String> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--package", "mbs-cli", "--bin", "mbs"]);
    build.arg("--no-default-features");
    for raised in RAISED {
        build.args(["--config", &format!("profile.dev.package.{raised}.opt-level=0")]);
    }
    run(build.env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").current_dir(process::root()))?;
    let [built, kept] =
        ["debug", "lean"].map(|folder| process::target_dir().join(folder).join("mbs"));
    let copied = fs::create_dir_all(process::target_dir().join("lean"));
    copied
        .and_then(|()| fs::copy(&built, &kept))
        .map_err(|e| format!("{}: {e}", kept.display()))?;
    Ok(kept)
}
