//! Results that were written, read again: rows and statistics of a run; and how two runs differ.

mod difference;
mod envelope;
mod read;

pub use difference::{ColumnDifference, Difference, difference, difference_over_time};
pub use envelope::envelope;
pub use read::{ResultColumn, ResultTable, UnreadableResults};
