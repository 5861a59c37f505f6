//! Results read again from the files of a run, and differences of two runs.

mod difference;
mod envelope;
mod read;

pub use difference::{ColumnDifference, Difference, difference, difference_over_time};
pub use envelope::envelope;
pub use read::{ResultColumn, ResultTable, UnreadableResults};
