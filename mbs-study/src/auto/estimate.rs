//! Error and CPU time of a method as powers of its setting, and the setting that an error needs.
//!
//! ```text
//! error ~ setting^a,   CPU time ~ setting^-b
//! ```

use super::trial::Trial;
use crate::compare::method::MethodCase;

/// Measured exponents of the error, relative to theory's, are taken within this range [-]: outside it the motion was lost, or an error
/// was small by chance.
pub(super) const ERROR_RANGE: [f64; 2] = [0.5, 1.25];
/// Measured exponents of the CPU time, relative to theory's, are taken within this range [-]: steps may end at the instants of the
/// results, whatever the tolerance.
const COST_RANGE: [f64; 2] = [0.25, 1.25];
/// Fraction below which a number is small beside another [-]. It is for the error of a trial beside its distance from a coarser one, which may agree
/// with it by chance, and for the steps that it has more. It is for the error of the best trial beside the required one, and for a tolerance
/// beside that of the trial before.
pub(super) const SMALL: f64 = 0.1;

/// Exponents of a method in its setting: the step, or the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Exponent a of the error.
    pub error: f64,
    /// Exponent b of the CPU time, its sign changed.
    pub cost: f64,
}

impl PowerLaw {
    /// Returns the exponents of theory.
    pub fn of(method: &MethodCase) -> Self {
        Self { error: method.order() * method.cost(), cost: method.cost() }
    }

    /// The exponents between two trials, within their ranges.
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

/// A completed trial whose error is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The step [s] or the tolerance.
    pub setting: f64,
    /// Error of the outputs.
    pub error: f64,
    /// CPU time of the trial [s].
    pub seconds: f64,
    /// Number of steps of the trial.
    pub steps: u64,
}

/// Basis that a prediction stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Basis {
    /// A trial with this setting.
    Tried,
    /// Trials on both sides of the required error.
    Between,
    /// The law beyond the trials: their nearest error over the required one.
    Beyond(f64),
    /// The order of the method alone.
    Theory,
}

/// A setting, and what is expected of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// The step [s] or the tolerance.
    pub setting: f64,
    /// Error of the outputs.
    pub error: f64,
    /// Predicted CPU time [s].
    pub seconds: f64,
    /// Basis that the prediction stands on.
    pub basis: Basis,
}

impl Prediction {
    pub(crate) fn of_trial(point: &Point) -> Self {
        let Point { setting, error, seconds, .. } = *point;
        Self { setting, error, seconds, basis: Basis::Tried }
    }
}

/// The setting for an error, no coarser than `coarsest`, from trials in the order of their settings, the coarsest first.
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

/// Returns what the law expects of another setting than that of a trial.
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

/// The error of a trial by its distance d from one of the same method that made fewer steps:
///
/// ```text
/// e = d r/(1 - r),   r = (coarse steps / fine steps)^order
/// ```
///
/// Infinite where the other made hardly fewer: the instants of the results then held the steps of both.
pub(crate) fn error_of_finer(method: &MethodCase, fine: &Trial, coarse: &Trial, d: f64) -> f64 {
    let steps = coarse.steps as f64 / fine.steps as f64;
    let r = steps.powf(method.order());
    if steps > 1.0 - SMALL { f64::INFINITY } else { d * (r / (1.0 - r)).max(SMALL) }
}
