//! The command `mbs` as a library, for programs that contain it: arguments, refusals, and the commands. Exit status: 0 done, 1 refused
//! (scene or usage), 2 the run stopped or its results could not be written, 3 the build lacks the precision. Computations are in other
//! crates, so that no code here is compiled once per scalar type or dimension.

#![deny(clippy::print_stderr, reason = "it panics where standard error is full")]

mod analysis;
mod bar;
mod channels;
mod check;
mod compare;
mod completions;
mod diff;
mod doctor;
mod explain;
mod export;
mod files;
mod generate;
mod import;
mod input;
mod inspect;
mod keep;
mod line;
mod manual;
mod method;
mod model;
mod new;
mod plot;
mod precision;
mod realtime;
mod refusal;
mod run;
mod say;
mod scene;
mod show;
mod signals;
mod status;
mod sweep;
mod table;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use mbs::Precision;
use mbs::scene_file::nearest_name;
use precision::{NO_PAIRS, named, unbuilt};
use refusal::{Refusal, usage};
use std::ffi::OsString;
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
Examples:
  mbs new crank-rocker                      a small scene to begin from
  mbs run crank-rocker.toml --open          its motion, peaks and plots as a page
  mbs run crank-rocker.toml --error 1e-4    by the cheapest method that has this error
  mbs doctor crank-rocker.toml              what is wrong with a scene, and what mends it
  mbs kinds revolute                        what a scene file may say of a revolute joint
Exit status:
  0  completed
  1  the scene or the usage was refused
  2  a run stopped early (its data are kept), there is no equilibrium, or the doctor found a fault
  3  this build lacks the precision";

/// The commands in the groups in which the help lists them.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Write a scene", &["new", "import", "kinds", "check", "schema", "generate"]),
    ("Run it", &["run", "plot", "diff"]),
    ("Analyse it", &["doctor", "explain", "inspect", "equilibrium", "modes"]),
    ("Many runs", &["sweep", "compare"]),
    ("Elsewhere", &["export", "completions", "man", "help"]),
];

/// Names in other programs of commands of this one.
const OTHER_WORDS: [(&str, &str); 7] = [
    ("simulate", "run"),
    ("init", "new"),
    ("create", "new"),
    ("validate", "check"),
    ("show", "run --open"),
    ("eigen", "modes"),
    ("static", "equilibrium"),
];

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
    /// Draw channels of one or several runs over each other, as a page, SVG or PDF, or write them as one table (CSV).
    Plot(plot::Arguments),
    /// Run a scene with many varied numbers, into one table; the same command continues a killed sweep.
    Sweep(sweep::Arguments),
    /// Write a small scene to begin from; without a name, list them.
    New(new::Arguments),
    /// Write a model of another program as a scene (URDF, MJCF, SDF), and list what is not in it.
    Import(import::Arguments),
    /// Compute what a mechanism has at a state: accelerations, efforts, mass matrix, momentum, frames.
    Inspect(inspect::Arguments),
    /// Read scenes and assemble them, without a run.
    Check(check::Arguments),
    /// List the tables and kinds of scene files; with a name, its keys, units, defaults and an example.
    Kinds(manual::Kinds),
    /// Write a JSON Schema of scene files, for editors.
    Schema(manual::Schema),
    /// Print the completions of a shell.
    Completions(completions::Completions),
    /// Write the manual pages of the command.
    Man(completions::Man),
}

/// The command line, with its commands in groups for the help.
fn command_line() -> clap::Command {
    let mut command = Cli::command();
    // `build` adds the command `help` and the global options
    command.build();
    let about = |name: &str| {
        let about = command.find_subcommand(name).and_then(clap::Command::get_about);
        about.map(ToString::to_string).unwrap_or_default()
    };
    let line = |name: &&str| format!("  {name:<12} {}\n", about(name).trim_end_matches('.'));
    let group = |(title, names): &(&str, &[&str])| {
        format!("{title}:\n{}\n", names.iter().map(line).collect::<String>())
    };
    let groups: String = GROUPS.iter().map(group).collect();
    Cli::command().help_template(format!(
        "{{about}}\n\n{{usage-heading}} {{usage}}\n\n{groups}Options:\n{{options}}{{after-help}}"
    ))
}

/// Runs the command of a command line. `program` is the command that started this process: a file, or an interpreter with its arguments.
/// The exit status is 0 for done, 1 for refused, 2 for stopped early or not written, 3 for a precision that is not in this build.
pub fn run(
    program: impl IntoIterator<Item = OsString>,
    words: impl IntoIterator<Item = OsString>,
) -> u8 {
    line::note(program.into_iter().collect(), words.into_iter().collect());
    let code = go();
    // an ExitCode does not give its number, so it is compared with all numbers
    (0..=u8::MAX).find(|number| ExitCode::from(*number) == code).unwrap_or(status::STOPPED)
}

fn go() -> ExitCode {
    signals::outlive_limits();
    let words = std::iter::once(OsString::from("mbs")).chain(line::words());
    let cli = match command_line()
        .try_get_matches_from(words)
        .and_then(|matches| Cli::from_arg_matches(&matches))
    {
        Ok(cli) => cli,
        Err(error) => {
            return unparsed(&error);
        }
    };
    if cli.big {
        input::read_big();
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
        Command::Import(arguments) => import::main(&arguments),
        Command::Inspect(arguments) => inspect::main(&arguments),
        Command::Check(arguments) => check::main(&arguments),
        Command::Kinds(arguments) => manual::kinds(&arguments),
        Command::Schema(_) => manual::schema(),
        Command::Completions(arguments) => completions::completions(&arguments, command_line()),
        Command::Man(arguments) => completions::man(&arguments, command_line()),
    }
}

impl Command {
    /// Precisions that the command will need, from its arguments. The list is empty if its names or its scene will be refused. Returns a
    /// refusal if the command never supports the precision.
    fn precisions(&self) -> Result<Vec<Precision>, [&'static str; 2]> {
        let (name, scene) = match self {
            Self::Run(arguments) => (&arguments.method.given.precision, &arguments.scene),
            Self::Explain(arguments) => (&arguments.method.given.precision, &arguments.scene),
            Self::Export(arguments) => (&arguments.precision, &arguments.scene),
            Self::Sweep(arguments) => (&arguments.method.given.precision, &arguments.scene),
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

/// Prints the help or the version, which are no refusals, or refuses the arguments.
fn unparsed(error: &clap::Error) -> ExitCode {
    let text = error.render();
    if !error.use_stderr() {
        return say::say(&text.to_string(), ExitCode::SUCCESS);
    }
    // prints with colours on a terminal; an error cannot be reported if standard error is closed
    let _ = error.print();
    let hint = hint(error).unwrap_or_default();
    if !hint.is_empty() {
        say::warn(&format!("\nhint: {hint}"));
    }
    let text = text.to_string();
    let message: Vec<_> = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    usage(message.join(" ").trim_start_matches("error: "), &hint)
}

/// Returns the hint for an unknown command: a scene file, the word of another program, or the nearest name if clap suggests none.
fn hint(error: &clap::Error) -> Option<String> {
    let word = match (error.kind(), error.get(ContextKind::InvalidSubcommand)) {
        (ErrorKind::InvalidSubcommand, Some(ContextValue::String(word))) => word,
        _ => return None,
    };
    if std::path::Path::new(word).exists() {
        return Some(format!("to run a scene, write `mbs run {word}`"));
    }
    if let Some((_, ours)) = OTHER_WORDS.iter().find(|(theirs, _)| theirs == word) {
        return Some(format!("write `mbs {ours}`"));
    }
    let names: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
    let is_met = error.get(ContextKind::SuggestedSubcommand).is_some();
    (!is_met).then(|| nearest_name(word, &names, "commands"))
}
