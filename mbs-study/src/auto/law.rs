//! How error and CPU time of a method go with its setting, and what follows for a wanted error.
//!
//! ```text
//! error ~ setting^a,   CPU time ~ setting^-b,   so CPU time ~ error^(-b/a)
//! ```

use crate::compare::method::{Control, MethodCase};
use mbs::IntegratorKind;

/// Between runs whose counts of steps differ by no more than a fiftieth there is no law: the intervals of the results hold their
/// steps, and the tolerance only changes the order.
const SAME: u64 = 50;
/// Exponents that are measured are believed within these shares of those of theory. An error that falls more slowly follows no law
/// yet, or is the reference's, and this share is taken; steps may well be held by what is no matter of tolerance.
const ERROR: [f64; 2] = [0.5, 1.25];
const DOUBTED: f64 = 0.75;
const COST: [f64; 2] = [0.25, 1.25];

/// A coarser setting gains little where the instants of the results hold this share of the steps.
pub(super) const HELD: f64 = 0.85;

/// Exponents of a method in its setting: the step, or the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    /// Of the error.
    pub(crate) error: f64,
    /// Of the CPU time, its sign changed.
    pub(crate) cost: f64,
}

impl Law {
    /// Theory's.
    pub(crate) fn of(method: &MethodCase) -> Self {
        let error = match (method.control, method.integrator) {
            (Control::Fixed, IntegratorKind::Rk4) => 4.0,
            (Control::Fixed, IntegratorKind::Newmark) => 1.0,
            (Control::Fixed, _) => 2.0,
            // the local error goes with the cube of the step, the global one with its square
            (Control::Error | Control::Energy, _) => 2.0 / 3.0,
            (Control::Own, _) => 1.0,
        };
        Self { error, cost: method.cost() }
    }

    /// Order of the error in the mean step; lower than theory's where the order itself is chosen.
    pub(crate) fn order(method: &MethodCase) -> f64 {
        match (method.control, method.integrator) {
            (Control::Own, IntegratorKind::Extrapolation | IntegratorKind::Rk853) => 8.0,
            (Control::Own, _) => 5.0,
            (Control::Fixed, IntegratorKind::Rk4) => 4.0,
            (Control::Fixed, IntegratorKind::Newmark) => 1.0,
            _ => 2.0,
        }
    }

    /// How much the setting changes for an error that is so many times as large.
    pub(crate) fn setting_for(&self, times_error: f64) -> f64 {
        times_error.powf(1.0 / self.error)
    }

    /// How much longer a run takes for an error that is smaller by a factor.
    pub(crate) fn cost_of(&self, factor: f64) -> f64 {
        factor.powf(self.cost / self.error)
    }

    /// The same of a run of which `held` is the share of steps that end at the instants of the results whatever the setting is: these
    /// stay as they are.
    pub(crate) fn longer(&self, held: f64, factor: f64) -> f64 {
        held + (1.0 - held) * self.cost_of(factor)
    }

    /// The exponents between two runs, as far as they are believed.
    fn between(&self, coarse: &Point, fine: &Point) -> Self {
        let span = (coarse.setting / fine.setting).ln();
        let error = match (coarse.error / fine.error).ln() / span / self.error {
            q if !q.is_finite() => 1.0,
            q if q < ERROR[0] => DOUBTED,
            q => q.min(ERROR[1]),
        };
        let cost = (fine.seconds / coarse.seconds).ln() / span / self.cost;
        let cost = if cost.is_finite() { cost.clamp(COST[0], COST[1]) } else { 1.0 };
        Self { error: error * self.error, cost: cost * self.cost }
    }
}

/// A completed run: its setting, its steps, its error, its CPU time [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    pub(crate) setting: f64,
    pub(crate) steps: u64,
    pub(crate) error: f64,
    pub(crate) seconds: f64,
    /// Share of its steps that the instants of the results hold.
    pub(crate) held: f64,
}

/// What a prediction stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Basis {
    /// Runs on both sides of the wanted error.
    Between,
    /// A run reaches it, and no coarser setting is expected to.
    Coarsest,
    /// Every run reaches it: a coarser setting is guessed, for an error larger by this factor.
    Coarser(f64),
    /// No run reaches it: a finer setting is guessed, for an error smaller by this factor.
    Finer(f64),
}

/// What a wanted error takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Prediction {
    pub(crate) point: Point,
    pub(crate) basis: Basis,
}

/// A run as it counts: an error that is small by luck is not believed, but that of the next finer one where it is larger.
pub(crate) fn credited(points: &[Point], i: usize) -> Point {
    let finer = points.get(i + 1).map_or(0.0, |p| p.error);
    Point { error: points[i].error.max(finer), ..points[i] }
}

/// Predicts from runs, from the coarsest to the finest, each [`credited`]. `coarsest`: no setting is longer than that.
pub(crate) fn predict(
    law: &Law,
    points: &[Point],
    wanted: f64,
    coarsest: f64,
) -> Option<Prediction> {
    let last = points.last()?;
    let reaches = (0..points.len()).find(|&i| credited(points, i).error <= wanted);
    let Some(i) = reaches else {
        let before = points.len().checked_sub(2).map(|i| &points[i]);
        // between two runs the time is measured, and what is held is in it
        let held = before.map_or(last.held, |_| 0.0);
        let law = before.map_or(*law, |before| law.between(before, last));
        let factor = last.error / wanted;
        return Some(Prediction {
            point: Point {
                setting: last.setting * law.setting_for(1.0 / factor),
                error: wanted,
                seconds: last.seconds * law.longer(held, factor),
                ..*last
            },
            basis: Basis::Finer(factor),
        });
    };
    let fine = credited(points, i);
    if let Some(coarse) = i.checked_sub(1).map(|k| credited(points, k)) {
        if fine.steps <= coarse.steps + coarse.steps / SAME {
            return Some(Prediction { point: fine, basis: Basis::Coarsest });
        }
        // an error of zero lies at the end of every line
        let share = (coarse.error / wanted).ln() / (coarse.error / fine.error).ln();
        let share = if fine.error > 0.0 { share.clamp(0.0, 1.0) } else { 1.0 };
        let mean = |a: f64, b: f64| (a.ln() + share * (b.ln() - a.ln())).exp();
        let setting = mean(coarse.setting, fine.setting);
        let seconds = mean(coarse.seconds, fine.seconds);
        let point = Point { setting, error: wanted, seconds, ..fine };
        return Some(Prediction { point, basis: Basis::Between });
    }
    if fine.setting >= coarsest * (1.0 - 1e-9) || fine.held >= HELD {
        return Some(Prediction { point: fine, basis: Basis::Coarsest });
    }
    let setting = fine.setting * law.setting_for(wanted / fine.error.max(f64::MIN_POSITIVE));
    let setting = setting.min(coarsest);
    let factor = (setting / fine.setting).powf(law.error);
    let seconds = fine.seconds / law.cost_of(factor);
    let point = Point { setting, error: fine.error * factor, seconds, ..fine };
    Some(Prediction { point, basis: Basis::Coarser(factor) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Law = Law { error: 2.0, cost: 1.0 };

    fn points(steps: &[f64]) -> Vec<Point> {
        let of = |&h: &f64| Point {
            setting: h,
            steps: (10.0 / h) as u64,
            error: h * h,
            seconds: 1e-3 / h,
            held: 0.0,
        };
        steps.iter().map(of).collect()
    }

    fn near(found: f64, claimed: f64) -> bool {
        (found / claimed - 1.0).abs() < 1e-9
    }

    #[test]
    fn a_method_that_keeps_its_law_is_predicted_exactly_on_either_side_of_its_runs() {
        for (wanted, basis) in [(1e-5, "finer"), (1e-3, "between"), (0.5e-1, "coarser")] {
            let found = predict(&SECOND, &points(&[0.1, 0.01]), wanted, 1.0).unwrap();
            let h = f64::sqrt(wanted);
            assert!(
                near(found.point.setting, h) && near(found.point.seconds, 1e-3 / h),
                "{found:?}"
            );
            let is = match found.basis {
                Basis::Finer(_) => "finer",
                Basis::Between => "between",
                Basis::Coarser(_) => "coarser",
                Basis::Coarsest => "coarsest",
            };
            assert_eq!(is, basis);
        }
    }

    #[test]
    fn steps_that_the_results_hold_take_no_longer_with_finer_settings() {
        let mut held = points(&[0.1]);
        held[0].held = 0.75;
        let found = predict(&SECOND, &held, 1e-4, 1.0).unwrap();
        assert!(near(found.point.seconds, (0.75 + 0.25 * 10.0) * 1e-2), "{found:?}");
    }

    #[test]
    fn the_coarsest_setting_is_not_left() {
        let found = predict(&SECOND, &points(&[0.1]), 0.5, 0.1).unwrap();
        assert_eq!((found.basis, found.point), (Basis::Coarsest, points(&[0.1])[0]));
        let found = predict(&SECOND, &points(&[0.1]), 0.5, 0.2).unwrap();
        assert!(near(found.point.setting, 0.2) && near(found.point.error, 0.04), "{found:?}");
    }

    #[test]
    fn where_finer_runs_have_no_more_steps_the_one_that_reaches_is_taken() {
        let mut stairs = points(&[0.1, 0.01]);
        stairs[1].steps = stairs[0].steps + 1;
        let found = predict(&SECOND, &stairs, 1e-3, 1.0).unwrap();
        assert_eq!((found.basis, found.point), (Basis::Coarsest, stairs[1]));
    }

    #[test]
    fn an_error_that_is_small_by_luck_does_not_count() {
        let mut lucky = points(&[0.1, 0.05, 0.025]);
        lucky[0].error = 1e-6;
        let found = predict(&SECOND, &lucky, 1e-3, 1.0).unwrap();
        assert!(found.point.setting < 0.05, "{found:?}");
        assert_eq!(predict(&SECOND, &[], 1e-3, 1.0), None);
    }
}
