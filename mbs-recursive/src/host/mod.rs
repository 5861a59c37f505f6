//! A tree on the host: its state, starts, steps, energies, reactions and efforts.

mod angles;
mod formulation;
mod history;
mod lanes;
mod quantities;
mod run;
mod start;
pub(crate) mod state;
mod turns;
mod under_efforts;

pub use formulation::{Tree, TreeStep};
pub use history::History;
pub use quantities::{EffortTerms, JointLinks};
pub use run::{
    bounded_step, extrapolated_step, radau5_step, rk4_step, rk54_step, rk853_step, step,
};
pub use start::StartError;
pub use state::{TreeState, Workspace};
