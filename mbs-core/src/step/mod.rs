//! Common parts of the steps of all formulations: errors, reports, and what they look for in vectors. Implicit ones share more, which is
//! in `implicit`, re-exported here where others than the augmented and the classical Lagrangian use it.

mod error;
mod report;
mod scan;

#[cfg(feature = "alloc")]
pub use crate::implicit::{
    add_response, add_work, check_guides, check_lines, check_rotations, has_new_inputs, load_at,
    take_coordinates,
};
pub use error::{InputError, OptionError, StepError};
pub use report::{Counts, Step, StepReport, Stop};
pub use scan::{largest, largest_or_nan, step_scale};
