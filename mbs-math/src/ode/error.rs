//! Errors that end an integration before its end time.

/// An integration that stopped early. The state is the last accepted state, at `time`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum OdeError<E> {
    /// The rates, or the hook after a step, failed.
    Rates {
        /// Time of the last accepted state [s].
        time: f64,
        /// Error of the rates or the hook.
        error: E,
    },
    /// No step above the rounding of the time satisfies the tolerance.
    StepTooSmall {
        /// Time of the last accepted state [s].
        time: f64,
        /// Step that would have been tried next [s].
        step: f64,
    },
    /// The steps that one call may try are used up, or the remaining time would need more than ten times as many.
    TooManySteps {
        /// Time of the last accepted state [s].
        time: f64,
        /// Number of steps tried.
        steps: u32,
    },
}

impl<E: core::fmt::Display> core::fmt::Display for OdeError<E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Rates { time, error } => write!(f, "{error} (after t = {time} s)"),
            Self::StepTooSmall { time, step } => write!(
                f,
                "no step down to {step:.1e} s meets the tolerance after t = {time} s: a rate is not finite or jumps there, or the tolerance is below rounding"
            ),
            Self::TooManySteps { time, steps } => write!(
                f,
                "{steps} steps were not enough, t = {time} s is reached: the system is stiff for an explicit method, or the tolerance is very small"
            ),
        }
    }
}

impl<E: core::error::Error + 'static> core::error::Error for OdeError<E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Rates { error, .. } => Some(error),
            _ => None,
        }
    }
}
