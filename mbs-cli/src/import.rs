//! `mbs import FILE`, and models where a scene is wanted.

use crate::files;
use crate::input;
use crate::model::{count, first_line};
use crate::refusal::Refusal;
use crate::say::{say, warn};
use crate::status::REFUSED;
use clap::{Args, ValueEnum};
use mbs::models::{
    BaseKind, FindingKind, ImportOptions, Imported, ModelFinding, ModelSizes, Stops, import,
    is_model,
};
use mbs::scene_file::format::counted;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const STATUS: &str = "\
Examples:
  mbs import robot.urdf -o robot.toml     the scene, and what is not in it
  mbs run robot.urdf                      every command takes such a file where it takes a scene
Exit status:
  0  imported
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
    /// Whether the root is fixed to the ground. Default: as the file says, else fixed.
    #[arg(long, value_enum)]
    base: Option<BaseWord>,
    /// Stops at the ends of the joints: stiffness and damping; without numbers, by the mass that they move. Default: the ends do not act.
    #[arg(long, value_name = "K,C", num_args = 0..=1, default_missing_value = "")]
    limits: Option<String>,
    /// Raise the smaller moments of inertias that no body has.
    #[arg(long)]
    balance: bool,
    /// A fixed joint that stays a joint, so that it has a reaction; may be repeated. Default: none.
    #[arg(long, value_name = "NAME")]
    keep_fixed: Vec<String>,
    /// A keyframe of an MJCF from which it starts. Default: as the model is drawn.
    #[arg(long, value_name = "NAME")]
    key: Option<String>,
    /// Meshes whose mass is needed count as massless, and are reported.
    #[arg(long)]
    massless_meshes: bool,
    /// Refuse included files outside of the folder of the model.
    #[arg(long)]
    no_outside: bool,
    /// Refuse a model of which something that can act is approximated or ignored.
    #[arg(long)]
    strict: bool,
    /// Print what became of the elements as one JSON object on standard output.
    #[arg(long)]
    json: bool,
}

/// Words of `--base`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BaseWord {
    /// To the ground.
    Fixed,
    /// It moves.
    Free,
}

/// Runs the command.
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
    let model = import(&bytes, &name, &options(arguments)?).map_err(refused)?;
    let scene = model.scene_file(&name).and_then(|file| file.scene::<f64>());
    scene.map_err(|error| Refusal::read("scene-refused", &error))?;
    let is_lost = arguments.strict && model.findings.iter().any(acts);
    let report = report(&name, &model);
    let (said, report) = match (&arguments.out, arguments.json) {
        (_, true) => (object(&name, &model).to_string(), String::new()),
        (Some(_), false) => (report, String::new()),
        (None, false) => (model.text.clone(), report),
    };
    if let Some(out) = arguments.out.as_deref().filter(|_| !is_lost) {
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

fn options(arguments: &Arguments) -> Result<ImportOptions, Refusal> {
    let limits = match arguments.limits.as_deref() {
        None => None,
        Some("") => Some(Stops::ByMass),
        Some(text) => {
            let numbers: Vec<f64> = text.split(',').filter_map(|x| x.trim().parse().ok()).collect();
            match numbers[..] {
                [stiffness, damping]
                    if stiffness > 0.0 && damping >= 0.0 && stiffness.is_finite() =>
                {
                    Some(Stops::Given { stiffness, damping })
                }
                _ => {
                    let message = format!("`--limits {text}`: no stiffness and damping");
                    return Err(Refusal::new(
                        "usage",
                        message,
                        "write --limits 1e4,10, or --limits alone",
                    ));
                }
            }
        }
    };
    let base = arguments.base.map(|base| match base {
        BaseWord::Fixed => BaseKind::Fixed,
        BaseWord::Free => BaseKind::Free,
    });
    Ok(ImportOptions {
        base,
        limits,
        balance: arguments.balance,
        keep_fixed: arguments.keep_fixed.clone(),
        key: arguments.key.clone(),
        folder: arguments.file.parent().map(Path::to_owned),
        no_outside: arguments.no_outside,
        massless_meshes: arguments.massless_meshes,
    })
}

/// Could it act?
fn acts(finding: &ModelFinding) -> bool {
    finding.kind != FindingKind::Appearance
}

/// The report for people.
fn report(name: &str, model: &Imported) -> String {
    let mut text = first_line(name, model) + "\n";
    for finding in model.findings.iter().filter(|finding| acts(finding)) {
        let ModelFinding { kind, file, line, column, element, says } = finding;
        text += &format!("{:<13} {file}:{line}:{column}  {element}: {says}\n", word(*kind));
    }
    let shown = count(model, FindingKind::Appearance);
    if shown > 0 {
        text += &format!("{:<13} {}\n", "for the eye", counted(shown, "element"));
    }
    text
}

const fn word(kind: FindingKind) -> &'static str {
    match kind {
        FindingKind::Approximated => "approximated",
        FindingKind::Ignored => "ignored",
        FindingKind::Appearance => "appearance",
    }
}

/// The report for programs.
fn object(name: &str, model: &Imported) -> Value {
    let list = |kind| {
        let found = model.findings.iter().filter(|finding| finding.kind == kind);
        let found = found.map(|ModelFinding { file, line, column, element, says, .. }| {
            json!({ "file": file, "line": line, "column": column, "element": element, "says": says })
        });
        found.collect::<Vec<_>>()
    };
    let ModelSizes { links, bodies, joints, couplings, inputs } = model.sizes;
    json!({
        "file": name,
        "format": model.format.name(),
        "mapped": { "links": links, "bodies": bodies, "joints": joints, "couplings": couplings, "inputs": inputs },
        "approximated": list(FindingKind::Approximated),
        "ignored": list(FindingKind::Ignored),
        "appearance": count(model, FindingKind::Appearance),
    })
}
