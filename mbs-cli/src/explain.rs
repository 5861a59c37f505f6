//! `mbs explain SCENE`.

use crate::{STOPPED, files, refuse};
use clap::Args;
use mbs::auto::{Goal, Processor, plan, time};
use mbs::explain::{Effort, explain_document, report};
use mbs::scene_file::{Explanation, Report};
use mbs::{Overrides, Settings, words};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `mbs explain`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Scene file (TOML).
    pub(crate) scene: PathBuf,
    /// Formulation; like the options below: left out, the scene's, else auto.
    #[arg(long, value_name = "F")]
    formulation: Option<String>,
    /// Step [s]; else 0.001.
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    step: Option<f64>,
    /// Duration [s].
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    duration: Option<f64>,
    /// Wanted error, as in `mbs run`: runs the pilot of the choice and tells what each candidate would cost.
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    error: Option<f64>,
    /// Deadline, as in `mbs run`.
    #[arg(long, value_name = "S", value_parser = time, allow_hyphen_values = true)]
    deadline: Option<f64>,
    /// Directory for explain.json and explain.html; made if missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// One JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
    /// f32, f64; left out: f64.
    #[arg(long, value_name = "P")]
    pub(crate) precision: Option<String>,
    /// Integrator; left out, the scene's, else trapezoidal.
    #[arg(long, value_name = "I")]
    integrator: Option<String>,
}

/// Runs the command.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let overrides = Overrides {
        formulation: arguments.formulation.clone(),
        integrator: arguments.integrator.clone(),
        precision: arguments.precision.clone(),
        step: arguments.step,
        duration: arguments.duration,
        ..Overrides::default()
    };
    let place = (arguments.out.as_deref(), "explain.json");
    let (document, scene, settings) = match files::begin(&arguments.scene, &overrides, place) {
        Ok(begun) => begun,
        Err(message) => return refuse(&message),
    };
    let goal = Goal { error: arguments.error, deadline: arguments.deadline };
    let chosen = (&overrides, settings.clone());
    let plan = plan((&document, &scene), chosen, goal, &mut Processor::new(settings.threads));
    let measured = match plan {
        Ok(plan) => plan.first().choice.clone(),
        Err(error) => return refuse(&error.render()),
    };
    let explained = explain_document((&document, &scene), &settings, &Effort::default());
    let mut explanation = match explained {
        Ok(Some(explanation)) => explanation,
        Ok(None) => return refuse(crate::NO_PAIRS),
        Err(error) => return refuse(&error.render()),
    };
    if let Some(choice) = measured {
        explanation.choice = Some(*choice);
    }
    tell(&explanation, arguments, &settings)
}

/// Files, then JSON or tables; the exit status says whether the run with all effects was completed.
fn tell(explanation: &Explanation, arguments: &Arguments, settings: &Settings) -> ExitCode {
    let options = [
        ("formulation", arguments.formulation.clone()),
        ("step", arguments.step.map(|x| x.to_string())),
        ("duration", arguments.duration.map(|x| x.to_string())),
        ("precision", arguments.precision.clone()),
        ("integrator", arguments.integrator.clone()),
        ("error", arguments.error.map(|x| x.to_string())),
        ("deadline", arguments.deadline.map(|x| x.to_string())),
    ];
    let provenance = files::provenance(("explain", &arguments.scene), &options, settings);
    let report = report(explanation, provenance);
    if let Some(out) = &arguments.out
        && let Err(error) = write_files(explanation, &report, out)
    {
        return refuse(&files::unwritable(out, &error));
    }
    let mut text = if arguments.json { explanation.to_json() } else { report.text() };
    if let (Some(out), false) = (&arguments.out, arguments.json) {
        text.push_str(&format!("\nwrote explain.json and explain.html to {}\n", out.display()));
    }
    // A reader that has gone away is no error of the command.
    let _ = writeln!(std::io::stdout(), "{}", text.trim_end());
    let Some(error) = &explanation.error else { return ExitCode::SUCCESS };
    if !arguments.json {
        let place = words::stopped_at(error);
        let scene = arguments.scene.display();
        eprintln!("{scene}: stopped {place}: {}\nhint: {}", error.message, error.hint);
    }
    ExitCode::from(STOPPED)
}

fn write_files(explanation: &Explanation, report: &Report, out: &Path) -> std::io::Result<()> {
    std::fs::write(out.join("explain.json"), explanation.to_json() + "\n")?;
    std::fs::write(out.join("explain.html"), report.page())
}
