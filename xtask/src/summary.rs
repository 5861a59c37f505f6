//! What ran, what was left out and how to get it: the last lines of `cargo xtask test`.

use crate::process::children_seconds;
use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;
use std::time::Instant;

/// How a check ended, when it did not fail.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It ran and holds; a remark, possibly empty.
    Passed(String),
    /// It could not run on this machine.
    LeftOut(LeftOut),
}

/// A check that did not run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// What is missing.
    pub why: String,
    /// What to do to have it run.
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

    /// Runs one check and notes how it ended.
    ///
    /// # Errors
    ///
    /// What the check says, with its name.
    pub fn check(
        &mut self,
        name: &str,
        job: impl FnOnce() -> Result<Outcome, String>,
    ) -> Result<(), String> {
        eprintln!("== {name}");
        let (start, cpu) = (Instant::now(), children_seconds());
        let outcome = job().map_err(|why| {
            self.lines.push(format!("  FAILED    {name}"));
            format!("{name} failed: {why}")
        })?;
        let seconds = start.elapsed().as_secs_f64();
        match outcome {
            Outcome::Passed(remark) => {
                let cpu = if self.is_beside { String::new() } else { since(cpu) };
                self.lines.push(format!("  ok        {name:<14} {seconds:>7.1} s{cpu}  {remark}"));
            }
            Outcome::LeftOut(left_out) => {
                let how = if self.is_strict { "FAILED  " } else { "left out" };
                self.lines.push(format!("  {how}  {name}"));
                self.left_out.push((name.to_owned(), left_out));
            }
        }
        Ok(())
    }

    /// What fails where nothing may be left out: found at the end, so that one missing tool does not hide what the other checks say.
    ///
    /// # Errors
    ///
    /// The names of the checks that could not run.
    pub fn complete(&self) -> Result<(), String> {
        if !self.is_strict || self.left_out.is_empty() {
            return Ok(());
        }
        let names: Vec<&str> = self.left_out.iter().map(|(name, _)| &**name).collect();
        Err(format!("This machine cannot run: {}", names.join(", ")))
    }

    /// Runs lists of checks beside each other; their lines follow list by list. Processor seconds are reported for all of them together.
    ///
    /// # Errors
    ///
    /// Of the first list in which a check failed; the others have come to their ends.
    pub fn beside<F: FnOnce(&mut Self) -> Result<(), String> + Send, const N: usize>(
        &mut self,
        lists: [F; N],
    ) -> Result<(), String> {
        let (start, cpu) = (Instant::now(), children_seconds());
        let is_strict = self.is_strict;
        let ended: Vec<(Self, Result<(), String>)> = thread::scope(|scope| {
            let run = |list: F| {
                scope.spawn(move || {
                    let mut part = Self { is_beside: true, ..Self::new(is_strict) };
                    let result = list(&mut part);
                    (part, result)
                })
            };
            let all: Vec<_> = lists.into_iter().map(run).collect();
            all.into_iter().map(|one| one.join().unwrap_or_else(|e| resume_unwind(e))).collect()
        });
        let mut failure = Ok(());
        for (part, result) in ended {
            self.lines.extend(part.lines);
            self.left_out.extend(part.left_out);
            failure = failure.and(result);
        }
        let seconds = start.elapsed().as_secs_f64();
        self.lines.push(format!("  together  {:<14} {seconds:>7.1} s{}", "", since(cpu)));
        failure
    }

    /// Notes a check that was not asked for.
    pub fn skip(&mut self, name: &str, why: &str) {
        self.lines.push(format!("  skipped   {name:<14} {why}"));
    }

    /// The summary as text: one line a check, then what was left out and how to get it.
    pub fn text(&self) -> String {
        let mut text = String::from("cargo xtask test:\n");
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

    #[test]
    fn summary_names_what_was_left_out_and_the_remedy() {
        let mut summary = Summary::default();
        summary.check("format", || Ok(Outcome::Passed(String::new()))).unwrap();
        let left_out = LeftOut { why: "no target".into(), remedy: "add it".into() };
        summary.check("check-nostd", || Ok(Outcome::LeftOut(left_out))).unwrap();
        let text = summary.text();
        assert!(text.contains("ok        format"));
        assert!(text.contains("check-nostd did not run: no target\nadd it\n"));
    }

    #[test]
    fn what_cannot_run_fails_a_strict_check_at_its_end() {
        let left_out = LeftOut { why: "no target".into(), remedy: "add it".into() };
        for (is_strict, end) in
            [(false, Ok(())), (true, Err("This machine cannot run: counts".to_owned()))]
        {
            let mut summary = Summary::new(is_strict);
            summary.check("counts", || Ok(Outcome::LeftOut(left_out.clone()))).unwrap();
            assert_eq!(summary.complete(), end);
        }
    }

    #[test]
    fn lists_beside_each_other_come_to_their_ends_and_the_failure_is_reported() {
        let mut summary = Summary::default();
        let result = summary.beside([true, false].map(|fails| {
            move |part: &mut Summary| {
                let name = if fails { "lints" } else { "pick" };
                let outcome =
                    || if fails { Err("one".into()) } else { Ok(Outcome::Passed("all".into())) };
                part.check(name, outcome)
            }
        }));
        assert_eq!(result, Err("lints failed: one".into()));
        let text = summary.text();
        assert!(text.contains("FAILED    lints") && text.contains("ok        pick"), "{text}");
    }

    #[test]
    fn failure_carries_the_name_of_the_check() {
        let mut summary = Summary::default();
        let failure = summary.check("lints", || Err("two warnings".into()));
        assert_eq!(failure, Err("lints failed: two warnings".into()));
    }
}
