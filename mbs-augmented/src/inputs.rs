//! Inputs that were set since the last step, taken into the state that the next one begins with.

use crate::options::Options;
use crate::workspace::{Mass, Workspace};
use mbs_core::model::{Model, State};
use mbs_core::step::{Counts, StepError, add_response, has_new_inputs, largest_or_nan, load_at};
use mbs_core::team::{norm_inf, set_sum, subtract};
use mbs_core::{Real, SpdSolver};

/// Sweeps of the response: the first leaves 1e-6 of it, the others go to rounding.
const MAX_SWEEPS: u32 = 12;

/// Makes accelerations, multipliers and power those of the inputs that are set now, if others were set since the last step; says
/// whether they were. Every step begins with this; a caller that keeps a state to go back to calls it before.
///
/// ```text
/// (M + J^T s J) d = M da + J^T (dl + s J da) - dQ,   da -= d,   dl += s J da
/// ```
///
/// Cost: nothing without a change; else two evaluations, a factorisation and about three solutions; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn take_inputs<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<bool, StepError> {
    if !has_new_inputs(model, s) {
        return Ok(false);
    }
    let n = w.f.len();
    w.counts = Counts::default();
    let factor = Options::<T>::index1().penalty.factor();
    for (penalty, &mass) in w.penalty.iter_mut().zip(&w.masses) {
        *penalty = factor * mass;
    }
    for rows in [&mut w.mu, &mut w.lambda, &mut w.rates] {
        rows.fill(T::ZERO);
    }
    w.a.fill(T::ZERO);

    // -dQ = -Q(u) + Q(u_n)
    let before = load_at(model, s, false, &mut w.terms);
    model.evaluate(&s.q, &mut w.terms);
    w.assemble(model, Mass::None, T::ONE);
    w.change[..n].copy_from_slice(&w.f);
    let after = load_at(model, s, true, &mut w.terms);
    w.assemble(model, Mass::None, T::ONE);
    for (change, &f) in w.change[..n].iter_mut().zip(&w.f) {
        *change = f - *change;
    }

    w.factor(model, (T::ZERO, T::ZERO), false)?;
    let mut last = None;
    for _ in 0..MAX_SWEEPS {
        set_sum(model.team(), &mut w.mu, &w.lambda, (&w.penalty, &w.rates));
        w.assemble(model, Mass::Acceleration, T::ZERO);
        for (f, &change) in w.f.iter_mut().zip(&w.change) {
            *f += change;
        }
        w.solve();
        subtract(model.team(), &mut w.a[..n], &w.f);
        model.multiply_jacobian(&w.terms, &w.a, &mut w.rates);
        for (k, lambda) in w.lambda.iter_mut().enumerate() {
            *lambda += w.penalty[k] * w.rates[k];
        }
        let correction = norm_inf(model.team(), &w.f);
        if !correction.is_finite() {
            return Err(StepError::NotFinite { unknown: largest_or_nan(&w.f) });
        }
        let rounding = norm_inf(model.team(), &w.a) * T::EPSILON;
        if correction <= rounding || last.is_some_and(|last| correction > last * T::HALF) {
            break;
        }
        last = Some(correction);
    }
    w.settled = w.counts;
    add_response(model, s, (&w.a[..n], &w.lambda, after - before), &mut w.terms);
    Ok(true)
}
