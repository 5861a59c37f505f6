//! Signals that depend on the motion, as a list of operations on the signals of one instant.
//!
//! ```text
//! lag       T x' = u - x:  x = (x_n + h/2 x'_n + h/(2 T) u) / (1 + h/(2 T))
//! integral  x' = u:        x = x_n + h/2 (x'_n + u), within its limits; at a limit u counts only if it leads x back
//! pid       s = p e + i x + d e',  x' = e;  if s is at its limit and e leads it further, the integral x stops
//! ```
//!
//! u is the input of a signal, x its state, T its time constant and h the step. e is the target minus the measured value, s the output of
//! the controller, and p, i, d are its gains. These formulas are the trapezoidal rule over the step h, solved for the values at its end.
//! States of signals therefore have the same order of accuracy as the motion, in each iterate of a step. With h = 0 the states stay as they
//! are, and their rates are those of a first-order system.

use crate::Real;

/// Index of the state for a controller without an integral. It means that the controller has no state.
pub const NO_STATE: u32 = u32::MAX;

/// One operation of a list, with its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackStep<T> {
    /// Index of the target among the signals.
    pub to: u32,
    /// Operation on the value, rate and acceleration of the target.
    pub operation: FeedbackOperation<T>,
}

/// Operations on value, rate and acceleration of a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FeedbackOperation<T> {
    /// Reads a measured coordinate and its rate.
    Value {
        /// Index of the measured coordinate.
        number: u32,
    },
    /// Reads the rate of a measured coordinate.
    Rate {
        /// Index of the measured coordinate.
        number: u32,
    },
    /// Sets a constant, with which sums and products begin.
    Constant(T),
    /// Adds another signal times a factor.
    Add {
        /// Index of the source among the signals.
        from: u32,
        /// Factor of the source.
        factor: T,
    },
    /// Multiplies by another signal.
    Multiply {
        /// Index of the source among the signals.
        from: u32,
    },
    /// Applies a function to another signal.
    Curve {
        /// Index of the source among the signals.
        from: u32,
        /// Index of the function.
        curve: u32,
    },
    /// Limits another signal to a range.
    Clamp {
        /// Index of the source among the signals.
        from: u32,
        /// Limits of the value, the lower one first.
        limits: [T; 2],
    },
    /// Ratio of the limited signal to the signal itself; one within the limits and at zero.
    LimitRatio {
        /// Index of the source among the signals.
        from: u32,
        /// Limits of the signal, the lower one first.
        limits: [T; 2],
    },
    /// Lag of first order behind the source.
    Lag {
        /// Index of the source among the signals.
        from: u32,
        /// Index of the integrated state.
        state: u32,
        /// Time constant of the lag [s].
        time: T,
    },
    /// Integral of another signal over time.
    Integral {
        /// Index of the source among the signals.
        from: u32,
        /// Index of the integrated state.
        state: u32,
        /// Limits of the integral, the lower one first. Infinite: no limit.
        limits: [T; 2],
    },
    /// Output of a PID controller.
    Pid {
        /// Indices of the target signal and of the measured signal.
        from: [u32; 2],
        /// Index of the integrated state; [`NO_STATE`] if the controller has no integral.
        state: u32,
        /// Gains of the difference, of its integral and of its rate.
        gains: [T; 3],
        /// Largest magnitude of the output. Infinite: no limit.
        limit: T,
    },
    /// Copies the value of another signal into a component of a vector.
    Component {
        /// Index of the source among the signals.
        from: u32,
        /// Index of the component, from 0.
        component: u32,
    },
    /// Makes the value of another signal a force on a measured coordinate. The force is the first component. The others are its resistance:
    /// minus its derivatives by the coordinate and by the rate, at least zero.
    Force {
        /// Index of the source among the signals.
        from: u32,
        /// Index of the measured coordinate on which the force acts.
        on: u32,
    },
}

/// Derivatives of a signal by one measured coordinate and its rate. A signal that depends on several coordinates has only the derivatives
/// by the first of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CourseSlope<T> {
    /// Index of the measured coordinate; `u32::MAX` for none.
    pub of: u32,
    /// Derivative by the coordinate and by its rate.
    pub by: [T; 2],
}

impl<T: Real> CourseSlope<T> {
    /// Slope of a signal that depends on no measured coordinate.
    #[must_use]
    pub const fn none() -> Self {
        Self { of: u32::MAX, by: [T::ZERO; 2] }
    }

    fn scaled(self, factor: T) -> Self {
        Self { of: self.of, by: self.by.map(|x| factor * x) }
    }

    /// Adds the slope of another signal if both have the same coordinate. Otherwise the first slope that has a coordinate is the result.
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

/// Value, rate and acceleration of a signal.
type Signal<T> = [T; 3];

/// States of signals at the start of the step and at this instant, each with its rate.
#[derive(Debug)]
pub struct SignalStates<'a, T> {
    /// Time since the start of the step [s]. If it is zero, the states do not change.
    pub dt: T,
    /// States at the start.
    pub starts: &'a mut [[T; 2]],
    /// States at this instant.
    pub ends: &'a mut [[T; 2]],
    /// Derivatives of each signal by a measured coordinate and its rate.
    pub slopes: &'a mut [CourseSlope<T>],
}

/// Carries out operations in their order on the signals of one instant.
///
/// `measure` gives a measured coordinate and its rate, `curve` a function's value and two derivatives. A signal or state whose index is out
/// of range counts as zero.
///
/// Cost: a few products for each operation; no allocation.
///
/// # Errors
/// Errors of `measure` and `curve`.
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
                // a force that drives the motion gets no slope: the Newton iteration converges without it, and the matrix stays positive
                // definite
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

/// Evaluates an operation with a state. Other operations give zeros.
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
            // the rate of a signal that depends on a coordinate depends on the coordinate's rate
            let by = CourseSlope { of: by.of, by: [by.by[0], by.by[1] + d * of_e.by[0]] };
            let is_free = asked[0].abs() < limit;
            (asked, if is_free { by } else { CourseSlope::none() })
        }
        _ => ([T::ZERO; 3], CourseSlope::none()),
    }
}

impl<T: Real> SignalStates<'_, T> {
    /// Slope of the signal with index `number`.
    fn slope(&self, number: u32) -> CourseSlope<T> {
        self.slopes.get(number as usize).copied().unwrap_or(CourseSlope::none())
    }

    /// Sets the state with number `state` by `f`, from the step's length and the state at its start. Returns the signal.
    fn with(&mut self, state: u32, f: impl FnOnce(T, [T; 2]) -> (Signal<T>, [T; 2])) -> Signal<T> {
        let start = self.starts.get(state as usize).copied().unwrap_or([T::ZERO; 2]);
        let (signal, end) = f(self.dt, start);
        if let Some(to) = self.ends.get_mut(state as usize) {
            *to = end;
        }
        signal
    }
}

/// Copies the listed signals, with their rates, into `ends` after the first `n_states` entries.
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

/// Product of two signals, with its rate and acceleration.
pub(crate) fn product<T: Real>([a, da, dda]: Signal<T>, [b, db, ddb]: Signal<T>) -> Signal<T> {
    [a * b, da * b + a * db, dda * b + T::TWO * da * db + a * ddb]
}

/// Value, rate and acceleration of f(s) for a signal s, from f with its two derivatives: the chain rule.
pub(crate) fn chain<T: Real>([f, df, ddf]: [T; 3], [_, ds, dds]: Signal<T>) -> Signal<T> {
    [f, df * ds, ddf * ds * ds + df * dds]
}

/// Value and slope of f(s) for a signal s, from f with its two derivatives and the slope of s.
#[inline(always)]
fn through<T: Real>(f: [T; 3], s: Signal<T>, slope: CourseSlope<T>) -> (Signal<T>, CourseSlope<T>) {
    (chain(f, s), slope.scaled(f[1]))
}

/// Ratio of the limited number to the number itself, with two derivatives.
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

/// Signal limited to a range. Outside the range its rate and acceleration are zero.
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
