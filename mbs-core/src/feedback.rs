//! Signals that follow the motion, as a list of operations on the courses of an instant.
//!
//! ```text
//! lag       T x' = u - x:  x = (x_n + h/2 x'_n + h/(2 T) u) / (1 + h/(2 T))
//! integral  x' = u:        x = x_n + h/2 (x'_n + u), within its limits; beyond one u counts only where it leads back
//! pid       s = p e + i x + d e',  x' = e;  at the limit of s the integral stops, if e leads it further
//! ```
//!
//! These are the trapezoidal rule over the step h, solved for its end: so states of signals have the motion's order, at each iterate. With
//! h = 0 states are what they are, and their rates are those of a system of first order.

use crate::Real;

/// The state of a controller without an integral: it has none.
pub const NO_STATE: u32 = u32::MAX;

/// One operation of a list, with its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackStep<T> {
    /// Index of the target among the courses.
    pub to: u32,
    /// Operation on its value, rate and acceleration.
    pub operation: FeedbackOperation<T>,
}

/// Operations on value, rate and acceleration of a course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FeedbackOperation<T> {
    /// A measured coordinate with its rate.
    Value {
        /// Which of those that are measured.
        number: u32,
    },
    /// The rate of a measured coordinate.
    Rate {
        /// Which of those that are measured.
        number: u32,
    },
    /// Constant with which sums and products begin.
    Constant(T),
    /// Adds another course times a factor.
    Add {
        /// Index of the source among the courses.
        from: u32,
        /// Factor of the source.
        factor: T,
    },
    /// Multiplies by another course.
    Multiply {
        /// Index of the source among the courses.
        from: u32,
    },
    /// A function of another course.
    Curve {
        /// Index of the source among the courses.
        from: u32,
        /// The number of the function.
        curve: u32,
    },
    /// Another course within limits, the lower one first.
    Clamp {
        /// Index of the source among the courses.
        from: u32,
        /// Limits of the value, the lower one first.
        limits: [T; 2],
    },
    /// Another course within limits by that course; one where it is zero.
    LimitRatio {
        /// Index of the source among the courses.
        from: u32,
        /// Limits of the ratio, the lower one first.
        limits: [T; 2],
    },
    /// Lag of first order behind the source.
    Lag {
        /// Index of the source among the courses.
        from: u32,
        /// Which of the states.
        state: u32,
        /// By this time [s].
        time: T,
    },
    /// The integral of another course.
    Integral {
        /// Index of the source among the courses.
        from: u32,
        /// Which of the states.
        state: u32,
        /// Limits of the integral, the lower one first; infinite: it has none.
        limits: [T; 2],
    },
    /// Output of a PID controller.
    Pid {
        /// The wanted course and the measured one.
        from: [u32; 2],
        /// Which of the states; [`NO_STATE`] where nothing is integrated.
        state: u32,
        /// Factors of difference, integral and rate.
        gains: [T; 3],
        /// Largest size of what it asks for; infinite: there is none.
        limit: T,
    },
    /// The value of another course becomes a component of a vector.
    Component {
        /// Index of the source among the courses.
        from: u32,
        /// Index of the component, from 0.
        component: u32,
    },
    /// The value of another course becomes a force on a measured coordinate, its first component; how it resists the coordinate and the
    /// rate are the others.
    Force {
        /// Index of the source among the courses.
        from: u32,
        /// Which of those that are measured.
        on: u32,
    },
}

/// How a course answers to one of the measured coordinates; of several, the first that it is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CourseSlope<T> {
    /// Which of those that are measured.
    pub of: u32,
    /// By the coordinate and by its rate.
    pub by: [T; 2],
}

impl<T: Real> CourseSlope<T> {
    /// Of a course that answers to none.
    #[must_use]
    pub const fn none() -> Self {
        Self { of: u32::MAX, by: [T::ZERO; 2] }
    }

    fn scaled(self, factor: T) -> Self {
        Self { of: self.of, by: self.by.map(|x| factor * x) }
    }

    /// With the part of another, if that is of the same coordinate, or this one answers to none.
    fn plus(self, other: Self) -> Self {
        if self.of == u32::MAX {
            other
        } else if self.of == other.of {
            Self { of: self.of, by: core::array::from_fn(|k| self.by[k] + other.by[k]) }
        } else {
            self
        }
    }
}

/// A value, rate and acceleration.
type Signal<T> = [T; 3];

/// States of signals, at the start and at this instant: each is a value with its rate.
#[derive(Debug)]
pub struct SignalStates<'a, T> {
    /// Time since the start [s]; zero: states are those of the start.
    pub dt: T,
    /// States at the start.
    pub starts: &'a mut [[T; 2]],
    /// States at this instant.
    pub ends: &'a mut [[T; 2]],
    /// How each course answers to what is measured.
    pub slopes: &'a mut [CourseSlope<T>],
}

/// Carries out operations in their order on the courses of an instant.
///
/// `measure` gives a measured coordinate and its rate, `curve` a function's value and two derivatives. Courses and states that are not
/// there count as zero.
///
/// Cost: a few products for each operation; no allocation.
///
/// # Errors
/// What `measure` or `curve` cannot give.
pub fn follow<T: Real, E>(
    steps: &[FeedbackStep<T>],
    mut measure: impl FnMut(u32) -> Result<[T; 2], E>,
    curve: impl Fn(u32, T) -> Result<[T; 3], E>,
    states: &mut SignalStates<'_, T>,
    courses: &mut [Signal<T>],
) -> Result<(), E> {
    for step in steps {
        let of = |number: u32| courses.get(number as usize).copied().unwrap_or([T::ZERO; 3]);
        let mine = of(step.to);
        let (value, by) = match step.operation {
            FeedbackOperation::Value { number } => {
                let [value, rate] = measure(number)?;
                ([value, rate, T::ZERO], CourseSlope { of: number, by: [T::ONE, T::ZERO] })
            }
            FeedbackOperation::Rate { number } => {
                let by = CourseSlope { of: number, by: [T::ZERO, T::ONE] };
                ([measure(number)?[1], T::ZERO, T::ZERO], by)
            }
            FeedbackOperation::Constant(value) => ([value, T::ZERO, T::ZERO], CourseSlope::none()),
            FeedbackOperation::Add { from, factor } => {
                let other = of(from);
                let by = states.slope(step.to).plus(states.slope(from).scaled(factor));
                (core::array::from_fn(|k| mine[k] + factor * other[k]), by)
            }
            FeedbackOperation::Multiply { from } => {
                let other = of(from);
                let [left, right] = [states.slope(step.to), states.slope(from)];
                (product(mine, other), left.scaled(other[0]).plus(right.scaled(mine[0])))
            }
            FeedbackOperation::Curve { from, curve: number } => {
                through(curve(number, of(from)[0])?, of(from), states.slope(from))
            }
            FeedbackOperation::Clamp { from, limits: [lower, upper] } => {
                let s = of(from);
                let is_free = s[0] >= lower && s[0] <= upper;
                let by = if is_free { states.slope(from) } else { CourseSlope::none() };
                (clamp(s, [lower, upper]), by)
            }
            FeedbackOperation::LimitRatio { from, limits } => {
                through(limit_ratio(of(from)[0], limits), of(from), states.slope(from))
            }
            FeedbackOperation::Lag { .. }
            | FeedbackOperation::Integral { .. }
            | FeedbackOperation::Pid { .. } => integrate(step.operation, of, states),
            FeedbackOperation::Component { from, component } => {
                let mut vector = mine;
                if let Some(to) = vector.get_mut(component as usize) {
                    *to = of(from)[0];
                }
                (vector, CourseSlope::none())
            }
            FeedbackOperation::Force { from, on } => {
                let by = states.slope(from);
                // what pushes the way it is pushed is left to the iteration: the matrix stays definite
                let resists = |slope: T| if by.of == on { (-slope).max(T::ZERO) } else { T::ZERO };
                ([of(from)[0], resists(by.by[0]), resists(by.by[1])], CourseSlope::none())
            }
        };
        if let Some(to) = courses.get_mut(step.to as usize) {
            *to = value;
        }
        if let Some(to) = states.slopes.get_mut(step.to as usize) {
            *to = by;
        }
    }
    Ok(())
}

/// The operations with a state; others give nothing.
#[inline(always)]
fn integrate<T: Real>(
    operation: FeedbackOperation<T>,
    of: impl Fn(u32) -> Signal<T>,
    states: &mut SignalStates<'_, T>,
) -> (Signal<T>, CourseSlope<T>) {
    let h = states.dt;
    match operation {
        FeedbackOperation::Lag { from, state, time } => {
            let share = h * T::HALF / time;
            let by = states.slope(from).scaled(share / (T::ONE + share));
            let lag = states.with(state, |h, start| lag((h, time), start, of(from)[0]));
            (lag, by)
        }
        FeedbackOperation::Integral { from, state, limits } => {
            let by = states.slope(from).scaled(h * T::HALF);
            let sum = states.with(state, |h, start| integral((h, limits), start, of(from)));
            (sum, by)
        }
        FeedbackOperation::Pid { from, state, gains, limit } => {
            let ([wanted, wanted_t, _], [measured, measured_t, _]) = (of(from[0]), of(from[1]));
            let e = [wanted - measured, wanted_t - measured_t];
            let asked = states.with(state, |h, start| pid((h, gains, limit), start, e));
            let of_e = states.slope(from[1]).scaled(-T::ONE).plus(states.slope(from[0]));
            let [p, i, d] = gains;
            let by = of_e.scaled(p + i * h * T::HALF);
            // the rate of what answers to a coordinate answers to the coordinate's rate
            let by = CourseSlope { of: by.of, by: [by.by[0], by.by[1] + d * of_e.by[0]] };
            let is_free = asked[0].abs() < limit;
            (asked, if is_free { by } else { CourseSlope::none() })
        }
        _ => ([T::ZERO; 3], CourseSlope::none()),
    }
}

impl<T: Real> SignalStates<'_, T> {
    /// How a course answers.
    fn slope(&self, number: u32) -> CourseSlope<T> {
        self.slopes.get(number as usize).copied().unwrap_or(CourseSlope::none())
    }

    /// Sets a state by the step's length and its start; what is left is its signal.
    fn with(&mut self, state: u32, f: impl FnOnce(T, [T; 2]) -> (Signal<T>, [T; 2])) -> Signal<T> {
        let start = self.starts.get(state as usize).copied().unwrap_or([T::ZERO; 2]);
        let (signal, end) = f(self.dt, start);
        if let Some(to) = self.ends.get_mut(state as usize) {
            *to = end;
        }
        signal
    }
}

/// Notes the courses of these numbers, with their rates, behind the first `n_states` of `ends`.
pub fn note_followed<T: Real>(
    (signals, n_states): (&[u32], usize),
    courses: &[Signal<T>],
    ends: &mut [[T; 2]],
) {
    for (to, &signal) in ends.iter_mut().skip(n_states).zip(signals) {
        if let Some(&[value, rate, _]) = courses.get(signal as usize) {
            *to = [value, rate];
        }
    }
}

/// The product of two signals.
pub(crate) fn product<T: Real>([a, da, dda]: Signal<T>, [b, db, ddb]: Signal<T>) -> Signal<T> {
    [a * b, da * b + a * db, dda * b + T::TWO * da * db + a * ddb]
}

/// A function, with two derivatives, of a signal.
pub(crate) fn chain<T: Real>([f, df, ddf]: [T; 3], [_, ds, dds]: Signal<T>) -> Signal<T> {
    [f, df * ds, ddf * ds * ds + df * dds]
}

/// A function of a signal, by its value and its derivatives, and how that answers to what is measured.
#[inline(always)]
fn through<T: Real>(f: [T; 3], s: Signal<T>, slope: CourseSlope<T>) -> (Signal<T>, CourseSlope<T>) {
    (chain(f, s), slope.scaled(f[1]))
}

/// A number within limits by that number, with its derivatives.
pub(crate) fn limit_ratio<T: Real>(s: T, [lower, upper]: [T; 2]) -> [T; 3] {
    let limit = if s > upper {
        upper
    } else if s < lower {
        lower
    } else {
        return [T::ONE, T::ZERO, T::ZERO];
    };
    let ratio = limit / s;
    let slope = T::ZERO - ratio / s;
    [ratio, slope, T::ZERO - (slope + slope) / s]
}

/// A signal within limits.
pub(crate) fn clamp<T: Real>(s: Signal<T>, [lower, upper]: [T; 2]) -> Signal<T> {
    let held = |value: T| [value, T::ZERO, T::ZERO];
    if s[0] < lower {
        held(lower)
    } else if s[0] > upper {
        held(upper)
    } else {
        s
    }
}

fn lag<T: Real>((h, time): (T, T), [x, rate]: [T; 2], u: T) -> (Signal<T>, [T; 2]) {
    let share = h * T::HALF / time;
    let x = (x + h * T::HALF * rate + share * u) / (T::ONE + share);
    let rate = (u - x) / time;
    ([x, rate, T::ZERO], [x, rate])
}

fn integral<T: Real>(
    (h, [lower, upper]): (T, [T; 2]),
    [x, rate]: [T; 2],
    [u, u_t, _]: Signal<T>,
) -> (Signal<T>, [T; 2]) {
    let free = x + h * T::HALF * (rate + u);
    let is_held = (free >= upper && u > T::ZERO) || (free <= lower && u < T::ZERO);
    let x = free.max(lower).min(upper);
    if is_held { ([x, T::ZERO, T::ZERO], [x, T::ZERO]) } else { ([x, u, u_t], [x, u]) }
}

fn pid<T: Real>(
    (h, [p, i, d], limit): (T, [T; 3], T),
    [x, rate]: [T; 2],
    [e, e_t]: [T; 2],
) -> (Signal<T>, [T; 2]) {
    let asked = |x: T| p * e + i * x + d * e_t;
    let held = |s: T| [s, T::ZERO, T::ZERO];
    let free = x + h * T::HALF * (rate + e);
    let wanted = asked(free);
    let leads_on = i * e * wanted > T::ZERO;
    if wanted.abs() <= limit {
        return (held(wanted), [free, e]);
    }
    let s = if wanted > T::ZERO { limit } else { -limit };
    if leads_on {
        let x = x + h * T::HALF * rate;
        return (held(s), [x, T::ZERO]);
    }
    (held(s), [free, e])
}
