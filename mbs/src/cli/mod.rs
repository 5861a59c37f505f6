//! Command line: arguments, refusals, and the commands.

mod run;
mod table;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Dynamics of multibody systems.
#[derive(Debug, Parser)]
#[command(name = "mbs", version, about, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a scene: summary, and with --out run.csv, run.json and run.html.
    Run(run::Arguments),
}

/// Exit status of a refusal.
pub(crate) const REFUSED: u8 = 1;
/// Exit status of a run that stopped.
pub(crate) const STOPPED: u8 = 2;

/// Parses, runs, and gives the exit status.
pub(crate) fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are no refusals; a closed pipe is none of our business.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { REFUSED } else { 0 });
        }
    };
    match cli.command {
        Command::Run(arguments) => run::main(&arguments),
    }
}

/// Writes a refusal to standard error.
pub(crate) fn refuse(message: &str) -> ExitCode {
    eprintln!("{}", message.trim_end());
    ExitCode::from(REFUSED)
}
