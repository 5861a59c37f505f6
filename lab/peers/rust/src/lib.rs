//! Common parts of the programs: the states from which every program starts, the clock, and the lines of output.

pub mod andrews;

use cpu_time::ProcessTime;

/// Number of states, which the timed calls use in turn.
pub const STATES: usize = 8;
/// Number of batches, of which the median counts.
const BATCHES: usize = 7;

/// Angles and rates of `n` joints by a linear congruential generator. Every program uses the same numbers.
#[must_use]
pub fn states(n: usize) -> Vec<[Vec<f64>; 2]> {
    let mut seed: u32 = 1;
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / 16_777_216.0 * 2.0 - 1.0
    };
    let mut numbers = |scale: f64| (0..n).map(|_| scale * next()).collect();
    (0..STATES).map(|_| [numbers(3.0), numbers(1.0)]).collect()
}

/// CPU time of one call [s]: the median of batches that fill `seconds` together.
pub fn time_of(seconds: f64, mut call: impl FnMut(usize)) -> f64 {
    let mut batch = |n: usize| {
        let start = ProcessTime::now();
        (0..n).for_each(|i| call(i % STATES));
        start.elapsed().as_secs_f64()
    };
    let mut n = 1;
    while batch(n) < seconds / (2 * BATCHES) as f64 {
        n *= 2;
    }
    let mut times: Vec<f64> = (0..BATCHES).map(|_| batch(n) / n as f64).collect();
    times.sort_by(f64::total_cmp);
    times[BATCHES / 2]
}

/// Prints one line: algorithm, seconds of one call, the value, the name of its reference.
pub fn print_line(algorithm: &str, seconds: f64, value: f64, reference: &str) {
    println!("{algorithm},{seconds:.6e},{value:.17e},{reference}");
}

/// Arguments of the program: problem, size, seconds.
///
/// # Errors
///
/// The usage of the program.
pub fn asked(usage: &str) -> Result<(String, usize, f64), String> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let read =
        || Some((words.first()?.clone(), words.get(1)?.parse().ok()?, words.get(2)?.parse().ok()?));
    read().ok_or_else(|| usage.to_owned())
}
