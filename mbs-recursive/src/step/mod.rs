//! Steps of a mechanism in slices: the trapezoidal rule, work that is bounded, methods with error control, projections, and states set from outside.

pub mod bounded;
pub mod explicit;
pub(crate) mod project;
pub mod set_state;
pub mod trapezoidal;
