//! CPU times of single steps: a histogram and quantiles.

use crate::compare::results::StepTimes;
use mbs_realtime::nearest_rank;

/// Number of histogram classes in a decade. Chosen, not tuned: a class is 26 % wide.
const PER_DECADE: f64 = 10.0;
/// Fraction of a class by which a time may be below the lower edge of its class [-]. The logarithm of the time is rounded.
const ROUNDING: f64 = 1e-9;

/// Makes a histogram and quantiles of the times of steps [s]. `reading` is the time of one reading of the clock [s], which is subtracted.
pub fn step_times(mut times: Vec<f64>, reading: f64) -> Option<StepTimes> {
    // Smallest time of a step [s]: one tick of the clock.
    const TICK: f64 = 1e-9;
    for time in &mut times {
        *time = (*time - reading).max(TICK);
    }
    times.sort_by(f64::total_cmp);
    let max = *times.last()?;
    let mut classes: Vec<(i32, u64)> = Vec::new();
    for time in &times {
        #[allow(clippy::cast_possible_truncation, reason = "a small number")]
        let class = (time.log10() * PER_DECADE + ROUNDING).floor() as i32;
        match classes.last_mut() {
            Some((of, count)) if *of == class => *count += 1,
            _ => classes.push((class, 1)),
        }
    }
    let edge = |class: i32| 10_f64.powf(f64::from(class) / PER_DECADE);
    Some(StepTimes {
        p50: *nearest_rank(&times, 50)?,
        p99: *nearest_rank(&times, 99)?,
        max,
        classes: classes.into_iter().map(|(class, count)| (edge(class), count)).collect(),
    })
}
