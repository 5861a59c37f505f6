//! Checkpoints of a run, and the resumption of a run from a checkpoint.

use super::Run;
use super::record::{Counts, Record, RunCheckpoints};
use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::checkpoint::{Checkpoint, CheckpointError, Identity, Kind, whole};
use crate::record::ControlSummary;
use crate::simulation::Simulation;
use core::time::Duration;
use mbs_core::Real;
use mbs_core::outputs::{Instant, MOST_INSTANTS};

impl<T: Real, const D: usize> Run<'_, T, D> {
    /// Resumes the run from a checkpoint. After an error the run must not be used.
    pub(super) fn resume(
        &mut self,
        checkpoint: &Checkpoint,
        identity: &Identity,
    ) -> Result<(), CheckpointError> {
        if !checkpoint.is_of_run() {
            return Err(CheckpointError::NoRun);
        }
        checkpoint.check(identity)?;
        let mut tape = checkpoint.body();
        self.simulation.restore_from(&mut tape)?;
        self.record.walk(&self.simulation, &mut tape, Duration::ZERO)?;
        holds(tape.left() == Some(0))?;
        let is_controlled = self.simulation.is_controlled();
        let t = self.simulation.state().t;
        holds(if is_controlled {
            t >= T::ZERO && t < self.record.lengths.duration
        } else {
            self.record.done < self.record.settings.n_steps()
        })
    }
}

impl<T: Real, const D: usize> Record<'_, T, D> {
    /// Writes rows and a checkpoint if they are due after step `k`; returns whether anything was written.
    pub(super) fn keep(&mut self, simulation: &Simulation<T, D>, k: u64) -> bool {
        self.done = k;
        let is_due = self.checkpoints.as_ref().is_some_and(|c| c.writer.is_due(self.reached));
        self.write(simulation, is_due)
    }

    /// Writes rows and a checkpoint, even if they are not due.
    pub(super) fn keep_now(&mut self, simulation: &Simulation<T, D>) {
        self.write(simulation, true);
    }

    /// Writes the waiting rows, and a checkpoint if it is due.
    fn write(&mut self, simulation: &Simulation<T, D>, is_due: bool) -> bool {
        let Some(checkpoints) = self.checkpoints.take() else { return false };
        let is_busy = is_due || checkpoints.writer.is_waiting(&self.recorder);
        if is_busy {
            let since = self.clock.get();
            let bytes = is_due.then(|| self.checkpoint(simulation, &checkpoints, since));
            checkpoints.writer.write(&self.recorder, bytes.map(|bytes| (self.reached, bytes)));
            self.clock.take_off(since);
        }
        self.checkpoints = Some(checkpoints);
        is_busy
    }

    /// Returns the bytes of a checkpoint.
    fn checkpoint(
        &mut self,
        simulation: &Simulation<T, D>,
        checkpoints: &RunCheckpoints<'_>,
        cpu: Duration,
    ) -> Result<Vec<u8>, CheckpointError> {
        let times = [self.reached, checkpoints.writer.every()];
        whole(&checkpoints.identity, (Kind::Run, times), |pen| {
            simulation.snapshot().walk(pen)?;
            self.walk(simulation, pen, cpu)
        })
    }

    /// Writes the record to a checkpoint, or reads it from one. `mark` and `values` are not stored, because the next step replaces them.
    fn walk(
        &mut self,
        simulation: &Simulation<T, D>,
        tape: &mut impl Tape,
        cpu: Duration,
    ) -> Walked {
        tape.count(&mut self.done)?;
        tape.float(&mut self.reached)?;
        self.recorder.walk(tape)?;
        self.motion.walk(tape)?;
        self.measures.walk(tape)?;
        self.walk_contacts(simulation, tape)?;
        self.limits.walk(tape)?;
        self.one_way.walk(tape)?;
        self.counts.walk(tape)?;
        self.alarm.walk(tape)?;
        let mut cpu = cpu;
        tape.duration(&mut cpu)?;
        if tape.left().is_some() {
            self.clock.before = cpu;
        }
        Ok(())
    }

    /// Writes or reads the begins and ends of contacts. The gaps are not stored, because they follow from the state.
    fn walk_contacts(&mut self, simulation: &Simulation<T, D>, tape: &mut impl Tape) -> Walked {
        let numbers = |i: &Instant| (i.t, i.effect, i.end, i.makes);
        let mut instants: Vec<_> = self.contacts.instants().iter().map(numbers).collect();
        let mut left_out = self.contacts.left_out();
        let n_effects = self.scene.effects.len();
        tape.list(&mut instants, 25, |tape, (t, effect, end, makes)| {
            tape.float(t)?;
            tape.index(effect, n_effects)?;
            tape.index(end, 2)?;
            tape.flag(makes)
        })?;
        tape.count(&mut left_out)?;
        holds(instants.len() <= MOST_INSTANTS)?;
        if tape.left().is_some() {
            let instant = |(t, effect, end, makes)| Instant { t, effect, end, makes };
            let instants: Vec<Instant> = instants.into_iter().map(instant).collect();
            self.contacts.resume(simulation.state(), &instants, left_out);
        }
        Ok(())
    }
}

impl Counts {
    fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        let Self { steps, iterations, factorizations, worst, control } = self;
        [steps, iterations, factorizations].into_iter().try_for_each(|x| tape.count(x))?;
        tape.duration(worst)?;
        // The rule belongs to the settings, and the index changes belong to the simulation, so neither is stored here.
        let ControlSummary { accepted, rejected, smallest_step, largest_step, .. } = control;
        [accepted, rejected].into_iter().try_for_each(|x| tape.count(x))?;
        tape.float(smallest_step)?;
        tape.float(largest_step)?;
        tape.count(&mut control.index_1_steps)?;
        tape.count(&mut control.events)
    }
}
