//! Inputs that were set since the last step, taken into the state that the next one begins with.

use crate::options::Options;
use crate::workspace::{Mass, Workspace};
use mbs_core::implicit::{add_response, has_new_inputs, load_at, solve_response};
use mbs_core::model::{Model, State};
use mbs_core::step::StepError;
use mbs_core::team::add;
use mbs_core::{Real, SymmetricSolver};

/// Makes accelerations, multipliers and power those of the inputs that are set now, if others were set since the last step; says
/// whether they were. Every step begins with this; a caller that keeps a state to go back to calls it before.
///
/// ```text
/// [ M  J^T    ] ( da )   ( dQ )
/// [ J  -delta ] ( dl ) = ( 0  )
/// ```
///
/// Cost: nothing without a change; else two evaluations, a factorisation and two solutions; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn take_inputs<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<bool, StepError> {
    if !has_new_inputs(model, s) {
        return Ok(false);
    }
    take_loads(model, options, s, w, s.t)?;
    Ok(true)
}

/// Makes accelerations, multipliers and power of `s`, just before a signal jumps, those just after, at time `to` [s].
///
/// Cost: as for inputs that change.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn pass_jump<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
    to: T,
) -> Result<(), StepError> {
    take_loads(model, options, s, w, to)?;
    s.t = to;
    Ok(())
}

/// From the loads of `s` to those of the inputs that are set, at time `to` [s].
fn take_loads<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
    to: T,
) -> Result<(), StepError> {
    let n = w.n;
    w.begin(options.regularisation);
    for rows in [&mut w.mu, &mut w.lambda, &mut w.rates] {
        rows.fill(T::ZERO);
    }
    w.end.a.fill(T::ZERO);

    // -dQ = -Q(u) + Q(u_n)
    let before = load_at(model, (s, s.t), false, &mut w.terms);
    model.evaluate(&s.q, &mut w.terms);
    w.factor(model, (T::ZERO, T::ZERO), false, options.rank)?;
    w.assemble(model, Mass::None, T::ONE, false);
    w.change[..n].copy_from_slice(&w.f[..n]);
    let after = load_at(model, (s, to), true, &mut w.terms);
    w.assemble(model, Mass::None, T::ONE, false);
    for (change, &f) in w.change[..n].iter_mut().zip(&w.f) {
        *change = f - *change;
    }

    let sweep = |w: &mut Workspace<T, S>| {
        w.mu.copy_from_slice(&w.lambda);
        w.assemble(model, Mass::Acceleration, T::ZERO, true);
        add(model.team(), &mut w.f[..n], &w.change);
        w.solve();
        w.correct(model, (T::ZERO, T::ZERO));
        model.multiply_jacobian(&w.terms, &w.end.a, &mut w.rates);
    };
    solve_response(model, w, sweep, |w| [&w.f[..n], &w.end.a])?;
    add_response(model, s, (&w.end.a[..n], &w.lambda, after - before), &mut w.terms);
    Ok(())
}
