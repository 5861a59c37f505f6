//! Error and CPU time of a method as powers of its setting, and the setting for a required error.
//!
//! ```text
//! error ~ setting^a,   CPU time ~ setting^-b
//! ```

use super::trial::Trial;
use crate::compare::method::MethodCase;

/// Range of the measured exponent of the error, relative to the theoretical one [-]. Beyond it, the motion was not resolved, or an error was
/// small by chance.
pub(super) const ERROR_RANGE: [f64; 2] = [0.5, 1.25];
/// Range of the measured exponent of the CPU time, relative to the theoretical one [-]. It may be small where steps must end at the instants
/// of the results, whatever the tolerance.
const COST_RANGE: [f64; 2] = [0.25, 1.25];
/// Fraction below which a number is negligible beside another [-]. It limits four ratios: a trial's error over its distance from a coarser
/// trial; the additional steps of a finer trial over its steps; the best trial's error over the required error; and a tolerance over that of
/// the trial before.
pub(super) const SMALL: f64 = 0.1;

/// Exponents of a method: its error and its CPU time are powers of its setting. The setting is the step or the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Exponent a of the error.
    pub error: f64,
    /// Exponent b of the CPU time, with its sign reversed.
    pub cost: f64,
}

impl PowerLaw {
    /// Returns the theoretical exponents of a method.
    pub fn of(method: &MethodCase) -> Self {
        Self { error: method.order() * method.cost(), cost: method.cost() }
    }

    /// Returns the exponents that two trials show, limited to their ranges.
    fn between(self, coarse: &Point, fine: &Point) -> Self {
        let span = (coarse.setting / fine.setting).ln();
        let within = |measured: f64, theory: f64, [least, most]: [f64; 2]| {
            let ratio = measured / span / theory;
            if ratio.is_nan() { theory } else { ratio.clamp(least, most) * theory }
        };
        Self {
            error: within((coarse.error / fine.error).ln(), self.error, ERROR_RANGE),
            cost: within((fine.seconds / coarse.seconds).ln(), self.cost, COST_RANGE),
        }
    }
}

/// Completed trial with a known error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Setting: the step [s] or the tolerance.
    pub setting: f64,
    /// Error of the outputs.
    pub error: f64,
    /// CPU time of the trial [s].
    pub seconds: f64,
    /// Number of steps of the trial.
    pub steps: u64,
}

/// Basis of a prediction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Basis {
    /// Measurement by a trial with this setting.
    Tried,
    /// Interpolation between trials with a larger and a smaller error.
    Between,
    /// Extrapolation beyond the trials by the power law. The number is the error of the nearest trial, divided by the required error.
    Beyond(f64),
    /// Theoretical order of the method, without trials close to the error.
    Theory,
}

/// Prediction of error and CPU time for a setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Setting: the step [s] or the tolerance.
    pub setting: f64,
    /// Error of the outputs.
    pub error: f64,
    /// Predicted CPU time [s].
    pub seconds: f64,
    /// Basis of the prediction.
    pub basis: Basis,
}

impl Prediction {
    pub(crate) fn of_trial(point: &Point) -> Self {
        let Point { setting, error, seconds, .. } = *point;
        Self { setting, error, seconds, basis: Basis::Tried }
    }
}

/// Predicts the setting for an error. The setting is no coarser than `coarsest`. `points` are trials sorted by setting, the coarsest first.
pub fn predict(
    theory: PowerLaw,
    points: &[Point],
    error: f64,
    coarsest: f64,
) -> Option<Prediction> {
    let (from, law) = match points.iter().position(|p| p.error <= error) {
        None => {
            let last = points.last()?;
            let before = points.len().checked_sub(2).map(|i| &points[i]);
            (last, before.map_or(theory, |before| theory.between(before, last)))
        }
        Some(0) => {
            (&points[0], points.get(1).map_or(theory, |fine| theory.between(&points[0], fine)))
        }
        Some(i) => return Some(interpolated(&points[i - 1], &points[i], error)),
    };
    let setting = (from.setting * (error / from.error).powf(1.0 / law.error)).min(coarsest);
    Some(extended(from, law, setting))
}

/// Extrapolates error and CPU time from a trial to another setting by the power law.
pub(crate) fn extended(from: &Point, law: PowerLaw, setting: f64) -> Prediction {
    let ratio = setting / from.setting;
    let times = ratio.powf(law.error);
    Prediction {
        setting,
        error: from.error * times,
        seconds: from.seconds * ratio.powf(-law.cost),
        basis: if (ratio - 1.0).abs() > 0.0 { Basis::Beyond(1.0 / times) } else { Basis::Tried },
    }
}

fn interpolated(coarse: &Point, fine: &Point, error: f64) -> Prediction {
    let share = (coarse.error / error).ln() / (coarse.error / fine.error).ln();
    let mean = |a: f64, b: f64| (a.ln() + share * (b.ln() - a.ln())).exp();
    Prediction {
        setting: mean(coarse.setting, fine.setting),
        error,
        seconds: mean(coarse.seconds, fine.seconds),
        basis: Basis::Between,
    }
}

/// Estimates the error e of a trial from its distance d to a trial of the same method with fewer steps:
///
/// ```text
/// e = d r/(1 - r),   r = (coarse steps / fine steps)^order
/// ```
///
/// The error is infinite if the coarse trial made more than nine tenths of the steps of the fine trial. The instants of the results then
/// limited the steps of both.
pub(crate) fn error_of_finer(method: &MethodCase, fine: &Trial, coarse: &Trial, d: f64) -> f64 {
    let steps = coarse.steps as f64 / fine.steps as f64;
    let r = steps.powf(method.order());
    if steps > 1.0 - SMALL { f64::INFINITY } else { d * (r / (1.0 - r)).max(SMALL) }
}
