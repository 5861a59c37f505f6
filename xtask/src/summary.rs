//! Summary of `cargo xtask test` and `cargo xtask check`, printed at their end: checks that ran, and checks that were left out with
//! remedies.

use crate::process::cpu_seconds;
use std::process::ExitCode;
use std::time::Instant;

/// Outcome of a check that did not fail.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// Check that ran and passed, with a remark, which may be empty.
    Passed(String),
    /// Check that could not run on this machine.
    LeftOut(LeftOut),
}

/// A check that did not run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Reason: the missing part.
    pub why: String,
    /// Remedy: an action after which the check can run.
    pub remedy: String,
}

/// Reports the outcome of a single check. A missing tool is a failure here.
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

/// A check that has ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// Name of the check.
    pub name: String,
    /// Wall-clock time of the check [s].
    pub seconds: f64,
    /// CPU time of this process and of its ended child processes [s]; `None` if the system does not report it.
    pub cpu: Option<f64>,
    /// Outcome of the check, or the reason why it failed.
    pub outcome: Result<Outcome, String>,
}

/// The checks so far.
#[derive(Debug, Default)]
pub struct Summary {
    /// Every check that has ended, in the order of their ends.
    pub(crate) ended: Vec<Ended>,
    lines: Vec<String>,
    left_out: Vec<(String, LeftOut)>,
    /// Names of the checks that failed, and why.
    failures: Vec<String>,
    /// True if a check that cannot run here counts as failed.
    is_strict: bool,
}

/// The seconds of a line: wall-clock time, and CPU time if it is known.
fn times(seconds: f64, cpu: Option<f64>) -> String {
    let cpu = cpu.map_or(String::new(), |cpu| format!(" {cpu:>7.1} s of CPU"));
    format!("{seconds:>7.1} s{cpu}")
}

/// CPU time since an earlier value of it [s].
fn since(cpu: Option<f64>) -> Option<f64> {
    cpu.zip(cpu_seconds()).map(|(before, after)| after - before)
}

impl Summary {
    /// A summary in which a check that cannot run fails (`is_strict`), or is only noted.
    pub fn new(is_strict: bool) -> Self {
        Self { is_strict, ..Self::default() }
    }

    /// Runs one check and notes its outcome. After a failure the next checks run too, so that one run shows all faults.
    pub fn check(&mut self, name: &str, job: impl FnOnce() -> Result<Outcome, String>) {
        eprintln!("== {name}");
        let (start, cpu) = (Instant::now(), cpu_seconds());
        let outcome = job();
        let (seconds, cpu) = (start.elapsed().as_secs_f64(), since(cpu));
        if let Err(why) = &outcome {
            eprintln!("== {name} failed: {why}");
        }
        self.note(Ended { name: name.to_owned(), seconds, cpu, outcome });
    }

    /// Notes the outcome of a check.
    pub(crate) fn note(&mut self, ended: Ended) {
        self.ended.push(ended.clone());
        let Ended { name, seconds, cpu, outcome } = ended;
        let times = times(seconds, cpu);
        match outcome {
            Ok(Outcome::Passed(remark)) => {
                self.lines.push(format!("  ok        {name:<14} {times}  {remark}"));
            }
            Ok(Outcome::LeftOut(left_out)) => {
                let how = if self.is_strict { "FAILED  " } else { "left out" };
                self.lines.push(format!("  {how}  {name}"));
                self.left_out.push((name, left_out));
            }
            Err(why) => {
                self.lines.push(format!("  FAILED    {name:<14} {times}"));
                self.failures.push(format!("{name} failed: {why}"));
            }
        }
    }

    /// Notes checks that ran in parallel, list by list, and their total time.
    pub(crate) fn beside(&mut self, run: impl FnOnce() -> Vec<Ended>) {
        let (start, cpu) = (Instant::now(), cpu_seconds());
        run().into_iter().for_each(|ended| self.note(ended));
        let times = times(start.elapsed().as_secs_f64(), since(cpu));
        self.lines.push(format!("  together  {:<14} {times}", ""));
    }

    /// Returns the result at the end of all checks.
    ///
    /// # Errors
    ///
    /// The checks that failed; in strict mode also the names of the checks that could not run.
    pub fn complete(&self) -> Result<(), String> {
        let mut failures = self.failures.clone();
        if self.is_strict && !self.left_out.is_empty() {
            let names: Vec<&str> = self.left_out.iter().map(|(name, _)| &**name).collect();
            failures.push(format!("This machine cannot run: {}", names.join(", ")));
        }
        if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
    }

    /// Notes a check that was not requested.
    pub fn skip(&mut self, name: &str, why: &str) {
        self.lines.push(format!("  skipped   {name:<14} {why}"));
    }

    /// Prints the summary of a job with its failures. Returns the exit status.
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

    /// The summary of a job as text: one line per check, then the checks left out with their remedies.
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
    use super::{Ended, LeftOut, Outcome, Summary};

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
        let ended = |name: &str, outcome| Ended {
            name: name.into(),
            seconds: 1.5,
            cpu: Some(12.25),
            outcome,
        };
        summary.beside(|| {
            vec![ended("fuzz", Err("one".into())), ended("pick", Ok(Outcome::Passed("all".into())))]
        });
        assert_eq!(summary.complete(), Err("format failed: two lines\nfuzz failed: one".into()));
        let text = summary.text("cargo xtask check");
        assert!(text.contains("FAILED    fuzz") && text.contains("together"), "{text}");
        let line = "  ok        pick               1.5 s    12.2 s of CPU  all";
        assert!(text.contains(line), "{text}");
    }
}
