//! Counts of tests, read from the output of Rust's test programs and of pytest.

use crate::child;
use crate::summary::Outcome;
use std::fmt::{self, Display, Formatter};
use std::process::Command;

/// Numbers of tests that passed and that failed, and names of those that failed.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub(crate) struct Tally {
    passed: usize,
    failed: usize,
    names: Vec<String>,
    /// Names of the list that is being read. A program prints its list twice; the last one before the result counts.
    listed: Vec<String>,
    /// True if a program has begun and has not printed its result so far.
    is_running: bool,
}

/// Text for a program that ended without a result.
const UNFINISHED: &str = "a program of tests that ended before its result";
/// Text for a failure that belongs to no test.
const OTHER: &str = "a build, or a program that ended by itself: see above";

impl Tally {
    /// Reads a line of `cargo test`.
    pub(crate) fn read_rust(&mut self, line: &str) {
        if line == "failures:" {
            self.listed.clear();
        } else if let Some(name) = line.strip_prefix("    ") {
            self.listed.push(name.to_owned());
        } else if line.starts_with("running ") && line.trim_end_matches('s').ends_with(" test") {
            self.unfinished();
            self.is_running = true;
        } else if let Some(result) = line.strip_prefix("test result: ") {
            self.is_running = false;
            let failed = count(result, "failed");
            self.add(count(result, "passed"), failed);
            // earlier lines of this form were printed by tests
            let from = self.listed.len().saturating_sub(failed);
            self.names.extend(self.listed.drain(..).skip(from));
        }
    }

    /// Reads a line of pytest.
    pub(crate) fn read_python(&mut self, line: &str) {
        let name = ["FAILED ", "ERROR "].iter().find_map(|word| line.strip_prefix(word));
        if let Some(name) = name {
            self.names.push(name.split(" - ").next().unwrap_or(name).to_owned());
        } else if let Some((counts, _)) = line.rsplit_once(" in ").filter(|(_, end)| is_time(end)) {
            let failed = ["failed", "error", "errors"].map(|word| count(counts, word));
            self.add(count(counts, "passed"), failed.iter().sum());
        }
    }

    /// Ends the count of a command. The command may have failed without a failed test.
    pub(crate) fn close(&mut self, is_failed: bool) {
        self.unfinished();
        if is_failed && self.failed == 0 {
            self.add(0, 1);
            self.names.push(OTHER.to_owned());
        }
    }

    /// Adds the counts of another command.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.add(other.passed, other.failed);
    }

    /// The names of the tests that failed, if there are any.
    pub(crate) fn failures(&self) -> Option<String> {
        (self.failed > 0).then(|| format!("{self}\n    {}", self.names.join("\n    ")))
    }

    fn add(&mut self, passed: usize, failed: usize) {
        self.passed += passed;
        self.failed += failed;
    }

    fn unfinished(&mut self) {
        if std::mem::take(&mut self.is_running) {
            self.add(0, 1);
            self.names.push(UNFINISHED.to_owned());
        }
    }
}

/// The last line of `cargo xtask test`.
impl Display for Tally {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed", self.passed, self.failed)
    }
}

/// Runs a command of tests. Its lines are shown and read, and its counts are added to `all`.
///
/// # Errors
///
/// The command's exit status, and the names of the tests that failed.
pub(crate) fn counted(
    command: &mut Command,
    read: fn(&mut Tally, &str),
    all: &mut Tally,
) -> Result<Outcome, String> {
    let mut tally = Tally::default();
    let ended = child::shown(command, |line| read(&mut tally, line));
    tally.close(ended.is_err());
    all.merge(&tally);
    match (ended, tally.failures()) {
        (Ok(()), None) => Ok(Outcome::Passed(tally.to_string())),
        (Ok(()), Some(failures)) => Err(failures),
        (Err(why), failures) => Err(format!("{why}: {}", failures.unwrap_or_default())),
    }
}

/// The number before a word, in a list such as `12 passed; 0 failed`.
fn count(text: &str, word: &str) -> usize {
    let words: Vec<_> =
        text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let before = words.windows(2).find(|pair| pair[1] == word);
    before.and_then(|pair| pair[0].parse().ok()).unwrap_or(0)
}

/// True if a text is the time at the end of pytest's output, such as `3.21s` or `61.11s (0:01:01)`.
fn is_time(text: &str) -> bool {
    let seconds = text.split(' ').next().and_then(|word| word.strip_suffix('s'));
    seconds.is_some_and(|number| number.parse::<f64>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rust(text: &str) -> Tally {
        let mut tally = Tally::default();
        text.lines().for_each(|line| tally.read_rust(line));
        tally
    }

    fn python(text: &str) -> Tally {
        let mut tally = Tally::default();
        text.lines().for_each(|line| tally.read_python(line));
        tally
    }

    const PASSED: &str = "running 2 tests\ntest a::b ... ok\ntest a::c ... ok\n\n\
        test result: ok. 2 passed; 0 failed; 1 ignored; 0 measured; 7 filtered out; finished in 0.00s\n";

    const FAILED: &str = "running 3 tests\ntest x ... ok\ntest m::y ... FAILED\ntest z ... FAILED\n\nfailures:\n\n\
        ---- m::y stdout ----\n    a line of a test\n\nthread 'm::y' panicked\n\nfailures:\n    m::y\n    z\n\n\
        test result: FAILED. 1 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.10s\n";

    #[test]
    fn programs_of_tests_are_summed_and_their_failures_named() {
        let mut tally = rust(&[PASSED, FAILED, PASSED].concat());
        tally.close(true);
        assert_eq!(tally.to_string(), "5 passed, 2 failed");
        assert_eq!(tally.failures().unwrap(), "5 passed, 2 failed\n    m::y\n    z");
        assert_eq!(rust(PASSED).failures(), None);
    }

    #[test]
    fn a_program_that_ends_early_and_a_build_that_fails_are_failures() {
        for (text, name, counts) in [
            ("running 4 tests\ntest a ... ok\n", UNFINISHED, "0 passed, 1 failed"),
            ("", OTHER, "0 passed, 1 failed"),
            (PASSED, OTHER, "2 passed, 1 failed"),
        ] {
            let mut tally = rust(text);
            tally.close(true);
            assert_eq!(
                (tally.names.clone(), tally.to_string()),
                (vec![name.into()], counts.into())
            );
        }
        let tally = rust(&["running 1 test\n", PASSED].concat());
        assert_eq!(tally.to_string(), "2 passed, 1 failed");
    }

    #[test]
    fn the_closing_line_of_pytest_is_read_with_its_names() {
        let text = "..F.\nFAILED tests/test_a.py::test_x - AssertionError: 1 in 2\n\
                    ERROR tests/test_b.py\n1 failed, 130 passed, 2 skipped, 1 error in 61.11s (0:01:01)\n";
        let tally = python(text);
        assert_eq!(tally.to_string(), "130 passed, 2 failed");
        assert_eq!(tally.names, ["tests/test_a.py::test_x", "tests/test_b.py"]);
        assert_eq!(python("12 passed in 3.21s\n").to_string(), "12 passed, 0 failed");
        assert_eq!(python("no tests ran in 0.01s\n").to_string(), "0 passed, 0 failed");
        assert_eq!(python("a line of a test in doubt\n"), Tally::default());
    }

    #[test]
    fn commands_are_added() {
        let mut tally = rust(FAILED);
        tally.merge(&python("12 passed, 1 failed in 3s\n"));
        assert_eq!(tally.to_string(), "13 passed, 3 failed");
    }

    #[cfg(unix)]
    #[test]
    fn what_a_command_prints_is_counted_and_its_status_obeyed() {
        let shell = |script: &str| {
            let mut all = Tally::default();
            let outcome =
                counted(Command::new("sh").args(["-c", script]), Tally::read_python, &mut all);
            (outcome, all.to_string())
        };
        let (outcome, all) = shell("echo '12 passed in 3s'");
        assert_eq!(outcome, Ok(Outcome::Passed("12 passed, 0 failed".into())));
        assert_eq!(all, "12 passed, 0 failed");
        let (outcome, all) =
            shell("echo 'FAILED a.py::b - c'; echo '2 passed, 1 failed in 3s'; exit 1");
        assert!(outcome.unwrap_err().ends_with("2 passed, 1 failed\n    a.py::b"));
        assert_eq!(all, "2 passed, 1 failed");
        assert_eq!(shell("exit 1").1, "0 passed, 1 failed");
    }
}
