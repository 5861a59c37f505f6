//! A scene document, run in the precision that its settings name.

use crate::checkpoint::{Checkpoint, CheckpointError, Keeping};
use crate::choice::Precision;
use crate::run::{Outcome, Progress, run, run_kept};
use crate::settings::Settings;
use crate::tree::{InSpace, Plane};
use mbs_core::Real;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::{Dimension, Scene};
use mbs_scene::{Document, ReadError};

/// Who is told where a run is [s].
struct Listener<'a>(&'a mut dyn FnMut(f64));

impl Progress for Listener<'_> {
    fn reached(&mut self, t: f64) {
        (self.0)(t);
    }
}

/// A scene in the digits and the dimensions of its run, and what is done with it.
trait Work {
    /// What comes of it.
    type Done;

    /// Does it.
    fn done<T: Real, const D: usize>(self, scene: &Scene<T>, settings: &Settings) -> Self::Done
    where
        Plane<D>: InSpace<T>;
}

/// A run.
struct Plain<'a>(Listener<'a>);

impl Work for Plain<'_> {
    type Done = Outcome;

    fn done<T: Real, const D: usize>(mut self, scene: &Scene<T>, settings: &Settings) -> Outcome
    where
        Plane<D>: InSpace<T>,
    {
        run::<T, D>(scene, settings, &mut self.0)
    }
}

/// A run that is kept, or goes on.
struct InParts<'a>(Listener<'a>, Option<&'a Checkpoint>, Option<&'a mut Keeping>);

impl Work for InParts<'_> {
    type Done = Result<Outcome, CheckpointError>;

    fn done<T: Real, const D: usize>(mut self, scene: &Scene<T>, settings: &Settings) -> Self::Done
    where
        Plane<D>: InSpace<T>,
    {
        run_kept::<T, D>(scene, settings, &mut self.0, (self.1, self.2))
    }
}

/// Runs a scene with the digits of the settings' precision: as it was read in `f64`, from which the settings are, or read anew from
/// its document in another; `reached` is told the time of each step [s].
///
/// The same as [`run`]; programs that take what precision comes compile it only once.
///
/// # Errors
/// [`ReadError`] where the text is no scene in that precision, though it is one in `f64`.
pub fn run_document(
    document: (&Document, &Scene<f64>),
    settings: &Settings,
    reached: &mut dyn FnMut(f64),
) -> Result<Outcome, ReadError> {
    in_precision(document, settings, Plain(Listener(reached)))
}

/// [`run_document`], from a checkpoint if there is one, and kept while it goes if it is to be: the same as [`run_kept`].
///
/// # Errors
/// As [`run_document`]; the inner error for a checkpoint of something else.
pub fn run_document_kept(
    document: (&Document, &Scene<f64>),
    settings: &Settings,
    reached: &mut dyn FnMut(f64),
    (from, keeping): (Option<&Checkpoint>, Option<&mut Keeping>),
) -> Result<Result<Outcome, CheckpointError>, ReadError> {
    in_precision(document, settings, InParts(Listener(reached), from, keeping))
}

fn in_precision<W: Work>(
    (document, scene): (&Document, &Scene<f64>),
    settings: &Settings,
    work: W,
) -> Result<W::Done, ReadError> {
    Ok(match settings.precision {
        Precision::F64 => in_space(scene, settings, work),
        Precision::F32 => in_space(&document.scene::<f32>()?, settings, work),
        Precision::DoubleDouble => in_space(&document.scene::<DoubleDouble>()?, settings, work),
    })
}

fn in_space<T: Real, W: Work>(scene: &Scene<T>, settings: &Settings, work: W) -> W::Done
where
    Plane<2>: InSpace<T>,
    Plane<3>: InSpace<T>,
{
    match scene.dimension {
        Dimension::Planar => work.done::<T, 2>(scene, settings),
        Dimension::Spatial => work.done::<T, 3>(scene, settings),
    }
}
