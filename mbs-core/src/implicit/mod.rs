//! Parts that implicit steps in natural coordinates share. They are the frame of a step, new inputs, prediction and correction, the end of
//! Newton's iteration, violations, and how a step enters the state.

mod commit;
mod end;
mod frame;
mod inputs;
mod newton;
mod violation;

pub use commit::{add_work, check_guides, check_lines, check_rotations, commit, take_coordinates};
pub use end::StepEnd;
pub use frame::{Solved, StepScratch, step};
pub use inputs::{InputResponse, add_response, load_at, pass_jump, solve_response, take_inputs};
pub use newton::Newton;
pub use violation::{ConstraintLevel, ResidualLimits};
