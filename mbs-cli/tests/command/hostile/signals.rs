//! Tests of signals: the first ends a command after its step, and its results so far are written; the second ends it at once.

use super::{Place, ended, output, results, wait_for};
use crate::{json, text};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Output, Stdio};

/// Options of a run that takes longer than any test.
const ENDLESS: &str = "--step 1e-4 --duration 1e5";

fn signal(name: &str, child: &Child) {
    let sent = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(sent.expect("there is a kill").success());
}

/// Starts a command, sends signals when a file exists, and returns the output of the command.
fn interrupted(place: &Place, command: &mut Command, file: &str, signals: &[&str]) -> Output {
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().expect("the command is built");
    wait_for(file, || place.0.join(file).exists());
    signals.iter().for_each(|name| signal(name, &child));
    output(child, file)
}

#[test]
fn a_run_that_is_interrupted_keeps_its_rows_and_says_so() {
    let place = Place::new("interrupted");
    for name in ["-INT", "-TERM"] {
        let mut command =
            place.run(&format!("{ENDLESS} --out out --restart --checkpoint 1 --json"));
        let said = interrupted(&place, &mut command, "out/checkpoint.mbs", &[name]);
        assert_eq!(said.status.code(), Some(2), "{}", text(&said.stderr));
        let object = json(&said);
        assert_eq!(
            (&object["completed"], &object["error"]["code"]),
            (&false.into(), &"interrupted".into())
        );
        let t = object["end_time"].as_f64().expect("a time");
        let rows = text(&place.read("out/run.csv"));
        let last: f64 =
            rows.lines().last().and_then(|row| row.split(',').next()?.parse().ok()).expect("a row");
        assert_eq!(last.to_bits(), t.to_bits(), "the last row is that of the last step");
        assert_eq!(
            place.names("out"),
            ["checkpoint.mbs", "run.csv", "run.html", "run.json", "steps.csv"]
        );
        let without = ended(&mut place.run("--out out"));
        assert_eq!(without.status.code(), Some(1));
        assert!(text(&without.stderr).contains("--resume"));
        std::fs::remove_file(place.0.join("out/checkpoint.mbs")).expect("it is there");
    }
}

#[test]
fn a_run_that_was_interrupted_resumes_to_the_bits_of_one_in_one_go() {
    let place = Place::new("gone-on");
    let long = "--step 1e-4 --duration 40";
    let mut command = place.run(&format!("{long} --out parts --checkpoint 3 --json"));
    let said = interrupted(&place, &mut command, "parts/checkpoint.mbs", &["-INT"]);
    // on a fast machine the sweep may end before the signal
    if json(&said)["completed"] == false {
        assert_eq!(ended(&mut place.run("--out parts --resume")).status.code(), Some(0));
    }
    assert_eq!(ended(&mut place.run(&format!("{long} --out whole"))).status.code(), Some(0));
    for file in ["run.csv", "steps.csv"] {
        let of = |folder: &str| place.read(&format!("{folder}/{file}"));
        assert!(of("parts") == of("whole"), "{file}");
    }
}

#[test]
fn a_second_signal_ends_a_run_at_once_and_loses_nothing_older() {
    let place = Place::new("at-once");
    assert_eq!(ended(&mut place.run("--out out")).status.code(), Some(0));
    let old = results(&place.0.join("out"));
    let mut command = place.run(&format!("{ENDLESS} --out out"));
    // the process is stopped, so that it makes no step between the two signals
    let signals = ["-STOP", "-INT", "-TERM", "-CONT"];
    let said = interrupted(&place, &mut command, "out/.lock", &signals);
    assert!(said.status.signal().is_some(), "{:?}", said.status);
    assert!(results(&place.0.join("out")) == old);
}

#[test]
fn a_sweep_that_is_interrupted_keeps_the_members_that_are_finished() {
    let place = Place::new("sweep");
    place.put(
        "s.toml",
        "[sweep]\ncombine = 'latin-hypercube'\nsamples = 400\nseed = 3\n\
         [[vary]]\npath = 'body.bar.mass'\nfrom = 0.5\nto = 2\n",
    );
    let line = "sweep p.toml s.toml --duration 5 --json --out out";
    let mut command = place.mbs(line);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let child = child.expect("the command is built");
    let lines = || {
        std::fs::read_to_string(place.0.join("out/sweep.journal")).map_or(0, |t| t.lines().count())
    };
    wait_for("members", || lines() > 20);
    signal("-INT", &child);
    let said = output(child, "a sweep");
    assert_eq!(said.status.code(), Some(2), "{}", text(&said.stderr));
    assert_eq!(json(&said)["error"]["code"], "interrupted");
    let kept = lines() - 1;
    assert!(kept < 400 && place.names("out") == ["sweep.journal"], "{kept}");
    let again = ended(&mut place.mbs(line));
    let report = json(&again);
    assert_eq!((&report["completed"], &report["resumed"]), (&400.into(), &kept.into()));
}

#[test]
fn a_comparison_that_is_interrupted_keeps_the_runs_that_are_finished() {
    let place = Place::new("compared");
    let made = ended(&mut place.run("--duration 10 --out ref"));
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    // the last of its steps would take longer than any test
    let line = "compare p.toml --reference ref/run.csv --duration 10 --formulation index-3 --precision f64 \
                --steps 1e-2,1e-3,1e-8 --tolerances 1e-4 --time-limit 1e6 --no-maps --out out --json";
    let mut command = place.mbs(line);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let child = child.expect("the command is built");
    let journal =
        || std::fs::read_to_string(place.0.join("out/compare.journal")).unwrap_or_default();
    wait_for("runs", || journal().lines().count() > 2);
    signal("-TERM", &child);
    let said = output(child, "a comparison");
    assert_eq!(said.status.code(), Some(2), "{}", text(&said.stderr));
    let error = &json(&said)["error"];
    assert_eq!(error["code"], "interrupted");
    assert!(error["hint"].as_str().is_some_and(|hint| hint.contains("--resume")), "{error}");
    assert!(!journal().contains("interrupted"), "what was cut short is no result");
    assert_eq!(place.names("out"), ["compare.journal"]);
}
