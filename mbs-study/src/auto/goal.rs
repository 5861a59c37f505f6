//! Requirements of a run: an error, a deadline, or both, and reasons to refuse them.

use core::fmt::{self, Display, Formatter};
use mbs::{Goal, Method, Precision, SimulationError};

/// Target of the choice, relative to the required error [-]: the margin covers errors of the predictions.
const AIM: f64 = 0.7;
/// Target error with a deadline alone [-]: outputs are printed with six digits, so a smaller error is useless.
pub(super) const ACCURATE: f64 = 1e-6;

/// Target of a run: its error and its deadline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PilotTarget {
    /// Error of the outputs.
    pub error: f64,
    /// Length of a frame [s]. The steps of each frame must be computed in at most this time.
    pub deadline: Option<f64>,
}

impl PilotTarget {
    pub(super) fn of(goal: &Goal) -> Self {
        Self { error: goal.error.unwrap_or(ACCURATE), deadline: goal.deadline }
    }

    /// Error for which settings are chosen. It is smaller than the required error.
    pub(crate) fn aim(&self) -> f64 {
        AIM * self.error
    }
}

/// Reason why a goal is refused.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum GoalError {
    /// Error that is not between 0 and 1.
    Error(f64),
    /// Error below the resolution of the run's numbers: the error, and their precision.
    TooFine(f64, Precision),
    /// Deadline that is not positive and finite.
    Deadline(f64),
    /// Deadline longer than the run: deadline and duration [s].
    TooLong(f64, f64),
    /// Name of an option that the caller has set although the choice decides it.
    Chosen(&'static str),
    /// Deadline although all allowed integrators have their own step control. The time of their steps has no bound.
    OwnSteps,
    /// Options that leave no method to choose from.
    NoCandidate,
    /// Difference of the chosen method from a method in other coordinates, relative to the ranges of the outputs.
    Differs(f64),
}

/// Options that the choice decides, each with a test whether the caller has set it.
type Given = (&'static str, fn(&Method) -> bool);
const DECIDED: [Given; 6] = [
    ("--step", |o| o.step.is_some()),
    ("--step-max", |o| o.step_max.is_some()),
    ("--step-control", |o| o.step_control.is_some()),
    ("--energy-tolerance", |o| o.energy_tolerance.is_some()),
    ("--error-tolerance", |o| o.error_tolerance.is_some()),
    ("--tolerance", |o| o.tolerance.is_some()),
];

/// Checks a goal together with the other options, for a run of `duration` [s] in a precision.
///
/// # Errors
/// [`GoalError`].
pub fn check_goal(
    goal: &Goal,
    overrides: &Method,
    (duration, precision): (f64, Precision),
) -> Result<(), GoalError> {
    if let Some(error) = goal.error.filter(|e| !(*e > 0.0 && *e < 1.0)) {
        return Err(GoalError::Error(error));
    }
    if let Some(error) = goal.error.filter(|e| *e < finest(precision)) {
        return Err(GoalError::TooFine(error, precision));
    }
    if let Some(deadline) = goal.deadline {
        if !(deadline > 0.0 && deadline.is_finite()) {
            return Err(GoalError::Deadline(deadline));
        }
        if deadline > duration {
            return Err(GoalError::TooLong(deadline, duration));
        }
    }
    match DECIDED.into_iter().find(|(_, is_given)| is_given(overrides)) {
        Some((option, _)) => Err(GoalError::Chosen(option)),
        None => Ok(()),
    }
}

/// Parses a time with or without a unit: `0.001`, `1ms`, `500us`, `2s` [s].
///
/// # Errors
/// Message with the accepted form of a time.
pub fn time(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let units = [("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9), ("s", 1.0)];
    let unit = units.into_iter().find_map(|(unit, size)| Some((text.strip_suffix(unit)?, size)));
    let (number, size) = unit.unwrap_or((text, 1.0));
    number.trim().parse::<f64>().map(|x| x * size).map_err(|_| {
        "write seconds, or a number with s, ms or us, such as 0.001, 1ms or 500us".to_owned()
    })
}

/// Relative distance of neighbouring numbers of a precision. No method resolves smaller errors.
fn finest(precision: Precision) -> f64 {
    match precision {
        Precision::F32 => f64::from(f32::EPSILON),
        Precision::F64 => f64::EPSILON,
        Precision::DoubleDouble => f64::EPSILON * f64::EPSILON,
    }
}

impl GoalError {
    /// Returns a hint at what to do about the error.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::TooFine(_, Precision::F32) => "write 1e-6 or more, or leave --precision out",
            Self::TooFine(..) => {
                "write 1e-13 or more; runs with more digits are those of --precision dd, with --integrator gbs and a --tolerance"
            }
            Self::Error(_) => {
                "write an error relative to each output's range, more than 0 and less than 1, such as 1e-4"
            }
            Self::Deadline(_) => "write a time longer than zero, such as 1ms",
            Self::TooLong(..) => "write a shorter deadline, or a longer --duration",
            Self::Chosen(_) => {
                "leave it out: it is chosen for the required error or the deadline; --formulation, --integrator and --precision narrow the choice"
            }
            Self::OwnSteps => "leave --integrator out, or take rk4 or an implicit one",
            Self::NoCandidate => "leave --formulation or --integrator out",
            Self::Differs(_) => {
                "one of the two is wrong: run it with --formulation index-3 and with --formulation recursive, and report the scene"
            }
        }
    }
}

impl Display for GoalError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let few = mbs_scene::format::few;
        match self {
            Self::Error(x) => {
                write!(
                    f,
                    "the required error must be more than 0 and less than 1, but is {}",
                    few(*x)
                )
            }
            Self::TooFine(x, precision) => write!(
                f,
                "the required error of {x:e} is below the resolution of {}: neighbouring numbers differ by {:.1e}",
                precision.name(),
                finest(*precision)
            ),
            Self::Deadline(x) => {
                write!(f, "the deadline must be a time longer than zero, but is {} s", few(*x))
            }
            Self::TooLong(deadline, duration) => write!(
                f,
                "the deadline of {} s is longer than the run of {} s",
                few(*deadline),
                few(*duration)
            ),
            Self::Chosen(option) => {
                write!(f, "{option} cannot be given beside --error or --deadline")
            }
            Self::OwnSteps => {
                write!(
                    f,
                    "rk54, rk853, gbs and radau5 choose their own steps: no deadline can be kept with them"
                )
            }
            Self::NoCandidate => {
                write!(f, "no method goes with this formulation and this integrator")
            }
            Self::Differs(apart) => write!(
                f,
                "relative and natural coordinates disagree by {} of an output's range, more than both can err by",
                few(*apart)
            ),
        }
    }
}

impl core::error::Error for GoalError {}

impl From<GoalError> for SimulationError {
    fn from(error: GoalError) -> Self {
        Self::new("goal-refused", &error, error.hint()).with_cause(error)
    }
}
