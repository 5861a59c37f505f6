//! The `mbs` command: arguments, refusals, and the commands. Exit status: 0 done, 1 refused (scene or usage), 2 the run
//! stopped or its results could not be written, 3 the build lacks the precision. The library computes: nothing here is compiled for a
//! scalar or a dimension.

#![deny(clippy::print_stderr, reason = "it panics where standard error is full")]

mod analysis;
mod bar;
mod channels;
mod check;
mod compare;
mod diff;
mod doctor;
mod explain;
mod export;
mod files;
mod generate;
mod keep;
mod manual;
mod new;
mod plot;
mod precision;
mod realtime;
mod refusal;
mod run;
mod say;
mod scene;
mod signals;
mod status;
mod sweep;
mod table;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Parser, Subcommand};
use mbs::Precision;
use precision::{NO_PAIRS, named, unbuilt};
use refusal::{Refusal, usage};
use std::process::ExitCode;

/// Dynamics of multibody systems: reads a scene file, writes motion, energies and plots.
#[derive(Debug, Parser)]
#[command(name = "mbs", version, about = ABOUT, arg_required_else_help = true, after_help = STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Read files of more than 64 MiB or 8 million values; they may need eighty times their size in memory.
    #[arg(long, global = true, display_order = 900)]
    big: bool,
}

const ABOUT: &str =
    "Dynamics of multibody systems: reads a scene file, writes motion, energies and plots.";
const STATUS: &str = "\
Example: mbs run scenes/double-pendulum.toml --out out
Exit status:
  0  completed
  1  the scene or the usage was refused
  2  a run stopped early (its data are kept), there is no equilibrium, or the doctor found a fault
  3  this build lacks the precision";

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a scene; with --out, write run.csv, run.json and run.html.
    Run(Box<run::Arguments>),
    /// Measure CPU time and true error of every method over a range of steps; --resume continues it.
    Compare(compare::Arguments),
    /// Compare the results of two runs: peaks, root mean squares, largest difference and when.
    Diff(diff::Arguments),
    /// Report what a scene simulates, what it does not, and the measured cost of each effect.
    Explain(explain::Arguments),
    /// Report faults and doubts, with remedies: dependent joints by name, reactions, branches, masses, units, start.
    Doctor(doctor::Arguments),
    /// Write a scene as constant tables for a controller: Rust, or bytes.
    Export(export::Arguments),
    /// Find the static equilibrium: joint coordinates, reactions, outputs, stability.
    Equilibrium(analysis::Equilibrium),
    /// Linearise a scene: eigenvalues, frequencies, damping ratios.
    Modes(analysis::Modes),
    /// Write a large scene: chain, tree, n-four-bar, net, or a convoy of a vehicle.
    Generate(generate::Arguments),
    /// Draw channels of one or several runs over each other (SVG), or write them as one table (CSV).
    Plot(plot::Arguments),
    /// Run a scene with many varied numbers, into one table; the same command continues a killed sweep.
    Sweep(sweep::Arguments),
    /// Write a small scene to begin from; without a name, list them.
    New(new::Arguments),
    /// Read scenes and assemble them, without a run.
    Check(check::Arguments),
    /// List the tables and kinds of scene files; with a name, its keys, units, defaults and an example.
    Kinds(manual::Kinds),
    /// Write a JSON Schema of scene files, for editors.
    Schema(manual::Schema),
}

fn main() -> ExitCode {
    signals::outlive_limits();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            return unparsed(&error);
        }
    };
    if cli.big {
        files::read_big();
    }
    match cli.command.precisions() {
        Ok(needed) => {
            if let Some(precision) = needed.into_iter().find(|p| !p.is_built()) {
                return unbuilt(precision);
            }
        }
        Err([message, hint]) => return Refusal::new("settings-refused", message, hint).report(),
    }
    match cli.command {
        Command::Run(arguments) => run::main(&arguments),
        Command::Compare(arguments) => compare::main(&arguments),
        Command::Diff(arguments) => diff::main(&arguments),
        Command::Explain(arguments) => explain::main(&arguments),
        Command::Doctor(arguments) => doctor::main(&arguments),
        Command::Export(arguments) => export::main(&arguments),
        Command::Equilibrium(arguments) => analysis::equilibrium(&arguments),
        Command::Modes(arguments) => analysis::modes(&arguments),
        Command::Generate(arguments) => generate::main(&arguments),
        Command::Plot(arguments) => plot::main(&arguments),
        Command::Sweep(arguments) => sweep::main(&arguments),
        Command::New(arguments) => new::main(&arguments),
        Command::Check(arguments) => check::main(&arguments),
        Command::Kinds(arguments) => manual::kinds(&arguments),
        Command::Schema(_) => manual::schema(),
    }
}

impl Command {
    /// Precisions that it will need, by its arguments; none where it will be refused for its names or its scene. Or the refusal
    /// of one that it never has.
    fn precisions(&self) -> Result<Vec<Precision>, [&'static str; 2]> {
        let (name, scene) = match self {
            Self::Run(arguments) => (&arguments.precision, &arguments.scene),
            Self::Explain(arguments) => (&arguments.precision, &arguments.scene),
            Self::Export(arguments) => (&arguments.precision, &arguments.scene),
            Self::Sweep(arguments) => (&arguments.precision, &arguments.scene),
            Self::Compare(arguments) if arguments.scene.is_there() => {
                return Ok(arguments.precisions());
            }
            _ => return Ok(Vec::new()),
        };
        match named(name) {
            Some(Precision::DoubleDouble) if !matches!(self, Self::Run(_)) => Err(NO_PAIRS),
            named => Ok(named.into_iter().filter(|_| scene.is_there()).collect()),
        }
    }
}

/// Help and version, which are no refusals, or what is wrong with the arguments.
fn unparsed(error: &clap::Error) -> ExitCode {
    let text = error.render();
    if !error.use_stderr() {
        return say::say(&text.to_string(), ExitCode::SUCCESS);
    }
    // with colours on a terminal; where it is closed nothing can be reported
    let _ = error.print();
    let hint = hint(error).unwrap_or_default();
    if !hint.is_empty() {
        say::warn(&format!("\nhint: {hint}"));
    }
    let text = text.to_string();
    let message: Vec<_> = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    usage(message.join(" ").trim_start_matches("error: "), &hint)
}

/// What to say about a command that is none.
fn hint(error: &clap::Error) -> Option<String> {
    let word = match (error.kind(), error.get(ContextKind::InvalidSubcommand)) {
        (ErrorKind::InvalidSubcommand, Some(ContextValue::String(word))) => word,
        _ => return None,
    };
    std::path::Path::new(word).exists().then(|| format!("to run a scene, write `mbs run {word}`"))
}
