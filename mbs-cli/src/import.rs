//! Command `mbs import FILE`, and models in place of scene files.

use crate::files;
use crate::input;
use crate::model::{self, ModelOptions, first_line};
use crate::refusal::Refusal;
use crate::say::{say, warn};
use crate::status::REFUSED;
use clap::Args;
use mbs::models::{FindingKind, ImportOptions, Imported, ModelFinding, import, is_model};
use mbs::scene_file::ReadError;
use mbs::scene_file::format::counted;
use mbs::{Error as _, SimulationError};
use mbs_study::doctor::Finding;
use mbs_study::imported::{StartFault, start_faults, to_json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const STATUS: &str = "\
Examples:
  mbs import robot.urdf -o robot.toml     the scene, and what is not in it
  mbs run robot.urdf --import base=free   every command takes such a file where it takes a scene
Exit status:
  0  imported; faults that the doctor finds in its start are listed
  1  refused; with --strict, also when something that can act is not in the scene as the file has it";

/// Arguments of `mbs import`.
#[derive(Debug, Args)]
#[command(after_help = STATUS)]
pub(crate) struct Arguments {
    /// Model: URDF, MJCF or SDF. - for standard input.
    file: PathBuf,
    /// Scene file that is written. Default: standard output, and the report on standard error.
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    model: ModelOptions,
    /// Refuse a model of which something that can act is approximated or ignored.
    #[arg(long)]
    strict: bool,
    /// Print what became of the elements as one JSON object on standard output.
    #[arg(long)]
    json: bool,
}

/// Runs the command `mbs import`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match imported(arguments) {
        Ok(status) => status,
        Err(refusal) => refusal.report(),
    }
}

fn imported(arguments: &Arguments) -> Result<ExitCode, Refusal> {
    let name = input::name(&arguments.file);
    let bytes = input::read(&arguments.file, "model")?;
    if !is_model(&bytes) {
        let message = format!("`{name}` is no XML");
        let hint =
            "give a model: URDF, MJCF or SDF; a scene needs no import, run it: mbs run SCENE";
        return Err(Refusal::new("model-refused", message, hint));
    }
    let refused = |error| Refusal::read("model-refused", &error);
    let home = arguments.file.parent().unwrap_or(Path::new(""));
    let folder = arguments.out.as_deref().and_then(Path::parent);
    let options = ImportOptions {
        // text on standard output counts as a file of the working directory, so that relative paths are valid there
        scene_folder: Some(folder.unwrap_or(Path::new("")).to_owned()),
        ..model::options(&arguments.model, home)?
    };
    let model = import(&bytes, &name, &options).map_err(refused)?;
    let faults = faults(&name, &model)?;
    let is_lost = arguments.strict && model.findings.iter().any(acts);
    let out = arguments.out.as_deref().filter(|_| !is_lost);
    let place = out.map_or_else(|| format!("scene of {name}"), |out| out.display().to_string());
    let report =
        report(&name, &model) + &fault_lines(&faults, &place, out.unwrap_or(&arguments.file));
    let (said, report) = match (&arguments.out, arguments.json) {
        (_, true) => (to_json(&name, &model, faults.as_deref()).to_string(), String::new()),
        (Some(_), false) => (report, String::new()),
        (None, false) => (model.text.clone(), report),
    };
    if let Some(out) = out {
        files::write(out, model.text.as_bytes(), Some(&arguments.file))?;
    }
    if !report.is_empty() {
        warn(&report);
    }
    if is_lost {
        let hint = "leave out --strict, or mend the file at the places above";
        let refusal =
            Refusal::new("model-refused", format!("--strict: `{name}` is not whole"), hint);
        warn(&refusal.text());
        return Ok(say(&said, ExitCode::from(REFUSED)));
    }
    Ok(say(&said, ExitCode::SUCCESS))
}

/// Faults of the scene's start; `None` if the start was not checked.
type Faults = Option<Vec<StartFault>>;

fn faults(name: &str, model: &Imported) -> Result<Faults, Refusal> {
    let refused = |error: SimulationError| match error.cause::<ReadError>() {
        Some(error) => Refusal::read("scene-refused", error),
        None => Refusal::new("settings-refused", &error, error.hint().unwrap_or_default()),
    };
    start_faults(name, model).map_err(refused)
}

/// Lines of the report on faults. `place` names the scene in them, and `file` is the argument for the doctor.
fn fault_lines(faults: &Faults, place: &str, file: &Path) -> String {
    let text = |StartFault { finding, line }: &StartFault| {
        let Finding { code, message, remedy, .. } = finding;
        let line = line.map(|line| format!(":{line}")).unwrap_or_default();
        format!("{:<13} {place}{line}  {code}: {message}; {remedy}\n", "fault")
    };
    match faults {
        Some(found) => found.iter().map(text).collect(),
        None => {
            let file = file.display();
            format!("{:<13} {place}  its start was not looked at: mbs doctor {file}\n", "large")
        }
    }
}

/// True if a finding concerns a part that may act on the motion, and the part is approximated or ignored.
fn acts(finding: &ModelFinding) -> bool {
    matches!(finding.kind, FindingKind::Approximated | FindingKind::Ignored)
}

fn is_for_the_eye(finding: &ModelFinding) -> bool {
    finding.kind == FindingKind::Appearance
}

/// The report for people.
fn report(name: &str, model: &Imported) -> String {
    let mut text = first_line(name, model) + "\n";
    for finding in model.findings.iter().filter(|finding| !is_for_the_eye(finding)) {
        let ModelFinding { kind, file, line, column, element, says } = finding;
        text += &format!("{:<13} {file}:{line}:{column}  {element}: {says}\n", word(*kind));
    }
    for (says, n) in for_the_eye(model) {
        let says = if says.is_empty() { String::new() } else { format!(": {says}") };
        text += &format!("{:<13} {}{says}\n", word(FindingKind::Appearance), counted(n, "element"));
    }
    text
}

/// Returns the texts of findings that concern only the appearance, each with its number of elements.
fn for_the_eye(model: &Imported) -> Vec<(&str, usize)> {
    let mut list: Vec<(&str, usize)> = Vec::new();
    let found = model.findings.iter().filter(|finding| is_for_the_eye(finding));
    for ModelFinding { says, .. } in found {
        match list.iter_mut().find(|(known, _)| known == says) {
            Some((_, n)) => *n += 1,
            None => list.push((says, 1)),
        }
    }
    list
}

const fn word(kind: FindingKind) -> &'static str {
    match kind {
        FindingKind::Approximated => "approximated",
        FindingKind::Ignored => "ignored",
        FindingKind::Appearance => "for the eye",
        FindingKind::Noted => "noted",
    }
}
