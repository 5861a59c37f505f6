//! The tests of the studies, in one program. `cargo test -p mbs-study -- doctor::` runs one of them.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

mod choice;
mod clock;
mod doctor;
mod doubtful;
mod estimate;
mod explain;
mod redundancy;
mod studies;
mod sweep;
