//! Command `mbs run SCENE`: simulation of a scene.

use crate::bar::{bar, ticks};
use crate::files::Begun;
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
use mbs::realtime::Pacing;
use mbs::record::{Provenance, RunError};
use mbs::scene_file::SceneFile;
use mbs::scene_file::format::significant;
use mbs::{
    CHECKPOINT, Method, Outcome, Precision, ResolvedMethod, StopError, run_document_kept, words,
};
use mbs_study::auto::{Clock, Goal, Plan, PlanError, Processor, plan, run_plan, time};
use mbs_study::estimate::estimate;
use mbs_study::remedy::name_what_runs;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options that go with one method alone: a run that may fall back on another has none of them.
const NOT_CHOSEN: [&str; 3] = ["checkpoint", "resume", "realtime"];

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
    #[arg(long, value_name = "E", allow_hyphen_values = true, conflicts_with_all = NOT_CHOSEN)]
    error: Option<f64>,
    /// Deadline of a frame [s, or 1ms, 500us]. Default: none.
    ///
    /// The run is made in frames of this length. Each is computed within this time, also where its steps are slowest.
    ///
    /// The error is then the smallest that fits; with --error, the cost is the smallest that reaches the error.
    #[arg(long, value_name = "S", value_parser = time, allow_hyphen_values = true, conflicts_with_all = NOT_CHOSEN)]
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

    fn goal(&self) -> Goal {
        Goal { error: self.error, deadline: self.deadline }
    }
}

/// Runs the command `mbs run`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    if arguments.show.watch {
        let inputs: Vec<_> = arguments.inputs.as_deref().into_iter().collect();
        return show::watch(&arguments.scene, &inputs, arguments.out.as_deref());
    }
    let mut clock = Processor::new(arguments.method.given.threads.unwrap_or(1));
    match begin(arguments) {
        Ok(begun) => go(arguments, begun, &mut clock),
        Err(Stop::Refused(refusal)) => refusal.report(),
        Err(Stop::Unbuilt(precision)) => unbuilt(precision),
    }
}

/// Why a run does not begin.
enum Stop {
    Refused(Box<Refusal>),
    /// Precision of the checkpoint to resume from, which this build lacks.
    Unbuilt(Precision),
}

impl From<Refusal> for Stop {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(Box::new(refusal))
    }
}

/// A run that may begin.
struct Run {
    begun: Begun,
    plan: Plan,
    overrides: Method,
    pacing: Option<Pacing>,
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

/// Reads what is run, and what it resumes from, and chooses where a target is given; else the refusal.
fn begin(arguments: &Arguments) -> Result<Run, Stop> {
    let out = arguments.show.out(arguments.out.as_deref());
    let pacing = arguments.realtime.pacing()?;
    let mut kept = arguments.keep.begin(out)?;
    let mut overrides = kept.overrides(arguments.method.given.clone())?;
    overrides.interrupt = signals::heeded();
    // Of a scene that is not there that is said.
    if let Some(missing) = named(&overrides.precision).filter(|p| !p.is_built())
        && arguments.scene.is_there()
    {
        return Err(Stop::Unbuilt(missing));
    }
    let mut begun = files::begin(&arguments.scene, &overrides, (out, &FILES))?;
    begun.settings = kept.settle(begun.settings)?;
    if let Some(table) = &arguments.inputs {
        (begun.document, begun.scene) = files::with_inputs(&begun.document, table)?;
    }
    arguments.keep.keep(out, &mut kept)?;
    let clock = &mut Processor::new(begun.settings.threads);
    let chosen = (&overrides, begun.settings.clone());
    let plan = plan((&begun.document, &begun.scene), chosen, arguments.goal(), clock);
    if arguments.goal().is_some() && overrides.interrupt.is_set() {
        let hint = "the choice was not made, and nothing was run; start it again";
        return Err(Refusal::interrupted("interrupted by a signal", hint).into());
    }
    let plan = plan.map_err(|error| unplanned(&error))?;
    Ok(Run { begun, plan, overrides, pacing, kept })
}

/// The refusal of a goal.
pub(crate) fn unplanned(error: &PlanError) -> Refusal {
    match error {
        PlanError::Goal(error) => Refusal::new("goal-refused", error, error.hint()),
        PlanError::Read(error) => Refusal::scene(error),
        other => Refusal::new("goal-refused", other.render(), ""),
    }
}

fn go(arguments: &Arguments, mut run: Run, clock: &mut dyn Clock) -> ExitCode {
    match outcome(arguments, &mut run, clock) {
        Ok((outcome, settings)) => report(&outcome, arguments, (&run, &settings)),
        Err(refusal) => refusal.report(),
    }
}

/// Runs it, at the pace of a clock or as fast as it can, and reports with what settings; else the refusal.
fn outcome(
    arguments: &Arguments,
    run: &mut Run,
    clock: &mut dyn Clock,
) -> Result<(Outcome, ResolvedMethod), Refusal> {
    let Run { begun, plan, overrides, pacing, kept } = run;
    let (document, scene) = (&begun.document, &begun.scene);
    let settings = plan.first();
    if let Some(pacing) = pacing {
        let run = realtime::run((document, scene), settings, pacing);
        return run.map(|outcome| (outcome, settings.clone()));
    }
    let mut bar = Bar::new(settings.duration, arguments.json);
    let mut reached = |t| bar.reached(t);
    if settings.choice.is_some() {
        let run = run_plan((document, scene), plan, &mut reached);
        bar.bar.finish_and_clear();
        return run.map_err(|error| Refusal::scene(&error));
    }
    let parts = (kept.from.as_ref(), kept.writer.as_mut());
    let outcome = run_document_kept((document, scene), settings, &mut reached, parts);
    bar.bar.finish_and_clear();
    match outcome {
        Ok(Ok(mut outcome)) => {
            if !arguments.no_estimate {
                estimate(scene, settings, &mut outcome, clock);
                name_what_runs(scene, (overrides, settings), &mut outcome);
            }
            Ok((outcome, settings.clone()))
        }
        Ok(Err(error)) => Err(Refusal::checkpoint(&error)),
        Err(error) => Err(Refusal::scene(&error)),
    }
}

/// Files, then JSON or table; the exit status says whether the run was completed, and whether its results are where they should be.
fn report(
    outcome: &Outcome,
    arguments: &Arguments,
    (run, settings): (&Run, &ResolvedMethod),
) -> ExitCode {
    let error = outcome.error.as_ref();
    let mut status = if error.is_some() { ExitCode::from(STOPPED) } else { ExitCode::SUCCESS };
    let mut object = outcome.summary.to_json();
    let mut written = None;
    if let Some(folder) = &run.begun.folder {
        if outcome.summary.steps == 0 && folder.path().join("run.json").exists() {
            let out = folder.path().display();
            warn(&format!("note: no step was made: the results that are in `{out}` stay there"));
        } else {
            let provenance = arguments.provenance(&run.overrides, settings);
            let id = files::results_id(&run.begun.document, settings);
            let provenance =
                Provenance { step: words::steps(&outcome.summary.method_used), ..provenance };
            let whole = write_files(outcome, folder, (provenance, &id), arguments.units);
            if let Some(whole) = Refusal::unless_lost(whole, &mut status) {
                (object, written) = (whole, Some(folder.path()));
                run.kept.end(matches!(error, Some(StopError::Interrupted)));
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
        let text = report.map(|report| stopped("stopped", report, error, &run.begun.document));
        warn(&text.unwrap_or_default());
    }
    status
}

/// The error of a run that stopped, with the place in the scene that it is about.
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
    // A key that is not written has the place of its entry's header.
    let header = document.place(entry, "");
    let places = error.fields().iter().map(|field| document.place(entry, field));
    let (file, place) = places.into_iter().find(|place| *place != header).unwrap_or(header);
    place.render(file, &message, &report.hint)
}

/// Replaces the files of the directory; gives the JSON object as it is there.
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

/// A progress bar on a terminal, nothing elsewhere.
struct Bar {
    bar: ProgressBar,
    duration: f64,
}

/// Ticks of the whole progress bar.
const TICKS: u64 = 1000;

impl Bar {
    fn new(duration: f64, is_quiet: bool) -> Self {
        Self { bar: bar(TICKS, is_quiet, "{wide_bar} {percent:>3} %  {msg}  {eta} left"), duration }
    }

    fn reached(&mut self, t: f64) {
        let ticks = ticks(t / self.duration, TICKS);
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
