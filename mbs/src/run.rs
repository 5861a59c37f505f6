//! A whole run: from a scene to its summary, rows and page.

use crate::alarm::Alarm;
use crate::channels::Channels;
use crate::digits::is_finer;
use crate::figure::Figure;
use crate::recorder::{Keep, Recorder, StepMark};
use crate::settings::{Lengths, Settings};
use crate::simulation::Simulation;
use crate::stop::{Names, StopError};
use crate::tree::{InSpace, Plane};
use crate::words::{limit_name, notes, stop_text, summary_rows};
use core::time::Duration;
use cpu_time::ProcessTime;
use mbs_core::Real;
use mbs_core::control::{Accepted, Invariant};
use mbs_core::outputs::{self, Contacts};
use mbs_core::real::DoubleDouble;
use mbs_core::scene::{EffectKind, Scene};
use mbs_scene::{
    Channel, Contact, ControlSummary, CsvWriter, EnergySummary, Outputs, Provenance, RunRecord,
    RunSummary, StepRow, StepSeries,
};
use std::io;
use std::time::Instant;

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

/// What a run gives.
#[derive(Debug)]
pub struct Outcome {
    /// The JSON object.
    pub summary: RunSummary,
    /// Why it stopped early.
    pub error: Option<StopError>,
    record: RunRecord,
    channels: Vec<Channel>,
    table: Vec<(f64, Vec<f64>)>,
    /// The same numbers with all their digits, where there are more than those of `f64`.
    long_table: Vec<Vec<DoubleDouble>>,
    ranges: Vec<[f64; 2]>,
    steps: StepSeries,
}

impl Outcome {
    /// Writes the rows as CSV.
    ///
    /// # Errors
    /// Those of the sink.
    pub fn write_csv(&self, sink: impl io::Write) -> io::Result<()> {
        let mut csv = CsvWriter::new(sink, &self.channels)?;
        for (i, (t, row)) in self.table.iter().enumerate() {
            match self.long_table.get(i) {
                Some(row) => csv.long_row(*t, row)?,
                None => csv.row(*t, row)?,
            }
        }
        csv.finish()
    }

    /// Writes the steps as CSV: their lengths, and what came of them.
    ///
    /// # Errors
    /// Those of the sink.
    pub fn write_steps(&self, sink: impl io::Write) -> io::Result<()> {
        mbs_scene::write_steps(sink, &self.steps)
    }

    /// The steps of the rows.
    #[must_use]
    pub fn steps(&self) -> &StepSeries {
        &self.steps
    }

    /// The page, with how the run was made.
    #[must_use]
    pub fn page(&self, provenance: Provenance) -> String {
        let record = RunRecord { provenance, ..self.record.clone() };
        mbs_scene::page(&record)
    }

    /// The rows: time and all components of all channels.
    #[must_use]
    pub fn rows(&self) -> &[(f64, Vec<f64>)] {
        &self.table
    }

    /// Least and largest value of each component of each channel, over the rows; empty when the run did not start.
    #[must_use]
    pub fn ranges(&self) -> &[[f64; 2]] {
        &self.ranges
    }

    /// What the user should know.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.record.notes
    }
}

/// Runs a checked scene to its end, or to where it stops.
pub fn run<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    progress: &mut impl Progress,
) -> Outcome
where
    Plane<D>: InSpace<T>,
{
    run_keeping(scene, settings, progress, Keep::Rows)
}

/// [`run`], with all rows and pictures, or with the last row and no picture.
pub(crate) fn run_keeping<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    progress: &mut impl Progress,
    keep: Keep,
) -> Outcome
where
    Plane<D>: InSpace<T>,
{
    let names = Names::new(scene);
    let channels = Channel::of_scene(scene);
    let started = Simulation::<T, D>::new(scene, settings);
    let started = started.and_then(|simulation| {
        let measures = Channels::new(scene, simulation.model())?;
        let contacts = Contacts::new(scene, simulation.model());
        Ok((simulation, measures, contacts.map_err(|e| StopError::Start(e.into()))?))
    });
    let (simulation, measures, contacts) = match started {
        Ok(both) => both,
        Err(error) => return not_started(scene, settings, &channels, &names, error),
    };
    let n_steps = settings.n_steps();
    let recorder = Recorder::new(channels, n_steps, simulation.invariant().initial(), keep);
    let figure = Figure::new(scene, simulation.model(), settings.duration);
    let mut run = Run {
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
    };
    run.start();
    let cpu = ProcessTime::now();
    let error = if run.simulation.is_controlled() {
        run.controlled_steps(progress).err()
    } else {
        run.steps(n_steps, progress).err()
    };
    let cpu = cpu.elapsed();
    run.finish(cpu, error, &names)
}

#[derive(Debug, Default)]
struct Counts {
    steps: u64,
    iterations: u64,
    factorizations: u64,
    worst: Duration,
    control: ControlSummary,
}

struct Run<'a, T: Real, const D: usize>
where
    Plane<D>: InSpace<T>,
{
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
}

impl<T: Real, const D: usize> Run<'_, T, D>
where
    Plane<D>: InSpace<T>,
{
    /// The first row.
    fn start(&mut self) {
        let n = self.recorder.channels.iter().map(|c| c.components.len()).sum();
        self.values = vec![T::ZERO; n];
        let violation = self.simulation.start.residual.map(Real::to_f64);
        let energies = self.simulation.initial_energies();
        let mark = StepMark { energies, violation, ..StepMark::default() };
        self.recorder.mark(&mark);
        self.contacts.start(self.simulation.state());
        self.row(&mark, false);
    }

    fn row(&mut self, mark: &StepMark, is_last: bool) {
        let state = self.simulation.state();
        self.measures.write(state, &mut self.values);
        if self.recorder.keeps_all() {
            self.figure.offer(mark.t, &state.q, is_last);
        }
        self.recorder.keep(mark, &self.values);
    }

    /// Steps of fixed length, or intervals over which an explicit method controls its own.
    fn steps(&mut self, n_steps: u64, progress: &mut impl Progress) -> Result<(), StopError> {
        let (h, end) = (self.settings.step_max, self.settings.duration);
        let Lengths { step_max, duration, .. } = self.lengths;
        let mut clock = Instant::now();
        for k in 1..=n_steps {
            let (from, to) = (multiple(k - 1, (step_max, h)), multiple(k, (step_max, h)));
            let is_last = k == n_steps;
            #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
            let (before, count) = ((k - 1) as f64 * h, k as f64);
            let is_full = !is_last || (end - before - h).abs() <= 1e-9 * h * count;
            let dt = if is_full { step_max } else { duration - from };
            self.step(dt, Some(if is_last { duration } else { to }), &mut clock)?;
            self.finish_step((k, is_last), progress)?;
        }
        Ok(())
    }

    /// Steps of controlled length, to the end.
    fn controlled_steps(&mut self, progress: &mut impl Progress) -> Result<(), StopError> {
        let end = self.lengths.duration;
        let mut clock = Instant::now();
        let mut k = 0;
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
        }
        Ok(())
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
        self.take(&accepted);
        let now = Instant::now();
        self.counts.worst = self.counts.worst.max(now - *clock);
        *clock = now;
        Ok(accepted.is_last)
    }

    /// A row where one is due, and the alarm.
    fn finish_step(
        &mut self,
        (k, is_last): (u64, bool),
        progress: &mut impl Progress,
    ) -> Result<(), StopError> {
        if self.recorder.keeps(k) || is_last {
            let mark = self.mark.clone();
            self.row(&mark, is_last);
            progress.reached(mark.t);
        }
        match self.alarm.rings(&self.simulation, is_last) {
            Some(stop) => self.stop(stop),
            None => Ok(()),
        }
    }

    /// Keeps the state at which the run stops.
    fn stop(&mut self, stop: StopError) -> Result<(), StopError> {
        let t = self.reached;
        if self.recorder.last_time().is_none_or(|last| last < t) {
            let energies = self.simulation.invariant().energies();
            self.row(&StepMark { t, energies, ..StepMark::default() }, true);
        }
        Err(stop)
    }

    /// Counts and maxima of a step.
    fn take(&mut self, accepted: &Accepted<T>) {
        let report = &accepted.attempt.report;
        let t = self.simulation.state().t.to_f64();
        self.counts.steps += u64::from(report.steps);
        self.reached = t;
        self.counts.iterations += u64::from(report.iterations);
        self.counts.factorizations += u64::from(report.factorizations);
        self.measures.track(self.simulation.state());
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
    }

    fn finish(self, cpu: Duration, error: Option<StopError>, names: &Names) -> Outcome {
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
            error: error.as_ref().map(|e| e.report(end_time, names)),
            end_time,
            cpu_seconds,
            real_time_factor: if cpu_seconds > 0.0 { end_time / cpu_seconds } else { 0.0 },
            worst_step_seconds: self.counts.worst.as_secs_f64(),
            iterations: self.counts.iterations,
            factorizations: self.counts.factorizations,
            energy: energy_summary(self.simulation.invariant()),
            control: self.simulation.is_controlled().then(|| control.clone()),
            violation: self.recorder.violation_summary(),
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
        let steps = self.recorder.step_series(control);
        let record = RunRecord {
            scene: self.scene.name.clone(),
            channels: self.recorder.series(),
            animation: Some(self.figure.animation),
            energy: Some(self.recorder.energy()),
            violation: Some(self.recorder.violation()),
            iterations: Some(self.recorder.iterations()),
            steps: self.simulation.is_controlled().then(|| steps.clone()),
            summary: summary_rows(&summary),
            notes: notes(self.scene, settings, &summary, self.simulation.start.change.to_f64()),
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

/// Time k h [s]: in `f64` where that has as many digits, so that short numbers make no short times.
fn multiple<T: Real>(k: u64, (step, in_f64): (T, f64)) -> T {
    #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
    let count = k as f64;
    if is_finer::<T>() { T::from_f64(count) * step } else { T::from_f64(count * in_f64) }
}

/// An instant with the effect's name.
fn contact<T: Real>(scene: &Scene<T>, instant: &outputs::Instant) -> Contact {
    let effect = &scene.effects[instant.effect];
    let is_limit = matches!(effect.kind, EffectKind::Limit { .. });
    Contact {
        time: instant.t,
        effect: effect.name.clone(),
        end: is_limit.then_some(["lower", "upper"][instant.end]),
        event: if instant.makes { "made" } else { "broken" },
    }
}

/// The invariant over every step.
fn energy_summary(invariant: &Invariant) -> EnergySummary {
    EnergySummary {
        initial: invariant.initial(),
        max_error: invariant.max_error(),
        final_error: invariant.error().abs(),
        turned_over: invariant.turned_over(),
        scatter: invariant.scatter(),
        drift: invariant.drift(),
    }
}

fn plain_summary<T: Real>(scene: &Scene<T>, settings: &Settings) -> RunSummary {
    RunSummary {
        scene: scene.name.clone(),
        formulation: settings.asked.clone(),
        precision: settings.precision.name().to_owned(),
        dimension: scene.dimension.count(),
        step: settings.step,
        chosen: settings.chosen(),
        ..RunSummary::default()
    }
}

fn not_started<T: Real>(
    scene: &Scene<T>,
    settings: &Settings,
    channels: &[Channel],
    names: &Names,
    error: StopError,
) -> Outcome {
    let summary =
        RunSummary { error: Some(error.report(0.0, names)), ..plain_summary(scene, settings) };
    let record = RunRecord {
        scene: scene.name.clone(),
        summary: summary_rows(&summary),
        error: summary.error.as_ref().map(stop_text),
        ..RunRecord::default()
    };
    Outcome {
        summary,
        error: Some(error),
        record,
        channels: channels.to_vec(),
        table: Vec::new(),
        long_table: Vec::new(),
        ranges: Vec::new(),
        steps: StepSeries::default(),
    }
}
