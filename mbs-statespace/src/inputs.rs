//! Inputs that were set since the last step, taken into the state that the next one begins with.

use crate::pivots::select_pivots;
use crate::workspace::Workspace;
use mbs_core::model::{Load, Model, State, System, Tangent};
use mbs_core::step::{StepError, add_response, has_new_inputs, load_at};
use mbs_core::{Real, SpdSolver};

/// Recomputes accelerations, multipliers and power if an input was changed since the last step; returns whether one was. Every step calls
/// this first. A caller that saves the state to undo a step calls it before saving.
///
/// ```text
/// R^T M R y = R^T dQ,   da = R y,   J_d^T dl = (dQ - M da)_d
/// ```
///
/// Cost: nothing without a change; else two evaluations, two factorisations and two solutions; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn take_inputs<T: Real, M: Model<T>>(
    model: &M,
    s: &mut State<T>,
    w: &mut Workspace<T>,
) -> Result<bool, StepError> {
    if !has_new_inputs(model, s) {
        return Ok(false);
    }
    take_loads(model, s, w, s.t)?;
    Ok(true)
}

/// Makes accelerations, multipliers and power of `s`, just before a signal jumps, those just after, at time `to` [s].
///
/// Cost: as for inputs that change.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn pass_jump<T: Real, M: Model<T>>(
    model: &M,
    s: &mut State<T>,
    w: &mut Workspace<T>,
    to: T,
) -> Result<(), StepError> {
    take_loads(model, s, w, to)?;
    s.t = to;
    Ok(())
}

/// From the loads of `s` to those of the inputs that are set, at time `to` [s].
fn take_loads<T: Real, M: Model<T>>(
    model: &M,
    s: &mut State<T>,
    w: &mut Workspace<T>,
    to: T,
) -> Result<(), StepError> {
    let n = model.n_unknowns();
    if w.is_stale {
        select_pivots(model, s, w)?;
    }
    w.a.fill(T::ZERO);
    w.dq.fill(T::ZERO);

    // -dQ = -Q(u) + Q(u_n), kept in the place of velocities
    let before = load_at(model, (s, s.t), false, &mut w.terms);
    w.move_to(model, s)?;
    w.basis.evaluate(&w.elimination);
    w.balance(model, T::ONE);
    w.v[..n].copy_from_slice(&w.balance);
    let after = load_at(model, (s, to), true, &mut w.terms);
    w.balance(model, T::ONE);
    for (load, balance) in w.v[..n].iter_mut().zip(&mut w.balance) {
        *balance -= *load;
        *load = *balance;
    }

    // R^T M R y = R^T dQ
    w.solve_transposed();
    w.jacobian.add_transposed(&w.lambda, &mut w.balance);
    for (d, &i) in w.d.iter_mut().zip(w.elimination.independent()) {
        *d = -w.balance[i as usize];
    }
    if !w.d.is_empty() {
        let tangent =
            Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty: &[], geometric: None };
        let load = Load { mass: None, multipliers: None, force: T::ZERO };
        let system = System { model, terms: &w.terms, tangent, load };
        w.basis.project(&w.elimination, &system, &mut w.tangent);
        SpdSolver::factor(&mut w.solver, &w.tangent)?;
        SpdSolver::solve(&w.solver, &mut w.d, &mut w.wanted);
        w.basis.expand(&w.elimination, &w.d, &mut w.a);
    }

    // J_d^T dl = (dQ - M da)_d
    w.balance(model, T::ZERO);
    for (balance, &load) in w.balance.iter_mut().zip(&w.v) {
        *balance += load;
    }
    w.solve_transposed();
    add_response(model, s, (&w.a[..n], &w.lambda, after - before), &mut w.terms);
    Ok(())
}
