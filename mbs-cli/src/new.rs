//! Command `mbs new TEMPLATE [FILE]`: writes a small scene as a beginning.

use crate::files;
use crate::refusal::Refusal;
use crate::say::say;
use clap::Args;
use mbs::scene_file::nearest_name;
use mbs::scene_file::templates::TEMPLATES;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLE: &str = "\
Example: mbs new crank-rocker
         mbs run crank-rocker.toml --out out";

/// Width of the column with the names of templates [characters].
const NAMES: usize = 16;

/// Arguments of `mbs new`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// Scene to begin from. Default: a list of all.
    template: Option<String>,
    /// File that is written; one that is there is never overwritten. Default: the template's name in the current directory.
    file: Option<PathBuf>,
}

/// Runs the command `mbs new`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match written(arguments) {
        Ok(text) => say(&text, ExitCode::SUCCESS),
        Err(refusal) => refusal.report(),
    }
}

fn written(arguments: &Arguments) -> Result<String, Refusal> {
    let Some(name) = &arguments.template else {
        let line = |name, meaning| format!("{name:<NAMES$}{meaning}\n");
        return Ok(TEMPLATES.iter().map(|x| line(x.name, x.meaning())).collect());
    };
    let Some(template) = TEMPLATES.iter().find(|template| template.name == name) else {
        let names: Vec<_> = TEMPLATES.iter().map(|template| template.name).collect();
        let hint = nearest_name(name, &names, "templates");
        return Err(Refusal::new("usage", format!("no template `{name}`"), hint));
    };
    let path = arguments.file.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let shown = path.display();
    if path.symlink_metadata().is_ok() {
        let message = format!("`{shown}` is there already, and is not overwritten");
        return Err(Refusal::new("out-unwritable", message, "give another file"));
    }
    files::write(&path, template.text.as_bytes(), None)?;
    Ok(format!("wrote {shown}\nrun it:  mbs run {shown} --out out\n"))
}
