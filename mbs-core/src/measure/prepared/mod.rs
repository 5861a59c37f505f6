//! Numbers of a scene prepared for evaluation: the terms of a sum with their curves, and what rolls.

mod curve;
mod monotone;
mod rolling;
mod term;

pub use curve::PreparedCurve;
pub(crate) use curve::knots;
pub use rolling::RollingInput;
pub use term::TermInput;
