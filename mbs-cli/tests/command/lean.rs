//! Tests of a build with `f64` alone, which the first command of the README makes. The variable `MBS_LEAN` contains its path. `cargo xtask
//! check` builds it, and runs these tests with `--ignored`.

use crate::{json, scene, status, text};
use std::process::{Command, Output};

/// Exit status of a command that requests a precision which is not built.
const UNBUILT: i32 = 3;

/// The lean command, with its subcommand.
fn mbs(subcommand: &str) -> Command {
    let lean = std::env::var_os("MBS_LEAN").expect("MBS_LEAN names a command in f64 alone");
    let mut command = Command::new(lean);
    command.arg(subcommand);
    command
}

/// Runs the lean command with arguments.
fn run(subcommand: &str, arguments: &[&str]) -> Output {
    mbs(subcommand).args(arguments).output().expect("the command is built")
}

#[test]
#[ignore = "asks for MBS_LEAN, a command in f64 alone"]
fn a_precision_that_is_not_built_is_named_and_has_a_status_of_its_own() {
    let pendulum = scene("simple-pendulum");
    for (command, options) in [
        ("run", &["--precision", "dd"][..]),
        ("run", &["--precision", "f32"]),
        ("explain", &["--precision", "f32"]),
        ("compare", &[]),
    ] {
        let output = run(command, &[&[&*pendulum], options].concat());
        let said = text(&output.stderr);
        assert_eq!(status(&output), UNBUILT, "{command} {options:?}: {said}");
        assert!(said.contains("this build has no precision") && said.contains("hint: "), "{said}");
        let quiet = mbs(command).arg(&pendulum).args(options).env("MBS_BUILDER", "1").output();
        let quiet = quiet.expect("the command is built");
        assert_eq!(status(&quiet), UNBUILT);
        assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty(), "{}", text(&quiet.stderr));
    }
}

#[test]
#[ignore = "asks for MBS_LEAN, a command in f64 alone"]
fn what_every_build_refuses_needs_no_other_build() {
    let pendulum = scene("simple-pendulum");
    for (command, arguments) in [
        ("run", &[&*pendulum, "--precision", "f16"][..]),
        ("run", &["no-such-scene.toml", "--precision", "dd"]),
        ("compare", &["no-such-scene.toml"]),
        ("explain", &[&*pendulum, "--precision", "dd"]),
        ("sweep", &[&*pendulum, "no-such-sweep.toml", "--precision", "dd"]),
    ] {
        let output = run(command, arguments);
        assert_eq!(status(&output), 1, "{command} {arguments:?}: {}", text(&output.stderr));
    }
}

#[test]
#[ignore = "asks for MBS_LEAN, a command in f64 alone"]
fn runs_in_doubles_are_as_in_every_build() {
    let output = run("run", &[&scene("simple-pendulum"), "--duration", "0.1", "--json"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    assert_eq!(json(&output)["precision"], "f64");
}
