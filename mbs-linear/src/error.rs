//! Errors of the search for an equilibrium and of the linearisation.

use mbs_core::step::OptionError;

/// Reason why a search for an equilibrium failed. The state is unchanged.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// An option is out of range.
    Option(OptionError),
    /// The forces could not be balanced.
    NotConverged {
        /// Largest remaining force [N or N m].
        residual: f64,
        /// The coordinate on which the force acts.
        unknown: u32,
    },
    /// Newton's method leads from the state to no equilibrium.
    NotNear,
    /// The states of integrals or lags among the signals do not come to rest.
    SignalsMove,
    /// Nothing holds the mechanism: it moved by more than a million times the scene's length.
    Escapes {
        /// The coordinate with the largest displacement.
        unknown: u32,
    },
    /// The constraints could not be closed near the state.
    NotClosed {
        /// Largest violation [m or rad].
        violation: f64,
        /// The row with the largest violation.
        row: u32,
    },
    /// A coordinate without mass that neither constraints nor forces determine.
    Undetermined {
        /// The unknown of the saddle system: a coordinate, or a row if it is n or larger.
        unknown: u32,
    },
    /// A force became infinite or not a number.
    NotFinite {
        /// The coordinate on which the force acts.
        unknown: u32,
    },
}

impl core::fmt::Display for EquilibriumError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Option(error) => write!(f, "{error}"),
            Self::NotConverged { residual, .. } => write!(
                f,
                "no equilibrium was found: a force of {residual:.3e} N (or N m) is left; start nearer to it"
            ),
            Self::NotNear => write!(
                f,
                "no equilibrium was found near the start; start nearer to it, or let the search go down"
            ),
            Self::SignalsMove => write!(
                f,
                "no equilibrium was found: an integral or a lag among the signals does not come to rest; let it measure what it drives, or take it out"
            ),
            Self::Escapes { .. } => write!(
                f,
                "no equilibrium was found: nothing holds the mechanism against its forces; hold it by a joint or a spring"
            ),
            Self::NotClosed { violation, .. } => write!(
                f,
                "the joints could not be closed: {violation:.3e} m (or rad) is left; start from an assembled state"
            ),
            Self::Undetermined { .. } => write!(
                f,
                "a coordinate has no mass, and neither joints nor forces determine it; give its body mass and inertia"
            ),
            Self::NotFinite { .. } => {
                write!(f, "a force became infinite or not a number; check the data of the effects")
            }
        }
    }
}

impl core::error::Error for EquilibriumError {}

impl From<OptionError> for EquilibriumError {
    fn from(error: OptionError) -> Self {
        Self::Option(error)
    }
}

/// Reason why a linearisation failed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum LinearError {
    /// An option is out of range.
    Option(OptionError),
    /// The state, or one within a difference of it, does not satisfy the constraints.
    NotClosed {
        /// Largest violation [m or rad].
        violation: f64,
    },
    /// A singular position is close: the displacement that closes the constraints is as large as the change of a coordinate in the
    /// difference.
    Singular {
        /// The independent coordinate that was changed.
        freedom: usize,
    },
    /// Accelerations do not follow from the forces, because a force acts on a coordinate without inertia.
    NoInertia {
        /// The unknown of the saddle system: a coordinate, or a row if it is n or larger.
        unknown: u32,
    },
    /// Accelerations near the state cannot be made to satisfy the constraints, because rows nearly depend on each other.
    NotSettled {
        /// Largest violation of the constraints by accelerations [m/s^2].
        left: f64,
    },
    /// A force became infinite or not a number.
    NotFinite,
    /// An output is infinite or not a number at the state or near it.
    Output {
        /// Index of the output among the measured values.
        output: usize,
    },
    /// Rolling bodies are in motion. They have more free positions than free velocities, so that a difference would drift.
    Rolls,
}

impl core::fmt::Display for LinearError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Option(error) => write!(f, "{error}"),
            Self::NotClosed { violation } => write!(
                f,
                "the joints stay open by {violation:.3e} m (or rad) at the state or next to it; start from an assembled state, away from singular positions"
            ),
            Self::Singular { .. } => write!(
                f,
                "the state is a singular position, or nearly: its branches have no common linearisation; move away from it"
            ),
            Self::Rolls => write!(
                f,
                "bodies that roll are in motion, where more places are free than velocities: linearise about a rest"
            ),
            Self::NoInertia { .. } => write!(
                f,
                "a force meets no inertia: a coordinate is neither determined by joints nor has mass; give its body mass and inertia"
            ),
            Self::NotSettled { left } => write!(
                f,
                "accelerations miss the joints by {left:.3e} m/s^2: joints nearly repeat each other; leave one of them out"
            ),
            Self::NotFinite => {
                write!(f, "a force became infinite or not a number; check the data of the effects")
            }
            Self::Output { output } => write!(
                f,
                "number {output} of what is measured is infinite or not a number; leave it out"
            ),
        }
    }
}

impl core::error::Error for LinearError {}

impl From<OptionError> for LinearError {
    fn from(error: OptionError) -> Self {
        Self::Option(error)
    }
}
