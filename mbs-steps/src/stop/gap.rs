//! Distance of a mechanism from coming together.

use super::StopError;
use mbs_core::start::AssemblyError;

impl StopError {
    /// The largest residual of joints and held values that a start leaves open [m or rad; of velocities per second]; nothing where it is not
    /// that which stopped it.
    #[must_use]
    pub fn gap(&self) -> Option<f64> {
        match self {
            Self::Start(
                AssemblyError::Position { residual, .. } | AssemblyError::Velocity { residual, .. },
            ) => Some(*residual),
            _ => None,
        }
    }
}
