//! End of a step in natural coordinates: the update of the state, and checks on the way.

use super::StepEnd;
use crate::Real;
use crate::integrator::Rule;
use crate::model::{Model, Owner, State, Terms};
use crate::step::StepError;
use crate::team::{Team, on_stretches};

/// Copies a finished step into the state. `end` has accelerations in [m/s^2]. `lambda` times `unit` are the multipliers of the equations of
/// motion. `reaction` computes, from a row and its multiplier, the multiplier in equilibrium with the projected accelerations.
#[inline]
pub fn commit<T: Real, M: Model<T>>(
    model: &M,
    (rule, compensated): (&Rule<T>, bool),
    end: &StepEnd<T>,
    (lambda, unit, reaction): (&[T], T, impl Fn(usize, T) -> T + Sync),
    terms: &mut Terms<T>,
    s: &mut State<T>,
) {
    let team = model.team();
    take_coordinates(team, (rule, compensated, end.moved().len()), s, (&end.dq, &end.v, &end.a));
    let phi = &terms.phi;
    let rows = [&mut s.lambda_previous[..], &mut s.lambda, &mut s.reaction, &mut s.phi];
    on_stretches(team, rows, |first, [previous, last, reaction_n, phi_n]| {
        for k in 0..last.len() {
            let i = first + k;
            previous[k] = last[k];
            last[k] = lambda[i] * unit;
            reaction_n[k] = reaction(i, last[k]);
            phi_n[k] = phi[i];
        }
    });
    s.t += rule.dt;
    add_work(model, rule.dt, s, terms);
}

/// Updates coordinates, velocities and accelerations, also the auxiliary accelerations. The sum (q, q_low) += dq is compensated and exact
/// if `compensated`, else it is q += dq. n is the number of unknowns; all slices are at least that long.
pub fn take_coordinates<T: Real, W: Team>(
    team: &W,
    (rule, compensated, n): (&Rule<T>, bool, usize),
    s: &mut State<T>,
    (dq, v, a): (&[T], &[T], &[T]),
) {
    s.dt = rule.dt;
    let shift = rule.auxiliary / rule.acceleration;
    let State { q, q_low, v: v_n, a: a_n, a_aux, .. } = s;
    let vectors = [&mut q[..n], &mut q_low[..n], &mut v_n[..n], &mut a_n[..n], &mut a_aux[..n]];
    on_stretches(team, vectors, |first, [q, q_low, v_n, a_n, a_aux]| {
        let n = q.len();
        let (dq, v, a) = (&dq[first..][..n], &v[first..][..n], &a[first..][..n]);
        for i in 0..n {
            let (_, _, a_predicted) = rule.predict(v_n[i], a_n[i], a_aux[i]);
            a_aux[i] += shift * (a[i] - a_predicted);
            v_n[i] = v[i];
            a_n[i] = a[i];
            if compensated {
                // (q, q_low) += dq, exactly
                let y = dq[i] + q_low[i];
                let sum = q[i] + y;
                let back = sum - q[i];
                q_low[i] = (q[i] - (sum - back)) + (y - back);
                q[i] = sum;
            } else {
                q[i] += dq[i];
            }
        }
    });
}

/// Adds the work of the last `dt` [s] to the energy balance, by the trapezoidal rule in time. It also remembers measured angles. q, v and
/// reaction of the state must be final.
pub fn add_work<T: Real, M: Model<T>>(model: &M, dt: T, s: &mut State<T>, terms: &mut Terms<T>) {
    if model.has_forces() {
        model.evaluate_forces(&s.q, &s.v, terms);
    }
    if !s.memory.is_empty() {
        model.remember(&s.q, terms, &mut s.memory);
    }
    s.signals.copy_from_slice(&terms.signals);
    if !(model.has_forces() || model.has_guides()) {
        return;
    }
    s.applied.copy_from_slice(&s.inputs);
    let power = model.power(&s.q, &s.v, &s.reaction, terms);
    s.work += (s.power + power) * dt * T::HALF;
    s.power = power;
}

/// Checks that no guided angle is half a turn from its guide, where the constraint holds too.
///
/// # Errors
/// [`StepError::OppositeBranch`] names the guide's row.
pub fn check_guides<T: Real, M: Model<T>>(
    model: &M,
    q: &[T],
    terms: &Terms<T>,
) -> Result<(), StepError> {
    if !model.has_guides() {
        return Ok(());
    }
    match model.opposite_guide(q, terms) {
        Some(row) => Err(StepError::OppositeBranch { row: u32::try_from(row).unwrap_or(u32::MAX) }),
        None => Ok(()),
    }
}

/// Checks that no rotation in space has reached a whole turn, where it is not defined.
///
/// # Errors
/// [`StepError::Overturned`] names the effect.
pub fn check_rotations<T: Real, M: Model<T>>(model: &M, terms: &Terms<T>) -> Result<(), StepError> {
    match model.overturned(terms) {
        Some(Owner::Effect(effect)) => {
            Err(StepError::Overturned { effect: u32::try_from(effect).unwrap_or(u32::MAX) })
        }
        _ => Ok(()),
    }
}

/// Checks that all directions are defined at the end of the step, to which `dq` leads. Each part of a line needs a length and each twist an
/// axis, and no rolling disc may lie flat.
///
/// # Errors
/// [`StepError::RopeCollapsed`], [`StepError::LineCollapsed`], [`StepError::TwistOpen`], [`StepError::RollingFlat`].
pub fn check_lines<T: Real, M: Model<T>>(
    model: &M,
    s: &State<T>,
    dq: &[T],
) -> Result<(), StepError> {
    match model.without_direction(s, dq) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}
