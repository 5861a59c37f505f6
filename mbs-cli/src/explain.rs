//! Command `mbs explain SCENE`: effects that a scene simulates, and their measured cost.

use crate::method::{MethodArguments, OfExplain};
use crate::precision::NO_PAIRS;
use crate::refusal::Refusal;
use crate::say::{say, warn};
use crate::scene::SceneArgument;
use crate::status::STOPPED;
use crate::{files, method, signals};
use clap::Args;
use mbs::{Goal, Method, Run, words};
use mbs_study::auto::time;
use mbs_study::explain::Explanation;
use mbs_study::explain::{Effort, explain_run};
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `mbs explain`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) scene: SceneArgument,
    #[command(flatten)]
    pub(crate) method: MethodArguments<OfExplain>,
    /// Required error, as in `mbs run`: runs the pilot and reports what each candidate would cost. Default: none.
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    error: Option<f64>,
    /// Deadline of a frame, as in `mbs run` [s, or 1ms, 500us]. Default: none.
    #[arg(long, value_name = "S", value_parser = time, allow_hyphen_values = true)]
    deadline: Option<f64>,
    /// Directory for explain.json and explain.html; created if missing. Default: no files.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
}

/// Runs the command `mbs explain`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match explain(arguments) {
        Ok((begun, explanation)) => write_results(&begun, &explanation, arguments),
        Err(refusal) => refusal.report(),
    }
}

fn explain(arguments: &Arguments) -> Result<(files::Begun, Explanation), Refusal> {
    let overrides = Method { interrupt: signals::heeded(), ..arguments.method.given.clone() };
    let place = (arguments.out.as_deref(), &["explain.json", "explain.html"][..]);
    let begun = files::begin(&arguments.scene, &overrides, place)?;
    let goal = Goal { error: arguments.error, deadline: arguments.deadline };
    let options = Run::new().method(overrides).goal(goal);
    let explained = explain_run(&begun.mechanism, &options, &Effort::default());
    if options.method.interrupt.is_set() {
        return Err(Refusal::interrupted("interrupted by a signal", "start it again"));
    }
    let explained = explained.map_err(|error| files::refused(&error, &begun.document))?;
    let explanation =
        explained.ok_or_else(|| Refusal::new("settings-refused", NO_PAIRS[0], NO_PAIRS[1]))?;
    Ok((begun, explanation))
}

/// Writes the files, then prints JSON or tables. The exit status says whether the run with all effects was completed.
fn write_results(
    begun: &files::Begun,
    explanation: &Explanation,
    arguments: &Arguments,
) -> ExitCode {
    let goal = [
        ("error", arguments.error.map(|x| x.to_string())),
        ("deadline", arguments.deadline.map(|x| x.to_string())),
    ];
    let options = [&method::written(&arguments.method.given)[..], &goal].concat();
    let provenance = files::provenance(("explain", &arguments.scene), &options, &begun.settings);
    let report = mbs_report::explanation(explanation, provenance);
    let error = explanation.error.as_ref();
    let mut status = if error.is_some() { ExitCode::from(STOPPED) } else { ExitCode::SUCCESS };
    let whole = (explanation.to_json(), &report);
    let (object, wrote) = files::write_report(begun, "explain", whole, &mut status);
    let text = if arguments.json { object } else { report.text() + &wrote };
    let status = say(&text, status);
    if let Some(error) = error.filter(|_| !arguments.json) {
        let place = words::stopped_at(error);
        let scene = arguments.scene.display();
        warn(&format!("{scene}: stopped {place}: {}\nhint: {}", error.message, error.hint));
    }
    status
}
