//! The command `cargo xtask`: its jobs, and those of `lab`, which is compiled when one of them is asked for.

use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;
use xtask::{check, counts, fuzz, jobs, nostd, package, pick, process, races, simulate};

/// The command line.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", about = "Jobs of the mbs repository")]
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
    /// Every check, stops at the first failure: format, lints, tests, fuzz, pages, documentation, features, pick, check-nostd, counts
    #[command(alias = "ci")]
    Test {
        /// Skip lints, fuzz, pages, documentation and counts
        #[arg(long)]
        quick: bool,
        /// Fail where a check cannot run for want of a tool
        #[arg(long)]
        strict: bool,
        /// Then the jobs that take hours: packages, races, the whole gauntlet, long fuzzing, choice, report, peers
        #[arg(long, conflicts_with = "quick")]
        long: bool,
    },
    /// Build and run each package of examples/pick: mbs-core and one formulation alone
    Pick,
    #[command(disable_help_flag = true, about = jobs::TABLES)]
    Tables(Words),
    #[command(disable_help_flag = true, about = jobs::REPORT)]
    Report(Words),
    #[command(disable_help_flag = true, about = jobs::STEPS)]
    Steps(Words),
    #[command(disable_help_flag = true, about = jobs::BENCH)]
    Bench(Words),
    #[command(disable_help_flag = true, about = jobs::CHOICE)]
    Choice(Words),
    #[command(disable_help_flag = true, about = jobs::ESTIMATE)]
    Estimate(Words),
    #[command(disable_help_flag = true, about = jobs::PEERS)]
    Peers(Words),
    /// Count the instructions of a step under callgrind: what is absent or switched off costs nothing
    Counts,
    #[command(disable_help_flag = true, about = jobs::PROFILE)]
    Profile(Words),
    /// Try malformed scenes, mutated text and random mechanisms; what breaks or hangs is kept under target/fuzz
    Fuzz {
        /// For so long [s]
        #[arg(long, value_name = "S", default_value_t = 120)]
        seconds: u64,
        /// Seed of the first text; the check of the repository begins at 1
        #[arg(long, value_name = "N", default_value_t = 1)]
        seed: u64,
    },
    #[command(disable_help_flag = true, about = jobs::GAUNTLET)]
    Gauntlet(Words),
    /// Package every crate, and build the packages on each other
    Package,
    /// Watch the lock-free team of mbs-parallel for data races, under ThreadSanitizer
    Races,
    /// Cross-compile the no_std crates for a microcontroller, without and with alloc
    CheckNostd,
}

/// What follows the name of a job of `lab`, which reads it.
#[derive(Debug, clap::Args)]
struct Words {
    /// Names and options of the job (`cargo xtask JOB --help` lists them)
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGS")]
    args: Vec<OsString>,
}

fn main() -> ExitCode {
    match Cli::parse().job {
        Job::Simulate { args } => simulate::simulate(&args),
        Job::Mbs { args } => simulate::mbs(&args),
        Job::Test { quick, strict, long } => {
            check::test(check::Scope { is_quick: quick, is_strict: strict, is_long: long })
        }
        Job::Pick => pick::pick(),
        Job::Tables(words) => lab("tables", &words),
        Job::Report(words) => lab("report", &words),
        Job::Steps(words) => lab("steps", &words),
        Job::Bench(words) => lab("bench", &words),
        Job::Choice(words) => lab("choice", &words),
        Job::Estimate(words) => lab("estimate", &words),
        Job::Peers(words) => lab("peers", &words),
        Job::Counts => counts::counts(),
        Job::Profile(words) => lab("profile", &words),
        Job::Fuzz { seconds, seed } => fuzz::fuzz(seconds, seed),
        Job::Gauntlet(words) => lab("gauntlet", &words),
        Job::Package => package::package(),
        Job::Races => races::races(),
        Job::CheckNostd => nostd::check_nostd(),
    }
}

/// Builds `lab` where that is needed, and has it do a job; its exit status.
fn lab(job: &str, words: &Words) -> ExitCode {
    let mut lab = process::cargo();
    lab.args(["run", "--quiet", "--release", "--package", "xtask", "--features", "lab"]);
    lab.args(["--bin", "lab", "--", job]).args(&words.args);
    process::hand_over(&mut lab)
}
