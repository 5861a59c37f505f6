//! A whole run: from a scene to its summary, rows and page.

mod kept;
mod outcome;
mod paced;
mod summary;

pub(crate) use paced::{Rung, Track, paced};

use crate::alarm::Alarm;
use crate::channels::Channels;
use crate::checkpoint::{Checkpoint, CheckpointError, Identity, Keeping};
use crate::digits::is_finer;
use crate::figure::Figure;
use crate::friction::Frictions;
use crate::names::Names;
use crate::recorder::{Keep, Recorder, StepMark};
use crate::settings::{Lengths, Settings};
use crate::simulation::Simulation;
use crate::stop::StopError;
use crate::words::{few_threads, limit_name, notes, stop_text, summary_rows};
use core::time::Duration;
use kept::{Clock, Kept};
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::outputs::Contacts;
use mbs_core::scene::Scene;
use mbs_scene::{
    Channel, ControlSummary, Outputs, RealtimeSummary, RunRecord, RunSummary, StepRow,
};
use std::time::Instant;
use summary::{contact, energy_summary, not_started, plain_summary};

pub use outcome::Outcome;

/// Roundings of the time at the end that are nothing.
const LAST_ROUNDINGS: f64 = 32.0;

/// Called now and then with the time reached; does nothing by default.
pub trait Progress {
    /// Time reached [s].
    fn reached(&mut self, t: f64) {
        let _ = t;
    }
}

impl Progress for () {}

/// Runs a checked scene to its end, or to where it stops.
pub fn run<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    progress: &mut impl Progress,
) -> Outcome {
    run_keeping::<T, D>(scene, settings, progress, Keep::Rows)
}

/// [`run`], with all rows and pictures, or with the last row and no picture.
pub(crate) fn run_keeping<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    progress: &mut impl Progress,
    keep: Keep,
) -> Outcome {
    match Run::<T, D>::begin(scene, settings, keep) {
        Ok(run) => run.complete(progress),
        Err(outcome) => *outcome,
    }
}

/// [`run`], from a checkpoint if there is one, and kept while it goes if it is to be.
///
/// # Errors
/// [`CheckpointError`] for a checkpoint of something else.
pub fn run_kept<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    progress: &mut impl Progress,
    (from, keeping): (Option<&Checkpoint>, Option<&mut Keeping>),
) -> Result<Outcome, CheckpointError> {
    let identity = Identity::new(scene, settings);
    let mut run = match Run::<T, D>::begin(scene, settings, Keep::Rows) {
        Ok(run) => run,
        Err(outcome) => return Ok(*outcome),
    };
    if let Some(checkpoint) = from {
        run.resume(checkpoint, &identity)?;
    }
    run.kept = keeping.map(|keeping| Kept { keeping, identity });
    run.keep(run.done);
    Ok(run.complete(progress))
}

#[derive(Debug, Default)]
struct Counts {
    steps: u64,
    iterations: u64,
    factorizations: u64,
    worst: Duration,
    control: ControlSummary,
}

struct Run<'a, T: Real, const D: usize> {
    scene: &'a Scene<T>,
    settings: &'a Settings,
    lengths: Lengths<T>,
    simulation: Simulation<T, D>,
    measures: Channels<T, D>,
    contacts: Contacts<T, D>,
    recorder: Recorder,
    figure: Figure<T, D>,
    values: Vec<T>,
    /// What the last step left behind.
    mark: StepMark,
    counts: Counts,
    /// Time reached [s].
    reached: f64,
    alarm: Alarm,
    frictions: Frictions<T, D>,
    /// Steps of the record's count that are made.
    done: u64,
    clock: Clock,
    kept: Option<Kept<'a>>,
    /// Of a paced run: how it kept up, and the lowest level since the last row where there is a ladder.
    realtime: Option<RealtimeSummary>,
    level: Option<f64>,
}

impl<'a, T: Real, const D: usize> Run<'a, T, D> {
    /// Builds everything and takes the first row; else the outcome of a run that does not start.
    fn begin(
        scene: &'a Scene<T>,
        settings: &'a Settings,
        keep: Keep,
    ) -> Result<Self, Box<Outcome>> {
        let rows = (settings.n_steps(), keep);
        Self::new(scene, settings, Channel::of_scene(scene), rows)?.started()
    }

    /// Everything that a run needs, for rows after so many steps or intervals; else how it did not start.
    fn new(
        scene: &'a Scene<T>,
        settings: &'a Settings,
        channels: Vec<Channel>,
        (n_rows, keep): (u64, Keep),
    ) -> Result<Self, Box<Outcome>> {
        let started = Simulation::<T, D>::new(scene, settings);
        let started = started.and_then(|simulation| {
            let measures = Channels::new(scene, simulation.model())?;
            let contacts = Contacts::new(scene, simulation.model());
            Ok((simulation, measures, contacts.map_err(|e| StopError::Start(e.into()))?))
        });
        let (simulation, measures, contacts) = match started {
            Ok(all) => all,
            Err(error) => return Err(Box::new(not_started(scene, settings, &channels, error))),
        };
        let recorder = Recorder::new(channels, n_rows, simulation.invariant().initial(), keep);
        let figure = Figure::new(scene, simulation.model(), settings.duration);
        let frictions = Frictions::new(scene, settings, simulation.model());
        let threads = simulation.threads();
        Ok(Self {
            scene,
            settings,
            lengths: settings.lengths(scene),
            simulation,
            measures,
            contacts,
            recorder,
            figure,
            values: Vec::new(),
            mark: StepMark::default(),
            counts: Counts::default(),
            reached: 0.0,
            alarm: Alarm::new(settings.energy_alarm),
            frictions,
            done: 0,
            clock: Clock::new(threads),
            kept: None,
            realtime: None,
            level: None,
        })
    }

    /// All steps that are left, to the end or to where the run stops.
    fn complete(mut self, progress: &mut impl Progress) -> Outcome {
        self.clock.begin();
        let error = if self.simulation.is_controlled() {
            self.controlled_steps(progress).err()
        } else {
            self.steps(self.settings.n_steps(), progress).err()
        };
        let cpu = self.clock.get();
        self.finish(cpu, error)
    }

    /// The run with its first row; else the outcome of one that does not start.
    fn started(mut self) -> Result<Self, Box<Outcome>> {
        match self.start() {
            Ok(()) => Ok(self),
            Err(error) => {
                let channels = &self.recorder.channels;
                Err(Box::new(not_started(self.scene, self.settings, channels, error)))
            }
        }
    }

    fn start(&mut self) -> Result<(), StopError> {
        let n = self.recorder.channels.iter().map(|c| c.components.len()).sum();
        self.values = vec![T::ZERO; n];
        let violation = self.simulation.start.residual.map(Real::to_f64);
        let energies = self.simulation.initial_energies();
        let mark = StepMark { energies, violation, ..StepMark::default() };
        self.recorder.mark(&mark);
        self.contacts.start(self.simulation.state());
        self.row(&mark, false)
    }

    /// Records a row, or no row where an output is not finite.
    fn row(&mut self, mark: &StepMark, is_last: bool) -> Result<(), StopError> {
        let state = self.simulation.state();
        let n = self.values.len() - usize::from(self.level.is_some());
        let (values, level) = self.values.split_at_mut(n);
        self.measures.write(state, values)?;
        if let ([level], Some(lowest)) = (level, &mut self.level) {
            *level = T::from_f64(core::mem::take(lowest));
        }
        if self.recorder.keeps_all() {
            self.figure.offer(mark.t, &state.q, is_last);
        }
        self.recorder.keep(mark, &self.values);
        Ok(())
    }

    /// Steps of fixed length, or intervals over which an explicit method controls its own.
    fn steps(&mut self, n_steps: u64, progress: &mut impl Progress) -> Result<(), StopError> {
        let (h, end) = (self.settings.step_max, self.settings.duration);
        let Lengths { step_max, duration, .. } = self.lengths;
        let mut clock = Instant::now();
        for k in self.done + 1..=n_steps {
            let (from, to) =
                (multiple(T::ZERO, k - 1, (step_max, h)), multiple(T::ZERO, k, (step_max, h)));
            let is_last = k == n_steps;
            #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
            let (before, count) = ((k - 1) as f64 * h, k as f64);
            let is_full = !is_last || (end - before - h).abs() <= 1e-9 * h * count;
            let dt = if is_full { step_max } else { duration - from };
            self.step(dt, Some(if is_last { duration } else { to }), &mut clock)?;
            self.finish_step((k, is_last), progress)?;
            if !is_last && self.keep(k) {
                clock = Instant::now();
            }
            self.heed(is_last)?;
        }
        Ok(())
    }

    /// Steps of controlled length, to the end.
    fn controlled_steps(&mut self, progress: &mut impl Progress) -> Result<(), StopError> {
        let end = self.lengths.duration;
        let mut clock = Instant::now();
        let mut k = self.done;
        let mut is_last = false;
        while !is_last {
            is_last = self.step(end - self.simulation.state().t, None, &mut clock)?;
            // What is left may be less than the clock can tell.
            let left = end - self.simulation.state().t;
            is_last |= left <= end * T::EPSILON * T::from_f64(LAST_ROUNDINGS);
            if is_last {
                self.simulation.set_time(end);
                self.reached = self.settings.duration;
                self.recorder.end_at(self.reached);
                self.mark.t = self.reached;
            }
            k += 1;
            self.finish_step((k, is_last), progress)?;
            if !is_last && self.keep(k) {
                clock = Instant::now();
            }
            self.heed(is_last)?;
        }
        Ok(())
    }

    /// Ends the run between two steps where it is asked to.
    fn heed(&mut self, is_last: bool) -> Result<(), StopError> {
        if is_last || !self.settings.interrupt.is_set() {
            return Ok(());
        }
        self.keep_now();
        self.stop(StopError::Interrupted)
    }

    /// One step of at most `rest` [s], with its counts; the time at its end is known where steps are fixed. Says
    /// whether it took the whole.
    fn step(&mut self, rest: T, to: Option<T>, clock: &mut Instant) -> Result<bool, StopError> {
        let accepted = match self.simulation.advance(rest) {
            Ok(accepted) => accepted,
            Err(error) => {
                let stop = self.simulation.explain(error);
                return self.stop(stop).map(|()| true);
            }
        };
        if let Some(to) = to {
            self.simulation.set_time(to);
        }
        self.made(&accepted, clock)?;
        Ok(accepted.is_last)
    }

    /// Takes a step that was made since the `clock`.
    fn made(&mut self, accepted: &Accepted<T>, clock: &mut Instant) -> Result<(), StopError> {
        let taken = self.take(accepted);
        let now = Instant::now();
        self.counts.worst = self.counts.worst.max(now - *clock);
        *clock = now;
        taken.or_else(|stop| self.stop(stop))
    }

    /// A row where one is due, and the alarm.
    fn finish_step(
        &mut self,
        (k, is_last): (u64, bool),
        progress: &mut impl Progress,
    ) -> Result<(), StopError> {
        let mut recorded = Ok(());
        if self.recorder.keeps(k) || is_last {
            let mark = self.mark.clone();
            recorded = self.row(&mark, is_last);
            progress.reached(mark.t);
        }
        // energy that is lost says more than an output that is not finite for it
        let passed = self.frictions.passed(&self.simulation);
        match self.alarm.rings_for(&self.simulation, is_last, passed) {
            Some(stop) => self.stop(stop),
            None => recorded,
        }
    }

    /// Keeps the state at which the run stops.
    fn stop(&mut self, stop: StopError) -> Result<(), StopError> {
        let t = self.reached;
        if self.recorder.last_time().is_none_or(|last| last < t) {
            let energies = self.simulation.invariant().energies();
            // a row that cannot be recorded is no other reason to stop
            let _ = self.row(&StepMark { t, energies, ..StepMark::default() }, true);
        }
        Err(stop)
    }

    /// Counts and maxima of a step.
    fn take(&mut self, accepted: &Accepted<T>) -> Result<(), StopError> {
        let report = &accepted.attempt.report;
        let t = self.simulation.state().t.to_f64();
        self.counts.steps += u64::from(report.steps);
        self.reached = t;
        self.counts.iterations += u64::from(report.iterations);
        self.counts.factorizations += u64::from(report.factorizations);
        let tracked = self.measures.track(&self.simulation);
        self.contacts.watch(self.simulation.state());
        let index = self.simulation.index().map(|(index, _)| index);
        let is_controlled = self.simulation.is_controlled();
        self.mark = StepMark {
            t,
            energies: accepted.attempt.energies,
            violation: report.violation.map(Real::to_f64),
            step: StepRow {
                length: accepted.step.to_f64(),
                index,
                iterations: report.iterations,
                rejected: accepted.rejected,
                energy_change: accepted.change,
                penalty_energy: report.penalty_energy.to_f64(),
                error_estimate: self.settings.rule.has_error().then_some(accepted.attempt.error),
                limit: is_controlled.then(|| limit_name(accepted.limit)),
            },
        };
        self.recorder.mark(&self.mark);
        self.counts.control.take(&self.mark.step);
        tracked
    }

    fn finish(self, cpu: Duration, error: Option<StopError>) -> Outcome {
        let end_time = self.reached;
        let cpu_seconds = cpu.as_secs_f64();
        let [coordinates, constraints, constraint_rank] = self.simulation.sizes();
        let settings = self.settings;
        let index_changes = self.simulation.index().map_or(0, |(_, changes)| u64::from(changes));
        let control =
            ControlSummary { rule: settings.rule.name(), index_changes, ..self.counts.control };
        let summary = RunSummary {
            steps: self.counts.steps,
            completed: error.is_none(),
            error: error.as_ref().map(|e| e.report(end_time, &Names::new(self.scene))),
            end_time,
            cpu_seconds,
            real_time_factor: if cpu_seconds > 0.0 { end_time / cpu_seconds } else { 0.0 },
            worst_step_seconds: self.counts.worst.as_secs_f64(),
            iterations: self.counts.iterations,
            factorizations: self.counts.factorizations,
            energy: energy_summary(self.simulation.invariant()),
            control: self.simulation.is_controlled().then(|| control.clone()),
            violation: self.recorder.violation_summary(),
            realtime: self.realtime,
            outputs: Outputs(self.recorder.last()),
            digits: self.recorder.last_long().map(Outputs),
            coordinates,
            constraints,
            constraint_rank,
            dof: coordinates - constraint_rank,
            not_unique: self.measures.not_unique(self.scene),
            contacts: self.contacts.instants().iter().map(|i| contact(self.scene, i)).collect(),
            contacts_left_out: self.contacts.left_out(),
            ..plain_summary(self.scene, settings)
        };
        let steps = self.recorder.step_series(0, control);
        let change = self.simulation.start.change.to_f64();
        let mut notes = notes(self.scene, settings, &summary, change);
        notes.extend(few_threads(settings.threads, self.simulation.threads()));
        let record = RunRecord {
            scene: self.scene.name.clone(),
            channels: self.recorder.series(),
            animation: Some(self.figure.animation),
            energy: Some(self.recorder.energy()),
            violation: Some(self.recorder.violation()),
            iterations: Some(self.recorder.iterations()),
            steps: self.simulation.is_controlled().then(|| steps.clone()),
            summary: summary_rows(&summary),
            notes,
            error: summary.error.as_ref().map(stop_text),
            choice: settings.choice.as_ref().map(|choice| choice.table()).unwrap_or_default(),
            ..RunRecord::default()
        };
        let long_table = self.recorder.long_table().collect();
        let table = self.recorder.table().map(|(t, row)| (t, row.to_vec())).collect();
        let channels = self.recorder.channels.clone();
        let ranges = self.recorder.ranges().to_vec();
        Outcome { summary, error, record, channels, table, long_table, ranges, steps }
    }
}

/// Time t + k h [s]: in `f64` where that has as many digits, so that short numbers make no short times.
pub(crate) fn multiple<T: Real>(t: T, k: u64, (step, in_f64): (T, f64)) -> T {
    #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
    let count = k as f64;
    if is_finer::<T>() {
        t + T::from_f64(count) * step
    } else {
        T::from_f64(t.to_f64() + count * in_f64)
    }
}
