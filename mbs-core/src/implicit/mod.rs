//! Parts that implicit steps in natural coordinates share: prediction and correction, the end of Newton's iteration, violations, and how a
//! step enters the state.

mod commit;
mod end;
mod inputs;
mod newton;
mod violation;

pub use commit::{add_work, check_guides, check_lines, check_rotations, commit, take_coordinates};
pub use end::StepEnd;
pub use inputs::{add_response, has_new_inputs, load_at, solve_response};
pub use newton::Newton;
pub use violation::{ConstraintLevel, ResidualLimits};
