//! Command `mbs run SCENE`: simulation of a scene.

use crate::bar::{bar, ticks};
use crate::method::{All, MethodArguments};
use crate::precision::{named, unbuilt};
use crate::refusal::Refusal;
use crate::say::{say, warn};
use crate::scene::SceneArgument;
use crate::status::STOPPED;
use crate::{files, keep, method, realtime, show, signals, table};
use clap::Args;
use indicatif::ProgressBar;
use mbs::folder::{Folder, WriteError};
use mbs::record::{Provenance, RunError};
use mbs::scene_file::SceneFile;
use mbs::scene_file::format::significant;
use mbs::{
    CHECKPOINT, Goal, Method, Outcome, Precision, ResolvedMethod, Run, RunResult, StopError,
    Watchers, words,
};
use mbs_study::auto::time;
use mbs_study::run_with;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `mbs run`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) scene: SceneArgument,
    #[command(flatten)]
    pub(crate) method: MethodArguments<All>,
    /// Table (CSV) that the scene's inputs follow: a first column `t` [s], then columns with names of inputs. Default: they keep their start.
    ///
    /// Values are linear between rows and held outside. A guide or a coupling follows the spline through its values.
    #[arg(long, value_name = "FILE")]
    inputs: Option<PathBuf>,
    /// Directory for run.csv, steps.csv, run.json and run.html, with --realtime also realtime.csv; created if missing. Default: no files.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    show: show::Arguments,
    #[command(flatten)]
    keep: keep::Arguments,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
    /// Show the statistics of all outputs, not of the first 20 rows alone.
    #[arg(long)]
    all: bool,
    /// Write the units as the second line of run.csv.
    #[arg(long, requires = "out")]
    units: bool,
    /// Required error: the largest over the run, relative to each output's range, as in `mbs compare`. Default: none.
    ///
    /// A short pilot measures which formulation, integrator and step reach it in the least time, and reports why.
    ///
    /// --formulation and --integrator narrow the choice.
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    error: Option<f64>,
    /// Deadline of a frame [s, or 1ms, 500us]. Default: none.
    ///
    /// The run is made in frames of this length. Each is computed within this time, also where its steps are slowest.
    ///
    /// The error is then the smallest that fits; with --error, the cost is the smallest that reaches the error.
    #[arg(long, value_name = "S", value_parser = time, allow_hyphen_values = true)]
    deadline: Option<f64>,
    /// Leave out the estimate of the outputs' errors, which takes up to 30 % of the run's time, or 0.1 s.
    ///
    /// After a stop it leaves out the search of a method that runs, too.
    #[arg(long)]
    no_estimate: bool,
    #[command(flatten)]
    realtime: realtime::Arguments,
}

impl Arguments {
    fn provenance(&self, overrides: &Method, settings: &ResolvedMethod) -> Provenance {
        let options = [
            ("inputs", self.inputs.as_ref().map(|file| file.display().to_string())),
            ("error", self.error.map(|x| x.to_string())),
            ("deadline", self.deadline.map(|x| x.to_string())),
        ];
        let others = options.into_iter().chain(self.realtime.options());
        let options: Vec<_> = method::written(overrides).into_iter().chain(others).collect();
        files::provenance(("run", &self.scene), &options, settings)
    }
}

/// Runs the command `mbs run`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    if arguments.show.watch {
        let inputs: Vec<_> = arguments.inputs.as_deref().into_iter().collect();
        return show::watch(&arguments.scene, &inputs, arguments.out.as_deref());
    }
    match begin(arguments).and_then(|begun| go(arguments, begun)) {
        Ok(status) => status,
        Err(Stop::Refused(refusal)) => refusal.report(),
        Err(Stop::Unbuilt(precision)) => unbuilt(precision),
    }
}

/// Reason why a run does not begin.
enum Stop {
    Refused(Box<Refusal>),
    /// Precision of the checkpoint to resume from, if this build lacks it.
    Unbuilt(Precision),
}

impl From<Refusal> for Stop {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(Box::new(refusal))
    }
}

/// Prepared run, with the settings of the command.
struct Begun {
    begun: files::Begun,
    options: Run,
    kept: keep::RunCheckpoints,
}

/// Files of a run.
const FILES: [&str; 8] = [
    "run.csv",
    "steps.csv",
    "run.json",
    "run.html",
    "realtime.csv",
    "choice.json",
    "choice.csv",
    CHECKPOINT,
];

/// Reads the scene and the checkpoint to resume from; otherwise returns the refusal.
fn begin(arguments: &Arguments) -> Result<Begun, Stop> {
    let out = arguments.show.out(arguments.out.as_deref());
    let pacing = arguments.realtime.pacing()?;
    let mut kept = arguments.keep.begin(out)?;
    let mut overrides = kept.overrides(arguments.method.given.clone())?;
    overrides.interrupt = signals::heeded();
    // a missing scene is reported before a missing precision
    if let Some(missing) = named(&overrides.precision).filter(|p| !p.is_built())
        && arguments.scene.is_there()
    {
        return Err(Stop::Unbuilt(missing));
    }
    let begun = files::begin(&arguments.scene, &overrides, (out, &FILES))?;
    let inputs = arguments.inputs.as_deref().map(files::input_table).transpose()?;
    arguments.keep.keep(out, &mut kept)?;
    let options = Run {
        method: overrides,
        goal: Goal { error: arguments.error, deadline: arguments.deadline },
        inputs,
        resume: kept.from.take(),
        checkpoints: kept.into.take(),
        estimate: !arguments.no_estimate && pacing.is_none(),
        pacing,
        last_row_alone: false,
    };
    Ok(Begun { begun, options, kept })
}

/// Makes the run with a progress bar, and reports it; otherwise returns the refusal.
fn go(arguments: &Arguments, run: Begun) -> Result<ExitCode, Stop> {
    let Begun { begun, options, .. } = &run;
    let is_quiet = arguments.json || options.pacing.is_some();
    let mut bar = Bar::new(begun.settings.duration, is_quiet);
    let mut reached = |t| bar.reached(t);
    let result = run_with(&begun.mechanism, options, &mut Watchers::progress(&mut reached));
    bar.bar.finish_and_clear();
    let result = result.map_err(|error| files::refused(&error, &begun.document))?;
    let driven = result.driven_mechanism().and_then(|mechanism| mechanism.to_file().ok());
    Ok(report(&result, arguments, (&run, driven.as_ref().unwrap_or(&begun.document))))
}

/// Writes the files, then prints JSON or a table. The exit status says whether the run was completed and its results were written.
fn report(
    result: &RunResult,
    arguments: &Arguments,
    (run, document): (&Begun, &SceneFile),
) -> ExitCode {
    let (outcome, settings) = (result.outcome(), result.settings());
    let error = outcome.error.as_ref();
    let mut status = if error.is_some() { ExitCode::from(STOPPED) } else { ExitCode::SUCCESS };
    let mut object = outcome.summary.to_json();
    let mut written = None;
    if let Some(folder) = &run.begun.folder {
        if outcome.summary.steps == 0 && folder.path().join("run.json").exists() {
            let out = folder.path().display();
            warn(&format!("note: no step was made: the results that are in `{out}` stay there"));
        } else {
            let provenance = arguments.provenance(&run.options.method, settings);
            let id = files::results_id(document, settings);
            let provenance =
                Provenance { step: words::steps(&outcome.summary.method_used), ..provenance };
            let whole = write_files(outcome, folder, (provenance, &id), arguments.units);
            if let Some(whole) = Refusal::unless_lost(whole, &mut status) {
                (object, written) = (whole, Some(folder.path()));
                let is_interrupted = matches!(error, Some(StopError::Interrupted));
                run.kept.end(result.checkpoints(), is_interrupted);
            }
        }
    }
    let text = if arguments.json { object } else { table::text(outcome, written, arguments.all) };
    let status = say(&text, status);
    if let Some(folder) = written.filter(|_| arguments.show.open) {
        show::open(&folder.join("run.html"));
    }
    if let Some(error) = error.filter(|_| !arguments.json) {
        let report = outcome.summary.error.as_ref();
        let text = report.map(|report| stopped("stopped", report, error, document));
        warn(&text.unwrap_or_default());
    }
    status
}

/// The error of a run that stopped, with its place in the scene file.
pub(crate) fn stopped(
    what: &str,
    report: &RunError,
    error: &mbs::StopError,
    document: &SceneFile,
) -> String {
    let message = format!("{what} {}: {}", words::stopped_at(report), report.message);
    let Some(entry) = error.entry() else {
        return format!("{}: {message}\nhint: {}\n", document.file(), report.hint);
    };
    // a key that the file does not contain gets the place of its entry's header
    let header = document.place(entry, "");
    let places = error.fields().iter().map(|field| document.place(entry, field));
    let (file, place) = places.into_iter().find(|place| *place != header).unwrap_or(header);
    place.render(file, &message, &report.hint)
}

/// Replaces the files of the directory. Returns the JSON object with the id in its file.
fn write_files(
    outcome: &Outcome,
    folder: &Folder,
    (provenance, id): (Provenance, &str),
    has_units: bool,
) -> Result<String, WriteError> {
    let mut part = folder.begin(id)?;
    part.table("run.csv", |sink| match has_units {
        true => outcome.write_csv_with_units(sink),
        false => outcome.write_csv(sink),
    })?;
    part.table("steps.csv", |sink| outcome.write_steps(sink))?;
    realtime::write(&mut part, &outcome.summary)?;
    let chosen = outcome.summary.chosen.as_ref();
    if let Some(choice) = chosen.and_then(|chosen| chosen.evidence.as_ref()) {
        files::write_choice(&mut part, choice)?;
    }
    let record = outcome.record(provenance);
    let page = match &outcome.summary.realtime {
        Some(paced) => mbs_report::paced_page(&record, paced),
        None => mbs_report::page(&record),
    };
    part.page("run.html", &page)?;
    part.finish("run.json", &outcome.summary.to_json())
}

/// A progress bar on a terminal; hidden without a terminal.
struct Bar {
    bar: ProgressBar,
    duration: f64,
}

/// Number of steps of the progress bar.
const TICKS: u64 = 1000;

impl Bar {
    fn new(duration: f64, is_quiet: bool) -> Self {
        Self { bar: bar(TICKS, is_quiet, "{wide_bar} {percent:>3} %  {msg}  {eta} left"), duration }
    }

    fn reached(&mut self, t: f64) {
        let ticks = ticks(t / self.duration, TICKS);
        if ticks >= TICKS {
            return self.bar.finish_and_clear();
        }
        if ticks != self.bar.position() {
            self.bar.set_position(ticks);
            self.bar.set_message(format!(
                "t = {} of {} s",
                words::time(t),
                significant(self.duration)
            ));
        }
    }
}
