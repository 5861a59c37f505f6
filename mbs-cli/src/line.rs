//! The command line of this process: the program and its arguments.

use std::ffi::OsString;
use std::process::Command;
use std::sync::{PoisonError, RwLock};

/// The command that started the program, and the arguments.
static LINE: RwLock<[Vec<OsString>; 2]> = RwLock::new([Vec::new(), Vec::new()]);

fn line() -> [Vec<OsString>; 2] {
    LINE.read().unwrap_or_else(PoisonError::into_inner).clone()
}

/// Stores the command line.
pub(crate) fn note(program: Vec<OsString>, words: Vec<OsString>) {
    *LINE.write().unwrap_or_else(PoisonError::into_inner) = [program, words];
}

/// The arguments without the program.
pub(crate) fn words() -> impl Iterator<Item = OsString> {
    let [_, words] = line();
    words.into_iter()
}

/// A command that starts this program again without arguments: this file, or the interpreter in which it runs.
pub(crate) fn again() -> Command {
    let [program, _] = line();
    match &program[..] {
        [interpreter, first @ ..] if !first.is_empty() => {
            let mut command = Command::new(interpreter);
            command.args(first);
            command
        }
        _ => Command::new(std::env::current_exe().unwrap_or_else(|_| "mbs".into())),
    }
}
