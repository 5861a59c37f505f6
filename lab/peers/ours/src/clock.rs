//! The clock of the measurements: the median CPU time of batches, the same in all programs.

use cpu_time::ProcessTime;

/// Number of states, which the timed calls use in turn.
pub(crate) const STATES: usize = 8;
/// Number of batches, of which the median counts.
const BATCHES: usize = 7;

/// Median time of one call [s]. `batch` makes a number of calls and returns the seconds of one. All batches together fill `seconds`.
fn median(seconds: f64, mut batch: impl FnMut(usize) -> f64) -> f64 {
    let mut n = 1;
    while batch(n) < seconds / (2 * BATCHES) as f64 {
        n *= 2;
    }
    let mut times: Vec<f64> = (0..BATCHES).map(|_| batch(n) / n as f64).collect();
    times.sort_by(f64::total_cmp);
    times[BATCHES / 2]
}

/// Time of one call [s]. The call gets the number of its state.
pub(crate) fn time_of(seconds: f64, mut call: impl FnMut(usize)) -> f64 {
    median(seconds, |n| {
        let start = ProcessTime::now();
        (0..n).for_each(|i| call(i % STATES));
        start.elapsed().as_secs_f64()
    })
}

/// Time of one step [s], where each batch starts from the initial state.
pub(crate) fn time_of_steps(seconds: f64, mut steps: impl FnMut(usize)) -> f64 {
    median(seconds, |n| {
        let start = ProcessTime::now();
        steps(n);
        start.elapsed().as_secs_f64()
    })
}
