//! Errors of steps, options and inputs.

use crate::FactorError;
#[cfg(feature = "alloc")]
use crate::laws::code::CodeOwner;

/// Error of a step that failed. The state is as it was before the step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// Newton's iteration did not converge.
    NotConverged {
        /// Number of iterations made.
        iterations: u32,
        /// Last correction of a coordinate, relative to the scene's length.
        correction: f64,
        /// Index of the unknown with the largest correction.
        unknown: u32,
    },
    /// The tangent matrix is not positive definite: a force acts on a coordinate without inertia, or nothing determines a coordinate.
    Singular(FactorError),
    /// A number became infinite or NaN.
    NotFinite {
        /// Index of the unknown concerned.
        unknown: u32,
    },
    /// The constraints lost rank: the mechanism is in or close to a singular position, or rows are redundant.
    RankLost {
        /// Index of the row that depends on the others.
        row: u32,
        /// Size of its pivot, relative to that of an independent row.
        pivot: f64,
    },
    /// The step-size control required a step that is too short.
    StepTooSmall {
        /// Length of the required step [s].
        step: f64,
    },
    /// A projection did not reach its required accuracy.
    Violated {
        /// Level of the projection: 0 position, 1 velocity, 2 acceleration.
        level: u8,
        /// Largest violation that remains.
        violation: f64,
        /// Index of the row with the largest violation.
        row: u32,
    },
    /// The length of the step or of the scene is not positive and finite.
    BadStep {
        /// Length of the step [s].
        dt: f64,
        /// Length of the scene [m].
        length: f64,
    },
    /// An option is outside its range.
    BadOption(OptionError),
    /// Indices in a model's tables are out of range, or a scratch belongs to another model.
    Tables,
    /// A joint rotated by more in one step than its position at the end can resolve, so that its turns are unknown.
    TurnTooLarge {
        /// Index of the joint in the scene.
        joint: u32,
        /// Rate of the joint times the step [rad].
        turn: f64,
    },
    /// An effect that measures a rotation in space has rotated by a whole turn, where its law is not defined.
    Overturned {
        /// Index of the effect in the scene.
        effect: u32,
    },
    /// A part of a coupling's line, such as a rope, has zero length and therefore no direction.
    RopeCollapsed {
        /// Index of the coupling in the scene.
        coupling: u32,
        /// Index of the part, from 0 in the order of the coupling's points.
        part: u32,
    },
    /// A rolling disc lies flat on its plane, where it has no lowest point, or a blade is parallel to the normal.
    RollingFlat {
        /// Index of the rolling contact in the scene.
        rolling: u32,
    },
    /// The formulation has independent coordinates, but the model has velocity rows, as for rolling bodies. Such rows restrict
    /// velocities, but no coordinates.
    VelocityRows,
    /// A part of an effect's line, such as an elastic rope, has zero length under tension and therefore no direction.
    LineCollapsed {
        /// Index of the effect in the scene.
        effect: u32,
        /// Index of the part, from 0 in the order of the effect's points.
        part: u32,
    },
    /// The axes of a ball are opposite, where its twist is undefined.
    TwistOpen {
        /// Index of the effect on the twist in the scene.
        effect: u32,
    },
    /// A user-defined law with data returned a number that is infinite or NaN.
    #[cfg(feature = "alloc")]
    Law {
        /// Index of the effect in the scene.
        effect: u32,
    },
    /// The user-defined relation of a coupling returned a number that is infinite or NaN.
    #[cfg(feature = "alloc")]
    Relation {
        /// Index of the coupling in the scene.
        coupling: u32,
    },
    /// A guided angle is half a turn from its guide, at the false root of the constraint.
    OppositeBranch {
        /// Index of the row of the guide.
        row: u32,
    },
}

/// Error of a value that cannot be set between steps. The inputs are then unchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputError {
    /// The effect, guide or signal does not exist, is disabled, or gets its values from the scene.
    NotAnInput {
        /// Index of the effect, guide or signal in the scene, or of the signal or guide in an exported model.
        number: usize,
    },
    /// A component is infinite or NaN.
    NotFinite {
        /// Index of the effect, guide or signal.
        number: usize,
        /// Index of the component, from 0.
        component: usize,
    },
}

impl InputError {
    /// Checks that all components of a value are finite.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] with the first component that is not finite.
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
    /// Message of an error whose message contains no numbers; `None` for other errors.
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
            // has a sentence above
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

/// Error for an option outside its range. It contains the name of the option.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OptionError {
    /// The option must be positive and finite.
    NotPositive(&'static str),
    /// The option must be finite and not negative.
    Negative(&'static str),
    /// The combination of options is not implemented.
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
