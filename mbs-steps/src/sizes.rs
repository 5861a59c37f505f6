//! Sizes of a scene at its consistent start.

use crate::ready::AssembledScene;
use crate::stop::StopError;
use mbs_core::scene::{Dimension, Scene};

/// Number of coordinates, number of constraints and their rank at the start, in natural coordinates. The scene is built and assembled
/// without a run.
///
/// Cost: the same as the start of a run.
///
/// # Errors
/// [`StopError`] when there is no model, no consistent start or no equilibrium.
pub fn sizes_at_start(scene: &Scene<f64>) -> Result<[usize; 3], StopError> {
    Ok(match scene.dimension {
        Dimension::Planar => AssembledScene::<f64, 2>::new(scene)?.sizes(),
        Dimension::Spatial => AssembledScene::<f64, 3>::new(scene)?.sizes(),
    })
}
