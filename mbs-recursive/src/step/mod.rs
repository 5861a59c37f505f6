//! Steps of a mechanism in slices: trapezoidal rule, bounded work, error control, projections, and states that are set from outside.

pub mod bounded;
pub mod explicit;
pub(crate) mod project;
pub mod set_state;
pub mod trapezoidal;
