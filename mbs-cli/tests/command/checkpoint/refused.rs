//! Checkpoints from which the command does not resume, and its messages.

use crate::files::{path, scratch};
use crate::{json, run};
use mbs::scene_file::SceneFile;
use mbs::{CHECKPOINT, Mechanism, Run};
use std::path::{Path, PathBuf};

/// Checks that the command is refused with exit status 1, and that its message contains all of these words.
fn refused(arguments: &[&str], words: &[&str]) {
    let output = run("run", arguments);
    let said = crate::text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
    assert!(output.stdout.is_empty());
    for word in words.iter().chain(&["error:", "hint:"]) {
        assert!(said.contains(word), "{arguments:?}: no `{word}` in {said}");
    }
}

/// A directory with the checkpoint of a run, and the file of its scene.
fn left(name: &str) -> (PathBuf, PathBuf) {
    let out = scratch(&format!("checkpoint-{name}"));
    let file = out.join("scene.toml");
    std::fs::copy(path("double-pendulum"), &file).expect("a copy");
    let read = std::fs::read(&file).expect("it was copied");
    let document = SceneFile::from_bytes(&read, "scene.toml").expect("TOML");
    let mechanism = Mechanism::of_file(document).expect("a scene");
    let done = mbs::run(&mechanism, &Run::new().duration(0.2).checkpoints(&out, 0.05));
    assert!(done.is_ok_and(|result| result.summary().completed));
    (out, file)
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path of plain letters")
}

#[test]
fn the_command_says_what_is_wrong_and_what_to_do() {
    let (out, file) = left("command");
    let checkpoint = out.join(CHECKPOINT);
    let (dir, file) = (text(&out), text(&file));
    refused(&[file, "--out", dir, "--checkpoint", "0.05"], &["--resume", "--restart", "0.15"]);
    refused(&[file, "--out", dir, "--resume", "--step", "1e-2"], &["step was 0.001, and is 0.01"]);
    refused(&[file, "--out", dir, "--resume", "--precision", "dd"], &["precision was f64"]);
    refused(&[file, "--resume"], &["--out"]);
    refused(&[file, "--out", dir, "--checkpoint", "0"], &["positive"]);
    let written = std::fs::read_to_string(file).expect("a scene");
    std::fs::write(file, written.replacen("mass = 1.0", "mass = 1.5", 1)).expect("written");
    refused(&[file, "--out", dir, "--resume"], &["another scene", "[[body]]"]);
    std::fs::write(file, format!("# a comment more\n{written}")).expect("written");

    let bytes = std::fs::read(&checkpoint).expect("it is there");
    std::fs::write(&checkpoint, &bytes[..bytes.len() / 2]).expect("written");
    refused(&[file, "--out", dir, "--resume"], &["torn"]);
    let mut changed = bytes.clone();
    changed[bytes.len() / 2] ^= 4;
    std::fs::write(&checkpoint, &changed).expect("written");
    refused(&[file, "--out", dir, "--resume"], &["damaged"]);
    std::fs::write(&checkpoint, written.as_bytes()).expect("written");
    refused(&[file, "--out", dir, "--resume"], &["no checkpoint"]);
    let mut later = bytes.clone();
    later[8] += 1;
    std::fs::write(&checkpoint, &later).expect("written");
    let format = format!("written by mbs with format {}", later[8]);
    refused(&[file, "--out", dir, "--resume"], &[&format]);

    std::fs::write(&checkpoint, &bytes).expect("written");
    let rows =
        std::fs::read(out.join(mbs::folder::PART).join("run.csv")).expect("rows were written");
    assert!(!rows.is_empty(), "no refusal has emptied the rows");
    let output = run("run", &[file, "--out", dir, "--resume", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", crate::text(&output.stderr));
    assert_eq!(json(&output)["steps"], 200, "the summary is that of the whole run");
    refused(&[file, "--out", dir, "--resume"], &["there is no checkpoint"]);
}
