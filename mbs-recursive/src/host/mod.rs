//! A tree on the host: its state, starts, steps, energies, reactions and efforts.

mod angles;
mod formulation;
mod history;
mod lanes;
mod quantities;
mod run;
mod start;
pub(crate) mod state;
mod step;
mod turns;
mod under_efforts;

pub use formulation::Tree;
pub use history::History;
pub use quantities::{EffortTerms, JointLinks};
pub use start::StartError;
pub use state::{TreeState, Workspace};
pub use step::TreeMethod;
