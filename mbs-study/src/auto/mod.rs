//! Choice of formulation, integrator and step by measurement, for a required error of the outputs or for a deadline.
//!
//! Methods that the scene's structure excludes are left out. A short pilot runs the others with coarse settings over the whole span. It
//! compares their outputs with those of the most accurate run. Then it predicts the CPU time that each method needs for the required error. A
//! given [`Clock`] measures the time.

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
