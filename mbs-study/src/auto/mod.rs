//! The choice of formulation, integrator and step by measurement: for a required error of the outputs, or for a deadline.
//!
//! Structure says who cannot run the scene. A short pilot runs the others over the whole span with coarse settings, takes their
//! errors against the best of them, and predicts what the required error costs each. Time comes from a [`Clock`] that is given.

mod bench;
pub(crate) mod candidates;
pub(crate) mod check;
pub(crate) mod choose;
pub(crate) mod estimate;
pub(crate) mod goal;
pub(crate) mod pilot;
mod plan;
mod report;
mod structure;
pub(crate) mod trial;

pub use bench::Clock;
pub(crate) use choose::{Pick, Pilot, Task, candidates, methods};
pub use goal::{GoalError, time};
pub use mbs::Goal;
#[doc(hidden)]
pub use plan::{Plan, Processor, plan, run_plan};
