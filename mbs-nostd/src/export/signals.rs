//! Tables of signals: laws for functions of time and inputs, and operations for all other signals.

use crate::inputs::{Rise, SignalLaw};
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::feedback::{FeedbackOperation, FeedbackStep};
use mbs_core::inputs::{Prescribed, SignalGraph};
use mbs_core::laws::Part;
use mbs_core::measure::PreparedCurve;
use mbs_core::scene::{Interpolation, SignalId, SignalKind};
use mbs_recursive::CurveTables;
use mbs_recursive::passes::feedback::FeedbackSlices;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::rows::coupled::Couplings;
use mbs_recursive::space::Space;

/// Error: a signal that tables do not support. It is an unsupported function of time, or a guide's signal that is not a constant, a spline
/// or a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MovingSignal {
    /// Index of the signal in the scene.
    pub signal: SignalId,
}

impl core::fmt::Display for MovingSignal {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let number = self.signal.index() + 1;
        write!(
            f,
            "signal {number} is a wave, a ramp or a table that holds or repeats, or a guide follows it that is no spline or step: tables for \
             controllers have none of these"
        )
    }
}

impl core::error::Error for MovingSignal {}

/// Operations on signals, with the curves to which they refer.
#[derive(Debug, Clone)]
pub(super) struct SignalTables<T> {
    steps: Vec<FeedbackStep<T>>,
    n_states: usize,
    curves: CurveTables<T>,
}

impl<T: Real> SignalTables<T> {
    /// Collects the operations of the signals that depend on other signals. The indices of the mechanism's curves do not change; new curves
    /// are appended.
    pub(super) fn new<S: Space<T>>(
        prescribed: &Prescribed<T>,
        mechanism: &TreeSlices<'_, T, S>,
    ) -> Self {
        let (program, couplings) = (prescribed.program(), &mechanism.loops.couplings);
        let mut tables = Self {
            steps: program.steps,
            n_states: program.starts.len(),
            curves: CurveTables::copied((couplings.curves, couplings.knots, couplings.numbers)),
        };
        let curve_of = |step: &FeedbackStep<T>| match step.operation {
            FeedbackOperation::Curve { curve, .. } => Some((step.to, curve)),
            _ => None,
        };
        let known: Vec<_> = mechanism.feedback.steps.iter().filter_map(curve_of).collect();
        for i in 0..tables.steps.len() {
            let Some((to, number)) = curve_of(&tables.steps[i]) else { continue };
            let known = known.iter().find(|(of, _)| *of == to).map(|(_, curve)| *curve);
            let number =
                known.unwrap_or_else(|| tables.curves.add(&program.curves[number as usize]));
            if let FeedbackOperation::Curve { curve, .. } = &mut tables.steps[i].operation {
                *curve = number;
            }
        }
        tables
    }

    /// Returns the tables of couplings, with the curves of signals appended to their curves.
    pub(super) fn couplings<'a, S: Space<T>>(
        &'a self,
        of: &Couplings<'a, T, S>,
    ) -> Couplings<'a, T, S> {
        let (curves, knots, numbers) = self.curves.slices();
        Couplings { curves, knots, numbers, ..*of }
    }

    /// Returns the operations, with the links of the measured coordinates.
    pub(super) fn feedback<'a>(&'a self, links: &'a [u32]) -> FeedbackSlices<'a, T> {
        FeedbackSlices {
            steps: &self.steps,
            links,
            measures: &[],
            n_states: self.n_states,
            signals: &[],
        }
    }

    /// Returns the part of `states` that belongs to signals with a state.
    pub(super) fn starts<'a>(&self, states: &'a [[T; 2]]) -> &'a [[T; 2]] {
        states.get(..self.n_states).unwrap_or(states)
    }
}

/// Returns the values of constant signals; zero for other signals.
pub(super) fn held<T: Real>(signals: &SignalGraph<T>) -> Vec<[T; 3]> {
    let all = signals.values(T::ZERO).into_iter().enumerate();
    let is_constant = |i| signals.is_constant(SignalId::new(i));
    all.map(|(i, value)| if is_constant(i) { value } else { [T::ZERO; 3] }).collect()
}

/// Tables to which signals are added: laws, and the knots and curvatures of splines.
type Laws<'a, T> = (&'a mut Vec<SignalLaw<T>>, (&'a mut Vec<[T; 2]>, &'a mut Vec<T>));

/// Adds the laws of signals. `held` has the values of constant signals. Signals that depend on other signals get a constant law, because
/// operations compute them.
pub(super) fn add_laws<T: Real>(
    signals: &SignalGraph<T>,
    held: &[[T; 3]],
    (courses, (knots, curvatures)): Laws<'_, T>,
) -> Result<(), MovingSignal> {
    for (i, ((kind, curve), &value)) in signals.kinds().zip(held).enumerate() {
        let signal = SignalId::new(i);
        let mut part = |rows: &[[T; 2]], curvature: &[T]| {
            let first = index(knots.len());
            knots.extend_from_slice(rows);
            curvatures.extend_from_slice(curvature);
            curvatures.resize(knots.len(), T::ZERO);
            Part { first, n: index(rows.len()) }
        };
        let is_made = !kind.operands().is_empty() || kind.is_feedback();
        courses.push(match (kind, curve) {
            _ if is_made || signals.is_constant(signal) => SignalLaw::Constant(value),
            (SignalKind::Input { value, .. }, _) => SignalLaw::Input([*value, T::ZERO, T::ZERO]),
            (
                SignalKind::Table { periodic: false, .. },
                PreparedCurve::Spline { curvature, knots, .. },
            ) => SignalLaw::Spline(part(knots, curvature)),
            (
                SignalKind::Table { rows, interpolation: Interpolation::Linear, periodic: false },
                _,
            ) => SignalLaw::Spline(part(rows, &[])),
            (&SignalKind::Step { from, to, at, rise }, _) => {
                SignalLaw::Step(Rise { from, to, at, rise })
            }
            _ => return Err(MovingSignal { signal }),
        });
    }
    Ok(())
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
