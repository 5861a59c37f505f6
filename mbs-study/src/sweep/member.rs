//! Run of one member of a sweep: from the varied scene to its row.

use core::time::Duration;
use cpu_time::ThreadTime;
use mbs::inside::PreparedRun;
use mbs::results::ResultTable;
use mbs::{Error as _, Mechanism, Method, Outcome, Precision, Run, SimulationError, Watchers};
use mbs_scene::{SceneFile, SceneSweep};

/// Row of the results of a member.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Index of the member, from 0.
    pub member: usize,
    /// Decimal texts of the varied numbers.
    pub values: Vec<String>,
    /// Code and message of a run that was not completed.
    pub failure: Option<(String, String)>,
    /// Measured values; `None` if the run did not start.
    pub measured: Option<MemberValues>,
    /// CPU time of the member, from reading the scene to the last step [s].
    pub cpu_seconds: f64,
}

/// Numbers of a run that started.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberValues {
    /// Time that the run reached [s].
    pub end_time: f64,
    /// Number of steps of the run.
    pub steps: u64,
    /// Largest error of the energy invariant [J].
    pub energy: f64,
    /// Largest violation of the constraints: positions, velocities, accelerations.
    pub violation: [f64; 3],
    /// Last, smallest and largest value of each component of each channel, over the rows of the run.
    pub outputs: Vec<[f64; 3]>,
}

impl Row {
    /// Makes the row of a member that did not start.
    #[doc(hidden)]
    #[must_use]
    pub fn failed(member: usize, values: Vec<String>, code: &str, message: &str) -> Self {
        let failure = Some((code.to_owned(), message.to_owned()));
        Self { member, values, failure, measured: None, cpu_seconds: 0.0 }
    }
}

/// Runs a member of a sweep.
pub(super) fn run(scene: &SceneFile, sweep: &SceneSweep, overrides: &Method, member: usize) -> Row {
    let cpu = ThreadTime::try_now();
    let document = sweep.member(scene, member);
    let values = sweep.values(member).map(str::to_owned).collect();
    let row = run_in(document, overrides, member, values);
    let cpu = cpu.and_then(|cpu| cpu.try_elapsed()).unwrap_or(Duration::ZERO);
    Row { cpu_seconds: cpu.as_secs_f64(), ..row }
}

/// Runs a member again and returns its rows; `None` if it does not start.
pub(super) fn rows(
    scene: &SceneFile,
    sweep: &SceneSweep,
    overrides: &Method,
    member: usize,
) -> Option<ResultTable> {
    let outcome = outcome(sweep.member(scene, member), overrides, false).ok()?;
    ResultTable::of_outcome(&outcome).ok()
}

/// Returns the outcome of a member's run, or code and message of its error.
fn outcome(
    document: SceneFile,
    method: &Method,
    last_row_alone: bool,
) -> Result<Outcome, (&'static str, String)> {
    let refused = |error: SimulationError| (error.code(), error.message().to_owned());
    let mechanism = Mechanism::of_file(document).map_err(|error| refused(error.into()))?;
    let options = Run { method: method.clone(), last_row_alone, ..Run::new() };
    let run = PreparedRun::new(&mechanism, &options).map_err(refused)?;
    if run.settings.precision == Precision::DoubleDouble {
        return Err(("settings-refused", "sweeps run in f64 or f32".to_owned()));
    }
    let read = run.read().map_err(refused)?;
    run.run_by(&read, &run.settings, &mut Watchers::default()).map_err(refused)
}

fn run_in(document: SceneFile, overrides: &Method, member: usize, values: Vec<String>) -> Row {
    let outcome = match outcome(document, overrides, true) {
        Ok(outcome) => outcome,
        Err((code, message)) => return Row::failed(member, values, code, &message),
    };
    let summary = &outcome.summary;
    let failure = summary.error.as_ref().map(|error| (error.code.clone(), error.message.clone()));
    let measured = measured(&outcome);
    Row { member, values, failure, measured, cpu_seconds: 0.0 }
}

fn measured(outcome: &Outcome) -> Option<MemberValues> {
    let summary = &outcome.summary;
    let (_, last) = outcome.rows().last()?;
    let ranges = outcome.ranges().iter();
    let violation = &summary.violation;
    Some(MemberValues {
        end_time: summary.end_time,
        steps: summary.steps,
        energy: summary.energy.max_error,
        violation: [violation.position, violation.velocity, violation.acceleration],
        outputs: last.iter().zip(ranges).map(|(&x, &[least, most])| [x, least, most]).collect(),
    })
}
