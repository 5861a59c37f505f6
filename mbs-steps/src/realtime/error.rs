//! Error of the pacing settings of a run.

use crate::methods::FormulationKind;
use mbs_core::formulation::SwitchError;
use mbs_scene::{format::significant, nearest_name};

/// Error of the pacing settings of a run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PacingError {
    /// Invalid time: `period` must be positive and finite, and `awake` must be from 0 to 1 s.
    Time {
        /// Key of the time: `period` or `awake`.
        key: &'static str,
        /// The invalid value [s].
        value: f64,
    },
    /// The quiet time before a return to a better level has zero periods.
    Quiet,
    /// A level names an effect that the scene does not have or that is switched off.
    NoEffect {
        /// Name that the level gives.
        name: String,
        /// Names of the effects that are switched on.
        known: Vec<String>,
    },
    /// The steps cannot be made longer for a degraded level.
    Steps {
        /// True if the step size is controlled; false if a period has too few steps.
        is_controlled: bool,
    },
    /// A level omits an effect that cannot be switched off during the run.
    Fixed {
        /// Name of the effect.
        name: String,
        /// Reason why the effect cannot be switched off.
        why: SwitchError,
    },
    /// No effect that may be omitted saves time, so there is no ladder.
    NoLadder,
}

impl PacingError {
    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Time { key: "period", .. } => {
                "write a number of seconds that is larger than a nanosecond".to_owned()
            }
            Self::Time { .. } => "write a number of seconds from 0 to 1".to_owned(),
            Self::Quiet => "write at least one period".to_owned(),
            Self::NoEffect { name, known } => nearest_name(name, known, "effects that are on"),
            Self::Steps { is_controlled: true } => {
                "name effects, or leave --degrade out".to_owned()
            }
            Self::Steps { .. } => {
                "write a shorter --step, so that a period has more of them, or name effects"
                    .to_owned()
            }
            Self::Fixed { why: SwitchError::Formulation, .. } => {
                let names = FormulationKind::names(|row| row.switches, "or");
                format!("take --formulation {names}, or --degrade steps")
            }
            Self::Fixed { .. } => "name another effect, or write steps".to_owned(),
            Self::NoLadder => {
                "write a shorter --step, name effects with --degrade, or take --overrun finish"
                    .to_owned()
            }
        }
    }
}

impl core::fmt::Display for PacingError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Time { key, value } => write!(f, "{key} cannot be {} s", significant(*value)),
            Self::Quiet => write!(f, "quiet time cannot be no period"),
            Self::NoEffect { name, .. } => {
                write!(f, "degrade: the scene has no effect `{name}` that is on")
            }
            Self::Steps { is_controlled: true } => {
                write!(f, "degrade: steps of controlled length cannot be made longer")
            }
            Self::Steps { .. } => {
                write!(f, "degrade: a period has not steps enough to make them longer")
            }
            Self::Fixed { name, why: SwitchError::Formulation } => {
                write!(f, "degrade: this formulation cannot leave `{name}` out while it runs")
            }
            Self::Fixed { name, .. } => write!(
                f,
                "degrade: `{name}` cannot be left out while the scene runs: coordinates or counted turns depend on it"
            ),
            Self::NoLadder => {
                write!(f, "degrade: nothing that may be left out was measured to save time")
            }
        }
    }
}

impl core::error::Error for PacingError {}
