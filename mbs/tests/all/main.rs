//! Tests of the crate's interface, in one program. Each test program compiles all formulations again, which takes more than a minute. `cargo
//! test -p mbs -- energy::` runs one module.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

mod common;
use mbs_testkit::retell;

mod analysis;
mod andrews;
mod axes;
mod balance;
mod balls;
mod checkpoint;
mod codes;
mod contact;
mod control;
mod couplings;
mod degrees;
mod drive_line;
mod driven_wheels;
mod energy;
mod excavator;
mod feedback;
mod field;
mod fingerprint;
mod folder;
mod formulations;
mod front;
mod generate;
mod gravity_scale;
mod guided_bodies;
mod hints;
mod inputs;
mod invariants;
mod joint_limits;
mod kinds;
mod linear_system;
mod machines;
mod massless_trees;
mod mjcf;
mod modes;
mod observers;
mod oracle;
mod output_quantities;
mod points;
mod random;
mod readings;
mod realtime;
mod record;
mod reference;
mod relations;
mod relative;
mod results;
mod rolling;
mod ropes;
mod rotors;
mod settings;
mod signal_times;
mod signals;
mod slack_ropes;
mod states;
mod statistics;
mod steady;
mod sums;
mod tables;
mod threads;
mod tooth_forces;
mod tree;
mod tree_derivatives;
mod tree_reach;
mod vehicle;

mod motion {
    mod pose;
    mod principal;
}
