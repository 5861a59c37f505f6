//! Command `mbs export SCENE`: a scene as constant tables for a controller.

use crate::refusal::Refusal;
use crate::scene::{CheckedScene, SceneArgument};
use crate::{files, input};
use clap::Args;
use mbs::export::{ExportError, export, ladder};
use mbs::{Method, Precision, ResolvedMethod};
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `mbs export`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) scene: SceneArgument,
    /// Rust file to write: constant tables, and a solver of exactly their size.
    #[arg(long, value_name = "FILE", required_unless_present = "binary")]
    rust: Option<PathBuf>,
    /// Binary file to write, which mbs-nostd reads without allocation.
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
    /// Precision: f32 or f64. Default: f64.
    #[arg(long, value_name = "P")]
    pub(crate) precision: Option<String>,
    /// JSON of `mbs explain`: the solver may leave out its effects when time runs out, smallest change first. Default: none.
    #[arg(long, value_name = "JSON")]
    ladder: Option<PathBuf>,
}

/// Runs the command `mbs export`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match written(arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(refusal) => refusal.report(),
    }
}

fn written(arguments: &Arguments) -> Result<(), Refusal> {
    let CheckedScene { document, scene } = arguments.scene.read()?;
    let overrides = Method {
        formulation: Some("recursive".to_owned()),
        integrator: Some("trapezoidal".to_owned()),
        precision: arguments.precision.clone(),
        ..Method::default()
    };
    let settings = ResolvedMethod::new(&scene, &overrides);
    let settings = settings.map_err(|error| files::refusal(&error, &document))?;
    let rungs = match &arguments.ladder {
        None => Vec::new(),
        Some(path) => {
            let bytes = input::read(path, "JSON of `mbs explain`")?;
            ladder(&String::from_utf8_lossy(&bytes), &scene).map_err(|error| refusal(&error))?
        }
    };
    let form = (&rungs[..], settings.precision == Precision::F32);
    let exported = export(&scene, &settings, form).map_err(|error| refusal(&error))?;
    for (path, bytes) in
        [(&arguments.rust, exported.rust.as_bytes()), (&arguments.binary, &exported.bytes)]
    {
        if let Some(path) = path {
            files::write(path, bytes, Some(&arguments.scene))?;
        }
    }
    Ok(())
}

fn refusal(error: &ExportError) -> Refusal {
    let hint = match error {
        ExportError::Stop(_) => {
            "`mbs run SCENE --formulation recursive` says more: controllers step in relative coordinates"
        }
        ExportError::Sum(_) => {
            "let it act on a joint with one coordinate, or on a length over `points`"
        }
        ExportError::Effect(_) | ExportError::Relation(_) => {
            "leave user-defined laws out: a table cannot hold code"
        }
        ExportError::Signal(_) => {
            "make it a step, a table without `hold` and `periodic`, or an `input`"
        }
        ExportError::Measure(_) => {
            "measure coordinates of joints, or make it an `input` that the controller sets"
        }
        ExportError::Guide(_) => {
            "let a chain of joints with one coordinate each, all guided, turn the body"
        }
        ExportError::Ladder(_) => {
            "make the list of effect costs from this scene: `mbs explain SCENE --json`"
        }
    };
    Refusal::new("export-refused", error, hint)
}
