//! Response of the state to inputs that were changed between two steps.

use crate::options::Options;
use crate::pivots::select_pivots;
use crate::workspace::Workspace;
use mbs_core::implicit::{InputResponse, add_response, load_at};
use mbs_core::model::{Load, Model, State, System, Tangent};
use mbs_core::step::StepError;
use mbs_core::{Real, SpdSolver};

impl<T: Real> InputResponse<T> for Workspace<T> {
    type Options = Options<T>;

    /// Solves for the changes of accelerations and multipliers that changed loads cause, in the independent coordinates.
    ///
    /// ```text
    /// R^T M R y = R^T dQ,   da = R y,   J_d^T dl = (dQ - M da)_d
    /// ```
    ///
    /// Cost: two evaluations, two factorisations and two solutions; no allocation.
    fn take_loads<M: Model<T>>(
        &mut self,
        model: &M,
        _options: &Options<T>,
        s: &mut State<T>,
        to: T,
    ) -> Result<(), StepError> {
        let w = self;
        let n = model.n_unknowns();
        if w.is_stale {
            select_pivots(model, s, w)?;
        }
        w.a.fill(T::ZERO);
        w.dq.fill(T::ZERO);

        // -dQ = -Q(u) + Q(u_n), stored in the vector of velocities
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
}
