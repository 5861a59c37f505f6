//! Commands `mbs kinds` and `mbs schema`: descriptions of the scene format.

use crate::refusal::Refusal;
use crate::say::say;
use clap::Args;
use mbs::scene_file::manual;
use std::process::ExitCode;

const KINDS: &str = "\
Example: mbs kinds
         mbs kinds revolute
         mbs kinds effect friction";

const SCHEMA: &str = "\
Example: mbs schema > scene.schema.json
An editor with a TOML language server completes and checks scenes by it.";

/// Arguments of `mbs kinds`.
#[derive(Debug, Args)]
#[command(after_help = KINDS)]
pub(crate) struct Kinds {
    /// A table or a kind, such as joint or revolute. Default: a list of all.
    kind: Vec<String>,
    /// Write all of it as Markdown: docs/SCENES.md.
    #[arg(long, conflicts_with = "kind")]
    markdown: bool,
}

/// Arguments of `mbs schema`.
#[derive(Debug, Args)]
#[command(after_help = SCHEMA)]
pub(crate) struct Schema {}

/// Runs the command `mbs kinds`.
pub(crate) fn kinds(arguments: &Kinds) -> ExitCode {
    if arguments.markdown {
        return say(&manual::markdown(), ExitCode::SUCCESS);
    }
    if arguments.kind.is_empty() {
        return say(&manual::list(), ExitCode::SUCCESS);
    }
    let kind = arguments.kind.join(" ");
    match manual::page(&kind) {
        Ok(page) => say(&page, ExitCode::SUCCESS),
        Err(hint) => Refusal::new("usage", format!("no table or kind `{kind}`"), hint).report(),
    }
}

/// Runs the command `mbs schema`.
pub(crate) fn schema() -> ExitCode {
    say(&manual::schema(), ExitCode::SUCCESS)
}
