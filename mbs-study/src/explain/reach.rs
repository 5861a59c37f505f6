//! Largest step with which a run completes, found by doubling.

use super::explanation::{LargestStep, SearchEnd};
use super::trials::outcome;
use mbs::ResolvedMethod;
use mbs::inside::SAME_LENGTH;
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Largest number of doublings of the step [-]: up to 64 times its length.
const MOST_DOUBLINGS: i32 = 6;
/// Smallest number of steps of a run. Chosen, not tuned.
const FEWEST_STEPS: f64 = 10.0;

/// Doubles the step until the run over `duration` [s] stops. `completes` is whether the run with the original step completes.
pub(super) fn largest_step<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    (duration, completes): (f64, bool),
    has_time: &impl Fn() -> bool,
) -> LargestStep {
    if !completes {
        return LargestStep { step: None, end: SearchEnd::Stops };
    }
    let h = settings.step_max;
    let found = |k: i32, end| LargestStep { step: Some(h * f64::powi(2.0, k)), end };
    for k in 1..=MOST_DOUBLINGS {
        let times = f64::powi(2.0, k);
        if h * times * FEWEST_STEPS > duration * (1.0 + SAME_LENGTH) {
            return found(k - 1, SearchEnd::Limit);
        }
        if !has_time() {
            return found(k - 1, SearchEnd::NotMeasured);
        }
        if !outcome::<T, D>(scene, settings, (times, duration)).summary.completed {
            return found(k - 1, SearchEnd::Stops);
        }
    }
    found(MOST_DOUBLINGS, SearchEnd::Limit)
}
