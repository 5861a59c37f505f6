//! The command line: how the program was started, and its words.

use std::ffi::OsString;
use std::process::Command;
use std::sync::OnceLock;

/// How the program was started, and its words.
#[derive(Debug)]
struct Line {
    program: Vec<OsString>,
    words: Vec<OsString>,
}

static LINE: OnceLock<Line> = OnceLock::new();

/// Notes the command line, once in a process.
pub(crate) fn note(program: Vec<OsString>, words: Vec<OsString>) {
    // a second one is that of a test
    let _ = LINE.set(Line { program, words });
}

/// The words behind the program.
pub(crate) fn words() -> impl Iterator<Item = &'static OsString> {
    LINE.get().into_iter().flat_map(|line| &line.words)
}

/// The program again, without words: this file, or the interpreter that it runs in.
pub(crate) fn again() -> Command {
    match LINE.get().map(|line| &line.program[..]) {
        Some([interpreter, first @ ..]) if !first.is_empty() => {
            let mut command = Command::new(interpreter);
            command.args(first);
            command
        }
        _ => Command::new(std::env::current_exe().unwrap_or_else(|_| "mbs".into())),
    }
}
