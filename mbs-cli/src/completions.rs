//! Commands `mbs completions SHELL` and `mbs man DIR`: files for an installation of the command.

use crate::refusal::Refusal;
use crate::say::{plain, say};
use clap::{Args, Command};
use clap_complete::Shell;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLE: &str = "\
Example: mbs completions bash > ~/.local/share/bash-completion/completions/mbs";

/// Arguments of `mbs completions`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Completions {
    /// Shell for which they are written.
    shell: Shell,
}

/// Arguments of `mbs man`.
#[derive(Debug, Args)]
pub(crate) struct Man {
    /// Directory for mbs.1 and a page for each command; created if missing.
    dir: PathBuf,
}

/// Prints the completions of a shell.
pub(crate) fn completions(arguments: &Completions, mut command: Command) -> ExitCode {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "mbs", &mut text);
    say(&String::from_utf8_lossy(&text), ExitCode::SUCCESS)
}

/// Writes the manual pages of the program and its commands.
pub(crate) fn man(arguments: &Man, command: Command) -> ExitCode {
    let dir = &arguments.dir;
    let written =
        std::fs::create_dir_all(dir).and_then(|()| clap_mangen::generate_to(command, dir));
    let shown = dir.display();
    match written {
        Ok(()) => {
            say(&format!("wrote mbs.1 and a page for each command to {shown}"), ExitCode::SUCCESS)
        }
        Err(error) => {
            let message = format!("cannot write to `{shown}`: {}", plain(&error));
            Refusal::new("out-unwritable", message, "give another directory").report()
        }
    }
}
