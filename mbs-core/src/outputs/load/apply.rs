//! Wrenches that effects apply to bodies.
//!
//! ```text
//! length      tension f of the law along the line of two points
//! along       -f d on the second body's point, f d on the first body at this point:  d the direction of the law
//! angle       -f about the joint's axis on the second body, opposite on the first; for a joint of two axes along the gradient of the angle
//! rotation    -f g on the second body, opposite on the first: g the gradient of a component of the rotation vector
//! on a body   sum of -f d at the law's point and -f m over the actions of the law:  d and m force and moment of the action for f = 1
//! ```

use super::super::frame::Frame;
use super::super::wrench::Applied;
use super::{Load, Measure, Wrench};
use crate::Real;
use crate::algebra::{Matrix, Vector, norm, raised, rotation_gradient, rotation_vector, unit};
use crate::effects::{BodyLaw, Law};
use crate::laws::LawInputs;
use crate::laws::body::{BodyMotion, MAX_ACTIONS, UnitWrench};
use crate::model::State;
use crate::natural::{Affine, unwrap_rotation};
use crate::scene::BodyId;

/// Points at which a wrench acts on both bodies (`None`: a moment only), and the wrench on the first body.
type Pull<T> = ([Option<Vector<T, 3>>; 2], Wrench<T>);

impl<T: Real, const D: usize> Load<T, D> {
    /// Passes to `take` the wrenches that the load applies at a state. `turned` gives the rotation matrix of a body.
    pub(in crate::outputs) fn apply(
        &self,
        (state, law_inputs): (&State<T>, &LawInputs<'_, T>),
        turned: &dyn Fn(BodyId) -> Matrix<T, 3>,
        take: &mut dyn FnMut(Applied<T>),
    ) {
        match self {
            Self::Between { bodies, gauge, law } => {
                let axes = turned(bodies[0]);
                if let Some((at, wrench)) = gauge.pull(law, state, &axes, law_inputs) {
                    take((bodies[0], at[0], wrench));
                    take((bodies[1], at[1], wrench.scaled(-T::ONE)));
                }
            }
            Self::Sum { sum, law } => {
                let [value, rate] = sum.measure(state);
                let tension = law.evaluate(value, rate, law_inputs).tension;
                sum.apply(-tension, state, take);
            }
            Self::Constant { body, point, force } => {
                let at = raised(&point.value(&state.q));
                take((BodyId::Body(*body), Some(at), push(*force)));
            }
            Self::Force { body, point, course, turns } => {
                let body = BodyId::Body(*body);
                let given = Vector::<T, 3>::from(law_inputs.courses[*course]);
                let force = if *turns { turned(body) * given } else { given };
                take((body, Some(raised(&point.value(&state.q))), push(force)));
            }
            Self::Torque { body, course, .. } => {
                let given = law_inputs.courses[*course];
                let moment = if D == 2 { unit(2) * given[0] } else { given.into() };
                take((BodyId::Body(*body), None, twist(moment)));
            }
            Self::OnBody { body, point, frame, axis, law } => {
                let body = BodyId::Body(*body);
                let motion = motion((point, frame), &(turned(body) * axis), state);
                let at = Vector::from(motion.position);
                let mut sum = Wrench::zero();
                for_each_action(
                    law,
                    &motion,
                    law_inputs,
                    |_, UnitWrench { force, moment, measure }| {
                        let (force, moment) = ((*force).into(), (*moment).into());
                        sum.add(&Wrench { force, moment }.scaled(-measure.tension));
                    },
                );
                take((body, Some(at), sum));
            }
        }
    }
}

impl<T: Real, const D: usize> Measure<T, D> {
    /// Wrench of a law at a state. `axes` is the rotation matrix of the first body. `None` if the length is zero, since the line then has
    /// no direction.
    fn pull(
        &self,
        law: &Law<T>,
        state: &State<T>,
        axes: &Matrix<T, 3>,
        law_inputs: &LawInputs<'_, T>,
    ) -> Option<Pull<T>> {
        let [value, rate] = self.measure(state);
        let tension = law.evaluate(value, rate, law_inputs).tension;
        Some(match self {
            Self::Length { points } => {
                let ([p, r], _) = ends(points, state);
                if !(value > T::ZERO) {
                    return None;
                }
                ([Some(p), Some(r)], push((r - p) * (tension / value)))
            }
            Self::Along { points, direction, .. } => {
                let ([_, r], _) = ends(points, state);
                ([Some(r); 2], push(raised(&direction.value(&state.q)) * tension))
            }
            Self::Angle { axis, angle, .. } => {
                let axis = axis.map_or_else(|| angle.gradient(&state.q), |axis| axes * axis);
                ([None; 2], twist(axis * tension))
            }
            Self::Rotation { number, .. } => {
                let g = axes * rotation_gradient(&self.rotation(state), *number);
                ([None; 2], twist(g * tension))
            }
        })
    }

    /// Value that a law measures at a state, and its rate. The rate is zero at length zero.
    pub(super) fn measure(&self, state: &State<T>) -> [T; 2] {
        match self {
            Self::Length { points } => {
                let ([p, r], rate) = ends(points, state);
                let (line, length) = (r - p, norm(&(r - p)));
                if !(length > T::ZERO) {
                    return [length, T::ZERO];
                }
                [length, (line * (T::ONE / length)).dot(&rate)]
            }
            Self::Along { points, direction, offset } => {
                let ([p, r], rate) = ends(points, state);
                let d = raised(&direction.value(&state.q));
                let turning = raised(&direction.rate(&state.v));
                [(r - p).dot(&d) - *offset, rate.dot(&d) + (r - p).dot(&turning)]
            }
            Self::Angle { angle, memory, .. } => {
                let (mut value, mut rate) = ([T::ZERO], [T::ZERO]);
                value[0] = memory.map_or(T::ZERO, |place| state.memory[place]);
                angle.track(&state.q, &value.clone(), &mut value);
                angle.rates(&state.q, &state.v, &mut rate);
                [value[0], rate[0]]
            }
            Self::Rotation { frames, number, .. } => {
                let w = self.rotation(state);
                let g: Vector<T, 3> = frames[0].rotation(&state.q) * rotation_gradient(&w, *number);
                let [first, second] = [0, 1].map(|i| frames[i].turning(&state.q, &state.v));
                [w[*number], g.dot(&(second - first))]
            }
        }
    }

    /// Rotation vector, with the turns that the state remembers.
    fn rotation(&self, state: &State<T>) -> Vector<T, 3> {
        let Self::Rotation { frames, memory, .. } = self else { return Vector::zeros() };
        let [first, second] = [0, 1].map(|i| frames[i].rotation(&state.q));
        let last =
            memory.map_or(Vector::zeros(), |at| Vector::from_fn(|i, _| state.memory[at + i]));
        unwrap_rotation(&rotation_vector(&(first.transpose() * second)), &last)
    }
}

/// Passes to `take` the unit wrenches of a law on one body, each with its index.
pub(super) fn for_each_action<T: Real>(
    law: &BodyLaw<T>,
    motion: &BodyMotion<T>,
    law_inputs: &LawInputs<'_, T>,
    mut take: impl FnMut(usize, &UnitWrench<T>),
) {
    let mut actions = [UnitWrench::default(); MAX_ACTIONS];
    let actions = &mut actions[..law.n_actions()];
    law.evaluate(motion, law_inputs, actions);
    actions.iter().enumerate().for_each(|(i, action)| take(i, action));
}

/// Motion of a body in the form that a law on the body needs. `axis` is the law's direction in its present orientation.
pub(super) fn motion<T: Real, const D: usize>(
    (point, frame): (&Affine<T, D>, &Frame<T, D>),
    axis: &Vector<T, 3>,
    state: &State<T>,
) -> BodyMotion<T> {
    BodyMotion {
        position: raised(&point.value(&state.q)).into(),
        velocity: raised(&point.rate(&state.v)).into(),
        axis: (*axis).into(),
        spin: frame.turning(&state.q, &state.v).into(),
    }
}

/// Positions of two points, and the rate of the vector from the first to the second.
fn ends<T: Real, const D: usize>(
    points: &[Affine<T, D>; 2],
    state: &State<T>,
) -> ([Vector<T, 3>; 2], Vector<T, 3>) {
    let rate = raised(&points[1].rate(&state.v)) - raised(&points[0].rate(&state.v));
    ([0, 1].map(|i| raised(&points[i].value(&state.q))), rate)
}

fn push<T: Real>(force: Vector<T, 3>) -> Wrench<T> {
    Wrench { force, moment: Vector::zeros() }
}

fn twist<T: Real>(moment: Vector<T, 3>) -> Wrench<T> {
    Wrench { force: Vector::zeros(), moment }
}
