//! Steps of a mechanism in slices: the trapezoidal rule, work that is bounded, methods with error control, projections. States that are set.

pub mod bounded;
pub mod explicit;
pub(crate) mod project;
pub mod set_state;
pub mod trapezoidal;
