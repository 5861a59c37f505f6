//! A line of the output, the numbers in it, and the failure that takes its place.

use std::error::Error;

/// Reason for which a problem cannot be run.
pub(crate) type Failure = Box<dyn Error>;

/// Number that is the same in any precision.
pub(crate) fn exactly<T: mbs_core::Real>(x: f64) -> T {
    T::from_f64(x)
}

/// Prints one line.
#[allow(clippy::print_stdout, reason = "the lines are what this program says")]
pub(crate) fn print_line(algorithm: &str, seconds: f64, value: f64, reference: &str) {
    println!("{algorithm},{seconds:.6e},{value:.17e},{reference}");
}
