//! Inputs that change between two steps, and the changes of the state at the beginning of the next step.
//!
//! ```text
//! M da + J^T dl = Q(q, v, u) - Q(q, v, u_n),   J da = 0
//! a += da,   a_aux += da,   lambda_n += dl,   lambda_(n-1) += dl,   W += V(q, u) - V(q, u_n)
//! ```
//!
//! da and dl are changes of accelerations and multipliers, u the new inputs, u_n the old ones, W the work and V the potential energy. A
//! rule computes the force at the beginning of a step from the accelerations there. With the changed accelerations an input acts in the
//! whole next step. A jump of a signal is treated in the same way: u is then the signal just after the jump, u_n just before. A change of
//! the energy stored in laws counts as work. Each formulation solves for da and dl with its own matrix.

use crate::Real;
use crate::model::{Model, State, Terms};
use crate::step::{StepError, largest_or_nan};
use crate::team::norm_inf;

/// Largest number of sweeps for a response [-]. The first sweep leaves a relative error of 1e-6 or less. One or two further sweeps reach
/// machine precision.
const MAX_SWEEPS: u32 = 12;

/// Scratch memory of a formulation that computes the response of a state to a change of loads.
pub trait InputResponse<T: Real> {
    /// Options of a step.
    type Options;

    /// Changes accelerations, multipliers and power of `s` from its present loads to the loads of the current inputs, at time `to` [s].
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    fn take_loads<M: Model<T>>(
        &mut self,
        model: &M,
        options: &Self::Options,
        s: &mut State<T>,
        to: T,
    ) -> Result<(), StepError>;
}

/// Recomputes accelerations, multipliers and power if an input has changed since the last step. Returns true if an input has changed. Every
/// step calls this first. A caller that saves the state to undo a step calls it before saving.
///
/// Cost: nothing without a change; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn take_inputs<T: Real, M: Model<T>, W: InputResponse<T>>(
    model: &M,
    options: &W::Options,
    s: &mut State<T>,
    w: &mut W,
) -> Result<bool, StepError> {
    if !has_new_inputs(model, s) {
        return Ok(false);
    }
    w.take_loads(model, options, s, s.t)?;
    Ok(true)
}

/// Replaces accelerations, multipliers and power of `s` just before the jump of a signal by those just after it, at time `to` [s].
///
/// Cost: as for inputs that change.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn pass_jump<T: Real, M: Model<T>, W: InputResponse<T>>(
    model: &M,
    options: &W::Options,
    s: &mut State<T>,
    w: &mut W,
    to: T,
) -> Result<(), StepError> {
    w.take_loads(model, options, s, to)?;
    s.t = to;
    Ok(())
}

/// True if the current inputs differ from the inputs with which the accelerations of `s` were computed.
#[inline]
fn has_new_inputs<T: Real, M: Model<T>>(model: &M, s: &State<T>) -> bool {
    model.inputs().is_some_and(|inputs| inputs.differs(&s.inputs, &s.applied))
}

/// Evaluates the forces at state `s` and time `t` [s]. They use the current inputs if `is_new`, else the inputs of the last step. Returns
/// the potential energy [J].
pub fn load_at<T: Real, M: Model<T>>(
    model: &M,
    (s, t): (&State<T>, T),
    is_new: bool,
    terms: &mut Terms<T>,
) -> T {
    terms.angles.copy_from_slice(&s.memory);
    terms.begin_signals(T::ZERO, s);
    if let Some(inputs) = model.inputs() {
        let of_effects = if is_new { &s.inputs } else { &s.applied };
        let at_end = (&s.applied[..], &of_effects[..]);
        inputs.write_end(t, at_end, (&mut terms.guides, &mut terms.courses));
    }
    model.evaluate_forces(&s.q, &s.v, terms);
    model.potential_energy(&s.q, terms)
}

/// Solves for a response by repeated sweeps. Each sweep writes the correction -f and the response over the unknowns. The sweeps end when a
/// correction reaches machine precision or is reduced by less than half.
///
/// # Errors
/// The error of a sweep, or [`StepError::NotFinite`].
pub fn solve_response<T: Real, M: Model<T>, W>(
    model: &M,
    w: &mut W,
    mut sweep: impl FnMut(&mut W),
    vectors: impl Fn(&W) -> [&[T]; 2],
) -> Result<(), StepError> {
    let mut last = None;
    for _ in 0..MAX_SWEEPS {
        sweep(w);
        let [f, da] = vectors(w);
        let correction = norm_inf(model.team(), f);
        if !correction.is_finite() {
            return Err(StepError::NotFinite { unknown: largest_or_nan(f) });
        }
        let is_slow = last.is_some_and(|last| correction > last * T::HALF);
        if correction <= norm_inf(model.team(), da) * T::EPSILON || is_slow {
            break;
        }
        last = Some(correction);
    }
    Ok(())
}

/// Adds a response to the state: accelerations `da` over the unknowns, multipliers `dl` and `work` [J]. `terms` belong to the new inputs.
pub fn add_response<T: Real, M: Model<T>>(
    model: &M,
    s: &mut State<T>,
    (da, dl, work): (&[T], &[T], T),
    terms: &mut Terms<T>,
) {
    let n = model.n_unknowns();
    for a in [&mut s.a, &mut s.a_aux] {
        for (a, &da) in a[..n].iter_mut().zip(da) {
            *a += da;
        }
    }
    for lambda in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
        for (lambda, &dl) in lambda.iter_mut().zip(dl) {
            *lambda += dl;
        }
    }
    model.evaluate_phi_t(&s.q, terms);
    s.power = model.power(&s.q, &s.v, &s.reaction, terms);
    s.work += work;
    s.signals.copy_from_slice(&terms.signals);
    if let Some(inputs) = model.inputs() {
        inputs.apply(&s.inputs, &mut s.applied);
    }
}
