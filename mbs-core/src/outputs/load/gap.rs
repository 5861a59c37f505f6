//! Gaps of effects that act on one side only: positive apart, negative pressed in.
//!
//! ```text
//! bumper   g = m - touch
//! limit    g = m - lower and upper - m
//! tire     g = -(deflection)
//! ```

#![cfg_attr(
    not(feature = "effects"),
    allow(unused_imports, unused_mut, unused_variables, reason = "not every effect is one-sided")
)]

use super::Load;
use super::apply::motion;
use crate::Real;
use crate::laws::Supplies;
use crate::laws::body::{Action, BodyLaw, MOST};
use crate::laws::scalar::Law;
use crate::model::State;

/// A gap [m or rad] and its rate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::outputs) struct Gap<T> {
    pub(in crate::outputs) value: T,
    pub(in crate::outputs) rate: T,
}

/// Gaps that one effect has at most: those of a limit, lower and upper.
pub(in crate::outputs) const MOST_GAPS: usize = 2;

impl<T: Real, const D: usize> Load<T, D> {
    /// How many gaps it has; none where it acts always.
    pub(in crate::outputs) fn n_gaps(&self) -> usize {
        match self {
            #[cfg(feature = "bumper")]
            Self::Between { law: Law::Bumper { .. }, .. } => 1,
            #[cfg(feature = "limit")]
            Self::Between { law: Law::Limit(_), .. } => 2,
            #[cfg(feature = "tire")]
            Self::OnBody { law: BodyLaw::Tire(_), .. } => 1,
            _ => 0,
        }
    }

    /// Its gaps at a state, [`n_gaps`](Self::n_gaps) of them.
    pub(in crate::outputs) fn gaps(
        &self,
        state: &State<T>,
        supplies: &Supplies<'_, T>,
    ) -> [Gap<T>; MOST_GAPS] {
        let mut gaps = [Gap::default(); MOST_GAPS];
        match self {
            #[cfg(feature = "bumper")]
            Self::Between { gauge, law: Law::Bumper { touch, .. }, .. } => {
                let [value, rate] = gauge.measure(state);
                gaps[0] = Gap { value: value - *touch, rate };
            }
            #[cfg(feature = "limit")]
            Self::Between { gauge, law: Law::Limit(limit), .. } => {
                let [value, rate] = gauge.measure(state);
                gaps[0] = Gap { value: value - limit.lower, rate };
                gaps[1] = Gap { value: limit.upper - value, rate: -rate };
            }
            #[cfg(feature = "tire")]
            Self::OnBody { point, frame, axis, law: BodyLaw::Tire(tire), .. } => {
                let axis = frame.rotation(&state.q) * axis;
                let mut actions = [Action::default(); MOST];
                let actions = &mut actions[..tire.n_actions()];
                tire.evaluate(&motion((point, frame), &axis, state), supplies, actions);
                let measure = &actions[crate::laws::tire::RADIAL].measure;
                gaps[0] = Gap { value: -measure.value, rate: measure.rate };
            }
            _ => {}
        }
        gaps
    }
}
