//! What the steps of all formulations share: errors, reports, and how a finished step enters the state.

#[cfg(feature = "alloc")]
mod commit;
mod error;
#[cfg(feature = "alloc")]
mod inputs;
mod newton;
mod report;
mod scan;

#[cfg(feature = "alloc")]
pub use commit::{add_work, check_guides, check_rotations, take_coordinates};
pub use error::{InputError, OptionError, StepError};
#[cfg(feature = "alloc")]
pub use inputs::{add_response, has_new_inputs, load_at};
pub use newton::{ConvergenceCriterion, stopping};
pub use report::{Counts, Step, StepReport, Stop};
pub use scan::{largest, largest_or_nan, step_scale};
