//! Record of the steps of a run: rows, maxima, counts and contacts. The record also has the alarms that stop the run.

use super::clock::Clock;
use crate::channels::Channels;
use crate::checkpoint::Identity;
use crate::driver::StepObserver;
use crate::energy_alarm::Alarm;
use crate::friction::Frictions;
use crate::joint_limits::LimitWatch;
use crate::kept::CheckpointWriter;
use crate::motion::MotionRecorder;
use crate::one_way::OneWayWatch;
use crate::record::{Channel, ControlSummary, RealtimeSummary, StepRow};
use crate::recorder::{RecordRows, Recorder, StepMark};
use crate::settings::{Lengths, ResolvedMethod};
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::ControlFlow;
use core::time::Duration;
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::outputs::Contacts;
use mbs_core::scene::Scene;
use std::time::Instant;

#[derive(Debug, Default)]
pub(super) struct Counts {
    pub(super) steps: u64,
    pub(super) iterations: u64,
    pub(super) factorizations: u64,
    pub(super) worst: Duration,
    pub(super) control: ControlSummary,
}

/// Additional columns of the rows. They follow the scene's channels.
pub trait Columns<T: Real, const D: usize> {
    /// Returns the names and units of the columns.
    fn channels(&self) -> Vec<Channel>;

    /// Called after each step, for columns that store values from step to step.
    ///
    /// # Errors
    /// The error that stops the run.
    fn follow(&mut self, now: &Simulation<T, D>) -> Result<(), StopError>;

    /// Writes the components of a row.
    ///
    /// # Errors
    /// An error if a component is not finite.
    fn write(&mut self, now: &Simulation<T, D>, out: &mut [T]) -> Result<(), StopError>;
}

/// Record of a run while it is simulated.
pub(super) struct Record<'a, T: Real, const D: usize> {
    pub(super) scene: &'a Scene<T>,
    pub(super) settings: &'a ResolvedMethod,
    pub(super) lengths: Lengths<T>,
    pub(super) measures: Channels<T, D>,
    pub(super) contacts: Contacts<T, D>,
    pub(super) limits: LimitWatch<T, D>,
    pub(super) one_way: OneWayWatch<T, D>,
    pub(super) recorder: Recorder,
    pub(super) motion: MotionRecorder<T, D>,
    values: Vec<T>,
    /// True if `values` belongs to the current state and is already in the statistics.
    is_measured: bool,
    /// Number of components of the scene's channels. The components of `others` follow them.
    n_measured: usize,
    pub(super) others: Option<&'a mut dyn Columns<T, D>>,
    /// Data of the last step.
    mark: StepMark,
    pub(super) counts: Counts,
    /// Time that the run has reached [s].
    pub(super) reached: f64,
    pub(super) alarm: Alarm,
    frictions: Frictions<T, D>,
    /// Number of completed steps or intervals.
    pub(super) done: u64,
    pub(super) clock: Clock,
    /// Clock time at which the current step began.
    begun: Instant,
    pub(super) checkpoints: Option<RunCheckpoints<'a>>,
    /// Number of periods of a paced run, its timing summary, and the most degraded level since the last row. The level is `None` without a
    /// ladder. A paced run may record one row after each period.
    pub(super) periods: Option<u64>,
    pub(super) realtime: Option<RealtimeSummary>,
    pub(super) level: Option<f64>,
}

impl<'a, T: Real, const D: usize> Record<'a, T, D> {
    /// Creates the record for one row after each of `n_rows` steps or intervals.
    pub(super) fn new(
        (scene, settings): (&'a Scene<T>, &'a ResolvedMethod),
        simulation: &Simulation<T, D>,
        channels: Vec<Channel>,
        (n_rows, keep): (u64, RecordRows),
    ) -> Result<Self, StopError> {
        let measures = Channels::new(scene, simulation.model())?;
        let contacts = Contacts::new(scene, simulation.model());
        let n = channels.iter().map(|c| c.components.len()).sum();
        Ok(Self {
            scene,
            settings,
            lengths: settings.lengths(scene),
            n_measured: measures.lengths().sum(),
            measures,
            contacts: contacts.map_err(|e| StopError::Start(e.into()))?,
            limits: LimitWatch::new(scene, simulation.model())?,
            one_way: OneWayWatch::new(scene, simulation.model()),
            recorder: Recorder::new(channels, n_rows, simulation.invariant().initial(), keep),
            motion: MotionRecorder::new(scene, simulation.model(), settings.duration),
            values: vec![T::ZERO; n],
            is_measured: false,
            others: None,
            mark: StepMark::default(),
            counts: Counts::default(),
            reached: 0.0,
            alarm: Alarm::new(settings.energy_alarm),
            frictions: Frictions::new(scene, settings, simulation.model()),
            done: 0,
            clock: Clock::new(simulation.threads()),
            begun: Instant::now(),
            checkpoints: None,
            periods: None,
            realtime: None,
            level: None,
        })
    }

    /// Records the first row.
    pub(super) fn start(&mut self, simulation: &Simulation<T, D>) -> Result<(), StopError> {
        let violation = simulation.start.residual.map(Real::to_f64);
        let energies = simulation.initial_energies();
        self.mark = StepMark { energies, violation, ..StepMark::default() };
        self.recorder.mark(&self.mark);
        self.contacts.start(simulation.state());
        self.limits.watch(simulation);
        self.one_way.watch(simulation);
        self.row(simulation, false)
    }

    /// Starts the clock of the steps.
    pub(super) fn begin(&mut self) {
        self.clock.begin();
        self.begin_step();
    }

    /// Stores the clock time at which the next step begins.
    pub(super) fn begin_step(&mut self) {
        self.begun = Instant::now();
    }

    /// CPU time of the steps.
    pub(super) fn cpu(&self) -> Duration {
        self.clock.get()
    }

    /// Evaluates all outputs at the current state, at most once for each state, and adds them to the statistics.
    ///
    /// # Errors
    /// An error if an output is not finite. The statistics then do not include this state.
    fn measure(&mut self, simulation: &Simulation<T, D>) -> Result<(), StopError> {
        if self.is_measured {
            return Ok(());
        }
        let (values, others) = self.values.split_at_mut(self.n_measured);
        let n_others = others.len() - usize::from(self.level.is_some());
        let (others, level) = others.split_at_mut(n_others);
        self.measures.write(simulation, values)?;
        if let Some(columns) = &mut self.others {
            columns.write(simulation, others)?;
        }
        if let ([level], Some(lowest)) = (level, self.level) {
            *level = T::from_f64(lowest);
        }
        self.recorder.measure(self.mark.t, &self.values);
        self.is_measured = true;
        Ok(())
    }

    /// Records a row; nothing is recorded if an output is not finite.
    fn row(&mut self, simulation: &Simulation<T, D>, is_last: bool) -> Result<(), StopError> {
        self.measure(simulation)?;
        // The most degraded level is determined anew for the next row.
        self.level = self.level.map(|_| 0.0);
        if self.recorder.keeps_all() {
            self.motion.offer(self.mark.t, &simulation.state().q, is_last);
        }
        self.recorder.keep(&self.mark, &self.values);
        Ok(())
    }

    /// Updates the statistics, records a row if one is due after step or period `k`, and checks the alarms.
    fn row_if_due(
        &mut self,
        simulation: &Simulation<T, D>,
        (k, is_last): (u64, bool),
    ) -> Result<(), StopError> {
        let recorded = if self.recorder.keeps(k) || is_last {
            self.row(simulation, is_last)
        } else if self.recorder.keeps_all() {
            self.measure(simulation)
        } else {
            Ok(())
        };
        // If an alarm and an output that is not finite occur together, the alarm is reported, because the energy error is the probable
        // cause.
        let passed = self.frictions.passed(simulation);
        self.alarm.rings_for(simulation, is_last, passed).map_or(recorded, Err)
    }

    /// Updates the counts and maxima with a step.
    fn take(
        &mut self,
        simulation: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<(), StopError> {
        let report = &accepted.attempt.report;
        let is_controlled = simulation.is_controlled();
        let is_end = is_last && is_controlled;
        let t = if is_end { self.settings.duration } else { simulation.state().t.to_f64() };
        self.counts.steps += u64::from(report.steps);
        self.reached = t;
        self.counts.iterations += u64::from(report.iterations);
        self.counts.factorizations += u64::from(report.factorizations);
        let mut tracked = self.measures.track(simulation);
        if let Some(columns) = &mut self.others {
            tracked = tracked.and(columns.follow(simulation));
        }
        self.contacts.watch(simulation.state());
        self.limits.watch(simulation);
        self.one_way.watch(simulation);
        self.mark = StepMark {
            t,
            energies: accepted.attempt.energies,
            violation: report.violation.map(Real::to_f64),
            step: StepRow {
                length: accepted.step.to_f64(),
                index: simulation.index().map(|(index, _)| index),
                iterations: report.iterations,
                rejected: accepted.rejected,
                energy_change: accepted.change,
                penalty_energy: report.penalty_energy.to_f64(),
                error_estimate: self.settings.rule.has_error().then_some(accepted.attempt.error),
                limit: is_controlled.then(|| accepted.limit.name()),
            },
        };
        self.recorder.mark(&self.mark);
        self.is_measured = false;
        self.counts.control.take(&self.mark.step);
        tracked
    }
}

impl<T: Real, const D: usize> StepObserver<T, D> for Record<'_, T, D> {
    fn step(
        &mut self,
        now: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let taken = self.take(now, accepted, is_last);
        let (from, to) = (self.begun, Instant::now());
        self.counts.worst = self.counts.worst.max(to - from);
        self.begun = to;
        taken?;
        if self.periods.is_some() {
            // If an output is not finite, the run stops at the end of the period.
            let _ = self.measure(now);
        } else {
            let k = self.done + 1;
            self.row_if_due(now, (k, is_last))?;
            if !is_last && self.keep(now, k) {
                self.begin_step();
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    fn instant(&mut self, now: &Simulation<T, D>) -> Result<ControlFlow<()>, StopError> {
        if let Some(periods) = self.periods {
            self.done += 1;
            self.reached = now.state().t.to_f64();
            self.mark.t = self.reached;
            self.recorder.end_at(self.reached);
            self.row_if_due(now, (self.done, self.done == periods))?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Records the state at which the run stops.
    fn end(&mut self, now: &Simulation<T, D>, stop: Option<&StopError>) {
        if matches!(stop, Some(StopError::Interrupted)) {
            self.keep_now(now);
        }
        let is_over = stop.is_some() || self.periods.is_none();
        if is_over && self.recorder.last_time().is_none_or(|last| last < self.reached) {
            let energies = now.invariant().energies();
            self.mark = StepMark { t: self.reached, energies, ..StepMark::default() };
            self.is_measured = false;
            // The run stops already, so an error of this row is ignored.
            let _ = self.row(now, true);
        }
    }
}

/// Checkpoints of a run: their writer, and the identity of scene and settings.
#[derive(Debug)]
pub(super) struct RunCheckpoints<'a> {
    pub(super) writer: &'a mut CheckpointWriter,
    pub(super) identity: Identity,
}
