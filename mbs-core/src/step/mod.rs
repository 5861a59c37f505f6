//! Common parts of the steps of all formulations: errors, reports, and what they look for in vectors. Implicit ones in natural coordinates
//! share more, which is in `implicit`.

mod error;
mod report;
mod scan;

pub use error::{InputError, OptionError, StepError};
pub use report::{Counts, Step, StepReport, Stop};
pub use scan::{largest, largest_or_nan, step_scale};
