//! Jobs of this repository that measure: tables, experiments, times, charts and pages; `cargo xtask NAME` runs them.

mod bench;
mod chart;
mod choice;
mod digits;
mod estimate;
mod gauntlet;
mod grades;
mod lab;
mod mbs;
mod page;
mod peers;
mod profile;
mod report;
mod steps;
mod tables;
mod tell;

use clap::{Parser, Subcommand};
use std::process::ExitCode;
use xtask::jobs;

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

/// The jobs; `cargo xtask --help` lists them too (`xtask/src/main.rs`).
#[derive(Debug, Subcommand)]
enum Job {
    #[command(about = jobs::TABLES)]
    Tables {
        /// Leave out runs of more than a million steps
        #[arg(long)]
        quick: bool,
        /// These tables alone: T1, T1p, T2, T3, T4, T5.1, T5.2, T5.3, T8, T6, T7, G1, G2, F6, D1
        #[arg(value_name = "TABLE")]
        names: Vec<String>,
    },
    #[command(about = jobs::REPORT)]
    Report {
        /// Leave out the longest runs and the largest scenes
        #[arg(long)]
        quick: bool,
    },
    #[command(about = jobs::STEPS)]
    Steps {
        /// Leave out the finest runs
        #[arg(long)]
        quick: bool,
        /// These experiments alone: F6, P2, A, B, C, H
        #[arg(value_name = "EXPERIMENT")]
        names: Vec<String>,
    },
    #[command(about = jobs::BENCH)]
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
    #[command(about = jobs::CHOICE)]
    Choice {
        /// These scenes alone
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    #[command(about = jobs::ESTIMATE)]
    Estimate {
        /// These scenes alone
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    #[command(about = jobs::PEERS)]
    Peers {
        /// Fewer and shorter turns
        #[arg(long)]
        quick: bool,
        /// These problems alone: chain, tree, inverse, four-bars, step, double-pendulum, n-four-bars, andrews
        #[arg(value_name = "PROBLEM")]
        names: Vec<String>,
    },
    #[command(about = jobs::PROFILE)]
    Profile {
        /// Put the tables into docs/PROFILES.md too
        #[arg(long)]
        keep: bool,
        /// These scenes alone; left out: the five whose steps take most time
        #[arg(value_name = "SCENE")]
        scenes: Vec<String>,
    },
    #[command(about = jobs::GAUNTLET)]
    Gauntlet {
        /// So many cases
        #[arg(long, value_name = "N", default_value_t = 10_000)]
        count: usize,
        /// In so many processes; left out: one for each core
        #[arg(long, value_name = "N")]
        jobs: Option<usize>,
    },
}

fn main() -> ExitCode {
    match Cli::parse().job {
        Job::Tables { quick, names } => tables::tables(quick, &names),
        Job::Report { quick } => report::report(quick),
        Job::Steps { quick, names } => steps::steps(quick, &names),
        Job::Bench { threads, quick, scenes } => {
            bench::bench(&bench::Asked { threads, quick, scenes })
        }
        Job::Choice { scenes } => choice::choice(&scenes),
        Job::Estimate { scenes } => estimate::estimate(&scenes),
        Job::Peers { quick, names } => peers::peers(quick, &names),
        Job::Profile { keep, scenes } => profile::profile(keep, &scenes),
        Job::Gauntlet { count, jobs } => gauntlet::gauntlet(count, jobs),
    }
}
