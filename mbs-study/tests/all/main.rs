//! Tests of the studies, in one program. `cargo test -p mbs-study -- doctor::` runs one module.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

mod auto;
mod choice;
mod clock;
mod doctor;
mod doubtful;
mod estimate;
mod explain;
mod redundancy;
mod remedy;
mod studies;
mod sweep;

mod compare {
    mod clocked;
    mod ladder;
    mod layout;
    mod map;
    mod method;
    mod reference;
    mod rounds;
    mod runs;
    mod store;
    mod table;

    mod results {
        mod csv;
        mod digest;
        mod fit;
        mod front;
        mod rank;
        mod scale;
    }
}
