//! Values and rates of signals, rates of their states, and the times at which signals jump or have a corner.

use crate::loads::Now;
use crate::scene::{Curve, Given, Law, Source};
use crate::vector::{Vector, add, scale};
use core::f64::consts::PI;

/// A value with its first and second derivative by time.
type Jet = [f64; 3];

/// The composition g(f(t)) with its derivatives by time. `inner` is f with its derivatives by time; the first argument is g with its
/// derivatives by f.
fn chain([value, slope, bend]: Jet, inner: Jet) -> Jet {
    [value, slope * inner[1], bend * inner[1] * inner[1] + slope * inner[2]]
}

/// amplitude times sin(angle) plus offset, as a function of time.
fn wave(amplitude: f64, offset: f64, angle: Jet) -> Jet {
    let (s, c) = angle[0].sin_cos();
    let [x, rate, bend] = chain([s, c, -s], angle).map(|x| amplitude * x);
    [x + offset, rate, bend]
}

/// max(x, 0) with its corner rounded over the width r = `rounding`. The rate rises by u² (3 - 2 u), where u = (x + r/2)/r.
fn corner(x: f64, rounding: f64) -> Jet {
    let half = 0.5 * rounding;
    if x >= half {
        return [x, 1.0, 0.0];
    }
    if x <= -half {
        return [0.0; 3];
    }
    let u = (x + half) / rounding;
    // the integral of u² (3 - 2 u), times the rounding
    let value = rounding * (u.powi(3) - 0.5 * u.powi(4));
    [value, u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / rounding]
}

/// Returns the ratio L/x, where L is the number x limited to a range. The ratio is one within the range.
fn limit_ratio([x, dx, ddx]: Jet, [lower, upper]: [f64; 2]) -> Jet {
    if (lower..=upper).contains(&x) {
        return [1.0, 0.0, 0.0];
    }
    // (L/x)'' = L (2 x'²/x³ - x''/x²)
    let limit = if x < 0.0 { lower } else { upper };
    [limit / x, -limit * dx / (x * x), limit * (2.0 * dx * dx / x - ddx) / (x * x)]
}

impl Source {
    /// Value and derivatives at a time. The closure `follows` evaluates sources that depend on the motion.
    fn jet(&self, t: f64, follows: &dyn Fn(&Self) -> Jet) -> Jet {
        match self {
            Self::Constant(x) => [*x, 0.0, 0.0],
            Self::Table(curve) => curve.at(t),
            Self::Sine([amplitude, frequency, phase, offset]) => {
                let w = 2.0 * PI * frequency;
                wave(*amplitude, *offset, [w * t + phase, w, 0.0])
            }
            Self::Chirp([amplitude, from, phase, offset, to, duration]) => {
                let (part, growth) = (t.min(*duration), (to - from) / duration);
                let turns = from * part + 0.5 * growth * part * part + to * (t - part);
                let growth = if t < *duration { growth } else { 0.0 };
                let frequency = from + (to - from) / duration * part;
                let angle = [turns + phase / (2.0 * PI), frequency, growth];
                wave(*amplitude, *offset, angle.map(|x| 2.0 * PI * x))
            }
            Self::Ramp([rate, start, end, rounding]) => {
                let (begun, ended) = (corner(t - start, *rounding), corner(t - end, *rounding));
                [0, 1, 2].map(|i| rate * (begun[i] - ended[i]))
            }
            Self::Step([from, to, at, rise]) => {
                if t < *at {
                    return [*from, 0.0, 0.0];
                }
                if t >= at + rise {
                    return [*to, 0.0, 0.0];
                }
                let s = (t - at) / rise;
                let smooth = Curve::Polynomial(vec![0.0, 0.0, 0.0, 10.0, -15.0, 6.0]).at(s);
                let [x, slope, bend] = chain(smooth, [s, 1.0 / rise, 0.0]);
                [from + (to - from) * x, (to - from) * slope, (to - from) * bend]
            }
            Self::Sum(terms) => terms.iter().fold([0.0; 3], |sum, (factor, source)| {
                let x = source.jet(t, follows);
                [0, 1, 2].map(|i| sum[i] + factor * x[i])
            }),
            Self::Product(factors) => factors.iter().fold([1.0, 0.0, 0.0], |[x, u, a], source| {
                let [y, v, b] = source.jet(t, follows);
                [x * y, u * y + x * v, a * y + 2.0 * u * v + x * b]
            }),
            Self::Of(curve, inner) => {
                let inner = inner.jet(t, follows);
                chain(curve.at(inner[0]), inner)
            }
            Self::LimitRatio(inner, [lower, upper]) => {
                limit_ratio(inner.jet(t, follows), [*lower, *upper])
            }
            Self::Clamp(inner, [lower, upper]) => {
                let x = inner.jet(t, follows);
                if x[0] < *lower {
                    [*lower, 0.0, 0.0]
                } else if x[0] > *upper {
                    [*upper, 0.0, 0.0]
                } else {
                    x
                }
            }
            Self::Measure(..) | Self::Lag(..) | Self::Integral(..) | Self::Pid(..) => follows(self),
        }
    }

    /// Adds the times at which the source jumps or has a corner.
    pub(crate) fn corners(&self, times: &mut Vec<f64>) {
        match self {
            Self::Table(Curve::Linear(rows, repeats) | Curve::Hold(rows, repeats)) => {
                let period = rows[rows.len() - 1][0] - rows[0][0];
                let periods = if *repeats { -PERIODS..=PERIODS } else { 0..=0 };
                for k in periods {
                    times.extend(rows.iter().map(|row| row[0] + f64::from(k) * period));
                }
            }
            Self::Table(Curve::Spline(spline)) => {
                times.extend(spline.knots.first().iter().chain(&spline.knots.last()).map(|k| k[0]));
            }
            Self::Ramp([_, start, end, rounding]) => {
                let half = 0.5 * rounding;
                times.extend([*start, *end].iter().flat_map(|t| [t - half, t + half]));
            }
            Self::Step([_, _, at, rise]) => times.extend([*at, at + rise]),
            Self::Chirp([.., duration]) => times.push(*duration),
            Self::Sum(terms) => terms.iter().for_each(|(_, source)| source.corners(times)),
            Self::Product(factors) => factors.iter().for_each(|source| source.corners(times)),
            Self::Of(_, inner)
            | Self::Clamp(inner, _)
            | Self::LimitRatio(inner, _)
            | Self::Lag(_, inner, _)
            | Self::Integral(_, inner, _) => inner.corners(times),
            Self::Pid(_, both, ..) => both.iter().for_each(|source| source.corners(times)),
            _ => {}
        }
    }
}

/// Number of periods, before and after the first, in which steps end at the rows of a periodic table. Chosen, not tuned.
const PERIODS: i32 = 50;

impl Law {
    /// Value and two derivatives at a time.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        match self {
            Self::Curve(curve) => curve.at(t),
            Self::Ramp(rate) => [rate * t, *rate, 0.0],
            Self::Sine([amplitude, frequency, phase]) => {
                let w = 2.0 * PI * frequency;
                wave(*amplitude, 0.0, [w * t + phase, w, 0.0])
            }
            Self::Signal(source) => source.jet(t, &|_| [0.0; 3]),
        }
    }
}

impl Now<'_> {
    /// A signal's value and derivatives by time. The derivatives of a controller's output are given as zero, and so are those of a measured
    /// rate.
    pub(crate) fn source(&self, source: &Source) -> Jet {
        source.jet(self.t, &|source| self.followed(source))
    }

    fn followed(&self, source: &Source) -> Jet {
        match source {
            Source::Measure(measure, is_rate) => {
                let row = self.measure(measure);
                let rate = row.rate(self.places);
                if *is_rate { [rate, 0.0, 0.0] } else { [row.value, rate, 0.0] }
            }
            Source::Lag(slot, ..) | Source::Integral(slot, ..) => {
                [self.memory[*slot], self.memory_rate(source), 0.0]
            }
            Source::Pid(.., limit) => [self.asked(source).clamp(-limit, *limit), 0.0, 0.0],
            _ => [0.0; 3],
        }
    }

    /// Returns the output of a controller before it is limited.
    fn asked(&self, source: &Source) -> f64 {
        let Source::Pid(slot, both, [p, i, d], _) = source else { return 0.0 };
        let [e, rate] = self.difference(both);
        p * e + i * self.memory[*slot] + d * rate
    }

    /// Difference of target and measured value, and the rate of the difference.
    fn difference(&self, both: &[Box<Source>; 2]) -> [f64; 2] {
        let [target, measured] = [0, 1].map(|k| self.source(&both[k]));
        [target[0] - measured[0], target[1] - measured[1]]
    }

    /// The rate of a signal's state.
    pub(crate) fn memory_rate(&self, source: &Source) -> f64 {
        match source {
            Source::Lag(slot, inner, time) => (self.source(inner)[0] - self.memory[*slot]) / time,
            Source::Integral(slot, inner, [lower, upper]) => {
                let (x, rate) = (self.memory[*slot], self.source(inner)[0]);
                let stops = (x >= *upper && rate > 0.0) || (x <= *lower && rate < 0.0);
                if stops { 0.0 } else { rate }
            }
            Source::Pid(_, both, [_, i, _], limit) => {
                let (asked, [e, _]) = (self.asked(source), self.difference(both));
                let further = asked.abs() >= *limit && asked * i * e > 0.0;
                if further || *i == 0.0 { 0.0 } else { e }
            }
            _ => 0.0,
        }
    }

    /// Value of a vector at the current time.
    pub(crate) fn given(&self, given: &Given) -> Vector {
        match given {
            Given::Constant(value) => *value,
            Given::Rows(rows) => linear(rows, self.t),
            Given::Named(sources) => {
                [0, 1, 2].map(|i| sources[i].as_ref().map_or(0.0, |source| self.source(source)[0]))
            }
        }
    }
}

/// Linear interpolation between the rows, constant outside.
fn linear(rows: &[(f64, Vector)], t: f64) -> Vector {
    let i = rows.partition_point(|row| row.0 <= t);
    if i == 0 {
        return rows[0].1;
    }
    let Some(next) = rows.get(i) else { return rows[i - 1].1 };
    let (t0, x0) = rows[i - 1];
    let share = (t - t0) / (next.0 - t0);
    add(scale(1.0 - share, x0), scale(share, next.1))
}
