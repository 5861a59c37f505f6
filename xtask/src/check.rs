//! The job `cargo xtask check`: runs every check of this repository.

use crate::debian;
use crate::documentation;
use crate::features;
use crate::lines;
use crate::lists;
use crate::nostd;
use crate::package;
use crate::pages;
use crate::pick;
use crate::process::{self, cargo, run};
use crate::python;
use crate::summary::{LeftOut, Outcome, Summary};
use crate::test::{self, DOCUMENTS};
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

/// Scope of the checks: parts that are left out, and parts that are added.
#[derive(Debug, Clone, Copy, Default)]
pub struct Scope {
    /// True if the tests are left out, since `cargo xtask test` has run them.
    pub is_tested: bool,
    /// True if a check that lacks a tool fails.
    pub is_strict: bool,
    /// True if the jobs that take hours are run too.
    pub is_long: bool,
}

/// Runs every check and prints the summary. The exit status is 1 if a check failed.
pub fn check(scope: Scope) -> ExitCode {
    let mut summary = Summary::new(scope.is_strict);
    listed(&BEFORE_THE_TESTS, &mut summary);
    if scope.is_tested {
        summary.skip("tests", "--tested");
        summary.skip("python", "--tested");
    } else {
        test::run(&mut summary);
    }
    listed(&AFTER_THE_TESTS, &mut summary);
    summary.beside(|| {
        lists::run(&BESIDE.map(names), |i, report| {
            let words = ["check", "--list", &i.to_string(), &report.display().to_string()];
            words.map(str::to_owned).to_vec()
        })
    });
    if scope.is_long {
        long(&mut summary);
    }
    summary.end("cargo xtask check")
}

/// Runs one of the parallel lists, by its number, and writes the outcomes of its checks into a file.
pub fn list(words: &[String]) -> ExitCode {
    let number = words.first().and_then(|word| word.parse::<usize>().ok());
    let (Some(list), Some(report)) = (number.and_then(|i| BESIDE.get(i)), words.get(1)) else {
        eprintln!("there is no such list");
        return ExitCode::FAILURE;
    };
    let mut summary = Summary::default();
    for (name, check) in *list {
        summary.check(name, check);
        if let Err(why) = lists::write(Path::new(report), &summary.ended) {
            eprintln!("{why}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

type Check = fn() -> Result<Outcome, String>;

type Listed = (&'static str, Check);

/// Checks that run first, since they find mistakes of writing quickly.
const BEFORE_THE_TESTS: [Listed; 2] = [("format", format), ("lints", lints)];

/// Checks that use the build of the tests and all cores, so that they run one after another. `lean` replaces `mbs` by a lean build, where
/// later jobs need the complete one. The tests of `lean` restore the complete one.
const AFTER_THE_TESTS: [Listed; 3] =
    [("rules", rules), ("lean", features::lean), ("documents", documents)];

/// Lists that run in parallel, since each list alone leaves a core idle half of the time. The programs of the tests that they need are built
/// before, with the features of the tests.
const BESIDE: [&[Listed]; 3] = [
    &[("fuzz", fuzz), ("pages", pages::check), ("counts", counts)],
    &[("check-nostd", nostd::check)],
    &[
        ("pick", pick::check),
        ("features", features::check),
        ("documentation", documentation::check),
        ("lines", lines::check),
    ],
];

/// Names of the checks of a list.
fn names(list: &[Listed]) -> Vec<&'static str> {
    list.iter().map(|(name, _)| *name).collect()
}

fn listed(list: &[Listed], summary: &mut Summary) {
    for (name, check) in list {
        summary.check(name, check);
    }
}

/// Seconds of the long fuzzing.
const LONG_FUZZ: &str = "1800";

/// A job of the long list.
#[derive(Debug, Clone, Copy)]
enum LongJob {
    /// Function of this program that makes the check.
    Here(Check),
    /// Words of the command line. Such a job ends its process, so it needs a process of its own.
    Words(&'static [&'static str]),
}

/// The long list: complete forms of the checks above, and checks that need other programs.
const LONG: [(&str, LongJob); 13] = [
    ("packages", LongJob::Here(package::check)),
    ("notebooks", LongJob::Here(python::notebooks)),
    ("features, more", LongJob::Here(features::more)),
    ("pages, whole", LongJob::Here(pages::whole)),
    ("counts, whole", LongJob::Words(&["counts"])),
    ("lines, whole", LongJob::Words(&["counts", "--lines"])),
    ("check-nostd, whole", LongJob::Words(&["check-nostd"])),
    ("races", LongJob::Words(&["races"])),
    ("gauntlet, whole", LongJob::Words(&["gauntlet"])),
    ("fuzz, long", LongJob::Words(&["fuzz", "--seconds", LONG_FUZZ])),
    ("choice", LongJob::Words(&["choice"])),
    ("report", LongJob::Words(&["report"])),
    ("peers", LongJob::Words(&["peers", "--quick"])),
];

fn long(summary: &mut Summary) {
    for (name, job) in LONG {
        summary.check(name, || match job {
            LongJob::Here(check) => check(),
            LongJob::Words(words) => {
                passed(Command::new(std::env::current_exe().unwrap_or_default()).args(words))
            }
        });
    }
}

/// Folders whose files a macro declares as modules. Cargo does not find these files by itself.
const BY_MACRO: [&str; 2] = ["mbs-core/src/effects", "mbs-core/src/outputs/quantity"];

fn format() -> Result<Outcome, String> {
    let mut args: Vec<String> = ["fmt", "--all", "--check", "--"].map(str::to_owned).to_vec();
    for folder in BY_MACRO {
        let files = std::fs::read_dir(process::root().join(folder)).map_err(|e| e.to_string())?;
        let files = files.flatten().map(|file| file.path());
        let sources = files.filter(|path| path.extension().is_some_and(|end| end == "rs"));
        args.extend(sources.map(|path| path.display().to_string()));
    }
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    component("fmt", "rustfmt", &args)
}

/// Runs the lints on the workspace, with lab's features: benches, effects, and our program among the peers. No other check has lints for
/// these.
fn lints() -> Result<Outcome, String> {
    let benches = ["clippy", "--workspace", "--features", "lab/benches,lab/effects,lab/ours"];
    let args = ["--all-targets", "--quiet", "--", "--deny", "warnings"];
    component("clippy", "clippy", &[&benches[..], &args[..]].concat())
}

/// The rules for text, edges, dependencies, licences and packages, which are tests of xtask.
fn rules() -> Result<Outcome, String> {
    passed(cargo().args(["test", "--workspace", "--quiet", "--test", "rules"]))
}

/// The commands of the documents, which are a test of the command.
fn documents() -> Result<Outcome, String> {
    passed(cargo().args(["test", "--workspace", "--quiet", "--test", "command", DOCUMENTS]))
}

/// Runs the first texts of fuzzing, which are the same on every machine. They take two to six minutes, and ten at most.
fn fuzz() -> Result<Outcome, String> {
    lab(&["fuzz", "--seconds", "600", "--count", "4000"])
}

fn counts() -> Result<Outcome, String> {
    match debian::find("valgrind", "valgrind") {
        Ok(()) => lab(&["counts", "--short"]),
        Err(left_out) => Ok(Outcome::LeftOut(left_out)),
    }
}

/// Runs a job of `lab`, which is built as for the tests. The last line that it prints is the remark on the check.
fn lab(words: &[&str]) -> Result<Outcome, String> {
    let mut lab = Command::new(process::tested("lab", "short")?);
    let out = lab.args(words).current_dir(process::root()).stderr(Stdio::inherit()).output();
    let out = out.map_err(|e| format!("cannot start `{}`: {e}", process::line(&lab)))?;
    let text = String::from_utf8_lossy(&out.stdout);
    if !out.status.success() {
        return Err(format!("`{}`: {}\n{text}", process::line(&lab), out.status));
    }
    Ok(Outcome::Passed(text.lines().last().unwrap_or_default().to_owned()))
}

/// Runs a command of which only the exit status counts.
fn passed(command: &mut Command) -> Result<Outcome, String> {
    run(command.current_dir(process::root())).map(|()| Outcome::Passed(String::new()))
}

/// Runs a cargo subcommand that a minimal Rust installation lacks.
fn component(subcommand: &str, name: &str, args: &[&str]) -> Result<Outcome, String> {
    if process::output(cargo().args([subcommand, "--version"])).is_none() {
        return Ok(Outcome::LeftOut(LeftOut {
            why: format!("`cargo {subcommand}` is not installed"),
            remedy: format!("Get it with `rustup component add {name}`."),
        }));
    }
    passed(cargo().args(args))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contributing_lists_the_checks_in_their_order() {
        let text = include_str!("../../CONTRIBUTING.md");
        let numbered = text.lines().filter_map(|line| {
            let (number, rest) = line.split_once(". `")?;
            number.parse::<u32>().ok()?;
            Some(rest.split_once("`: ")?.0)
        });
        let beside = BESIDE.iter().flat_map(|list| names(list)).collect();
        let lists =
            [names(&BEFORE_THE_TESTS), vec!["tests", "python"], names(&AFTER_THE_TESTS), beside];
        assert_eq!(numbered.collect::<Vec<_>>(), lists.concat());
    }

    #[test]
    fn contributing_lists_the_long_list_in_its_order() {
        let text = include_str!("../../CONTRIBUTING.md");
        let (_, after) = text.split_once("The long list has").expect("a paragraph on it");
        let named = after.lines().skip(1).skip_while(|line| !line.starts_with("- `"));
        let named = named.take_while(|line| !line.is_empty());
        let named = named.filter_map(|line| line.strip_prefix("- `")?.split_once("`: "));
        let names: Vec<_> = named.map(|(name, _)| name).collect();
        assert_eq!(names, LONG.map(|(name, _)| name));
    }
}
