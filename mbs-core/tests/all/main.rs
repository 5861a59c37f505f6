//! Tests of this crate in one program, because each program compiles the same solvers again. `cargo test -p mbs-core start::` runs
//! one module.

mod gradient;
mod small;

mod axes;
mod balls;
mod check;
mod codes;
mod control;
mod coupling_kinds;
mod document;
mod effect_table;
mod effects;
mod efforts;
mod elements;
mod events;
mod integrator;
mod joints;
mod least;
mod model;
mod motion;
mod moved_mass;
mod output_table;
mod outputs;
mod quantities;
mod reactions;
mod relative;
mod settings;
mod signals;
mod start;
mod sums;
mod undetermined;
mod wheel_angles;

mod inputs {
    mod breaks;
}

mod laws {
    mod bumper;
    mod calspan;
    mod corner;
    mod guide;
    mod polynomial;
    mod relation;
    mod road;
    mod road_contact;
    mod slip;
    mod spin;
    mod tire;
}

mod mechanism {
    mod align;
}

mod measure {
    mod curve;
    mod monotone;
}

mod natural {
    mod coordinate_sets;
    mod spatial_index;
}
