//! Time of one evaluation of accelerations.
fn main() {}
