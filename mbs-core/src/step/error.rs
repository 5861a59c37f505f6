//! Errors that stop a step, and errors of options and inputs.

use crate::FactorError;
#[cfg(feature = "alloc")]
use crate::laws::code::CodeOwner;

/// A step that could not be made. The state is as it was before the step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// The iteration did not converge.
    NotConverged {
        /// Number of iterations made.
        iterations: u32,
        /// Last correction of a coordinate, relative to the scene's length.
        correction: f64,
        /// The unknown that was corrected most.
        unknown: u32,
    },
    /// The tangent matrix lost positive definiteness: a force meets no inertia, or a coordinate is not determined.
    Singular(FactorError),
    /// A number became infinite or NaN.
    NotFinite {
        /// Number of the unknown concerned.
        unknown: u32,
    },
    /// The constraints lost rank: the mechanism stands in (or near) a singular position, or rows repeat each other.
    RankLost {
        /// The row that depends on the others.
        row: u32,
        /// Size of its pivot, relative to what a row of full effect has.
        pivot: f64,
    },
    /// The control of the step needed one too short to matter.
    StepTooSmall {
        /// The step it asked for [s].
        step: f64,
    },
    /// A projection did not reach its level.
    Violated {
        /// 0 position, 1 velocity, 2 acceleration.
        level: u8,
        /// Largest violation that is left.
        violation: f64,
        /// The row that is violated most.
        row: u32,
    },
    /// A step whose length, or whose scene's length, is not positive and finite.
    BadStep {
        /// Length of the step [s].
        dt: f64,
        /// Length of the scene [m].
        length: f64,
    },
    /// An option outside its range.
    BadOption(OptionError),
    /// Numbers in a model's tables point outside of them, or a scratch is not the model's.
    Tables,
    /// A joint turned by more in one step than its position at the end can resolve: its turns would be lost.
    TurnTooLarge {
        /// The joint in the scene.
        joint: u32,
        /// Rate of the joint times the step [rad].
        turn: f64,
    },
    /// An effect that measures a rotation in space has turned by more than its law holds for: a whole turn.
    Overturned {
        /// The effect in the scene.
        effect: u32,
    },
    /// A part of a coupling's line, such as a rope's, has no length left: it has no direction.
    RopeCollapsed {
        /// The coupling in the scene.
        coupling: u32,
        /// The part, from 0 in the order of the coupling's points.
        part: u32,
    },
    /// A disc that rolls lies flat on its plane, where it has no lowest point; or a blade stands along the normal.
    RollingFlat {
        /// The rolling in the scene.
        rolling: u32,
    },
    /// Rows of velocities, as of bodies that roll, in a formulation whose coordinates are independent: more places are free than velocities.
    VelocityRows,
    /// A part of an effect's line, such as an elastic rope's, has no length left while it pulls: it has no direction.
    LineCollapsed {
        /// The effect in the scene.
        effect: u32,
        /// The part, from 0 in the order of the effect's points.
        part: u32,
    },
    /// The axes of a ball are opposite: its twist is open there.
    TwistOpen {
        /// The effect in the scene that is on the twist.
        effect: u32,
    },
    /// A user-defined law with data gave a number that is infinite or NaN.
    #[cfg(feature = "alloc")]
    Law {
        /// The effect in the scene.
        effect: u32,
    },
    /// The user-defined relation of a coupling gave a number that is infinite or NaN.
    #[cfg(feature = "alloc")]
    Relation {
        /// The coupling in the scene.
        coupling: u32,
    },
    /// A guided angle ended at the false root, half a turn from its guide.
    OppositeBranch {
        /// The row of the guide.
        row: u32,
    },
}

/// A value that cannot be set between steps. Nothing is set then.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputError {
    /// There is no such effect or guide, it is switched off, or its values come from the scene.
    NotAnInput {
        /// Number that is no input: of the effect or guide in the scene, of the course or guide in an exported model.
        number: usize,
    },
    /// A component is infinite or NaN.
    NotFinite {
        /// The number of the effect, course or guide.
        number: usize,
        /// The component, from 0.
        component: usize,
    },
}

impl InputError {
    /// Checks that a value is one that can be set.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] names the first component that is not finite.
    pub fn check<T: crate::Real>(number: usize, value: &[T; 3]) -> Result<(), Self> {
        match value.iter().position(|x| !x.is_finite()) {
            Some(component) => Err(Self::NotFinite { number, component }),
            None => Ok(()),
        }
    }
}

impl core::fmt::Display for InputError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotAnInput { number } => write!(
                f,
                "number {number} has no input: give its course or guide as `Input` to set it between steps"
            ),
            Self::NotFinite { number, component } => write!(
                f,
                "component {component} of the input of number {number} is not finite: set a finite value"
            ),
        }
    }
}

impl core::error::Error for InputError {}

impl StepError {
    /// The sentence of an error without numbers.
    const fn sentence(&self) -> Option<&'static str> {
        Some(match self {
            Self::NotFinite { .. } => "a number became infinite or NaN: try a smaller step",
            Self::Tables => "the tables of the model do not fit each other: load it again",
            Self::Overturned { .. } => {
                "the effect is turned by more than a whole turn, where its law ends: give the joint's axis a torsion spring"
            }
            Self::VelocityRows => {
                "bodies that roll restrict velocities, not places, which this formulation has no rows for: take another one"
            }
            Self::RollingFlat { .. } => {
                "the disc lies flat on its plane, where it has no lowest point, or the blade stands on it: end its motion before"
            }
            Self::TwistOpen { .. } => {
                "the ball has swung by half a turn, where its twist is open: hold its swing by a limit"
            }
            #[cfg(feature = "alloc")]
            Self::Law { .. } => {
                "the law of the effect gave a number that is infinite or NaN: give it a finite force, tangent and energy wherever it is asked, or try a smaller step"
            }
            #[cfg(feature = "alloc")]
            Self::Relation { .. } => {
                "the relation of the coupling gave a number that is infinite or NaN: give it finite derivatives wherever it is asked, or try a smaller step"
            }
            Self::OppositeBranch { .. } => {
                "the guided angle jumped half a turn away from its guide: try a smaller step"
            }
            Self::NotConverged { .. }
            | Self::Singular(_)
            | Self::RankLost { .. }
            | Self::StepTooSmall { .. }
            | Self::Violated { .. }
            | Self::BadStep { .. }
            | Self::BadOption(_)
            | Self::TurnTooLarge { .. }
            | Self::RopeCollapsed { .. }
            | Self::LineCollapsed { .. } => return None,
        })
    }
}

impl core::fmt::Display for StepError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if let Some(sentence) = self.sentence() {
            return f.write_str(sentence);
        }
        match self {
            Self::NotConverged { iterations, correction, .. } => write!(
                f,
                "no convergence in {iterations} iterations (last correction {correction:.1e} of the scene's length): try a smaller step"
            ),
            Self::Singular(e) => write!(
                f,
                "the tangent matrix is not positive definite (pivot {:.1e}): a force meets no inertia there, or nothing determines the coordinate; give the body mass or inertia, or try a smaller step",
                e.pivot
            ),
            Self::RankLost { pivot, .. } => write!(
                f,
                "the constraints depend on each other here (relative pivot {pivot:.1e}): redundant joints or a singular position; try a formulation that tolerates them, index-3 or index-1"
            ),
            Self::StepTooSmall { step } => write!(
                f,
                "the control of the step asked for a step of {step:.1e} s: the motion may be stiff or not smooth here; try a looser tolerance or another integrator"
            ),
            Self::Violated { level, violation, .. } => {
                let name = ["positions", "velocities", "accelerations"][usize::from(*level).min(2)];
                write!(
                    f,
                    "the projection left {name} violated by {violation:.1e}: the mechanism may stand in a singular position or lock; try a smaller step or another penalty"
                )
            }
            Self::BadStep { dt, length } => write!(
                f,
                "a step of {dt:e} s in a scene of {length:e} m cannot be made: both must be positive and finite"
            ),
            Self::BadOption(error) => error.fmt(f),
            Self::TurnTooLarge { turn, .. } => write!(
                f,
                "the joint turns by {turn:.1} rad in one step, more than its position determines: make the step shorter"
            ),
            Self::RopeCollapsed { part, .. } | Self::LineCollapsed { part, .. } => write!(
                f,
                "part {} of the rope has no length left, so that its direction is not known: end its motion before, by a limit or a bumper",
                part + 1
            ),
            // has a sentence
            _ => Ok(()),
        }
    }
}

impl core::error::Error for StepError {}

#[cfg(feature = "alloc")]
impl From<CodeOwner> for StepError {
    fn from(failed: CodeOwner) -> Self {
        match failed {
            CodeOwner::Effect(effect) => Self::Law { effect },
            CodeOwner::Coupling(coupling) => Self::Relation { coupling },
        }
    }
}

impl From<FactorError> for StepError {
    fn from(error: FactorError) -> Self {
        Self::Singular(error)
    }
}

impl From<OptionError> for StepError {
    fn from(error: OptionError) -> Self {
        Self::BadOption(error)
    }
}

/// An option outside its range, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OptionError {
    /// Must be positive and finite.
    NotPositive(&'static str),
    /// Must be finite and not negative.
    Negative(&'static str),
    /// The combination is not built.
    NotBuilt(&'static str),
}

impl core::fmt::Display for OptionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotPositive(name) => write!(f, "option `{name}` must be positive and finite"),
            Self::Negative(name) => write!(f, "option `{name}` must be finite and not negative"),
            Self::NotBuilt(name) => write!(f, "option `{name}`: this combination is not built"),
        }
    }
}

impl core::error::Error for OptionError {}
