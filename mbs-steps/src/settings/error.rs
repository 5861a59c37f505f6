//! Errors of settings, with hints for the user.

use super::length::{self, MOST_STEPS};
use crate::choice::Precision;
use crate::methods::FormulationKind;
use crate::precision::{PrecisionError, not_built_hint};
use mbs_core::scene::SceneError;
use mbs_scene::format::significant;

/// Error of a setting of a run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// Name that is unknown or not available in this build.
    NotBuilt {
        /// Key of the setting.
        key: &'static str,
        /// Value that was requested.
        value: String,
        /// Names that are available.
        built: &'static [&'static str],
        /// True if the scene requests the value, false if the caller does.
        from_scene: bool,
    },
    /// A precision that this build does not have.
    NotInBuild(Precision),
    /// A number that must be positive and finite.
    NotPositive {
        /// Key of the setting.
        key: &'static str,
        /// Value of the setting.
        value: f64,
    },
    /// Limits U and L of the energy rule of which the first is not larger than the second.
    LimitOrder([f64; 2]),
    /// Formulation and option that cannot be combined.
    NotTogether {
        /// Formulation that does not support the option.
        formulation: FormulationKind,
        /// Option that the formulation does not support.
        option: String,
    },
    /// The scene is not valid for a run of this duration.
    Scene(SceneError),
    /// A step of fixed length that is longer than the run.
    StepTooLong {
        /// Length of a step [s].
        step: f64,
        /// Duration of the run [s].
        duration: f64,
    },
    /// The step is so short that the number of steps exceeds its limit.
    TooManySteps {
        /// Length of a step [s].
        step: f64,
        /// Duration of the run [s].
        duration: f64,
    },
}

impl SettingsError {
    /// Key of the setting that the error concerns; `None` if the error concerns no setting.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::NotBuilt { key, .. } | Self::NotPositive { key, .. } => Some(key),
            Self::NotInBuild(_) => Some("precision"),
            Self::NotTogether { option, .. } => option.split(' ').next(),
            Self::TooManySteps { .. } | Self::StepTooLong { .. } => Some("step"),
            Self::LimitOrder(_) | Self::Scene(_) => None,
        }
    }

    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::NotBuilt { value, built, .. } => mbs_scene::nearest_name(value, built, "built are"),
            Self::NotInBuild(precision) => not_built_hint(*precision),
            Self::NotPositive { .. } => "write a number larger than zero".to_owned(),
            Self::LimitOrder(_) => "write the larger one first: U, then L".to_owned(),
            Self::NotTogether { option, .. } if option.starts_with("step control") => {
                "rk54, rk853, gbs and radau5 control their own step by --tolerance; the others need an implicit one-step rule"
                    .to_owned()
            }
            Self::NotTogether { option, .. } if option == "threads" => {
                let names = FormulationKind::names(|row| row.threads, "and");
                format!("threads share the steps of {names}")
            }
            Self::NotTogether { option, .. } if option == "penalty" => {
                "leave the penalty out".to_owned()
            }
            Self::NotTogether { .. } => {
                let name = FormulationKind::RELATIVE.name();
                format!("rk4, rk54, rk853, gbs and radau5 need formulation `{name}`")
            }
            Self::TooManySteps { .. } => "write a longer step, or a shorter duration".to_owned(),
            Self::Scene(error) => error.fault.advice().to_owned(),
            Self::StepTooLong { duration, .. } => {
                format!("write a step of {} s at most, or a longer duration", significant(*duration))
            }
        }
    }
}

impl core::fmt::Display for SettingsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotBuilt { key, value, .. } => write!(f, "unknown {key} `{value}`"),
            Self::NotInBuild(precision) => PrecisionError::NotBuilt(*precision).fmt(f),
            Self::NotPositive { key, value } => {
                write!(f, "{key} must be positive and finite, but is {}", significant(*value))
            }
            Self::LimitOrder([upper, lower]) => write!(
                f,
                "energy_tolerance: U must be larger than L, but U is {} and L is {}",
                significant(*upper),
                significant(*lower)
            ),
            Self::NotTogether { formulation, option } => {
                write!(f, "formulation `{}` has no `{option}`", formulation.name())
            }
            Self::Scene(SceneError { entry, field, fault }) => {
                write!(f, "`{field}` of {entry} {fault:#}")
            }
            Self::StepTooLong { step, duration } => {
                f.write_str(&length::too_long(*step, *duration))
            }
            Self::TooManySteps { step, duration } => write!(
                f,
                "a step of {} s is too short for a run of {} s: more than {MOST_STEPS:e} steps",
                significant(*step),
                significant(*duration)
            ),
        }
    }
}

impl core::error::Error for SettingsError {}
