//! A scene document, run in the precision that its settings name.

use crate::choice::Precision;
use crate::run::{Outcome, Progress, run};
use crate::settings::Settings;
use crate::tree::{InSpace, Plane};
use mbs_core::Real;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::Dimension;
use mbs_scene::{Document, ReadError};

/// Who is told where a run is [s].
struct Listener<'a>(&'a mut dyn FnMut(f64));

impl Progress for Listener<'_> {
    fn reached(&mut self, t: f64) {
        (self.0)(t);
    }
}

/// Runs a scene from its text, which is read with the digits of the settings' precision; `reached` is told the time of each step [s].
///
/// The same as [`run`] for the scene of the document; programs that take what precision comes compile it only once.
///
/// # Errors
/// [`ReadError`] where the text is no scene in that precision, though it may be in another.
pub fn run_document(
    document: &Document,
    settings: &Settings,
    reached: &mut dyn FnMut(f64),
) -> Result<Outcome, ReadError> {
    match settings.precision {
        Precision::F64 => in_precision::<f64>(document, settings, reached),
        Precision::F32 => in_precision::<f32>(document, settings, reached),
        Precision::DoubleDouble => in_precision::<DoubleDouble>(document, settings, reached),
    }
}

fn in_precision<T: Real>(
    document: &Document,
    settings: &Settings,
    reached: &mut dyn FnMut(f64),
) -> Result<Outcome, ReadError>
where
    Plane<2>: InSpace<T>,
    Plane<3>: InSpace<T>,
{
    let scene = document.scene::<T>()?;
    let mut listener = Listener(reached);
    Ok(match scene.dimension {
        Dimension::Planar => run::<T, 2>(&scene, settings, &mut listener),
        Dimension::Spatial => run::<T, 3>(&scene, settings, &mut listener),
    })
}
