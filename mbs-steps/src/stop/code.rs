//! Error codes of the reasons why a run stopped.

use super::{INTERRUPTED, StopError};
use mbs_core::start::AssemblyError;
use mbs_core::step::StepError;

impl StopError {
    /// Error code of the stop reason, a constant word for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Start(AssemblyError::Model(_)) => "no-model",
            Self::Start(AssemblyError::Position { .. } | AssemblyError::NotLeast { .. }) => {
                "cannot-assemble"
            }
            Self::Start(AssemblyError::Velocity { .. }) => "contradicting-velocities",
            Self::Start(AssemblyError::NoInertia { .. }) => "no-inertia",
            Self::Start(_) => "no-accelerations",
            Self::Step(StepError::NotConverged { .. }, _) => "not-converged",
            Self::Step(StepError::Singular(_), _) => "singular-matrix",
            Self::Step(StepError::NotFinite { .. }, _) => "not-finite",
            Self::Step(StepError::Violated { .. }, _) => "violated",
            Self::Step(StepError::OppositeBranch { .. }, _) => "opposite-branch",
            Self::Step(StepError::RankLost { .. }, _) => "rank-lost",
            Self::Step(StepError::StepTooSmall { .. }, _) => "step-too-small",
            Self::Step(StepError::TurnTooLarge { .. }, _) => "turn-too-large",
            Self::Step(StepError::Overturned { .. }, _) => "overturned",
            Self::Step(StepError::RollingFlat { .. }, _) => "rolling-flat",
            Self::Step(StepError::VelocityRows, _) => "velocity-rows",
            Self::Step(StepError::RopeCollapsed { .. } | StepError::LineCollapsed { .. }, _) => {
                "rope-collapsed"
            }
            Self::Step(StepError::TwistOpen { .. }, _) => "twist-open",
            Self::Step(StepError::Law { .. }, _) => "law-not-finite",
            Self::Step(StepError::Relation { .. }, _) => "relation-not-finite",
            Self::Step(..) => "step-failed",
            Self::AlmostDependent(_) => "almost-dependent",
            Self::Reaction(_) => "no-reactions",
            Self::Tree(..) => "no-tree",
            Self::Friction { .. } => "friction-not-resolved",
            Self::Energy { .. } => "energy-drift",
            Self::Output { .. } => "output-not-finite",
            Self::Equilibrium(..) => "no-equilibrium",
            Self::Linear(_) => "no-linearisation",
            Self::NotSteady(_) => "not-steady",
            Self::Eigenvalues => "no-eigenvalues",
            Self::NoThreads(_) => "no-threads",
            Self::NotBuilt => "precision-not-built",
            Self::Interrupted => INTERRUPTED,
            Self::Observer { code, .. } => code,
        }
    }
}
