//! Signals: named numbers that depend on time or on the motion. They are constants, tables, waves, ramps, steps, inputs, or
//! functions of other signals.
//!
//! ```text
//! sum      Σ f_k s_k                      curve    f(s)
//! product  s_1 s_2 ...                    clamp    min(max(s, lower), upper)
//! measure  a joint's coordinate or rate   lag      time x' = s - x
//! limit-ratio  min(max(s, lower), upper)/s
//! integral x' = s, within limits          pid      p e + i x + d e',  x' = e = target - measured
//! ```
//!
//! Guides and couplings use signals of time that are twice differentiable. Forces and torques use any signal. Signals that depend
//! on the motion, and their states x, are part of the state of the mechanism. A step advances them, and a rejected step restores
//! them.

use crate::Real;
use crate::scene::{CouplingMeasure, Curve, CurveShape, SignalId, TableEnds};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt::{self, Display, Formatter};

/// A signal with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedSignal<T> {
    /// Unique name among the signals.
    pub name: String,
    /// Kind of the signal, with its numbers.
    pub kind: SignalKind<T>,
}

/// Interpolation of a table between its rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Cubic spline through the rows, with this condition at the ends.
    Spline(TableEnds),
    /// Twice differentiable function that stays between the values of neighbouring rows, with this condition at the ends.
    Monotone(TableEnds),
    /// Straight lines between the rows.
    Linear,
    /// Value of the latest row whose time has passed.
    Hold,
}

impl Interpolation {
    /// Condition at both ends of a spline or monotone table; `None` for an interpolation that is not smooth.
    #[must_use]
    pub const fn ends(self) -> Option<TableEnds> {
        match self {
            Self::Spline(ends) | Self::Monotone(ends) => Some(ends),
            Self::Linear | Self::Hold => None,
        }
    }

    /// Name of the interpolation in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spline(_) => "spline",
            Self::Monotone(_) => "monotone",
            Self::Linear => "linear",
            Self::Hold => "hold",
        }
    }
}

impl From<CurveShape> for Interpolation {
    fn from(shape: CurveShape) -> Self {
        match shape {
            CurveShape::Monotone => Self::Monotone(TableEnds::Natural),
            CurveShape::Linear => Self::Linear,
        }
    }
}

/// Kind of a signal, with its numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SignalKind<T> {
    /// Constant number, the same at all times.
    Constant(T),
    /// Table of rows (time, value). Before the first and after the last row the end value is held, or the table repeats.
    Table {
        /// The rows [s, unit of the signal].
        rows: Vec<[T; 2]>,
        /// Interpolation between the rows.
        interpolation: Interpolation,
        /// True if the table repeats. Its last value must then equal its first.
        periodic: bool,
    },
    /// Sine wave: offset + amplitude sin(2 pi frequency t + phase).
    Sine {
        /// Amplitude of the sine [unit of the signal].
        amplitude: T,
        /// Frequency of the sine [Hz].
        frequency: T,
        /// Phase at time zero [rad].
        phase: T,
        /// Mean of the sine [unit of the signal].
        offset: T,
    },
    /// Sine wave whose frequency changes at a constant rate for a duration, and is constant afterwards.
    Chirp {
        /// Amplitude of the chirp [unit of the signal].
        amplitude: T,
        /// Frequency at the start [Hz].
        frequency: T,
        /// Frequency after the duration [Hz].
        to_frequency: T,
        /// Duration of the change of frequency [s].
        duration: T,
        /// Phase at the start [rad].
        phase: T,
        /// Mean of the chirp [unit of the signal].
        offset: T,
    },
    /// Ramp: rate (t - start) between start and end. Zero before the start, constant after the end.
    Ramp {
        /// Rate of the ramp [unit of the signal per s].
        rate: T,
        /// Time at which the ramp begins [s].
        start: T,
        /// Time at which the ramp ends [s]; `None`: it never ends.
        end: Option<T>,
        /// Length of each rounded corner, half of it before the corner and half after [s]. Values outside the rounding do not
        /// change.
        rounding: T,
    },
    /// Smooth step between two values: from + (to - from) s^3 (10 - 15 s + 6 s^2), s = (t - at)/rise.
    Step {
        /// Value before the step.
        from: T,
        /// Value after the step.
        to: T,
        /// Time at which the step begins [s].
        at: T,
        /// Duration of the step [s]; zero makes a jump.
        rise: T,
    },
    /// Sum of signals, each times its factor.
    Sum {
        /// Signals that are added.
        of: Vec<SignalId>,
        /// Factors of the signals, in their order.
        factors: Vec<T>,
    },
    /// Product of several signals.
    Product {
        /// Signals that are multiplied.
        of: Vec<SignalId>,
    },
    /// Function (curve) of another signal.
    Curve {
        /// Signal that is the argument of the function.
        of: SignalId,
        /// Function of the signal.
        curve: Curve<T>,
    },
    /// Signal limited to a range.
    Clamp {
        /// Signal that is limited.
        of: SignalId,
        /// Lower limit of the value.
        lower: T,
        /// Upper limit of the value.
        upper: T,
    },
    /// Ratio of a limited signal to the signal itself; one where the signal is zero.
    LimitRatio {
        /// Signal that is limited.
        of: SignalId,
        /// The lower limit, at most zero.
        lower: T,
        /// The upper limit, at least zero.
        upper: T,
    },
    /// Input whose value is held until it is set between steps.
    Input {
        /// Value of the input at the start.
        value: T,
        /// Unit of the input, shown to users and not used in computation.
        unit: String,
    },
    /// Measured number of the mechanism, or its rate.
    Measure {
        /// Number that is measured. A length is the full length, not the difference from the reference configuration.
        of: CouplingMeasure<T>,
        /// True if the rate of the number is measured, and not its value.
        is_rate: bool,
    },
    /// First-order lag x of a signal s: time x' = s - x.
    Lag {
        /// Signal that the lag follows.
        of: SignalId,
        /// Time constant [s]: after a jump of the signal, the lag follows 63 percent of it in this time.
        time: T,
        /// Value of the lag at the start.
        value: T,
    },
    /// Integral of a signal over time. At a limit it stops, and continues when the signal changes its sign.
    Integral {
        /// Signal that is integrated.
        of: SignalId,
        /// Lower limit of the integral; `None`: no limit.
        lower: Option<T>,
        /// Upper limit of the integral; `None`: no limit.
        upper: Option<T>,
        /// Value of the integral at the start.
        value: T,
    },
    /// Output of a PID controller: p e + i x + d e' with e = target - measured and x' = e.
    Pid {
        /// Target signal and measured signal.
        of: [SignalId; 2],
        /// Gain of the difference e.
        p: T,
        /// Gain of the integral x of the difference.
        i: T,
        /// Gain of the rate e' of the difference.
        d: T,
        /// Largest absolute value of the output; at this limit the integral stops. `None`: no limit.
        limit: Option<T>,
    },
}

/// Smoothness class of a signal, in ascending order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Smoothness {
    /// Signal whose value jumps.
    Jump,
    /// Signal whose rate jumps.
    Corner,
    /// Signal that is twice differentiable, except where its acceleration jumps.
    Smooth,
}

/// Break of a signal: a place at which it is not smooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignalBreak {
    /// Signal with the break: the examined signal, or one of its operands, direct or indirect.
    pub signal: SignalId,
    /// True if the value jumps. Otherwise only the rate jumps.
    pub is_jump: bool,
    /// True if the signal depends on the motion. Its accelerations are then not known in advance, and it counts as a jump.
    pub is_feedback: bool,
    /// First time of the break [s]; `None` if it is not known in advance.
    pub time: Option<f64>,
}

impl<T> SignalKind<T> {
    /// Operands of the signal: the signals that it is computed from.
    #[must_use]
    pub fn operands(&self) -> &[SignalId] {
        match self {
            Self::Sum { of, .. } | Self::Product { of } => of,
            Self::Curve { of, .. }
            | Self::Clamp { of, .. }
            | Self::LimitRatio { of, .. }
            | Self::Lag { of, .. }
            | Self::Integral { of, .. } => core::slice::from_ref(of),
            Self::Pid { of, .. } => of,
            _ => &[],
        }
    }

    /// True if the signal measures the motion, or has its own state.
    #[must_use]
    pub const fn is_feedback(&self) -> bool {
        matches!(
            self,
            Self::Measure { .. } | Self::Lag { .. } | Self::Integral { .. } | Self::Pid { .. }
        )
    }

    /// True if the signal changes without its operands: in time, by an input, or with the motion.
    pub(crate) fn moves(&self) -> bool {
        let is_alone = self.operands().is_empty() && !matches!(self, Self::Constant(_));
        is_alone || self.is_feedback()
    }

    /// True if the rate of the signal is known, provided that the rates of its operands are known.
    pub(crate) const fn has_rate(&self) -> bool {
        !matches!(self, Self::Measure { is_rate: true, .. } | Self::Pid { .. })
    }

    /// Remedy that makes the signal smooth, as an imperative sentence.
    pub(crate) const fn remedy(&self) -> &'static str {
        match self {
            Self::Step { .. } => "give it `rise`",
            Self::Ramp { .. } => "give it `rounding`",
            Self::Table { .. } | Self::Curve { .. } => {
                "give it `interpolation = \"monotone\"`, or \"spline\""
            }
            Self::Input { .. } => {
                "give `input` in place of `signal`: it has rate and acceleration too"
            }
            Self::Clamp { .. } | Self::LimitRatio { .. } => {
                "follow another signal: one within limits has corners"
            }
            _ => "follow a signal of time and inputs, or let a force or a torque follow this one",
        }
    }

    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> SignalKind<U> {
        match self {
            Self::Constant(x) => SignalKind::Constant(f(x)),
            Self::Table { rows: table, interpolation, periodic } => SignalKind::Table {
                rows: table.iter().map(|[t, x]| [f(t), f(x)]).collect(),
                interpolation: *interpolation,
                periodic: *periodic,
            },
            Self::Sine { amplitude, frequency, phase, offset } => {
                let [amplitude, frequency, phase, offset] =
                    [amplitude, frequency, phase, offset].map(&mut *f);
                SignalKind::Sine { amplitude, frequency, phase, offset }
            }
            Self::Chirp { amplitude, frequency, to_frequency, duration, phase, offset } => {
                let [amplitude, frequency, to_frequency, duration, phase, offset] =
                    [amplitude, frequency, to_frequency, duration, phase, offset].map(&mut *f);
                SignalKind::Chirp { amplitude, frequency, to_frequency, duration, phase, offset }
            }
            Self::Ramp { rate, start, end, rounding } => SignalKind::Ramp {
                rate: f(rate),
                start: f(start),
                end: end.as_ref().map(&mut *f),
                rounding: f(rounding),
            },
            Self::Step { from, to, at, rise } => {
                let [from, to, at, rise] = [from, to, at, rise].map(&mut *f);
                SignalKind::Step { from, to, at, rise }
            }
            Self::Sum { of, factors } => {
                SignalKind::Sum { of: of.clone(), factors: factors.iter().map(f).collect() }
            }
            Self::Product { of } => SignalKind::Product { of: of.clone() },
            Self::Curve { of, curve } => SignalKind::Curve { of: *of, curve: curve.map(f) },
            Self::Clamp { of, lower, upper } => {
                SignalKind::Clamp { of: *of, lower: f(lower), upper: f(upper) }
            }
            Self::LimitRatio { of, lower, upper } => {
                SignalKind::LimitRatio { of: *of, lower: f(lower), upper: f(upper) }
            }
            Self::Input { value, unit } => {
                SignalKind::Input { value: f(value), unit: unit.clone() }
            }
            Self::Measure { of, is_rate } => {
                SignalKind::Measure { of: of.map(f), is_rate: *is_rate }
            }
            Self::Lag { of, time, value } => {
                SignalKind::Lag { of: *of, time: f(time), value: f(value) }
            }
            Self::Integral { of, lower, upper, value } => {
                let [lower, upper] = [lower, upper].map(|limit| limit.as_ref().map(&mut *f));
                SignalKind::Integral { of: *of, lower, upper, value: f(value) }
            }
            Self::Pid { of, p, i, d, limit } => {
                let [p, i, d] = [p, i, d].map(&mut *f);
                SignalKind::Pid { of: *of, p, i, d, limit: limit.as_ref().map(f) }
            }
        }
    }
}

impl<T: Real> SignalKind<T> {
    /// First break of the signal after time zero, with smooth operands; `None` if it has no break. The Boolean is true for a jump
    /// and false for a corner. The number is the time of the break [s], if it is known.
    fn own_break(&self) -> Option<(bool, Option<f64>)> {
        let at = |is_jump, time: &T| Some((is_jump, Some(time.to_f64())));
        let is_within = |time: &T| *time > T::ZERO;
        match self {
            Self::Table { rows, interpolation: Interpolation::Linear, .. } if rows.len() > 1 => {
                at(false, rows.iter().map(|[t, _]| t).find(|t| is_within(t))?)
            }
            Self::Table { rows, interpolation: Interpolation::Hold, .. } => {
                at(true, rows.iter().skip(1).map(|[t, _]| t).find(|t| is_within(t))?)
            }
            Self::Ramp { rate, start, end, rounding } if rounding.is_zero() && !rate.is_zero() => {
                at(false, Some(start).into_iter().chain(end).find(|t| is_within(t))?)
            }
            Self::Step { from, to, at: time, rise } => {
                if rise.is_zero() && from != to && is_within(time) { at(true, time) } else { None }
            }
            Self::Clamp { .. } | Self::LimitRatio { .. } => Some((false, None)),
            Self::Curve { curve, .. } if curve.has_corners() => Some((false, None)),
            Self::Input { .. } => Some((true, None)),
            kind if kind.is_feedback() => Some((true, None)),
            _ => None,
        }
    }
}

/// Order of the signals in which each one comes after its operands.
///
/// Cost: one pass over the signals and their operands.
///
/// # Errors
/// A circle of signals: each one is an operand of the one before, and the first is an operand of the last.
pub fn signal_order<T>(signals: &[NamedSignal<T>]) -> Result<Vec<usize>, Vec<usize>> {
    let n = signals.len();
    let operands = |i: usize| {
        let all = signals[i].kind.operands().iter();
        all.map(|id| id.index()).filter(move |of| *of < n)
    };
    let mut users = vec![Vec::new(); n];
    let mut open = vec![0_usize; n];
    for i in 0..n {
        operands(i).for_each(|of| users[of].push(i));
        open[i] = operands(i).count();
    }
    let mut order: Vec<usize> = (0..n).filter(|&i| open[i] == 0).collect();
    let mut done = 0;
    while let Some(&i) = order.get(done) {
        done += 1;
        for &user in &users[i] {
            open[user] -= 1;
            if open[user] == 0 {
                order.push(user);
            }
        }
    }
    let Some(start) = open.iter().position(|&left| left > 0) else { return Ok(order) };
    let (mut way, mut seen) = (vec![start], vec![None; n]);
    seen[start] = Some(0);
    loop {
        let last = way[way.len() - 1];
        // a signal in a circle has an operand that is also left open
        let Some(next) = operands(last).find(|&of| open[of] > 0) else { return Err(way) };
        if let Some(first) = seen[next] {
            return Err(way.split_off(first));
        }
        seen[next] = Some(way.len());
        way.push(next);
    }
}

/// Returns the worst break of each signal among its own break and those of its operands. Of equally bad breaks the first operand's
/// is returned.
///
/// Splines are smooth between their rows; [`Scene::check_run`](crate::scene::Scene::check_run) checks their ends.
///
/// Cost: one pass over the signals in their [order](signal_order).
#[must_use]
pub fn signal_breaks<T: Real>(
    signals: &[NamedSignal<T>],
    order: &[usize],
) -> Vec<Option<SignalBreak>> {
    let mut breaks: Vec<Option<SignalBreak>> = vec![None; signals.len()];
    for &i in order {
        let kind = &signals[i].kind;
        let signal = SignalId::new(i);
        let is_feedback = kind.is_feedback();
        let own = kind.own_break();
        let own = own.map(|(is_jump, time)| SignalBreak { signal, is_jump, is_feedback, time });
        let of = kind.operands().iter().filter_map(|of| *breaks.get(of.index())?);
        let rank = |of: &SignalBreak| (of.is_feedback, of.is_jump);
        breaks[i] = of.chain(own).reduce(|a, b| if rank(&b) > rank(&a) { b } else { a });
    }
    breaks
}

/// Finds the first signal for which `is_one` holds, for each signal among itself and its direct and indirect operands.
pub(crate) fn first_of<T>(
    signals: &[NamedSignal<T>],
    order: &[usize],
    is_one: impl Fn(&SignalKind<T>) -> bool,
) -> Vec<Option<SignalId>> {
    let mut first: Vec<Option<SignalId>> = vec![None; signals.len()];
    for &i in order {
        let kind = &signals[i].kind;
        let of = kind.operands().iter().find_map(|of| *first.get(of.index())?);
        first[i] = of.or_else(|| is_one(kind).then(|| SignalId::new(i)));
    }
    first
}

impl Display for SignalBreak {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_feedback {
            return f.write_str("follows the motion");
        }
        let what = if self.is_jump { "jumps" } else { "has a corner" };
        match self.time {
            Some(time) => write!(f, "{what} at {time} s"),
            None => write!(f, "{what}"),
        }
    }
}

impl SignalBreak {
    /// Smoothness class of a signal with this break; `None` is a signal without breaks.
    #[must_use]
    pub const fn class(broken: Option<&Self>) -> Smoothness {
        match broken {
            None => Smoothness::Smooth,
            Some(Self { is_jump: true, .. }) => Smoothness::Jump,
            Some(_) => Smoothness::Corner,
        }
    }
}
