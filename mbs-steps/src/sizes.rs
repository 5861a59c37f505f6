//! Sizes of a scene that assembles at its start.

use crate::ready::AssembledScene;
use crate::stop::StopError;
use mbs_core::scene::{Dimension, Scene};

/// Coordinates, constraints, and the rank of these at the start, in natural coordinates, of a scene that is built and assembled without a run.
///
/// Cost: that of the start of a run.
///
/// # Errors
/// [`StopError`] when there is no model, no consistent start or no equilibrium.
pub fn sizes_at_start(scene: &Scene<f64>) -> Result<[usize; 3], StopError> {
    Ok(match scene.dimension {
        Dimension::Planar => AssembledScene::<f64, 2>::new(scene)?.sizes(),
        Dimension::Spatial => AssembledScene::<f64, 3>::new(scene)?.sizes(),
    })
}
