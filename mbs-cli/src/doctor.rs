//! Command `mbs doctor SCENE`: faults and doubts of a scene, with remedies.

use crate::method::{MethodArguments, OfDoctor};
use crate::refusal::Refusal;
use crate::say::say;
use crate::scene::SceneArgument;
use crate::status::STOPPED;
use crate::{files, method, signals};
use clap::Args;
use mbs::core::scene::Entry;
use mbs::record::{Provenance, RecordedMotion};
use mbs::{Method, Precision, Run};
use mbs_report::diagnosis;
use mbs_study::doctor::{Checkup, Effort, Severity, examine, to_json};
use std::path::PathBuf;
use std::process::ExitCode;

const STATUS: &str = "\
A finding is a note, a doubt or a fault, with its place in the scene and a remedy; see docs/DOCTOR.md.
Exit status:
  0  no fault; doubts are reported, and the scene runs
  1  the scene or the usage was refused
  2  a fault: the scene does not start, or its run stops";

/// Arguments of `mbs doctor`.
#[derive(Debug, Args)]
#[command(after_help = STATUS)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
    /// Directory for doctor.json and doctor.html; created if missing. Default: no files.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    method: MethodArguments<OfDoctor>,
    /// Examine the start only, without a run.
    #[arg(long)]
    still: bool,
}

/// Runs the command `mbs doctor`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let overrides = Method {
        precision: Some(Precision::F64.name().to_owned()),
        interrupt: signals::heeded(),
        ..arguments.method.given.clone()
    };
    let place = (arguments.out.as_deref(), &["doctor.json", "doctor.html"][..]);
    let begun = match files::begin(&arguments.scene, &overrides, place) {
        Ok(begun) => begun,
        Err(refusal) => return refusal.report(),
    };
    let mut effort = Effort::default();
    if arguments.still {
        effort.positions = 0;
    }
    let checkup = examine(&begun.scene, &begun.settings, &effort)
        .with_unused_parameters(&begun.document.unused_parameters());
    if overrides.interrupt.is_set() {
        return Refusal::interrupted("interrupted by a signal", "start it again").report();
    }
    let motion = at_start(&begun, overrides);
    write_results(&begun, (&checkup, motion), arguments)
}

/// The scene at its start, for the page: a run of one step. `None` if no page is written.
fn at_start(begun: &files::Begun, given: Method) -> Option<RecordedMotion> {
    begun.folder.as_ref()?;
    let duration = Some(begun.settings.step);
    let result = mbs::run(&begun.mechanism, &Run::new().method(Method { duration, ..given }));
    result.ok()?.outcome().record(Provenance::default()).motion
}

/// Writes the files, then prints JSON or text. The exit status says whether there is a fault.
fn write_results(
    begun: &files::Begun,
    (checkup, motion): (&Checkup, Option<RecordedMotion>),
    arguments: &Arguments,
) -> ExitCode {
    let files::Begun { document, scene, settings, .. } = begun;
    let options = method::written(&arguments.method.given);
    let command = if arguments.still { "doctor --still" } else { "doctor" };
    let provenance = files::provenance((command, &arguments.scene), &options, settings);
    let line = |entry: Entry, key: &str| {
        let (file, place) = document.place(entry, key);
        Some(((file != document.file()).then(|| file.to_owned()), place.line))
    };
    let (report, text) = diagnosis(scene, checkup, &line, (motion, provenance));
    let mut status = match checkup.worst() {
        Some(Severity::Fault) => ExitCode::from(STOPPED),
        _ => ExitCode::SUCCESS,
    };
    let whole = (to_json(checkup, &line).to_string(), &report);
    let (object, wrote) = files::write_report(begun, "doctor", whole, &mut status);
    say(&if arguments.json { object } else { text + &wrote }, status)
}
