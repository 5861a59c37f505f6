//! Remaining residual of an assembly that failed.

use super::StopError;
use mbs_core::start::AssemblyError;

impl StopError {
    /// Largest residual of joints and prescribed values in an assembly that failed [m or rad; for velocities m/s or rad/s]. It is `None`
    /// for other errors.
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
