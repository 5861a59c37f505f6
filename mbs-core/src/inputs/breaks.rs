//! Times at which signals of time alone jump or have corners. Steps with step-size control end at these times.
//!
//! Known times are those of steps without `rise`, of ramps without `rounding`, and of the rows of linear and hold tables, also for
//! forces. The ends of splines are known too. A signal that is computed from others has their times. Times of clamps, of inputs and
//! of signals that depend on the motion are not known.

use super::signals::SignalGraph;
use crate::Real;
use crate::scene::{Interpolation, Signal, SignalKind};
use alloc::vec;
use alloc::vec::Vec;

/// Time at which a signal jumps or has a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignalTime<T> {
    /// Time of the jump or corner [s].
    pub time: T,
    /// True if the value jumps. Otherwise only the rate jumps.
    pub is_jump: bool,
}

/// Times of a signal, ascending. They repeat if the period is larger than zero.
#[derive(Debug, Clone, PartialEq)]
struct Times<T> {
    times: Vec<T>,
    is_jump: bool,
    /// Beginning of the first period, and length of a period [s].
    period: [T; 2],
}

/// Times at which the signals of a scene jump or have corners.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalTimes<T>(Vec<Times<T>>);

/// Largest change of a slope that does not count as a corner, relative to the slopes [-]. Rows on a straight line, written with few
/// digits, have such changes. Chosen, not tuned.
const STRAIGHT: f64 = 1e-9;

impl<T: Real> SignalTimes<T> {
    /// Finds the times of the scene's signals, and of the force signals that are tables. Cost: one pass over them.
    #[doc(hidden)]
    pub fn new<'a>(
        signals: &'a SignalGraph<T>,
        courses: impl Iterator<Item = &'a Signal<T>>,
    ) -> Self {
        let tables = courses.filter_map(|course| match course {
            Signal::Table(rows) => Some(Times::once(corners(rows, |row| row), false)),
            _ => None,
        });
        let all = of_signals(signals).chain(tables);
        Self(all.filter(|times| !times.times.is_empty()).collect())
    }

    /// First time after `t` [s]. A jump precedes a corner at the same time. Cost: a binary search for each signal with such times.
    #[must_use]
    pub fn after(&self, t: T) -> Option<SignalTime<T>> {
        let all = self
            .0
            .iter()
            .filter_map(|times| Some(SignalTime { time: times.after(t)?, is_jump: times.is_jump }));
        all.reduce(|a, b| {
            let is_first = a.time < b.time || (a.time == b.time && a.is_jump);
            if is_first { a } else { b }
        })
    }
}

impl<T: Real> Times<T> {
    fn once(times: Vec<T>, is_jump: bool) -> Self {
        Self { times, is_jump, period: [T::ZERO; 2] }
    }

    fn after(&self, t: T) -> Option<T> {
        let next = |begin: T| {
            let at = self.times.partition_point(|time| *time + begin <= t);
            self.times.get(at).map(|time| *time + begin)
        };
        let [first, period] = self.period;
        if !(period > T::ZERO) {
            return next(T::ZERO);
        }
        // rounding may assign the time to the period before or after the right one
        let turns = T::from_f64(libm::floor(((t - first) / period).to_f64()));
        let mut near = [-T::ONE, T::ZERO, T::ONE].into_iter();
        near.find_map(|more| next((turns + more) * period))
    }
}

fn of_signals<T: Real>(signals: &SignalGraph<T>) -> impl Iterator<Item = Times<T>> + '_ {
    signals.kinds().filter_map(|(kind, _)| match kind {
        SignalKind::Step { from, to, at, rise } if rise.is_zero() && from != to => {
            Some(Times::once(vec![*at], true))
        }
        SignalKind::Ramp { rate, start, end, rounding }
            if rounding.is_zero() && !rate.is_zero() =>
        {
            Some(Times::once([*start].into_iter().chain(*end).collect(), false))
        }
        SignalKind::Table { rows, interpolation, periodic } => {
            let (ends, is_jump) =
                ([rows.first()?[0], rows.last()?[0]], *interpolation == Interpolation::Hold);
            let times = match interpolation {
                Interpolation::Spline(_) | Interpolation::Monotone(_) if *periodic => return None,
                Interpolation::Spline(_) | Interpolation::Monotone(_) => ends.to_vec(),
                // the last row equals the first row of the next period
                _ if *periodic => rows.iter().rev().skip(1).rev().map(|row| row[0]).collect(),
                Interpolation::Linear => corners(rows, |row| (row[0], [row[1], T::ZERO, T::ZERO])),
                Interpolation::Hold => {
                    let jumps = rows.windows(2).filter(|pair| pair[0][1] != pair[1][1]);
                    jumps.map(|pair| pair[1][0]).collect()
                }
            };
            let period = if *periodic { [ends[0], ends[1] - ends[0]] } else { [T::ZERO; 2] };
            Some(Times { times, is_jump, period })
        }
        _ => None,
    })
}

/// Times of the rows at which a linear table has a corner.
fn corners<T: Real, R: Copy>(rows: &[R], row: impl Fn(R) -> (T, [T; 3])) -> Vec<T> {
    let still = [T::ZERO; 3];
    let slope = |i: usize| {
        let pair = (rows.get(i), rows.get(i + 1));
        let (Some(&a), Some(&b)) = pair else { return still };
        let ((t, x), (u, y)) = (row(a), row(b));
        core::array::from_fn(|k| (y[k] - x[k]) / (u - t))
    };
    let bends = |i: &usize| {
        let before = if *i == 0 { still } else { slope(*i - 1) };
        let pairs = before.into_iter().zip(slope(*i));
        pairs.into_iter().any(|(a, b)| (a - b).abs() > T::from_f64(STRAIGHT) * a.abs().max(b.abs()))
    };
    (0..rows.len()).filter(bends).map(|i| row(rows[i]).0).collect()
}
