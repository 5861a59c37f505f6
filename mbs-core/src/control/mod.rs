//! Choosing the length of steps: the energy invariant, a local error estimate, and the driver that repeats steps.
//!
//! Knows no formulation: what is stepped is a [`Stepper`].

mod driver;
mod energy;
mod estimate;
mod invariant;

pub use driver::{Accepted, Attempt, Crossing, Driver, Limit, Rules, Stepper};
pub use energy::EnergyRule;
pub use estimate::LocalError;
pub use invariant::Invariant;

#[cfg(test)]
mod tests;
