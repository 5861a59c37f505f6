//! Prepared signals of a scene: value, rate and acceleration of each by the chain rule.
//!
//! ```text
//! sum      [Σ f s, Σ f s', Σ f s'']
//! product  [a b, a' b + a b', a'' b + 2 a' b' + a b'']
//! curve    [f(s), f' s', f'' s'^2 + f' s'']
//! step     s^3 (10 - 15 s + 6 s^2),  30 s^2 (1 - s)^2 / T,  60 s (1 - s) (1 - 2 s) / T^2
//! chirp    phase 2π (f t + (f' - f) t^2 / (2 T)), f' the last frequency, which is kept after the duration T
//! ```

use super::feedback::{Feedback, number};
use crate::Real;
use crate::feedback::{FeedbackOperation, NO_STATE, chain, clamp, limit_ratio, product};
use crate::laws::guide;
use crate::measure::{PreparedCurve, TermInput, within};
use crate::scene::{Interpolation, NamedSignal, SignalId, SignalKind, first_of, signal_order};
use alloc::vec;
use alloc::vec::Vec;

/// Signals of a scene, prepared once.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalGraph<T> {
    nodes: Vec<Node<T>>,
    /// Order of evaluation: each signal after its operands.
    order: Vec<usize>,
    /// Index of each signal that is an input, and its start value.
    inputs: Vec<(usize, T)>,
    /// True for each signal that depends on the motion.
    follows: Vec<bool>,
    /// True for each signal that changes, by itself or through its operands.
    moves: Vec<bool>,
}

/// Prepared signal of the scene.
#[derive(Debug, Clone, PartialEq)]
struct Node<T> {
    kind: SignalKind<T>,
    /// Prepared form of a spline or a curve.
    curve: PreparedCurve<T>,
    /// Place of the signal among the inputs.
    input: usize,
}

impl<T: Real> SignalGraph<T> {
    /// Prepares the signals of a scene. Signals in a circle, which the check of a scene refuses, are zero.
    ///
    /// Cost: one tridiagonal elimination for each spline, and one pass over the signals.
    #[must_use]
    pub fn new(signals: &[NamedSignal<T>]) -> Self {
        let (mut nodes, mut inputs) = (Vec::with_capacity(signals.len()), Vec::new());
        for (i, NamedSignal { kind, .. }) in signals.iter().enumerate() {
            nodes.push(Node { kind: kind.clone(), curve: curve(kind), input: inputs.len() });
            if let SignalKind::Input { value, .. } = kind {
                inputs.push((i, *value));
            }
        }
        let order = signal_order(signals).unwrap_or_default();
        let has = |is_one: fn(&SignalKind<T>) -> bool| {
            first_of(signals, &order, is_one).iter().map(Option::is_some).collect::<Vec<_>>()
        };
        let follows = has(SignalKind::is_feedback);
        let moves = has(SignalKind::moves);
        Self { nodes, order, inputs, follows, moves }
    }

    /// Number of signals of the scene.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// True if the list of signals is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Index of each signal that is an input, and its start value.
    #[must_use]
    pub fn inputs(&self) -> &[(usize, T)] {
        &self.inputs
    }

    /// Kind of each signal, with the prepared spline of a table or function of a curve.
    pub fn kinds(&self) -> impl Iterator<Item = (&SignalKind<T>, &PreparedCurve<T>)> {
        self.nodes.iter().map(|node| (&node.kind, &node.curve))
    }

    /// True if the signal is constant: a constant itself, or a function of constants.
    #[must_use]
    pub fn is_constant(&self, signal: SignalId) -> bool {
        !self.moves.get(signal.index()).copied().unwrap_or(false)
    }

    /// Indices of the signals that depend on the motion.
    pub(super) fn following(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.follows.iter().enumerate().filter_map(|(i, &follows)| follows.then_some(i))
    }

    /// True if the signal depends on the motion, by itself or through its operands.
    #[must_use]
    pub fn follows_motion(&self, signal: SignalId) -> bool {
        self.follows.get(signal.index()).copied().unwrap_or(false)
    }

    /// Writes value, rate and acceleration of each signal at time `t`, with `inputs` in their order. Signals that depend on the
    /// motion are left unchanged: [`Feedback`](crate::inputs::Feedback) computes them.
    ///
    /// Cost: one evaluation for each signal; no allocation.
    pub fn write(&self, t: T, inputs: &[T], values: &mut [[T; 3]]) {
        for &i in self.order.iter().filter(|&&i| !self.follows[i]) {
            let Some(node) = self.nodes.get(i) else { continue };
            let value = node.at(t, inputs, values);
            if let Some(to) = values.get_mut(i) {
                *to = value;
            }
        }
    }

    /// Adds the operations of the signals for which `is_taken` holds, in their order.
    pub(super) fn add_feedback(&self, is_taken: impl Fn(SignalId) -> bool, to: &mut Feedback<T>) {
        for &i in self.order.iter().filter(|&&i| is_taken(SignalId::new(i))) {
            self.nodes[i].add_feedback(number(i), to);
        }
    }

    /// Value, rate and acceleration of each signal at time `t`, with the start values of inputs.
    #[must_use]
    pub fn values(&self, t: T) -> Vec<[T; 3]> {
        let mut values = vec![[T::ZERO; 3]; self.len()];
        self.write(t, &[], &mut values);
        values
    }
}

/// Prepared function of a smooth table or of a curve.
fn curve<T: Real>(kind: &SignalKind<T>) -> PreparedCurve<T> {
    match kind {
        SignalKind::Curve { curve, .. } => PreparedCurve::new(Some(curve)),
        SignalKind::Table { rows, interpolation, periodic } if interpolation.ends().is_some() => {
            PreparedCurve::table(rows, *interpolation, *periodic)
        }
        _ => PreparedCurve::Identity,
    }
}

/// Value of a signal, from the list of the values of all signals. Zero if there is no such signal.
pub(super) fn value_of<T: Real>(signal: SignalId, values: &[[T; 3]]) -> [T; 3] {
    values.get(signal.index()).copied().unwrap_or([T::ZERO; 3])
}

impl<T: Real> Node<T> {
    fn at(&self, t: T, inputs: &[T], values: &[[T; 3]]) -> [T; 3] {
        let of = |signal: &SignalId| value_of(*signal, values);
        let held = |value: T| [value, T::ZERO, T::ZERO];
        match &self.kind {
            SignalKind::Constant(value) => held(*value),
            SignalKind::Input { value, .. } => {
                held(inputs.get(self.input).copied().unwrap_or(*value))
            }
            SignalKind::Table { rows, interpolation, periodic } => match interpolation {
                Interpolation::Spline(_) | Interpolation::Monotone(_) => self.curve.at(t),
                way => pieces(rows, (*way == Interpolation::Hold, *periodic), t),
            },
            SignalKind::Sine { amplitude, frequency, phase, offset } => {
                let m = guide::sine(*amplitude, *frequency, *phase, t);
                [*offset + m.value, m.rate, m.acceleration]
            }
            SignalKind::Chirp { amplitude, frequency, to_frequency, duration, phase, offset } => {
                let [turns, rate, growth] = swept([*frequency, *to_frequency], *duration, t);
                let turn = T::TWO * T::PI;
                let (sin, cos) = (turn * turns + *phase).sin_cos();
                let (w, dw, a) = (turn * rate, turn * growth, *amplitude);
                [*offset + a * sin, a * w * cos, a * (dw * cos - w * w * sin)]
            }
            SignalKind::Ramp { rate, start, end, rounding } => {
                let begun = corner(t - *start, *rounding);
                let ended = end.map_or([T::ZERO; 3], |end| corner(t - end, *rounding));
                core::array::from_fn(|i| *rate * (begun[i] - ended[i]))
            }
            SignalKind::Step { from, to, at, rise } => guide::step([*from, *to], (t - *at, *rise)),
            SignalKind::Sum { of: signals, factors } => {
                let parts = signals.iter().zip(factors);
                parts.fold([T::ZERO; 3], |sum, (signal, &factor)| {
                    let s = of(signal);
                    core::array::from_fn(|i| sum[i] + factor * s[i])
                })
            }
            SignalKind::Product { of: signals } => {
                let one = [T::ONE, T::ZERO, T::ZERO];
                signals.iter().fold(one, |all, signal| product(all, of(signal)))
            }
            SignalKind::Curve { of: signal, .. } => {
                let s = of(signal);
                chain(self.curve.at(s[0]), s)
            }
            SignalKind::Clamp { of: signal, lower, upper } => clamp(of(signal), [*lower, *upper]),
            SignalKind::LimitRatio { of: signal, lower, upper } => {
                let s = of(signal);
                chain(limit_ratio(s[0], [*lower, *upper]), s)
            }
            // computed by the feedback operations, because they depend on the motion
            SignalKind::Measure { .. }
            | SignalKind::Lag { .. }
            | SignalKind::Integral { .. }
            | SignalKind::Pid { .. } => [T::ZERO; 3],
        }
    }
}

impl<T: Real> Node<T> {
    /// Adds the operations that compute the signal with this number.
    fn add_feedback(&self, to: u32, feedback: &mut Feedback<T>) {
        let id = |signal: &SignalId| number(signal.index());
        let limit = |limit: Option<T>, sign: f64| {
            limit.unwrap_or_else(|| T::from_f64(sign * f64::INFINITY))
        };
        match &self.kind {
            SignalKind::Measure { of, is_rate } => {
                let number = feedback.measure(TermInput::measured(of));
                feedback.push(
                    to,
                    if *is_rate {
                        FeedbackOperation::Rate { number }
                    } else {
                        FeedbackOperation::Value { number }
                    },
                );
            }
            SignalKind::Sum { of, factors } => {
                feedback.push(to, FeedbackOperation::Constant(T::ZERO));
                for (of, &factor) in of.iter().zip(factors) {
                    feedback.push(to, FeedbackOperation::Add { from: id(of), factor });
                }
            }
            SignalKind::Product { of } => {
                feedback.push(to, FeedbackOperation::Constant(T::ONE));
                for of in of {
                    feedback.push(to, FeedbackOperation::Multiply { from: id(of) });
                }
            }
            SignalKind::Curve { of, .. } => {
                let curve = feedback.curve(&self.curve);
                feedback.push(to, FeedbackOperation::Curve { from: id(of), curve });
            }
            SignalKind::LimitRatio { of, lower, upper } => {
                let limits = [*lower, *upper];
                feedback.push(to, FeedbackOperation::LimitRatio { from: id(of), limits });
            }
            SignalKind::Clamp { of, lower, upper } => {
                let limits = [*lower, *upper];
                feedback.push(to, FeedbackOperation::Clamp { from: id(of), limits });
            }
            SignalKind::Lag { of, time, value } => {
                let state = feedback.state(*value);
                feedback.push(to, FeedbackOperation::Lag { from: id(of), state, time: *time });
            }
            SignalKind::Integral { of, lower, upper, value } => {
                let state = feedback.state(*value);
                let limits = [limit(*lower, -1.0), limit(*upper, 1.0)];
                feedback.push(to, FeedbackOperation::Integral { from: id(of), state, limits });
            }
            SignalKind::Pid { of: [wanted, measured], p, i, d, limit: largest } => {
                // without integral gain the integral has no effect, and would never come to rest
                let state = if i.is_zero() { NO_STATE } else { feedback.state(T::ZERO) };
                let (from, gains) = ([id(wanted), id(measured)], [*p, *i, *d]);
                let limit = limit(*largest, 1.0);
                feedback.push(to, FeedbackOperation::Pid { from, state, gains, limit });
            }
            // other kinds depend on time and inputs, and need no operation
            _ => {}
        }
    }
}

/// Value of a table at time `t` that is linear between rows, or holds each row until the next.
fn pieces<T: Real>(rows: &[[T; 2]], (is_held, is_periodic): (bool, bool), t: T) -> [T; 3] {
    let period = match rows {
        [first, .., last] if is_periodic => last[0] - first[0],
        _ => T::ZERO,
    };
    let t = within(rows, period, t);
    let next = rows.partition_point(|row| row[0] <= t);
    match (next.checked_sub(1).and_then(|i| rows.get(i)), rows.get(next)) {
        (Some(&[t0, x0]), Some(&[t1, x1])) if !is_held => {
            let s = (t - t0) / (t1 - t0);
            [x0 + (x1 - x0) * s, (x1 - x0) / (t1 - t0), T::ZERO]
        }
        (Some(&[_, x]), _) | (None, Some(&[_, x])) => [x, T::ZERO, T::ZERO],
        (None, None) => [T::ZERO; 3],
    }
}

/// Phase in turns since the start, for a frequency that changes linearly during `duration`, with its derivatives.
fn swept<T: Real>([from, to]: [T; 2], duration: T, t: T) -> [T; 3] {
    let growth = (to - from) / duration;
    if t > duration {
        return [(from + to) * T::HALF * duration + to * (t - duration), to, T::ZERO];
    }
    [(from + growth * T::HALF * t) * t, from + growth * t, growth]
}

/// Function max(x, 0) with a corner rounded over a length, half of it before zero and half after. The rate rises by u^2 (3 - 2 u).
fn corner<T: Real>(x: T, rounding: T) -> [T; 3] {
    let half = rounding * T::HALF;
    if x >= half {
        return [x, T::ONE, T::ZERO];
    }
    if x <= -half {
        return [T::ZERO; 3];
    }
    let (u, three) = ((x + half) / rounding, T::from_f64(3.0));
    let rate = u * u * (three - T::TWO * u);
    let acceleration = T::TWO * three * u * (T::ONE - u) / rounding;
    [rounding * u * u * u * (T::ONE - u * T::HALF), rate, acceleration]
}
