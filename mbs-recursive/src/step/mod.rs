//! Steps of a mechanism in slices: trapezoidal rule, bounded steps, error control, projections, and states that the caller sets.

pub mod bounded;
pub mod explicit;
pub(crate) mod project;
pub mod set_state;
pub mod trapezoidal;
