//! Lines of output, their numbers, and the error that replaces a line.

use std::error::Error;

/// Reason for which a problem cannot be run.
pub(crate) type Failure = Box<dyn Error>;

/// Converts a number that every precision represents exactly.
pub(crate) fn exactly<T: mbs_core::Real>(x: f64) -> T {
    T::from_f64(x)
}

/// Prints one line.
#[allow(clippy::print_stdout, reason = "the lines are what this program says")]
pub(crate) fn print_line(algorithm: &str, seconds: f64, value: f64, reference: &str) {
    println!("{algorithm},{seconds:.6e},{value:.17e},{reference}");
}
