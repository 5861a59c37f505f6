//! Jobs of this repository that measure: tables, experiments, times, charts and pages. `cargo xtask NAME` runs them.

mod bench;
mod chart;
mod choice;
mod counts;
mod digits;
mod estimate;
mod format;
mod fuzz;
mod gauntlet;
mod lab;
mod mbs;
mod page;
mod peers;
mod profile;
mod report;
mod report_grades;
mod step_experiments;
mod tables;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "cargo xtask",
    bin_name = "cargo xtask",
    about = "Jobs of the mbs repository that measure"
)]
struct Cli {
    /// The job.
    #[command(subcommand)]
    job: Job,
}

/// The jobs; `cargo xtask --help` lists their names (`xtask/src/main.rs`).
#[derive(Debug, Subcommand)]
enum Job {
    /// Run the report's tables anew, beside its numbers: text, CSV and HTML under target/tables
    Tables {
        /// Leave out runs of more than a million steps
        #[arg(long)]
        quick: bool,
        /// These tables alone: T1, T1p, T2, T3, T4, T5.1, T5.2, T5.3, T8, T6, T7, G1, G2, F6, D1
        #[arg(value_name = "TABLE")]
        names: Vec<String>,
    },
    /// Make every page of measurements with an index under target/report; a run that stops unlisted fails the job
    Report {
        /// Leave out the longest runs and the largest scenes
        #[arg(long)]
        quick: bool,
    },
    /// Run the experiments on variable steps beside fixed ones: text, CSV and HTML under target/steps
    Steps {
        /// Leave out the finest runs
        #[arg(long)]
        quick: bool,
        /// These experiments alone: F6, P2, A, B, C, H
        #[arg(value_name = "EXPERIMENT")]
        names: Vec<String>,
    },
    /// Time a step in each formulation and scene, its phases, faer beside it, and what threads gain: text, JSON and HTML under target/bench
    Bench {
        /// Sizes of teams: 4, 1-4, or 1-N for as many as there are cores; left out: 1-N
        #[arg(long, value_name = "1-N")]
        threads: Option<bench::Threads>,
        /// Leave out the largest scenes, and measure for less time
        #[arg(long)]
        quick: bool,
        /// These scenes alone: those of scenes/, or chain-N, tree-N, n-four-bar-N, net-N, convoy-N
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    /// Hold the choice by measurement against the best of all methods, on every scene at three errors: text and CSV under target/choice
    Choice {
        /// These scenes alone
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    /// Compare the errors that a run states with those that it has, on every scene: text under target/estimate
    Estimate {
        /// These scenes alone
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    /// Time mbs and its peers on the same problems, interleaved (docs/PEERS.md): text, Markdown, CSV and HTML under target/peers
    Peers {
        /// Fewer and shorter turns
        #[arg(long)]
        quick: bool,
        /// These problems alone: chain, tree, inverse, four-bars, robot, step, double-pendulum, n-four-bars, andrews
        #[arg(value_name = "PROBLEM")]
        names: Vec<String>,
    },
    /// Profile steps of index-3: instructions by parts under callgrind, operations, and the time beside the floor that the machine's own rates give (docs/PROFILES.md): text and Markdown under target/profile
    Profile {
        /// Put the tables into docs/PROFILES.md too
        #[arg(long)]
        keep: bool,
        /// These scenes alone; left out: the five whose steps take most time
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    /// Run hard cases by seed in every formulation; the table of methods by properties under target/gauntlet
    Gauntlet {
        /// So many cases
        #[arg(long, value_name = "N", default_value_t = 10_000)]
        count: usize,
        /// In so many processes; left out: one for each core
        #[arg(long, value_name = "N")]
        jobs: Option<usize>,
    },
    /// Count the instructions of a step under callgrind: what is absent or switched off costs nothing
    Counts {
        /// Leave out the build that has no effects: the cost of effects in a scene without them, and their refusals
        #[arg(long)]
        short: bool,
    },
    /// Try malformed scenes, mutated text and random mechanisms; what breaks or hangs is kept under target/fuzz
    Fuzz {
        /// For so long [s]
        #[arg(long, value_name = "S", default_value_t = 120)]
        seconds: u64,
        /// Seed of the first text; the check of the repository begins at 1
        #[arg(long, value_name = "N", default_value_t = 1)]
        seed: u64,
        /// So many texts; left out, as many as there is time for
        #[arg(long, value_name = "N", default_value_t = u64::MAX, hide_default_value = true)]
        count: u64,
    },
}

fn main() -> ExitCode {
    match run(Cli::parse().job) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("cargo xtask {}: {why}", std::env::args().nth(1).unwrap_or_default());
            ExitCode::FAILURE
        }
    }
}

/// Runs one of the jobs. Returns whether its results are as expected.
fn run(job: Job) -> Result<bool, String> {
    match job {
        Job::Tables { quick, names } => tables::tables(quick, &names)?,
        Job::Report { quick } => report::report(quick)?,
        Job::Steps { quick, names } => drop(step_experiments::run(quick, &names)?),
        Job::Bench { threads, quick, scenes } => {
            bench::run(&bench::Asked { threads, quick, scenes })?;
        }
        Job::Choice { scenes } => return choice::choice(&scenes),
        Job::Estimate { scenes } => return estimate::estimate(&scenes),
        Job::Peers { quick, names } => return peers::peers(quick, &names),
        Job::Profile { keep, scenes } => profile::profile(keep, &scenes)?,
        Job::Gauntlet { count, jobs } => return gauntlet::gauntlet(count, jobs),
        Job::Counts { short } => return counts::counts(short),
        Job::Fuzz { seconds, seed, count } => fuzz::fuzz(seconds, seed, count)?,
    }
    Ok(true)
}
