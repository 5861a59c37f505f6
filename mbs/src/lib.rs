#![doc = include_str!("../README.md")]

mod channels;
mod figure;
mod recorder;
mod run;
mod settings;
mod simulation;
mod stop;
pub mod words;

pub use mbs_augmented as augmented;
pub use mbs_core as core;
pub use mbs_scene as scene_file;
pub use mbs_sparse as sparse;

pub use run::{Outcome, Progress, run};
pub use settings::{
    FORMULATIONS, Formulation, INTEGRATORS, IntegratorKind, Overrides, PRECISIONS, Precision,
    Settings, SettingsError,
};
pub use simulation::{Simulation, StartError};
pub use stop::{Names, StopError};
