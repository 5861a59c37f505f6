//! Command `mbs check SCENE...`: reads scenes and assembles them, without a run.

use crate::files;
use crate::refusal::Refusal;
use crate::run::stopped;
use crate::say::{say, warn};
use crate::scene::{CheckedScene, SceneArgument};
use crate::status::REFUSED;
use clap::Args;
use mbs::scene_file::format::counted;
use mbs::{Method, Names, ResolvedMethod, sizes_at_start};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const STATUS: &str = "\
Example: mbs check scenes/*.toml
Exit status:
  0  every scene is read, and assembles at t = 0
  1  one of them is refused, or does not assemble";

/// Arguments of `mbs check`.
#[derive(Debug, Args)]
#[command(after_help = STATUS)]
pub(crate) struct Arguments {
    /// Scene files.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Print one JSON object for each file, a line each.
    #[arg(long)]
    json: bool,
}

/// Sizes of a valid scene (coordinates, constraints, rank), and notes on it.
type Sizes = ([usize; 3], Vec<String>);

/// Reason why a scene is refused: an object for programs, and a text.
type Failure = (Value, String);

/// Runs the command `mbs check`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let mut text = String::new();
    let mut status = ExitCode::SUCCESS;
    for path in &arguments.scenes {
        let file = path.display().to_string();
        let checked = check(path);
        if let Err((_, why)) = &checked {
            status = ExitCode::from(REFUSED);
            warn(why);
        }
        text += &match (checked, arguments.json) {
            (checked, true) => object(&file, checked).to_string() + "\n",
            (Ok(([coordinates, constraints, rank], notes)), false) => {
                let notes = notes.iter().map(|note| format!("note: {note}\n"));
                format!(
                    "{file}: {} of freedom ({}, {} of rank {rank})\n{}",
                    counted(coordinates - rank, "degree"),
                    counted(coordinates, "coordinate"),
                    counted(constraints, "constraint"),
                    notes.collect::<String>(),
                )
            }
            (Err(_), false) => String::new(),
        };
    }
    say(&text, status)
}

/// Reads a scene, checks its settings, and assembles it.
fn check(path: &Path) -> Result<Sizes, Failure> {
    let refused = |refusal: Refusal| (refusal.error(), refusal.text());
    let CheckedScene { document, scene } = SceneArgument::new(path, &[]).read().map_err(refused)?;
    let settings = ResolvedMethod::new(&scene, &Method::default());
    settings.map_err(|error| refused(files::refusal(&error, &document)))?;
    let sizes = sizes_at_start(&scene).map_err(|error| {
        let report = error.report(0.0, &Names::new(&scene));
        (json!(report), stopped("no start", &report, &error, &document))
    })?;
    let couplings = scene.sense_notes().chain(scene.radii_notes()).map(|(_, note)| note);
    Ok((sizes, couplings.chain(scene.table_notes().into_iter().map(|note| note.text)).collect()))
}

fn object(file: &str, checked: Result<Sizes, Failure>) -> Value {
    match checked {
        Ok(([coordinates, constraints, rank], notes)) => json!({
            "scene": file, "completed": true, "error": null, "notes": notes,
            "coordinates": coordinates, "constraints": constraints, "constraint_rank": rank, "dof": coordinates - rank,
        }),
        Err((error, _)) => json!({ "scene": file, "completed": false, "error": error }),
    }
}
