//! Statistics of the outputs of a run. They are updated at every step, and their memory does not grow with the number of steps.
//!
//! ```text
//! rms = √(1/T ∫ x² dt),   ∫ x² dt ≈ Σ (tₖ − tₖ₋₁) (xₖ² + xₖ₋₁²)/2
//! ```
//!
//! Peaks between steps are computed by [`turning_point`].

use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::peak::turning_point;
use crate::record::{Channel, ComponentStatistics, Statistics, measured};
use core::ops::Range;
use mbs_core::Real;

/// Running statistics of one quantity.
#[derive(Debug, Clone, Copy)]
struct Tally {
    min: f64,
    at_min: f64,
    max: f64,
    at_max: f64,
    /// Integral of the squared value over time.
    square: f64,
    last: f64,
    /// The last five values.
    recent: [f64; 5],
}

impl Tally {
    const NEW: Self = Self {
        min: f64::INFINITY,
        at_min: 0.0,
        max: f64::NEG_INFINITY,
        at_max: 0.0,
        square: 0.0,
        last: 0.0,
        recent: [0.0; 5],
    };

    /// Adds the value `x` at time `t` [s]. `dt` is the time since the last value [s].
    fn take(&mut self, t: f64, dt: f64, x: f64) {
        self.peak(t, x);
        self.square += dt * (x * x + self.last * self.last) / 2.0;
        self.last = x;
        self.recent.rotate_left(1);
        self.recent[4] = x;
    }

    /// Updates minimum and maximum with the value `x` at time `t` [s].
    fn peak(&mut self, t: f64, x: f64) {
        if x < self.min {
            (self.min, self.at_min) = (x, t);
        }
        if x > self.max {
            (self.max, self.at_max) = (x, t);
        }
    }
}

/// Statistics of all quantities of a run.
#[derive(Debug)]
pub struct Tallies {
    /// Index range of the columns of each quantity: one column, or all columns of the vector whose magnitude is the quantity.
    columns: Vec<Range<usize>>,
    /// True for each quantity that is the magnitude of a vector.
    is_magnitude: Vec<bool>,
    tallies: Vec<Tally>,
    /// First and last time [s]; `None` before the first values.
    times: Option<[f64; 2]>,
    /// Last five times [s], of which the last `n_recent` are valid.
    recent: [f64; 5],
    n_recent: u64,
}

impl Tallies {
    /// Creates the statistics for these channels.
    pub fn new(channels: &[Channel]) -> Self {
        let (mut columns, mut is_magnitude, mut first) = (Vec::new(), Vec::new(), 0);
        for channel in channels {
            for (one, places) in measured(channel) {
                columns.push(first + places.start..first + places.end);
                is_magnitude.push(one.is_magnitude);
            }
            first += channel.components.len();
        }
        let tallies = vec![Tally::NEW; columns.len()];
        Self { columns, is_magnitude, tallies, times: None, recent: [0.0; 5], n_recent: 0 }
    }

    /// Adds the components of all channels at time `t` [s]. No allocation.
    pub fn take<T: Real>(&mut self, t: f64, values: &[T]) {
        let [from, last] = self.times.unwrap_or([t, t]);
        self.times = Some([from, t]);
        self.recent.rotate_left(1);
        self.recent[4] = t;
        self.n_recent = (self.n_recent + 1).min(5);
        let has_all = self.n_recent == 5;
        let numbers = self.columns.iter().zip(&self.is_magnitude);
        for ((columns, is_magnitude), tally) in numbers.zip(&mut self.tallies) {
            let values = values[columns.clone()].iter().map(|x| x.to_f64());
            let x = match is_magnitude {
                true => values.map(|x| x * x).sum::<f64>().sqrt(),
                false => values.sum(),
            };
            tally.take(t, t - last, x);
            let peak = if has_all { turning_point(self.recent, tally.recent) } else { None };
            if let Some((t, x)) = peak {
                tally.peak(t, if *is_magnitude { x.max(0.0) } else { x });
            }
        }
    }

    /// Statistics of each channel. If no time has passed, the root mean square is the magnitude of the single value.
    pub fn of_channels(&self, channels: &[Channel]) -> Vec<Vec<ComponentStatistics>> {
        let Some([from, to]) = self.times else { return vec![Vec::new(); channels.len()] };
        let mut tallies = self.tallies.iter();
        let mut statistics = || {
            let Tally { min, at_min, max, at_max, square, last, .. } = tallies.next()?;
            let mean = if to > from { square / (to - from) } else { last * last };
            let [min, at_min, max, at_max] = [*min, *at_min, *max, *at_max];
            Some(Statistics { min, at_min, max, at_max, rms: mean.sqrt(), end: *last })
        };
        let of_channel = |channel| {
            let each = measured(channel).into_iter();
            let each = each.map(|(one, _)| ComponentStatistics {
                of: statistics().unwrap_or_default(),
                ..one
            });
            each.collect()
        };
        channels.iter().map(of_channel).collect()
    }

    /// Least and greatest value of each column.
    pub fn ranges(&self) -> Vec<[f64; 2]> {
        let both = self.tallies.iter().zip(&self.is_magnitude);
        both.filter(|(_, is_magnitude)| !**is_magnitude).map(|(x, _)| [x.min, x.max]).collect()
    }

    /// Writes the statistics to a checkpoint, or reads them from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.option(&mut self.times, |tape, times| tape.floats(times))?;
        tape.floats(&mut self.recent)?;
        tape.count(&mut self.n_recent)?;
        holds(self.n_recent <= 5)?;
        tape.places(&mut self.tallies, |tape, tally| {
            let Tally { min, at_min, max, at_max, square, last, recent } = tally;
            let each = [min, at_min, max, at_max, square, last];
            each.into_iter().try_for_each(|x| tape.float(x))?;
            tape.floats(recent)
        })
    }
}
