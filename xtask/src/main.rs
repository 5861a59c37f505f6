//! The command `cargo xtask`: its jobs, and those of `lab`, which is compiled when one of them is asked for.

use clap::error::ErrorKind::InvalidSubcommand;
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;
use xtask::{
    bundle, check, dist, lines, nostd, package, pick, pictures, process, python, races, simulate,
};

/// The jobs of `lab`.
const LAB: &str = "Jobs that measure, each with its own --help; they are compiled when one is asked for: bench, choice, counts, estimate, fuzz, gauntlet, peers, profile, report, steps, tables";

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
    /// Every check, also behind one that fails: format, lints, tests, fuzz, pages, documentation, features, pick, check-nostd, counts, python
    #[command(alias = "ci")]
    Test {
        /// Skip lints, fuzz, pages, documentation, counts and the Python package
        #[arg(long)]
        quick: bool,
        /// Fail where a check cannot run for want of a tool
        #[arg(long)]
        strict: bool,
        /// Then the jobs that take hours: packages, races, the whole gauntlet, long fuzzing, choice, report, peers, notebooks
        #[arg(long, conflicts_with = "quick")]
        long: bool,
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
        Job::Test { quick, strict, long } => {
            check::test(check::Scope { is_quick: quick, is_strict: strict, is_long: long })
        }
        Job::Pick => pick::pick(),
        Job::Python => python::python(),
        Job::Dist(options) => dist::dist(&options),
        Job::Package => package::package(),
        Job::Races => races::races(),
        Job::Bundle => bundle::bundle(),
        Job::Pictures { words } => pictures::pictures(&words),
        Job::CheckNostd => nostd::check_nostd(),
        Job::Lab(words) if words[0].to_str().is_some_and(|job| LAB.contains(job)) => {
            process::hand_over(process::cargo().arg("lab").args(words))
        }
        Job::Lab(_) => Cli::command().error(InvalidSubcommand, "there is no such job").exit(),
    }
}
