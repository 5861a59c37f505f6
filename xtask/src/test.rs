//! The job `cargo xtask test`: runs the tests of every crate, of the command and of the Python package.

use crate::process::{self, cargo};
use crate::python;
use crate::summary::Summary;
use crate::tally::{Tally, counted};
use std::panic::resume_unwind;
use std::process::{Command, ExitCode};
use std::thread;

/// The module with the rules for text, in the tests of xtask. It is a check of its own.
pub const RULES: &str = "tidy::";
/// The module that runs the commands of documents, in the tests of the command. It is a check of its own.
pub const DOCUMENTS: &str = "documents::";

/// Runs the tests of the repository. The last line of standard output has their counts.
#[allow(clippy::print_stdout, reason = "the count is what is asked for")]
pub fn test(is_strict: bool) -> ExitCode {
    let mut summary = Summary::new(is_strict);
    let tally = run(&mut summary);
    let code = summary.end("cargo xtask test");
    println!("{tally}");
    code
}

/// Runs the tests of Rust, then those of Python, whose tools are installed at the same time. Returns their counts.
pub(crate) fn run(summary: &mut Summary) -> Tally {
    thread::scope(|scope| {
        let tools = scope.spawn(python::tools);
        let mut tally = Tally::default();
        summary.check("tests", || counted(&mut of_rust(), Tally::read_rust, &mut tally));
        let tools = tools.join().unwrap_or_else(|e| resume_unwind(e));
        summary.check("python", || python::tests(tools, &mut tally));
        tally
    })
}

/// The command of the workspace's tests. All programs run even if one fails.
fn of_rust() -> Command {
    let mut command = cargo();
    command.args(["test", "--workspace", "--no-fail-fast", "--"]);
    command.args(["--skip", RULES, "--skip", DOCUMENTS]).current_dir(process::root());
    command
}
