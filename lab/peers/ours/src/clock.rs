//! The clock: CPU time, and the median of batches, alike in all programs.

use cpu_time::ProcessTime;

/// States, which the calls take in turn.
pub(crate) const STATES: usize = 8;
/// Batches of which the middle one counts.
const BATCHES: usize = 7;

/// Seconds for one call, in batches that `batch` makes of so many calls and that fill `seconds` together.
fn median(seconds: f64, mut batch: impl FnMut(usize) -> f64) -> f64 {
    let mut n = 1;
    while batch(n) < seconds / (2 * BATCHES) as f64 {
        n *= 2;
    }
    let mut times: Vec<f64> = (0..BATCHES).map(|_| batch(n) / n as f64).collect();
    times.sort_by(f64::total_cmp);
    times[BATCHES / 2]
}

/// Seconds for one call, which gets the number of its state.
pub(crate) fn time_of(seconds: f64, mut call: impl FnMut(usize)) -> f64 {
    median(seconds, |n| {
        let start = ProcessTime::now();
        (0..n).for_each(|i| call(i % STATES));
        start.elapsed().as_secs_f64()
    })
}

/// Seconds for one step, where each batch begins anew.
pub(crate) fn time_of_steps(seconds: f64, mut steps: impl FnMut(usize)) -> f64 {
    median(seconds, |n| {
        let start = ProcessTime::now();
        steps(n);
        start.elapsed().as_secs_f64()
    })
}
