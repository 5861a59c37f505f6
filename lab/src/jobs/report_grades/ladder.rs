//! Runs with decreasing steps: the first run that is accurate enough, and the CPU time of a required accuracy.

use super::printed::Method;
use crate::lab::case::Case;
use crate::lab::{Lab, Run};

/// Time below which a run is repeated, so that its least time counts [s].
const SHORT: f64 = 1.0;

/// A scene with the steps to try, in decreasing order [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ladder {
    /// The scene, by its file.
    pub(crate) scene: &'static str,
    /// Steps that are tried [s].
    pub(crate) steps: &'static [f64],
    /// Simulated time of each run [s]; `None` for that of the scene.
    pub(crate) duration: Option<f64>,
    /// Text that is appended to the scene.
    pub(crate) appended: &'static str,
}

impl Ladder {
    /// Makes a ladder of a scene without changes.
    pub(crate) const fn new(scene: &'static str, steps: &'static [f64]) -> Self {
        Self { scene, steps, duration: None, appended: "" }
    }

    /// The run of a method at a step.
    pub(crate) fn case(&self, method: &Method, step: f64) -> Case {
        Case {
            duration: self.duration,
            arguments: method.arguments,
            appended: self.appended,
            ..Case::fixed(self.scene, method.formulation, step)
        }
    }
}

/// Energy error relative to the exchanged energy, if the run was completed.
pub(crate) fn share(run: &Run) -> Option<f64> {
    run.figures().map(crate::mbs::outcome::Figures::share).filter(|share| share.is_finite())
}

/// Runs one case of a ladder. With `is_timed` a short run is repeated for its least time.
///
/// # Errors
///
/// The reason why the case cannot be run.
pub(crate) fn run(lab: &Lab<'_>, case: &Case, is_timed: bool) -> Result<Run, String> {
    let mut run = first(lab.measure(std::slice::from_ref(case), 1)?)?;
    if is_timed && run.seconds().is_some_and(|s| s < SHORT) {
        let again = first(lab.measure(std::slice::from_ref(case), 3)?)?;
        if again.seconds() < run.seconds() {
            run = again;
        }
    }
    Ok(run)
}

fn first(runs: Vec<Run>) -> Result<Run, String> {
    runs.into_iter().next().ok_or_else(|| "a case was not run".to_owned())
}

/// Decreases the step until the relative energy error is at most `level`. Returns all runs.
///
/// # Errors
///
/// The reason why a case cannot be run.
pub(crate) fn descend(
    lab: &Lab<'_>,
    ladder: &Ladder,
    method: &Method,
    level: f64,
    is_timed: bool,
) -> Result<Vec<Run>, String> {
    let mut runs = Vec::new();
    for &step in ladder.steps {
        let run = run(lab, &ladder.case(method, step), is_timed)?;
        let is_enough = share(&run).is_some_and(|share| share <= level);
        runs.push(run);
        if is_enough {
            break;
        }
    }
    Ok(runs)
}

/// The step of the last run, if that is accurate enough [s].
pub(crate) fn reached(runs: &[Run], level: f64) -> Option<f64> {
    let last = runs.last()?;
    share(last).filter(|&share| share <= level).map(|_| last.case.step)
}

/// CPU time at which the error is `level` [s]: interpolated by a power law between the last two runs. If the one before the last was not
/// completed, it is the time of the last run.
pub(crate) fn price(runs: &[Run], level: f64) -> Option<f64> {
    reached(runs, level)?;
    let last = runs.last()?;
    let (fine, seconds) = (share(last)?, last.seconds()?);
    let before =
        runs.len().checked_sub(2).and_then(|i| Some((share(&runs[i])?, runs[i].seconds()?)));
    match before {
        Some((coarse, less)) if coarse > fine && fine > 0.0 && less > 0.0 => {
            let part = (coarse / level).ln() / (coarse / fine).ln();
            Some(less * (seconds / less).powf(part))
        }
        _ => Some(seconds),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mbs::outcome::{Figures, Outcome};

    fn made(step: f64, share: Option<f64>) -> Run {
        let case = Case::fixed("pendulum", "index-3", step);
        let figures = |share| Figures {
            energy_error: share,
            turned_over: 1.0,
            seconds: 1e-2 / step,
            ..Figures::default()
        };
        let stopped = Outcome::Refused("no".into());
        let outcome = share.map_or(stopped, |share| Outcome::Completed(figures(share)));
        Run { case, outcome, true_error: None }
    }

    #[test]
    fn an_accuracy_between_two_runs_costs_what_the_order_says() {
        // second order: a tenth of the step gives a hundredth of the error
        let runs = [made(1e-2, Some(1e-2)), made(1e-3, Some(1e-4))];
        let price = price(&runs, 1e-3).unwrap();
        assert!((price - 10f64.sqrt()).abs() < 1e-9, "{price}");
    }

    #[test]
    fn what_never_is_good_enough_has_no_price_and_no_step() {
        let runs = [made(1e-2, None), made(1e-3, Some(1e-2))];
        assert_eq!((price(&runs, 1e-3), reached(&runs, 1e-3)), (None, None));
        assert_eq!(reached(&runs, 1e-1), Some(1e-3));
        assert_eq!(price(&runs, 1e-1), Some(10.0), "the run before gives no slope");
    }
}
