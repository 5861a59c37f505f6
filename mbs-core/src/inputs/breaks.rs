//! When signals of time alone jump or have corners: times at which controlled steps end.
//!
//! Known are steps without `rise`, ramps without `rounding`, and rows of tables that are linear or hold, also of forces; and the ends of
//! splines. What signals are made of has the same times. Not known are those of clamps and inputs, and of what follows the motion.

use super::signals::SignalGraph;
use crate::Real;
use crate::scene::{Interpolation, Signal, SignalKind};
use alloc::vec;
use alloc::vec::Vec;

/// A time at which a signal jumps or has a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignalTime<T> {
    /// The time [s].
    pub time: T,
    /// Does a value jump, and not a rate alone?
    pub is_jump: bool,
}

/// The times of a signal, ascending; with a period larger than zero they come again.
#[derive(Debug, Clone, PartialEq)]
struct Times<T> {
    times: Vec<T>,
    is_jump: bool,
    /// Where the first period begins, and its length [s].
    period: [T; 2],
}

/// The times of all signals of a scene that jump or have corners.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalTimes<T>(Vec<Times<T>>);

/// Change of a slope that is none, relative to the slopes [-]: that of rows of a straight line in short numbers. Chosen, not tuned.
const STRAIGHT: f64 = 1e-9;

impl<T: Real> SignalTimes<T> {
    /// Those of signals, and of the tables among the courses. Cost: one pass over them.
    pub(super) fn new<'a>(
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

    /// The first of them after a time [s]; of several at once a jump. Cost: a binary search for each signal that has some.
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
        // rounding may take the time into the period before or after its own
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
                Interpolation::Spline(_) if *periodic => return None,
                Interpolation::Spline(_) => ends.to_vec(),
                // the last row is the first of the next period
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

/// The times of the rows between which a table that is linear bends.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{NamedSignal, TableEnds};
    use alloc::string::String;

    fn times(kinds: Vec<SignalKind<f64>>) -> SignalTimes<f64> {
        let named = |kind| NamedSignal { name: String::new(), kind };
        let signals: Vec<_> = kinds.into_iter().map(named).collect();
        SignalTimes::new(&SignalGraph::new(&signals), core::iter::empty())
    }

    fn until(all: &SignalTimes<f64>, end: f64) -> Vec<(f64, bool)> {
        let mut found = Vec::new();
        let mut t = 0.0;
        while let Some(next) = all.after(t).filter(|next| next.time <= end) {
            assert!(next.time > t);
            found.push((next.time, next.is_jump));
            t = next.time;
        }
        found
    }

    #[test]
    fn steps_ramps_and_tables_have_their_times_and_smooth_signals_none() {
        let rows = || vec![[0.5, 1.0], [1.0, 2.0], [1.5, 3.0], [2.0, 3.0]];
        let table =
            |interpolation, periodic| SignalKind::Table { rows: rows(), interpolation, periodic };
        let step = |rise: f64| SignalKind::Step { from: 0.0, to: 2.0, at: 0.3, rise };
        let ramp =
            |rounding: f64| SignalKind::Ramp { rate: 2.0, start: 0.2, end: Some(0.7), rounding };
        let of = |kind| until(&times(vec![kind]), 10.0);
        assert_eq!(of(step(0.0)), [(0.3, true)]);
        assert_eq!(of(ramp(0.0)), [(0.2, false), (0.7, false)]);
        // straight from 0.5 to 1.5, then level
        assert_eq!(of(table(Interpolation::Linear, false)), [(0.5, false), (1.5, false)]);
        assert_eq!(of(table(Interpolation::Hold, false)), [(1.0, true), (1.5, true)]);
        let spline = Interpolation::Spline(TableEnds::Natural);
        assert_eq!(of(table(spline, false)), [(0.5, false), (2.0, false)]);
        for smooth in [step(0.1), ramp(0.1), SignalKind::Constant(2.0), table(spline, true)] {
            assert_eq!(of(smooth), []);
        }
        let both = until(&times(vec![step(0.0), ramp(0.0)]), 10.0);
        assert_eq!(both, [(0.2, false), (0.3, true), (0.7, false)]);
    }

    #[test]
    fn tables_that_repeat_have_times_in_every_period() {
        let rows = vec![[0.1, 0.0], [0.2, 1.0], [0.4, 0.0]];
        let kind = SignalKind::Table { rows, interpolation: Interpolation::Hold, periodic: true };
        let all = times(vec![kind]);
        let found = until(&all, 100.0);
        // two in each period of 0.3 s, as its end is the beginning of the next
        assert!((660..=670).contains(&found.len()), "{}", found.len());
        for pair in found.windows(2) {
            let gap = pair[1].0 - pair[0].0;
            assert!((gap - 0.1).abs() < 1e-12 || (gap - 0.2).abs() < 1e-12, "{pair:?}");
        }
    }
}
