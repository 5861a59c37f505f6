//! The command `cargo xtask`: its jobs, and those of `lab`, which is compiled when one of them is asked for.

use clap::error::ErrorKind::InvalidSubcommand;
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;
use xtask::{
    bundle, check, dist, lines, nostd, package, pick, pictures, process, python, races, simulate,
    test,
};

/// The jobs of `lab`.
const LAB: &str = "Jobs that measure, each with its own --help; they are compiled when one is asked for: bench, choice, estimate, fuzz, gauntlet, peers, profile, report, steps, tables";

/// The command line.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", about = "Jobs of the mbs repository")]
#[command(after_help = LAB)]
struct Cli {
    /// The job.
    #[command(subcommand)]
    job: Job,
}

/// The jobs.
#[derive(Debug, Subcommand)]
enum Job {
    /// Build `mbs` in release mode and run a scene: `mbs run ARGS`
    #[command(disable_help_flag = true)]
    Simulate {
        /// Arguments of `mbs run`: a scene file and options (`--help` lists them)
        #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGS")]
        args: Vec<OsString>,
    },
    /// Build `mbs` in release mode and call it: `mbs ARGS`
    #[command(disable_help_flag = true)]
    Mbs {
        /// A command of `mbs` with its arguments (`--help` lists them)
        #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGS")]
        args: Vec<OsString>,
    },
    /// The tests of every crate, of the command and of the Python package. The last line is `N passed, N failed`
    Test {
        /// Fail where tests cannot run for want of a tool
        #[arg(long)]
        strict: bool,
        /// An option of `check`
        #[arg(long, hide = true)]
        quick: bool,
        /// An option of `check`
        #[arg(long, hide = true)]
        long: bool,
    },
    /// Every check, also behind one that fails: format, lints, tests, python, rules, lean, documents, fuzz, pages, counts, check-nostd, pick, features, documentation, lines
    Check {
        /// Without the tests, which `cargo xtask test` has run
        #[arg(long)]
        tested: bool,
        /// Fail where a check cannot run for want of a tool
        #[arg(long)]
        strict: bool,
        /// Then the long list: what the check has in a short form, and jobs that take hours (CONTRIBUTING.md)
        #[arg(long)]
        long: bool,
        /// One of the lists beside each other, and the file that says how its checks ended: how the check starts itself
        #[arg(long, hide = true, num_args = 2, value_names = ["NUMBER", "FILE"], conflicts_with_all = ["tested", "strict", "long"])]
        list: Option<Vec<String>>,
    },
    /// Build and run each package of examples/pick: mbs-core and one formulation alone
    Pick,
    /// Build the wheel of the Python package, and test it in a clean virtual environment
    Python,
    /// Make the files of a release in `target/dist`, and try each without a compiler: wheel, archive, sums
    Dist(dist::Options),
    /// Package every crate, and build the packages on each other
    Package,
    /// Watch the lock-free team of mbs-parallel for data races, under ThreadSanitizer
    Races,
    /// Cross-compile the no_std crates for a microcontroller, without and with alloc
    CheckNostd,
    /// Bundle the part of three.js that pages contain, with the versions of its lock file; needs node and npm
    Bundle,
    /// Draw the pictures of README.md and docs/ with `mbs`; needs chromium
    Pictures {
        /// Words: pictures whose names have one of them. Default: all
        words: Vec<String>,
    },
    /// Count the instructions of a step under callgrind (a job of `lab`), or the lines of code before optimisation
    Counts {
        /// Lines of code that LLVM is given, crate by crate: what a build costs. Fails above the bounds in docs/PROFILES.md
        #[arg(long)]
        lines: bool,
        /// Write the lines into docs/PROFILES.md; bounds are raised by hand
        #[arg(long, requires = "lines")]
        keep: bool,
    },
    /// A job of `lab`, and its words
    #[command(external_subcommand)]
    Lab(Vec<OsString>),
}

fn main() -> ExitCode {
    if let Some(end) = lines::as_compiler() {
        return end;
    }
    match Cli::parse().job {
        Job::Simulate { args } => simulate::simulate(&args),
        Job::Mbs { args } => simulate::mbs(&args),
        Job::Test { quick: true, .. } => refused(
            "test --quick",
            "`cargo xtask test` runs the tests alone, `cargo xtask check` every check",
        ),
        Job::Test { long: true, .. } => refused(
            "test --long",
            "`cargo xtask check --long` runs every check, then the long list",
        ),
        Job::Test { strict, .. } => test::test(strict),
        Job::Check { list: Some(words), .. } => check::list(&words),
        Job::Check { tested, strict, long, .. } => {
            check::check(check::Scope { is_tested: tested, is_strict: strict, is_long: long })
        }
        Job::Pick => pick::pick(),
        Job::Python => python::python(),
        Job::Dist(options) => dist::dist(&options),
        Job::Package => package::package(),
        Job::Races => races::races(),
        Job::Bundle => bundle::bundle(),
        Job::Pictures { words } => pictures::pictures(&words),
        Job::CheckNostd => nostd::check_nostd(),
        Job::Counts { lines: true, keep } => lines::lines(keep),
        Job::Counts { .. } => process::hand_over(process::cargo().args(["lab", "counts"])),
        Job::Lab(words) if words[0].to_str().is_some_and(|job| LAB.contains(job)) => {
            process::hand_over(process::cargo().arg("lab").args(words))
        }
        Job::Lab(words) if words[0] == "ci" => {
            refused("ci", "`cargo xtask check` runs every check")
        }
        Job::Lab(_) => Cli::command().error(InvalidSubcommand, "there is no such job").exit(),
    }
}

/// Refuses a former word of the command line, with exit status 2.
fn refused(word: &str, hint: &str) -> ! {
    let message = format!("there is no `cargo xtask {word}`\n\n  hint: {hint}");
    Cli::command().error(InvalidSubcommand, message).exit()
}
