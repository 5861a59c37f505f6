//! Main interface of the crate: a mechanism as a list of named parts, made in code or read from a file.

mod conflict;
mod held;
mod mechanism;
mod options;
mod part;
pub(crate) mod prepared;
mod relative;
mod result;
mod run;
mod simulate;
mod simulation;
mod study;
mod table;

use crate::erased::{error, failure, function, inner, inputs, seen, values, view};
use crate::tree;

pub use crate::erased::input_table::{InputTable, InputTableError};
pub use conflict::RunConflict;
pub use error::{Error, PathError, SceneError, UnknownName};
pub use failure::SimulationError;
pub use function::{FunctionId, OutputFunction};
pub use inputs::{InputId, InputInfo, InputOwner};
pub use mechanism::Mechanism;
pub use options::{Goal, Run, Watchers};
pub use part::{Id, Part};
pub use result::RunResult;
pub use run::{run, run_with};
pub use simulation::{Simulation, Snapshot};
pub use study::{
    EquilibriumOptions, equilibrium, linearize, linearize_at, linearize_frozen,
    linearize_frozen_at, linearize_steady, linearize_steady_at, modes,
};
pub use table::Table;
pub use values::{
    BodyMotion, Components, ContactEvent, Coordinates, Energies, PointMotion, Pose, Sizes,
    StepReport, Wrench,
};
pub use view::{Observer, RunInputs, View};

use mbs_core::scene;
use mbs_core::scene::Number;

/// A rigid body.
pub type Body = scene::Body<Number>;
/// A joint between two bodies.
pub type Joint = scene::Joint<Number>;
/// Condition that holds exactly at the start.
pub type InitialCondition = scene::InitialCondition<Number>;
/// Prescribed motion of a joint coordinate.
pub type Guide = scene::Guide<Number>;
/// Coupling: a constraint on a sum of joint coordinates and lengths.
pub type Coupling = scene::Coupling<Number>;
/// Rolling contact without slip, or a blade.
pub type Rolling = scene::Rolling<Number>;
/// Named function of time, which guides, couplings and effects can follow.
pub type NamedSignal = scene::NamedSignal<Number>;
/// Effect: a force, a spring, friction, a tire and so on.
pub type Effect = scene::Effect<Number>;
/// A quantity that is recorded.
pub type Output = scene::Output<Number>;
