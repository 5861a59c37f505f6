//! A scene document, run in the precision that its settings name.

use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::driver::StepObserver;
use crate::kept::CheckpointWriter;
use crate::precision::{PrecisionError, ReadScene, SceneWork};
use crate::run::{Outcome, run, run_kept};
use crate::settings::ResolvedMethod;
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::ControlFlow;
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::scene::Scene;
use mbs_scene::SceneFile;

/// Receives the time that a run has reached [s].
struct Listener<'a>(&'a mut dyn FnMut(f64));

impl<T: Real, const D: usize> StepObserver<T, D> for Listener<'_> {
    fn step(
        &mut self,
        now: &Simulation<T, D>,
        _: &Accepted<T>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        (self.0)(now.state().t.to_f64());
        Ok(ControlFlow::Continue(()))
    }
}

/// Run of a scene: a listener to the time of each step, and the settings.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct Plain<'a>(pub &'a mut dyn FnMut(f64), pub &'a ResolvedMethod);

impl SceneWork for Plain<'_> {
    type Done = Outcome;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Outcome {
        run::<T, D>(scene, self.1, &mut Listener(self.0))
    }
}

/// A run with checkpoints, or one that is resumed.
struct InParts<'a>(
    Listener<'a>,
    &'a ResolvedMethod,
    Option<&'a Checkpoint>,
    Option<&'a mut CheckpointWriter>,
);

impl SceneWork for InParts<'_> {
    type Done = Result<Outcome, CheckpointError>;

    fn done<T: Real, const D: usize>(mut self, scene: &Scene<T>) -> Self::Done {
        run_kept::<T, D>(scene, self.1, &mut self.0, (self.2, self.3))
    }
}

/// Runs a scene with the digits of the settings' precision: as it was read in `f64`, from which the settings are, or read anew from
/// its document in another. `reached` is called with the time of each step [s].
///
/// The same as [`run`]; programs that take what precision comes compile it only once.
///
/// # Errors
/// [`PrecisionError`] where the text is no scene in that precision, though it is one in `f64`, or the build does not have it.
pub fn run_document(
    document: (&SceneFile, &Scene<f64>),
    settings: &ResolvedMethod,
    reached: &mut dyn FnMut(f64),
) -> Result<Outcome, PrecisionError> {
    let read = ReadScene::new(document, settings.precision)?;
    Ok(read.work(Plain(reached, settings)))
}

/// [`run_document`], from a checkpoint if there is one, and kept while it goes if it is to be: the same as [`run_kept`].
///
/// # Errors
/// As [`run_document`]; the inner error for a checkpoint of something else.
pub fn run_document_kept(
    document: (&SceneFile, &Scene<f64>),
    settings: &ResolvedMethod,
    reached: &mut dyn FnMut(f64),
    (from, writer): (Option<&Checkpoint>, Option<&mut CheckpointWriter>),
) -> Result<Result<Outcome, CheckpointError>, PrecisionError> {
    let read = ReadScene::new(document, settings.precision)?;
    Ok(read.work(InParts(Listener(reached), settings, from, writer)))
}
