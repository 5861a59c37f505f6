#![doc = include_str!("../README.md")]

mod front;
pub mod results;

use mbs_steps::{
    checkpoint, choice, equilibrium, erased, fingerprint, interrupt, linear_system, methods, modes,
    names, placed, precision, rest, run, settings, sizes, statics, stop, tilt, tree,
};
pub use mbs_steps::{export, folder, realtime, record, typed, words};

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
pub use equilibrium::{Search, equilibrium_start, find_equilibrium};
pub use front::{
    Body, BodyMotion, Components, ContactEvent, Coordinates, Coupling, Effect, Energies,
    EquilibriumOptions, Error, FunctionId, Goal, Guide, Id, InitialCondition, InputId, InputInfo,
    InputOwner, InputTable, InputTableError, Joint, Mechanism, NamedSignal, Observer, Output,
    OutputFunction, Part, PathError, PointMotion, Pose, Rolling, Run, RunConflict, RunInputs,
    RunResult, SceneError, Simulation, SimulationError, Sizes, Snapshot, StepReport, Table,
    UnknownName, View, Watchers, Wrench, equilibrium, linearize, linearize_at, linearize_frozen,
    linearize_frozen_at, linearize_steady, linearize_steady_at, modes, run, run_with,
};
pub use interrupt::Interrupt;
pub use linear_system::{LinearSystem, LinearizeOptions, ModeShape, Unsteady};
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
pub use mbs_steps::tree::{
    AccelerationDerivatives, EffortDerivatives, FrameMotion, FrameTarget, InverseKinematics,
    InverseKinematicsEnd, Matrix, Rollout, RolloutEnd, TotalMomentum, Tree, TreeError,
    TreeErrorKind, TreeRange,
};
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

/// Items for the studies of mbs-study and for tests; they are no part of the crate's interface.
#[doc(hidden)]
pub mod inside {
    pub use crate::front::prepared::PreparedRun;
    pub use mbs_steps::at_state::{Gradient, gradients, poses};
    pub use mbs_steps::changes::OutputRanges;
    pub use mbs_steps::channels::Channels;
    pub use mbs_steps::driver::{Fixed, Stretch, continue_if, drive_simulation as drive};
    pub use mbs_steps::energy_alarm::Alarm;
    pub use mbs_steps::fingerprint::fingerprint;
    pub use mbs_steps::peak::turning_point;
    pub use mbs_steps::precision::{ReadScene, SceneWork, in_space, not_built_hint};
    pub use mbs_steps::ready::AssembledScene;
    pub use mbs_steps::ready::constraint_rank as rank;
    pub use mbs_steps::run::step;
    pub use mbs_steps::settings::DEFAULT_STEP;
    pub use mbs_steps::settings::length::{SAME_LENGTH, is_too_long, too_long};
    pub use mbs_steps::stiffness::shortest_period;
    pub use mbs_steps::tilt::notes;

    pub mod tested {
        pub use mbs_steps::checkpoint::tape::{Eye, Pen, Tape};
        pub use mbs_steps::erased::clock::StepClock;
        pub use mbs_steps::linear_system::solve::{Factor, divided, product, size};
        pub use mbs_steps::linear_system::states::choose;
        pub use mbs_steps::motion::pose::{of_axes, smallest};
        pub use mbs_steps::motion::principal::principal;
        pub use mbs_steps::realtime::run::parts;
    }
}

#[doc = include_str!("../TASKS.md")]
pub mod tasks {}

/// Example programs of docs/RUST.md, compiled as tests; published packages do not contain them.
#[cfg(doctest)]
#[doc = include_str!("../../docs/RUST.md")]
mod guide {}
