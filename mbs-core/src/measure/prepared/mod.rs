//! Measured quantities of a scene, prepared for evaluation: terms of sums with their curves, and rolling bodies.

mod curve;
mod monotone;
mod rolling;
mod term;

pub use curve::PreparedCurve;
pub(crate) use curve::knots;
pub use rolling::RollingInput;
pub use term::TermInput;
