//! Summary of what ran, what was left out and how to get it: the last lines of `cargo xtask test` and `cargo xtask check`.

use crate::process::children_seconds;
use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;
use std::time::Instant;

/// How a check ended, when it did not fail.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// Check that ran and holds; a remark, possibly empty.
    Passed(String),
    /// Check that could not run on this machine.
    LeftOut(LeftOut),
}

/// A check that did not run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Reason: what is missing.
    pub why: String,
    /// Remedy: what to do to have it run.
    pub remedy: String,
}

/// Says how a check that was asked for alone ended: here a tool that is missing is a failure.
pub fn ended(name: &str, outcome: Result<Outcome, String>) -> ExitCode {
    match outcome {
        Ok(Outcome::Passed(remark)) => {
            eprintln!("{name} holds: {remark}");
            return ExitCode::SUCCESS;
        }
        Ok(Outcome::LeftOut(LeftOut { why, remedy })) => {
            eprintln!("{name} did not run: {why}\n{remedy}");
        }
        Err(why) => eprintln!("{name} failed: {why}"),
    }
    ExitCode::FAILURE
}

/// The checks so far.
#[derive(Debug, Default)]
pub struct Summary {
    lines: Vec<String>,
    left_out: Vec<(String, LeftOut)>,
    /// Names of the checks that failed, and why.
    failures: Vec<String>,
    /// A check that cannot run here fails.
    is_strict: bool,
    /// Other checks run at the same time: processor seconds are not those of one.
    is_beside: bool,
}

/// Processor seconds of child processes since a count of them.
fn since(cpu: Option<f64>) -> String {
    cpu.zip(children_seconds())
        .map_or(String::new(), |(before, after)| format!(" {:>7.1} s of CPU", after - before))
}

impl Summary {
    /// A summary in which a check that cannot run here fails, or is noted.
    pub fn new(is_strict: bool) -> Self {
        Self { is_strict, ..Self::default() }
    }

    /// Runs one check and notes how it ended. One that fails does not keep the next from running: one run says all there is to mend.
    pub fn check(&mut self, name: &str, job: impl FnOnce() -> Result<Outcome, String>) {
        eprintln!("== {name}");
        let (start, cpu) = (Instant::now(), children_seconds());
        let outcome = job();
        let seconds = start.elapsed().as_secs_f64();
        match outcome {
            Ok(Outcome::Passed(remark)) => {
                let cpu = if self.is_beside { String::new() } else { since(cpu) };
                self.lines.push(format!("  ok        {name:<14} {seconds:>7.1} s{cpu}  {remark}"));
            }
            Ok(Outcome::LeftOut(left_out)) => {
                let how = if self.is_strict { "FAILED  " } else { "left out" };
                self.lines.push(format!("  {how}  {name}"));
                self.left_out.push((name.to_owned(), left_out));
            }
            Err(why) => {
                eprintln!("== {name} failed: {why}");
                self.lines.push(format!("  FAILED    {name:<14} {seconds:>7.1} s"));
                self.failures.push(format!("{name} failed: {why}"));
            }
        }
    }

    /// Returns the result at the end of all checks.
    ///
    /// # Errors
    ///
    /// What failed, and where nothing may be left out the names of the checks that could not run.
    pub fn complete(&self) -> Result<(), String> {
        let mut failures = self.failures.clone();
        if self.is_strict && !self.left_out.is_empty() {
            let names: Vec<&str> = self.left_out.iter().map(|(name, _)| &**name).collect();
            failures.push(format!("This machine cannot run: {}", names.join(", ")));
        }
        if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
    }

    /// Runs lists of checks beside each other; their lines follow list by list. Processor seconds are reported for all of them together.
    pub fn beside<F: FnOnce(&mut Self) + Send, const N: usize>(&mut self, lists: [F; N]) {
        let (start, cpu) = (Instant::now(), children_seconds());
        let is_strict = self.is_strict;
        let ended: Vec<Self> = thread::scope(|scope| {
            let run = |list: F| {
                scope.spawn(move || {
                    let mut part = Self { is_beside: true, ..Self::new(is_strict) };
                    list(&mut part);
                    part
                })
            };
            let all: Vec<_> = lists.into_iter().map(run).collect();
            all.into_iter().map(|one| one.join().unwrap_or_else(|e| resume_unwind(e))).collect()
        });
        for part in ended {
            self.lines.extend(part.lines);
            self.left_out.extend(part.left_out);
            self.failures.extend(part.failures);
        }
        let seconds = start.elapsed().as_secs_f64();
        self.lines.push(format!("  together  {:<14} {seconds:>7.1} s{}", "", since(cpu)));
    }

    /// Notes a check that was not asked for.
    pub fn skip(&mut self, name: &str, why: &str) {
        self.lines.push(format!("  skipped   {name:<14} {why}"));
    }

    /// Prints the summary of a job, and what failed; its exit status.
    pub fn end(&self, job: &str) -> ExitCode {
        eprint!("\n{}", self.text(job));
        match self.complete() {
            Ok(()) => {
                eprintln!("\nAll checks that ran hold.");
                ExitCode::SUCCESS
            }
            Err(why) => {
                eprintln!("\n{why}");
                ExitCode::FAILURE
            }
        }
    }

    /// The summary of a job as text: one line a check, then what was left out and how to get it.
    pub fn text(&self, job: &str) -> String {
        let mut text = format!("{job}:\n");
        for line in &self.lines {
            text.push_str(line.trim_end());
            text.push('\n');
        }
        for (name, LeftOut { why, remedy }) in &self.left_out {
            text.push_str(&format!("\n{name} did not run: {why}\n{remedy}\n"));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{LeftOut, Outcome, Summary};

    fn missing_target() -> LeftOut {
        LeftOut { why: "no target".into(), remedy: "add it".into() }
    }

    #[test]
    fn summary_names_what_was_left_out_and_the_remedy() {
        let mut summary = Summary::default();
        summary.check("format", || Ok(Outcome::Passed(String::new())));
        summary.check("check-nostd", || Ok(Outcome::LeftOut(missing_target())));
        let text = summary.text("cargo xtask check");
        assert!(text.contains("ok        format"));
        assert!(text.contains("check-nostd did not run: no target\nadd it\n"));
    }

    #[test]
    fn what_cannot_run_fails_a_strict_check_at_its_end() {
        for (is_strict, end) in
            [(false, Ok(())), (true, Err("This machine cannot run: counts".to_owned()))]
        {
            let mut summary = Summary::new(is_strict);
            summary.check("counts", || Ok(Outcome::LeftOut(missing_target())));
            assert_eq!(summary.complete(), end);
        }
    }

    #[test]
    fn every_failure_is_reported_of_checks_one_after_another_and_beside() {
        let mut summary = Summary::default();
        summary.check("format", || Err("two lines".into()));
        summary.beside([true, false].map(|fails| {
            move |part: &mut Summary| {
                part.check(if fails { "fuzz" } else { "pick" }, || {
                    if fails { Err("one".into()) } else { Ok(Outcome::Passed("all".into())) }
                });
            }
        }));
        assert_eq!(summary.complete(), Err("format failed: two lines\nfuzz failed: one".into()));
        let text = summary.text("cargo xtask check");
        assert!(text.contains("FAILED    fuzz") && text.contains("ok        pick"), "{text}");
    }
}
