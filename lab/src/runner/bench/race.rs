//! Repeated measurements of several subjects, interleaved. The compared subjects are measured within the same seconds, since other programs
//! may load the machine.

use serde_json::{Value, json};
use std::time::Instant;

/// Subject of a measurement, which repeats its work a given number of times.
pub(crate) trait Runner {
    /// Does the work `n` times, and returns the elapsed time [s].
    ///
    /// # Errors
    /// The reason why the work cannot continue.
    fn run(&mut self, n: u32) -> Result<f64, String>;
    /// Forgets the counts so far; called after the warm-up.
    fn reset(&mut self) {}
}

/// Time of one piece of work: median and quartiles of several measurements [s].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Timing {
    pub(crate) median: f64,
    pub(crate) quartiles: [f64; 2],
    /// Number of measurements, and of pieces of work in each.
    pub(crate) rounds: usize,
    pub(crate) batch: u32,
}

impl Timing {
    fn of(mut samples: Vec<f64>, batch: u32) -> Self {
        samples.sort_by(f64::total_cmp);
        let [low, median, high] = [0.25, 0.5, 0.75].map(|share| quantile(&samples, share));
        Self { median, quartiles: [low, high], rounds: samples.len(), batch }
    }

    /// Returns the timing as keys of a line.
    pub(crate) fn json(&self) -> Value {
        json!({ "seconds": self.median, "quartiles": self.quartiles, "rounds": self.rounds, "batch": self.batch })
    }
}

/// The quantile of ascending numbers, interpolated between the two nearest; NaN for an empty list.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    #[allow(clippy::cast_precision_loss, reason = "some tens of numbers")]
    let place = share * last as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within them")]
    let below = (place.floor() as usize).min(last);
    let above = (below + 1).min(last);
    sorted[below] + (place - place.floor()) * (sorted[above] - sorted[below])
}

/// Shortest duration of a measurement [s], unless one piece of work takes longer. The scheduler of a busy system gives a process much
/// longer slices of time. So most measurements are not interrupted, and the median is one of these.
const SHORTEST: f64 = 2e-4;
/// Least and largest number of measurements of each runner. Chosen, not tuned.
const ROUNDS: [f64; 2] = [7.0, 301.0];

/// Warms up all runners, then measures them interleaved for roughly `seconds`. A runner that fails has its reason as result.
pub(crate) fn race(runners: &mut [&mut dyn Runner], seconds: f64) -> Vec<Result<Timing, String>> {
    let mut pilot = |runner: &mut &mut dyn Runner| -> Result<f64, String> {
        runner.run(2)?;
        let once = runner.run(1)?;
        // short work is repeated, so that the time of reading the clock is negligible
        if once < SHORTEST { Ok(runner.run(20)? / 20.0) } else { Ok(once) }
    };
    let pilots: Vec<_> = runners.iter_mut().map(&mut pilot).collect();
    let good = || pilots.iter().filter_map(|pilot| pilot.as_ref().ok().copied());
    let least = good().fold(f64::INFINITY, f64::min);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let batch = (SHORTEST / least).ceil().clamp(1.0, 1e5) as u32;
    let round = good().sum::<f64>() * f64::from(batch);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let rounds = (seconds / round).clamp(ROUNDS[0], ROUNDS[1]) as usize;
    let mut samples: Vec<Result<Vec<f64>, String>> =
        pilots.into_iter().map(|pilot| pilot.map(|_| Vec::new())).collect();
    runners.iter_mut().for_each(|runner| runner.reset());
    let n = runners.len();
    for round in 0..rounds {
        // each round begins with another runner
        for i in (0..n).map(|i| (i + round) % n) {
            let Ok(list) = &mut samples[i] else { continue };
            match runners[i].run(batch) {
                Ok(time) => list.push(time / f64::from(batch)),
                Err(why) => samples[i] = Err(why),
            }
        }
    }
    samples.into_iter().map(|list| list.map(|list| Timing::of(list, batch))).collect()
}

/// The time of some work [s].
pub(crate) fn timed<R>(work: impl FnOnce() -> Result<R, String>) -> Result<f64, String> {
    let clock = Instant::now();
    work()?;
    Ok(clock.elapsed().as_secs_f64())
}

/// A runner made of a closure that cannot fail.
pub(crate) struct Work<F>(pub(crate) F);

impl<F: FnMut()> Runner for Work<F> {
    fn run(&mut self, n: u32) -> Result<f64, String> {
        timed(|| {
            (0..n).for_each(|_| (self.0)());
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_quartiles_lie_between_neighbours() {
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let timing = Timing::of(vec![4.0, 1.0, 3.0, 2.0], 5);
        assert!(close(timing.median, 2.5));
        assert!(close(timing.quartiles[0], 1.75) && close(timing.quartiles[1], 3.25));
        assert!(close(quantile(&[7.0], 0.25), 7.0) && quantile(&[], 0.5).is_nan());
        assert_eq!((timing.rounds, timing.batch), (4, 5));
    }

    #[test]
    fn runners_take_turns_and_failures_keep_their_reason() {
        struct Failing(u32);
        impl Runner for Failing {
            fn run(&mut self, n: u32) -> Result<f64, String> {
                self.0 += n;
                if self.0 > 40 { Err("no more".to_owned()) } else { Ok(1e-3) }
            }
        }
        let mut n = 0;
        let mut work = Work(|| n += 1);
        let mut failing = Failing(0);
        let timings = race(&mut [&mut work, &mut failing], 0.0);
        assert_eq!(timings[1], Err("no more".to_owned()));
        let timing = timings[0].as_ref().unwrap();
        assert_eq!(timing.rounds, 7);
        assert!(n > 7);
    }
}
