//! Processes that are killed, and new processes that resume their runs.

use crate::files::{path, scratch, without_clocks};
use mbs::{CHECKPOINT, Checkpoint};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Time limit for a run to be killed; after it the test fails.
const PATIENCE: Duration = Duration::from_secs(120);

fn mbs(scene: &str, out: &Path, options: &[&str]) -> Command {
    let mut command = crate::mbs("run");
    // the basis of an estimate depends on the time of the run, so it is left out
    command.arg(path(scene)).arg("--no-estimate").arg("--out").arg(out).args(options);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Starts a run and kills it when its checkpoint has reached `t` [s]. Returns the time of the checkpoint.
fn kill_at(t: f64, out: &Path, mut command: Command) -> f64 {
    let mut child = command.spawn().expect("the command is built");
    let begun = Instant::now();
    let reached = || Checkpoint::open(&out.join(CHECKPOINT)).map_or(-1.0, |c| c.time());
    while reached() < t {
        assert!(child.try_wait().expect("a child").is_none(), "the run has ended before {t} s");
        assert!(begun.elapsed() < PATIENCE, "the run has not come to {t} s");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it runs");
    let status = child.wait().expect("it was started");
    assert!(!status.success(), "it was killed");
    reached()
}

fn read(out: &Path, file: &str) -> String {
    std::fs::read_to_string(out.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

/// Kills a run twice, resumes it each time, and compares it with an uninterrupted run.
fn survives(name: &str, scene: &str, options: &[&str], [first, second]: [f64; 2]) {
    let [whole, parts] =
        ["whole", "parts"].map(|part| scratch(&format!("checkpoint-{name}-{part}")));
    let status = mbs(scene, &whole, options).status().expect("the command is built");
    assert!(status.success());
    let [rows, steps, json] = ["run.csv", "steps.csv", "run.json"].map(|file| read(&whole, file));

    let begin = [options, &["--checkpoint", "0.05"]].concat();
    let at = kill_at(first, &parts, mbs(scene, &parts, &begin));
    for (file, whole) in [("run.csv", &rows), ("steps.csv", &steps)] {
        let part = read(&parts.join(mbs::folder::PART), file);
        let last = part.lines().last().and_then(|line| line.split(',').next()).expect("rows");
        let last: f64 = last.parse().expect("a time");
        assert!(last > 0.5 * at && part.len() < whole.len(), "{file}: {last} s");
        assert!(whole.starts_with(&part), "{file}: what is there is what will be there");
    }
    let again = kill_at(second, &parts, mbs(scene, &parts, &["--resume"]));
    assert!(again >= second && second > at, "it has gone on: {again} {at}");
    let status = mbs(scene, &parts, &["--resume"]).status().expect("the command is built");
    assert!(status.success());

    assert!(rows == read(&parts, "run.csv"), "run.csv differs");
    assert!(steps == read(&parts, "steps.csv"), "steps.csv differs");
    assert_eq!(without_clocks(&json), without_clocks(&read(&parts, "run.json")));
    let left: Vec<_> = std::fs::read_dir(&parts)
        .expect("a directory")
        .map(|entry| entry.expect("an entry").file_name())
        .filter(|name| {
            !["run.csv", "steps.csv", "run.json", "run.html"].contains(&&*name.to_string_lossy())
        })
        .collect();
    assert!(left.is_empty(), "nothing else is left: {left:?}");
}

#[test]
fn a_killed_run_of_fixed_steps_resumes_to_the_same_files() {
    survives("fixed", "double-pendulum", &["--step", "1e-5"], [2.0, 6.0]);
}

#[test]
fn a_killed_run_of_controlled_steps_resumes_to_the_same_files() {
    let control = ["--formulation", "multi-index", "--step-control", "both"];
    let steps = ["--step", "1e-4", "--step-max", "1e-3", "--duration", "10"];
    let options = [&control[..], &steps].concat();
    survives("controlled", "iltis-stairs", &options, [1.0, 3.0]);
}
