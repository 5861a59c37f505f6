#![doc = include_str!("../README.md")]

#[doc(hidden)]
pub mod at_state;
#[doc(hidden)]
pub mod changes;
#[doc(hidden)]
pub mod channels;
#[doc(hidden)]
pub mod checkpoint;
#[doc(hidden)]
pub mod choice;
#[doc(hidden)]
pub mod control;
#[doc(hidden)]
pub mod driver;
#[doc(hidden)]
pub mod energy_alarm;
#[doc(hidden)]
pub mod equilibrium;
#[doc(hidden)]
pub mod erased;
pub mod export;
#[doc(hidden)]
pub mod fingerprint;
pub mod folder;
#[doc(hidden)]
pub mod friction;
#[doc(hidden)]
pub mod interrupt;
#[doc(hidden)]
pub mod joint_limits;
mod kept;
#[doc(hidden)]
pub mod linear_system;
mod loop_alone;
#[doc(hidden)]
pub mod methods;
#[doc(hidden)]
pub mod mode;
pub mod modes;
#[doc(hidden)]
pub mod motion;
#[doc(hidden)]
pub mod names;
#[doc(hidden)]
pub mod one_way;
#[doc(hidden)]
pub mod peak;
#[doc(hidden)]
pub mod placed;
#[doc(hidden)]
pub mod precision;
#[doc(hidden)]
pub mod ready;
pub mod realtime;
pub mod record;
#[doc(hidden)]
pub mod recorder;
#[doc(hidden)]
pub mod rest;
#[doc(hidden)]
pub mod run;
#[doc(hidden)]
pub mod settings;
#[doc(hidden)]
pub mod signal_ends;
#[doc(hidden)]
pub mod simulation;
#[doc(hidden)]
pub mod sizes;
#[doc(hidden)]
pub mod statics;
#[doc(hidden)]
pub mod stiffness;
#[doc(hidden)]
pub mod stop;
#[doc(hidden)]
pub mod tally;
#[doc(hidden)]
pub mod tilt;
#[doc(hidden)]
pub mod tree;
mod unsteady;
pub mod words;

#[doc(hidden)]
pub use mbs_core as core;

/// Types and functions for generic code that knows the scalar and the dimension of its scene.
pub mod typed {
    pub use crate::driver::{StepInputs, StepObserver};
    pub use crate::run::{Recording, run, run_recorded};
    pub use crate::simulation::Simulation;
}
