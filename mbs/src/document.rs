//! A scene document, run in the precision that its settings name.

use crate::choice::Precision;
use crate::run::{Outcome, Progress, run};
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

/// Runs a scene with the digits of the settings' precision: as it was read in `f64`, from which the settings are, or read anew from
/// its document in another; `reached` is told the time of each step [s].
///
/// The same as [`run`]; programs that take what precision comes compile it only once.
///
/// # Errors
/// [`ReadError`] where the text is no scene in that precision, though it is one in `f64`.
pub fn run_document(
    (document, scene): (&Document, &Scene<f64>),
    settings: &Settings,
    reached: &mut dyn FnMut(f64),
) -> Result<Outcome, ReadError> {
    match settings.precision {
        Precision::F64 => Ok(in_space(scene, settings, reached)),
        Precision::F32 => Ok(in_space(&document.scene::<f32>()?, settings, reached)),
        Precision::DoubleDouble => {
            Ok(in_space(&document.scene::<DoubleDouble>()?, settings, reached))
        }
    }
}

fn in_space<T: Real>(scene: &Scene<T>, settings: &Settings, reached: &mut dyn FnMut(f64)) -> Outcome
where
    Plane<2>: InSpace<T>,
    Plane<3>: InSpace<T>,
{
    let mut listener = Listener(reached);
    match scene.dimension {
        Dimension::Planar => run::<T, 2>(scene, settings, &mut listener),
        Dimension::Spatial => run::<T, 3>(scene, settings, &mut listener),
    }
}
