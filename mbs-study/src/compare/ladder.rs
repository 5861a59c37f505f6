//! Steps and tolerances of the runs, and instants at which runs are compared. They do not depend on a clock, so two comparisons of a scene
//! make the same runs.

/// Default steps, relative to the scene's step [-].
const STEPS: [f64; 9] = [10.0, 5.0, 2.0, 1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];
/// Default tolerances of controlled steps [-].
const TOLERANCES: [f64; 8] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];
/// Default number of instants [-]. Chosen, not tuned.
const INSTANTS: usize = 200;
/// Largest relative deviation at which a step still divides the interval of two instants [-]. Chosen, not tuned.
const FITS: f64 = 1e-6;

/// Nominal time of one iteration for each coordinate and constraint [s]: the order of magnitude on a processor of 3 GHz. It measures work,
/// not time, so that it is the same in every run.
const PER_UNKNOWN: f64 = 2e-7;
/// Nominal time of one iteration, without the part that grows with the model [s].
const PER_ITERATION: f64 = 3e-7;

/// Steps of the runs, from the longest [s]. Default steps longer than a tenth of the run are left out.
pub fn steps(asked: &[f64], of_scene: f64, duration: f64) -> Vec<f64> {
    let mut steps: Vec<f64> = match asked {
        [] => {
            STEPS.iter().map(|factor| factor * of_scene).filter(|h| *h <= duration / 10.0).collect()
        }
        asked => asked.iter().map(|h| h.min(duration)).collect(),
    };
    if steps.is_empty() {
        steps.push(of_scene.min(duration));
    }
    steps.sort_by(|a, b| b.total_cmp(a));
    steps.dedup();
    steps
}

/// Tolerances of the runs, from the largest.
pub fn tolerances(asked: &[f64]) -> Vec<f64> {
    let mut tolerances = if asked.is_empty() { TOLERANCES.to_vec() } else { asked.to_vec() };
    tolerances.sort_by(|a, b| b.total_cmp(a));
    tolerances.dedup();
    tolerances
}

/// Equally spaced instants at which runs are compared. Each instant is the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instants {
    /// Number of instants after the start.
    pub count: usize,
    /// Distance of the instants [s].
    pub interval: f64,
}

impl Instants {
    /// Makes at most 200 instants. Their distance is at least the longest step and, if possible, a multiple of every step.
    pub fn new(duration: f64, steps: &[f64]) -> Self {
        let longest = steps.iter().copied().fold(0.0, f64::max);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 200")]
        let most = (duration / longest * (1.0 + FITS)).floor().clamp(1.0, INSTANTS as f64) as usize;
        let of = |count: usize| Self { count, interval: duration / count as f64 };
        let fits = |instants: &Self| {
            steps.iter().all(|h| {
                let n = instants.interval / h;
                (n - n.round()).abs() <= FITS * n
            })
        };
        let candidates = (most.div_ceil(2)..=most).rev().map(of);
        candidates.into_iter().find(fits).unwrap_or_else(|| of(most))
    }

    /// Number of steps between two instants. The length of these steps is nearest to `step` [s].
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    pub fn steps_between(&self, step: f64) -> u64 {
        (self.interval / step).round().max(1.0) as u64
    }

    /// Time of an instant [s]; index 0 is the start.
    pub(crate) fn time(&self, k: usize) -> f64 {
        k as f64 * self.interval
    }
}

/// Nominal time of iterations of a model with `unknowns` coordinates and constraints [s].
pub(crate) fn work(iterations: u64, unknowns: usize) -> f64 {
    iterations as f64 * (PER_ITERATION + PER_UNKNOWN * unknowns as f64)
}
