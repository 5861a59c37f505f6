//! One run of a scene, for every scalar and dimension.

use super::failure::SimulationError;
use super::function::{Function, FunctionColumns};
use super::inputs::Inputs;
use super::view::{Observed, Observer, Sight};
use crate::checkpoint::Checkpoint;
use crate::driver::StepObserver;
use crate::kept::CheckpointWriter;
use crate::names::Names;
use crate::precision::{ReadScene, SceneWork};
use crate::realtime::{self, Pacing};
use crate::recorder::RecordRows;
use crate::run::{Outcome, Recording, run_recorded};
use crate::settings::ResolvedMethod;
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::ControlFlow;
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::scene::Scene;
use mbs_realtime::Clock;

/// Run of a scene: its method, its observers, and the rows that stay in memory.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct SceneRun<'a, 'b> {
    /// Settings of the run, all resolved to values.
    pub settings: &'a ResolvedMethod,
    /// Names of the scene.
    pub names: &'a Names,
    /// Rows that stay in memory.
    pub keep: RecordRows,
    /// Outputs that are user-defined code.
    pub functions: &'a [Function],
    /// Observers, and the inputs that they may set.
    pub observers: (&'a mut [&'b mut dyn Observer], Inputs),
    /// Function that receives the simulated time after each step [s].
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Checkpoint to resume from, and the writer of checkpoints.
    pub checkpoints: (Option<&'a Checkpoint>, Option<&'a mut CheckpointWriter>),
    /// Pacing of the run and its clock; `None`: the run is not paced. A paced run has no observers, user-defined outputs or checkpoints.
    pub pace: Option<(&'a Pacing, &'a mut dyn Clock)>,
}

impl SceneRun<'_, '_> {
    /// Runs the scene in the precision in which it was read.
    ///
    /// # Errors
    /// [`SimulationError`] for a checkpoint of another run, and for an invalid pacing.
    pub fn run(self, read: &ReadScene<'_>) -> Result<Outcome, SimulationError> {
        read.work(self)
    }
}

impl SceneWork for SceneRun<'_, '_> {
    type Done = Result<Outcome, SimulationError>;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Self::Done {
        let Self { settings, names, keep, functions, progress, .. } = self;
        if let Some((pacing, clock)) = self.pace {
            return Ok(realtime::run::run::<T, D>(scene, settings, pacing, clock)?);
        }
        let sight = || Sight::<T, D>::new(scene, names);
        let (observers, inputs) = self.observers;
        let mut observed;
        let observer: &mut dyn StepObserver<T, D> = if observers.is_empty() {
            &mut ()
        } else {
            observed = Observed::new(sight(), inputs, observers);
            &mut observed
        };
        let mut columns;
        let others = if functions.is_empty() {
            None
        } else {
            columns = FunctionColumns { sight: sight(), functions };
            Some(&mut columns as _)
        };
        let (from, writer) = self.checkpoints;
        let recording = Recording { keep, columns: others, from, writer };
        let mut listener = Listener(progress);
        let mut all = (&mut listener, observer);
        let outcome = run_recorded::<T, D>(scene, settings, &mut all, recording);
        outcome.map_err(SimulationError::not_resumed)
    }
}

/// Observer that reports the time that a run has reached [s].
struct Listener<'a>(Option<&'a mut dyn FnMut(f64)>);

impl<T: Real, const D: usize> StepObserver<T, D> for Listener<'_> {
    fn step(
        &mut self,
        now: &Simulation<T, D>,
        _: &Accepted<T>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        if let Some(reached) = &mut self.0 {
            reached(now.state().t.to_f64());
        }
        Ok(ControlFlow::Continue(()))
    }
}
