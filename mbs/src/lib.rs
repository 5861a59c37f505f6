#![doc = include_str!("../README.md")]

mod changes;
mod channels;
mod checkpoint;
mod choice;
mod control;
mod document;
mod driver;
mod energy_alarm;
mod equilibrium;
pub mod export;
mod fingerprint;
pub mod folder;
mod friction;
mod front;
mod interrupt;
mod joint_limits;
mod linear_system;
mod methods;
mod modes;
mod motion;
mod named;
mod names;
mod once;
mod one_way;
mod placed;
mod precision;
mod ready;
pub mod realtime;
pub mod record;
mod recorder;
mod rest;
pub mod results;
mod run;
mod settings;
mod signal_ends;
mod simulation;
mod sizes;
mod statics;
mod stop;
mod tally;
mod tilt;
pub mod words;

pub use mbs_augmented as augmented;
pub use mbs_classical as classical;
pub use mbs_core as core;
pub use mbs_import as models;
pub use mbs_linear as linear;
pub use mbs_parallel as parallel;
pub use mbs_recursive as recursive;
pub use mbs_scene as scene_file;
pub use mbs_sparse as sparse;
pub use mbs_statespace as statespace;

pub use checkpoint::{Checkpoint, CheckpointError, CheckpointWriter, FILE as CHECKPOINT};
pub use choice::{INTEGRATORS, IntegratorKind, PRECISIONS, Precision, STEP_RULES, StepRule};
pub use document::{run_document, run_document_kept};
pub use equilibrium::{Search, equilibrium_start, find_equilibrium};
pub use front::tree::{
    AccelerationDerivatives, EffortDerivatives, FrameMotion, FrameTarget, InverseKinematics,
    InverseKinematicsEnd, Matrix, Rollout, RolloutEnd, TotalMomentum, Tree, TreeError,
    TreeErrorKind, TreeRange,
};
pub use front::{
    Body, BodyMotion, Components, ContactEvent, Coordinates, Coupling, Effect, Energies,
    EquilibriumOptions, Error, FunctionId, Guide, Id, InitialCondition, InputId, InputInfo,
    InputOwner, InputTableError, Joint, Mechanism, NamedSignal, Observer, Output, OutputFunction,
    Part, PathError, PointMotion, Pose, Rolling, Run, RunInputs, RunResult, SceneError, Simulation,
    SimulationError, Sizes, Snapshot, StepReport, Table, UnknownName, View, Wrench, equilibrium,
    linearize, linearize_at, modes, run, run_with, with_inputs,
};
pub use interrupt::Interrupt;
pub use linear_system::{LinearSystem, LinearizeOptions, ModeShape};
pub use mbs_core::formulation::{Formulation, SwitchError};
pub use mbs_core::laws::code::{BodyLaw, Force, ForceLaw, Measured, MeasuredBody};
pub use mbs_core::laws::relation::Relation;
pub use mbs_core::scene::{
    BallAngle, BodyId, CouplingId, CouplingKind, CouplingMeasure, CouplingTerm, Curve, EffectId,
    EffectKind, GROUND, GuideId, InitialId, Interpolation, JointId, JointLimits, Motion, Number,
    OutputId, PolynomialPiece, Road, RoadFeature, RollingId, RollingKind, RollingPlane, Signal,
    SignalId, SignalKind, TableEnds, Vector3,
};
pub use mbs_scene::{ReadError, WriteError};
pub use methods::{FORMULATIONS, FormulationKind, PenaltyUse, Row};
pub use modes::{Mode, Modes};
pub use names::Names;
pub use placed::Place;
pub use precision::PrecisionError;
pub use rest::LeftOut;
pub use run::Outcome;
pub use settings::{Method, ResolvedMethod, SettingsError};
pub use sizes::sizes_at_start;
pub use statics::{Moved, StaticEquilibrium};
pub use stop::{INTERRUPTED, StopError};
pub use tilt::AlmostDependent;

/// What the studies of mbs-study share with this crate, and what its tests call; no part of its interface.
#[doc(hidden)]
pub mod inside {
    pub use crate::changes::OutputRanges;
    pub use crate::channels::Channels;
    pub use crate::driver::{Fixed, Stretch, continue_if, drive};
    pub use crate::energy_alarm::Alarm;
    pub use crate::fingerprint::fingerprint;
    pub use crate::precision::{ReadScene, SceneWork, in_space, not_built_hint};
    pub use crate::ready::AssembledScene;
    pub use crate::ready::rank;
    pub use crate::recorder::RecordRows;
    pub use crate::run::{run_keeping, step};
    pub use crate::settings::DEFAULT_STEP;
    pub use crate::settings::length::{SAME_LENGTH, is_too_long, too_long};
    pub use crate::tilt::notes;

    pub mod tested {
        pub use crate::checkpoint::tape::{Eye, Pen, Tape};
        pub use crate::front::clock::StepClock;
        pub use crate::linear_system::solve::{Factor, divided, product, size};
        pub use crate::linear_system::states::choose;
        pub use crate::motion::pose::{of_axes, smallest};
        pub use crate::motion::principal::principal;
        pub use crate::realtime::document::parts;
    }
}

/// A scene in one scalar and dimension: for those who write generic code.
pub mod typed {
    pub use crate::driver::{StepInputs, StepObserver};
    pub use crate::run::{run, run_kept};
    pub use crate::simulation::Simulation;
}

#[doc = include_str!("../TASKS.md")]
pub mod tasks {}

/// The programs of docs/RUST.md, which packages leave out.
#[cfg(doctest)]
#[doc = include_str!("../../docs/RUST.md")]
mod guide {}
