//! Complete run: from a scene to its summary, its rows and its page.

mod checkpoint;
mod clock;
mod outcome;
mod paced;
mod record;
mod summary;

pub use paced::{PacedLevel, PacedSchedule, paced};

use crate::checkpoint::{Checkpoint, CheckpointError, Identity};
use crate::driver::{StepObserver, Stretch, drive, multiple};
use crate::kept::CheckpointWriter;
use crate::names::Names;
use crate::record::{Channel, ControlSummary, Outputs, RunRecord, RunSummary};
use crate::recorder::RecordRows;
use crate::settings::length::SAME_LENGTH;
use crate::settings::{Lengths, ResolvedMethod};
use crate::simulation::Simulation;
use crate::stop::StopError;
use crate::words::{few_threads, notes, stop_text, summary_rows};
use core::time::Duration;
use mbs_core::once::found;
use mbs_core::scene::Scene;
use mbs_core::{Real, instances};
pub use record::Columns;
use record::{Record, RunCheckpoints};
use summary::{contact, energy_summary, method_used, not_started, plain_summary};

pub use outcome::Outcome;

/// Runs a checked scene until its end or until it stops, and calls an observer at each step. `&mut ()` is an observer that does nothing.
pub fn run<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    observer: &mut dyn StepObserver<T, D>,
) -> Outcome {
    if T::HAS_INSTANCES {
        return found::<RunHere<T, D>>(RUN)(scene, settings, observer);
    }
    run_here(scene, settings, observer)
}

type RunHere<T, const D: usize> =
    fn(&Scene<T>, &ResolvedMethod, &mut dyn StepObserver<T, D>) -> Outcome;
instances!(RUN: RunHere<T, D> = run_here::<T, D>);

fn run_here<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    observer: &mut dyn StepObserver<T, D>,
) -> Outcome {
    match Run::<T, D>::begin(scene, settings, (RecordRows::All, None)) {
        Ok(run) => run.complete(observer),
        Err(outcome) => *outcome,
    }
}

/// Options of a recorded run: rows, columns and checkpoints.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct Recording<'a, T: Real, const D: usize> {
    /// Rows that stay in memory.
    pub keep: RecordRows,
    /// Columns in addition to the scene's outputs.
    pub columns: Option<&'a mut dyn Columns<T, D>>,
    /// Checkpoint to resume from.
    pub from: Option<&'a Checkpoint>,
    /// Writer that saves checkpoints of the run.
    pub writer: Option<&'a mut CheckpointWriter>,
}

impl<T: Real, const D: usize> Default for Recording<'_, T, D> {
    fn default() -> Self {
        Self { keep: RecordRows::All, columns: None, from: None, writer: None }
    }
}

/// [`run`] with a start from a checkpoint and with saved checkpoints, both optional.
///
/// # Errors
/// [`CheckpointError`] if the checkpoint belongs to another scene or other settings.
pub fn run_recorded<'a, T: Real, const D: usize>(
    scene: &'a Scene<T>,
    settings: &'a ResolvedMethod,
    observer: &mut dyn StepObserver<T, D>,
    recording: Recording<'a, T, D>,
) -> Result<Outcome, CheckpointError> {
    let Recording { keep, columns, from, writer } = recording;
    let mut run = match Run::<T, D>::begin(scene, settings, (keep, columns)) {
        Ok(run) => run,
        Err(outcome) => return Ok(*outcome),
    };
    if from.is_some() || writer.is_some() {
        let identity = Identity::new(scene, settings);
        if let Some(checkpoint) = from {
            run.resume(checkpoint, &identity)?;
        }
        run.record.checkpoints = writer.map(|writer| RunCheckpoints { writer, identity });
        let Run { simulation, record } = &mut run;
        record.keep(simulation, record.done);
    }
    Ok(run.complete(observer))
}

/// Stretch for step `k` of a run, counted from 1. It is a step of fixed length, or an interval in which the step size is controlled. The
/// last stretch ends with the run.
pub fn step<T: Real>(settings: &ResolvedMethod, lengths: &Lengths<T>, k: u64) -> Stretch<T> {
    let (h, end) = (settings.step_max, settings.duration);
    let &Lengths { step_max, duration, .. } = lengths;
    let at = |k| multiple((T::ZERO, 0.0), k, (step_max, h));
    let is_last = k == settings.n_steps();
    #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
    let (before, count) = ((k - 1) as f64 * h, k as f64);
    let is_full = !is_last || (end - before - h).abs() <= SAME_LENGTH * h * count;
    let dt = if is_full { step_max } else { duration - at(k - 1) };
    let to = if is_last { duration } else { at(k) };
    Stretch { is_last, ..Stretch::to(to).in_one(Some(dt)) }
}

/// A simulation and the record of its run.
struct Run<'a, T: Real, const D: usize> {
    simulation: Simulation<T, D>,
    record: Record<'a, T, D>,
}

impl<'a, T: Real, const D: usize> Run<'a, T, D> {
    /// Builds the simulation and records the first row. If the run cannot start, the error is its outcome.
    fn begin(
        scene: &'a Scene<T>,
        settings: &'a ResolvedMethod,
        (keep, columns): (RecordRows, Option<&'a mut dyn Columns<T, D>>),
    ) -> Result<Self, Box<Outcome>> {
        let mut channels = Channel::of_scene(scene);
        channels.extend(columns.iter().flat_map(|columns| columns.channels()));
        let mut run = Self::new(scene, settings, channels, (settings.n_steps(), keep))?;
        run.record.others = columns;
        run.started()
    }

    /// Builds the simulation and its record. `rows` has the number of steps or intervals, each with one row. If the run cannot start, the
    /// error is its outcome.
    fn new(
        scene: &'a Scene<T>,
        settings: &'a ResolvedMethod,
        channels: Vec<Channel>,
        rows: (u64, RecordRows),
    ) -> Result<Self, Box<Outcome>> {
        let simulation = Simulation::<T, D>::new(scene, settings);
        let started = simulation.and_then(|simulation| {
            let record = Record::new((scene, settings), &simulation, channels.clone(), rows)?;
            Ok(Self { simulation, record })
        });
        started.map_err(|error| Box::new(not_started(scene, settings, &channels, error)))
    }

    /// Records the first row. If the run cannot start, the error is its outcome.
    fn started(mut self) -> Result<Self, Box<Outcome>> {
        match self.record.start(&self.simulation) {
            Ok(()) => Ok(self),
            Err(error) => {
                let Record { scene, settings, recorder, .. } = &self.record;
                Err(Box::new(not_started(scene, settings, &recorder.channels, error)))
            }
        }
    }

    /// Makes all remaining steps, until the end or until the run stops.
    fn complete(mut self, observer: &mut dyn StepObserver<T, D>) -> Outcome {
        let Self { simulation, record } = &mut self;
        let (settings, lengths, done) = (record.settings, record.lengths, record.done);
        let end = lengths.duration;
        let is_controlled = simulation.is_controlled();
        let whole = is_controlled.then(|| Stretch { is_last: true, ..Stretch::to(end) });
        let n = if is_controlled { 0 } else { settings.n_steps() };
        let stretches = (done + 1..=n).map(|k| step(settings, &lengths, k)).chain(whole);
        record.begin();
        let mut both = (&mut *record, observer);
        let error = drive(simulation, stretches, &settings.interrupt, &mut both).err();
        let cpu = self.record.cpu();
        self.finish(cpu, error)
    }

    fn finish(self, cpu: Duration, error: Option<StopError>) -> Outcome {
        let Self { simulation, record: run } = self;
        let end_time = run.reached;
        let cpu_seconds = cpu.as_secs_f64();
        let [coordinates, constraints, constraint_rank] = simulation.sizes();
        let settings = run.settings;
        let index_changes = simulation.index().map_or(0, |(_, changes)| u64::from(changes));
        let control =
            ControlSummary { rule: settings.rule.name(), index_changes, ..run.counts.control };
        let summary = RunSummary {
            method_used: method_used(settings, &run.counts, end_time),
            steps: run.counts.steps,
            completed: error.is_none(),
            error: error.as_ref().map(|e| e.report(end_time, &Names::new(run.scene))),
            end_time,
            cpu_seconds,
            real_time_factor: if cpu_seconds > 0.0 { end_time / cpu_seconds } else { 0.0 },
            worst_step_seconds: run.counts.worst.as_secs_f64(),
            iterations: run.counts.iterations,
            factorizations: run.counts.factorizations,
            energy: energy_summary(simulation.invariant()),
            control: simulation.is_controlled().then(|| control.clone()),
            violation: run.recorder.violation_summary(),
            realtime: run.realtime,
            outputs: Outputs(run.recorder.last()),
            channels: run.recorder.summaries(),
            digits: run.recorder.last_long().map(Outputs),
            coordinates,
            constraints,
            constraint_rank,
            dof: coordinates - constraint_rank,
            not_unique: run.measures.not_unique(run.scene),
            contacts: run.contacts.instants().iter().map(|i| contact(run.scene, i)).collect(),
            contacts_left_out: run.contacts.left_out(),
            ..plain_summary(run.scene, settings)
        };
        let steps = run.recorder.step_series(0, control);
        let motion = run.motion.finish(run.scene);
        let start = (simulation.start.change.to_f64(), motion.most_moved(run.scene));
        let mut notes = notes(run.scene, settings, &summary, start);
        notes.extend([run.limits.notes(run.scene), run.one_way.notes(run.scene)].concat());
        notes.extend(few_threads(settings.threads, simulation.threads()));
        let record = RunRecord {
            scene: run.scene.name.clone(),
            channels: run.recorder.series(),
            motion: Some(motion),
            energy: Some(run.recorder.energy()),
            violation: Some(run.recorder.violation()),
            iterations: Some(run.recorder.iterations()),
            steps: simulation.is_controlled().then(|| steps.clone()),
            summary: summary_rows(&summary),
            notes,
            error: summary.error.as_ref().map(stop_text),
            choice: settings.choice.as_ref().map(|choice| choice.table()).unwrap_or_default(),
            ..RunRecord::default()
        };
        let long_table = run.recorder.long_table().collect();
        let table = run.recorder.table().map(|(t, row)| (t, row.to_vec())).collect();
        let channels = run.recorder.channels.clone();
        let ranges = run.recorder.ranges();
        Outcome { summary, error, record, channels, table, long_table, ranges, steps }
    }
}
