//! Steps and tolerances that are run, and instants at which runs are compared. None of them depends on a clock: two comparisons of a scene make
//! the same runs.

/// Steps by default, relative to the scene's [-].
const STEPS: [f64; 9] = [10.0, 5.0, 2.0, 1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];
/// Tolerances by default [-].
const TOLERANCES: [f64; 8] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];
/// Number of instants by default [-]. Chosen, not tuned.
const INSTANTS: usize = 200;
/// Largest relative misfit of a step that fits into the interval of two instants [-]. Chosen, not tuned.
const FITS: f64 = 1e-6;

/// Work of one iteration for each coordinate and constraint [s]: what it takes on a processor of 3 GHz, by its order of magnitude. It is a
/// measure of work that is the same every time, not of time.
const PER_UNKNOWN: f64 = 2e-7;
/// Work of one iteration besides [s], likewise.
const PER_ITERATION: f64 = 3e-7;

/// Steps to run, from the longest; those that are longer than a tenth of the run are left out.
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

/// Tolerances to run, from the largest.
pub fn tolerances(asked: &[f64]) -> Vec<f64> {
    let mut tolerances = if asked.is_empty() { TOLERANCES.to_vec() } else { asked.to_vec() };
    tolerances.sort_by(|a, b| b.total_cmp(a));
    tolerances.dedup();
    tolerances
}

/// Equally spaced instants at which runs are compared; every step ends on one, or is made to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instants {
    /// Number of instants after the start.
    pub count: usize,
    /// Distance of the instants [s].
    pub interval: f64,
}

impl Instants {
    /// At most 200, no closer than the longest step, and so that the steps fit between them, if that can be had.
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

    /// Steps between two instants: as many as bring their length nearest to the one that is asked for.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    pub fn steps_between(&self, step: f64) -> u64 {
        (self.interval / step).round().max(1.0) as u64
    }

    /// Time of an instant, from 0 for the start [s].
    pub(crate) fn time(&self, k: usize) -> f64 {
        k as f64 * self.interval
    }
}

/// The work of iterations of a model with `unknowns` coordinates and constraints [s, nominal].
pub(crate) fn work(iterations: u64, unknowns: usize) -> f64 {
    iterations as f64 * (PER_ITERATION + PER_UNKNOWN * unknowns as f64)
}
