//! `mbs doctor SCENE`.

use crate::{STOPPED, files, refuse};
use clap::Args;
use mbs::core::scene::{Entry, Scene};
use mbs::doctor::{Checkup, Effort, Severity, examine, report, to_json};
use mbs::scene_file::{Document, Report};
use mbs::{Overrides, Precision, Settings};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const STATUS: &str = "\
Findings are notes, doubts and faults, each with its place in the scene and what would mend it; see docs/DOCTOR.md.
Exit status: 0 no fault (doubts are told and run), 1 scene or usage refused, 2 a fault: no start, or the run stops.";

/// Arguments of `mbs doctor`.
#[derive(Debug, Args)]
#[command(after_help = STATUS)]
pub(crate) struct Arguments {
    /// Scene file (TOML).
    scene: PathBuf,
    /// One JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
    /// Directory for doctor.json and doctor.html; made if missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Formulation of the run that is watched; like the options below: left out, the scene's, else auto.
    #[arg(long, value_name = "F")]
    formulation: Option<String>,
    /// Step of that run [s]; else 0.001.
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    step: Option<f64>,
    /// Duration of that run [s].
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    duration: Option<f64>,
    /// Look at the start only: no run.
    #[arg(long)]
    still: bool,
}

/// Runs the command.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let overrides = Overrides {
        formulation: arguments.formulation.clone(),
        step: arguments.step,
        duration: arguments.duration,
        precision: Some(Precision::F64.name().to_owned()),
        ..Overrides::default()
    };
    let place = (arguments.out.as_deref(), "doctor.json");
    let (document, scene, settings) = match files::begin(&arguments.scene, &overrides, place) {
        Ok(begun) => begun,
        Err(message) => return refuse(&message),
    };
    let mut effort = Effort::default();
    if arguments.still {
        effort.positions = 0;
    }
    let checkup = examine(&scene, &settings, &effort);
    tell((&scene, &document), &checkup, arguments, &settings)
}

/// Files, then JSON or text; the exit status says whether there is a fault.
fn tell(
    (scene, document): (&Scene<f64>, &Document),
    checkup: &Checkup,
    arguments: &Arguments,
    settings: &Settings,
) -> ExitCode {
    let options = [
        ("formulation", arguments.formulation.clone()),
        ("step", arguments.step.map(|x| x.to_string())),
        ("duration", arguments.duration.map(|x| x.to_string())),
    ];
    let command = if arguments.still { "doctor --still" } else { "doctor" };
    let provenance = files::provenance((command, &arguments.scene), &options, settings);
    let line = |entry: Entry, key: &str| Some(document.place(entry, key).line);
    let (page, mut text) = report(scene, checkup, &line, provenance);
    let object = to_json(checkup, &line).to_string();
    if let Some(out) = &arguments.out
        && let Err(error) = write_files(&object, &page, out)
    {
        return refuse(&files::unwritable(out, &error));
    }
    if arguments.json {
        text = object;
    } else if let Some(out) = &arguments.out {
        text.push_str(&format!("\nwrote doctor.json and doctor.html to {}\n", out.display()));
    }
    // A reader that has gone away is no error of the command.
    let _ = writeln!(std::io::stdout(), "{}", text.trim_end());
    match checkup.worst() {
        Some(Severity::Fault) => ExitCode::from(STOPPED),
        _ => ExitCode::SUCCESS,
    }
}

fn write_files(object: &str, page: &Report, out: &Path) -> std::io::Result<()> {
    std::fs::write(out.join("doctor.json"), format!("{object}\n"))?;
    std::fs::write(out.join("doctor.html"), page.page())
}
