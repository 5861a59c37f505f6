//! Common parts of the steps of all formulations: errors, reports, and scans of vectors. Implicit steps in natural coordinates have further
//! common parts in `implicit`.

mod error;
mod report;
mod scan;

pub use error::{InputError, OptionError, StepError};
pub use report::{Counts, Step, StepReport, Stop};
pub use scan::{largest, largest_or_nan, step_scale};
