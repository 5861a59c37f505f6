//! The tests of the command from outside, in one program.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

#[path = "../../../mbs/tests/all/common/files.rs"]
mod files;

mod analysis;
mod checkpoint;
mod choice;
mod command;
mod compare;
mod contract;
mod diff;
mod doctor;
#[cfg(unix)]
mod documents;
mod double_double;
mod explain;
mod forms;
mod generate;
mod help;
#[cfg(target_os = "linux")]
mod hostile;
mod inputs;
mod lean;
mod link_frames;
mod manual;
mod models;
mod new;
mod one_run;
mod plot;
mod realtime;
mod refusals;
mod show;
mod sweep;

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

/// The command, with its subcommand.
fn mbs(subcommand: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
    command.arg(subcommand);
    command
}

/// Runs the command with arguments.
fn run(subcommand: &str, arguments: &[&str]) -> Output {
    mbs(subcommand).args(arguments).output().expect("the command is built")
}

/// Runs the command with the words of a line, which are separated by spaces.
fn run_line(line: &str) -> Output {
    let words: Vec<&str> = line.split_whitespace().collect();
    run(words[0], &words[1..])
}

/// The JSON object of a command, which must have exit status 0.
fn done(output: &Output) -> Value {
    assert_eq!(status(output), 0, "{}", text(&output.stderr));
    json(output)
}

/// Writes a text to a file of the tests. Returns the path.
fn written(name: &str, text: &str) -> String {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&file, text).expect("the directory is ours");
    plain(file)
}

fn status(output: &Output) -> i32 {
    output.status.code().expect("it ended by itself")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Standard output as one JSON object and nothing else.
fn json(output: &Output) -> Value {
    let value: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {} {}", text(&output.stdout), text(&output.stderr)));
    assert!(value.is_object());
    value
}

/// A scene of the repository, as an argument.
fn scene(name: &str) -> String {
    plain(files::path(name))
}

/// A path as an argument.
fn plain(path: PathBuf) -> String {
    path.into_os_string().into_string().expect("a path of plain letters")
}
