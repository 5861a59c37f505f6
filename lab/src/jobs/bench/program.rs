//! The measuring program, and the lines that it prints.

use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;
use xtask::child::printed;
use xtask::process;

/// The program, with the arguments that every run of it has.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) path: PathBuf,
    pub(crate) threads: String,
    pub(crate) seconds: &'static str,
}

impl Program {
    /// Runs the measuring program. Returns its lines.
    ///
    /// # Errors
    ///
    /// The program's message, or that it took longer than `limit`.
    pub(crate) fn run(&self, places: &[&str], limit: Duration) -> Result<Vec<Value>, String> {
        let mut command = Command::new(&self.path);
        command.arg("bench").args(places).args([
            "--threads",
            &self.threads,
            "--seconds",
            self.seconds,
        ]);
        command.current_dir(process::root());
        lines(&printed(&mut command, limit)?)
    }
}

/// Parses lines of JSON.
fn lines(text: &str) -> Result<Vec<Value>, String> {
    let value = |line: &str| serde_json::from_str(line).map_err(|e| format!("`{line}`: {e}"));
    text.lines().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_json() {
        let read = lines("{\"kind\": \"fork\"}\n").unwrap();
        assert_eq!(read, [serde_json::json!({ "kind": "fork" })]);
        assert!(lines("no json").is_err());
    }
}
