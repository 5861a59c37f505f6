//! A model of another program: options of its conversion, and a one-line description.

use crate::refusal::Refusal;
use clap::{Args, Parser, ValueEnum};
use mbs::models::{BaseKind, FindingKind, ImportOptions, Imported, ModelSizes, Stops};
use mbs::scene_file::format::counted;
use mbs_study::imported::count;
use std::path::{Path, PathBuf};

/// How a model is read; elsewhere they are words of `--import`.
#[derive(Debug, Args)]
pub(crate) struct ModelOptions {
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
    /// An input JOINT.motor for each joint that moves and that no actuator of the file drives; the effort limit of the joint holds.
    #[arg(long)]
    motors: bool,
    /// Meshes whose mass is needed count as massless, and are reported.
    #[arg(long)]
    massless_meshes: bool,
    /// The folder of a package, for links `package://NAME/...`; may be repeated. Default: ROS_PACKAGE_PATH, then upwards from the model.
    #[arg(long, value_name = "NAME=FOLDER")]
    package: Vec<String>,
    /// Refuse included files outside of the folder of the model.
    #[arg(long)]
    no_outside: bool,
}

/// Words of `--base`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BaseWord {
    /// To the ground.
    Fixed,
    /// It moves.
    Free,
}

/// Options of a command line of their own.
#[derive(Debug, Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct OptionLine {
    #[command(flatten)]
    model: ModelOptions,
}

/// The options in the words of `--import`, such as `base=free` for `--base=free`; `None` without words.
pub(crate) fn of_words(words: &[String]) -> Result<Option<ImportOptions>, Refusal> {
    if words.is_empty() {
        return Ok(None);
    }
    let line = OptionLine::try_parse_from(words.iter().map(|word| format!("--{word}")));
    let line = line.map_err(|error| {
        let text = error.render().to_string();
        let message = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
        let hint = "write --import base=free, or another option that mbs import --help lists";
        Refusal::new("usage", format!("--import: {message}"), hint)
    })?;
    options(&line.model, Path::new("")).map(Some)
}

/// The options of a command line, for a model in a folder; otherwise the refusal.
pub(crate) fn options(model: &ModelOptions, folder: &Path) -> Result<ImportOptions, Refusal> {
    let limits = match model.limits.as_deref() {
        None => None,
        Some("") => Some(Stops::ByMass),
        Some(text) => {
            let finite = |x: &str| x.trim().parse().ok().filter(|x: &f64| x.is_finite());
            let numbers: Option<Vec<f64>> = text.split(',').map(finite).collect();
            match numbers.as_deref() {
                Some(&[stiffness, damping]) if stiffness > 0.0 && damping >= 0.0 => {
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
    let base = model.base.map(|base| match base {
        BaseWord::Fixed => BaseKind::Fixed,
        BaseWord::Free => BaseKind::Free,
    });
    Ok(ImportOptions {
        base,
        limits,
        balance: model.balance,
        keep_fixed: model.keep_fixed.clone(),
        key: model.key.clone(),
        no_outside: model.no_outside,
        motors: model.motors,
        massless_meshes: model.massless_meshes,
        packages: model.package.iter().map(|text| package(text)).collect::<Result<_, _>>()?,
        ..ImportOptions::in_folder(folder.to_owned())
    })
}

/// Reads the name and the folder of `NAME=FOLDER`; otherwise returns the refusal.
fn package(text: &str) -> Result<(String, PathBuf), Refusal> {
    let refused = |what: &str| {
        let message = format!("`--package {text}`: {what}");
        Refusal::new("usage", message, "write --package NAME=FOLDER")
    };
    let (name, folder) = text.split_once('=').ok_or_else(|| refused("no `=`"))?;
    if !Path::new(folder).is_dir() {
        return Err(refused("there is no such folder"));
    }
    Ok((name.to_owned(), PathBuf::from(folder)))
}

/// A note on a model that is used in place of a scene file.
pub(crate) fn note(name: &str, model: &Imported) -> String {
    let [approximated, ignored] =
        [FindingKind::Approximated, FindingKind::Ignored].map(|kind| count(model, kind));
    format!(
        "{}; {approximated} approximated, {ignored} ignored: mbs import {name} lists them",
        first_line(name, model)
    )
}

/// Returns a line on the scene of a model: its format, and the numbers of its bodies, joints and other parts.
pub(crate) fn first_line(name: &str, model: &Imported) -> String {
    let ModelSizes { links, bodies, joints, couplings, inputs } = model.sizes;
    let bodies = if bodies == 1 { "1 body".to_owned() } else { format!("{bodies} bodies") };
    format!(
        "{name}: {}, {bodies} of {}, {}, {}, {}",
        model.format.name(),
        counted(links, "link"),
        counted(joints, "joint"),
        counted(couplings, "coupling"),
        counted(inputs, "input"),
    )
}
