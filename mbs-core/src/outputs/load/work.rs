//! Energy stored in effects, and power of effects on bodies.
//!
//! ```text
//! scalar law   V(m),   power -f m'       V: energy, m: measure, f: tension of the law
//! constant     V = -F.r                  F: force, r: position of its point
//! on a body    power F.v + M.omega       F and M: force and moment at the law's point, v: velocity of this point
//! ```

use super::Load;
use super::apply::{for_each_action, motion};
use crate::Real;
use crate::algebra::{Matrix, Vector, raised};
use crate::laws::LawInputs;
use crate::laws::body::TireForces;
use crate::laws::scalar::ScalarForce;
use crate::model::State;
use crate::scene::BodyId;

impl<T: Real, const D: usize> Load<T, D> {
    /// Value that the law measures, and its rate; zeros for other loads.
    pub(super) fn measure(&self, state: &State<T>) -> [T; 2] {
        match self {
            Self::Between { gauge, .. } => gauge.measure(state),
            Self::Sum { sum, .. } => sum.measure(state),
            _ => [T::ZERO; 2],
        }
    }

    /// Value, rate and tension of a scalar law; `None` for other loads.
    pub(in crate::outputs) fn scalar(
        &self,
        state: &State<T>,
        law_inputs: &LawInputs<'_, T>,
    ) -> Option<ScalarForce<T>> {
        let (Self::Between { law, .. } | Self::Sum { law, .. }) = self else { return None };
        let [value, rate] = self.measure(state);
        let tension = law.evaluate(value, rate, law_inputs).tension;
        Some(ScalarForce { value, rate, tension, ..ScalarForce::default() })
    }

    /// Energy stored in the effect [J]. `turned` gives the rotation matrix of a body.
    pub(in crate::outputs) fn energy(
        &self,
        (state, law_inputs): (&State<T>, &LawInputs<'_, T>),
        turned: &dyn Fn(BodyId) -> Matrix<T, 3>,
    ) -> T {
        match self {
            Self::Between { law, .. } | Self::Sum { law, .. } => {
                law.energy(self.measure(state)[0], law_inputs)
            }
            Self::Constant { point, force, .. } => -force.dot(&raised(&point.value(&state.q))),
            Self::Force { .. } | Self::Torque { .. } => T::ZERO,
            Self::OnBody { body, point, frame, axis, law } => {
                let axis = turned(BodyId::Body(*body)) * axis;
                let mut sum = T::ZERO;
                for_each_action(
                    law,
                    &motion((point, frame), &axis, state),
                    law_inputs,
                    |i, action| {
                        sum += law.energy(i, &action.measure);
                    },
                );
                sum
            }
        }
    }

    /// Forces of the road on a tire; `None` for other loads. `turned` gives the rotation matrix of a body.
    pub(in crate::outputs) fn tire(
        &self,
        (state, law_inputs): (&State<T>, &LawInputs<'_, T>),
        turned: &dyn Fn(BodyId) -> Matrix<T, 3>,
    ) -> Option<TireForces<T>> {
        let Self::OnBody { body, point, frame, axis, law } = self else { return None };
        let axis = turned(BodyId::Body(*body)) * axis;
        law.tire(&motion((point, frame), &axis, state), law_inputs)
    }

    /// Power that the load supplies to bodies [W]. `turned` gives the rotation matrix of a body.
    pub(in crate::outputs) fn power(
        &self,
        (state, law_inputs): (&State<T>, &LawInputs<'_, T>),
        turned: &dyn Fn(BodyId) -> Matrix<T, 3>,
    ) -> T {
        match self {
            Self::Between { law, .. } | Self::Sum { law, .. } => {
                let [value, rate] = self.measure(state);
                -law.evaluate(value, rate, law_inputs).tension * rate
            }
            Self::Constant { point, .. } | Self::Force { point, .. } => {
                let mut power = T::ZERO;
                let velocity = raised(&point.rate(&state.v));
                self.apply((state, law_inputs), turned, &mut |(_, _, wrench)| {
                    power += wrench.force.dot(&velocity);
                });
                power
            }
            Self::Torque { frame, .. } | Self::OnBody { frame, .. } => {
                let omega = frame.turning(&state.q, &state.v);
                let velocity = match self {
                    Self::OnBody { point, .. } => raised(&point.rate(&state.v)),
                    _ => Vector::zeros(),
                };
                let mut power = T::ZERO;
                self.apply((state, law_inputs), turned, &mut |(_, _, wrench)| {
                    power += wrench.force.dot(&velocity) + wrench.moment.dot(&omega);
                });
                power
            }
        }
    }
}
