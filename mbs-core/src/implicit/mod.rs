//! Common parts of implicit steps in natural coordinates. They are the frame of a step, new inputs, prediction and correction. Further
//! parts are the end of Newton's iteration, constraint violations, and the update of the state.

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
