//! Response of the state to inputs that were changed between two steps.

use crate::options::Options;
use crate::workspace::Workspace;
use mbs_core::implicit::{InputResponse, add_response, load_at, solve_response};
use mbs_core::model::{Model, State};
use mbs_core::step::StepError;
use mbs_core::team::{add, add_product, set_sum, subtract};
use mbs_core::{Real, SpdSolver};

impl<T: Real, S: SpdSolver<T>> InputResponse<T> for Workspace<T, S> {
    type Options = Options<T>;

    /// Solves for the changes of accelerations and multipliers that changed loads cause, with the penalties of index-1.
    ///
    /// ```text
    /// (M + J^T s J) d = M da + J^T (dl + s J da) - dQ,   da -= d,   dl += s J da
    /// ```
    ///
    /// Cost: two evaluations, a factorisation and about three solutions; no allocation.
    fn take_loads<M: Model<T>>(
        &mut self,
        model: &M,
        _options: &Options<T>,
        s: &mut State<T>,
        to: T,
    ) -> Result<(), StepError> {
        let w = self;
        let (n, factor) = (w.equations.f.len(), w.scale.factor);
        w.begin(model, (Options::index1().penalty, T::ONE, T::ONE));
        w.scale.factor = factor;
        for rows in [&mut w.equations.mu, &mut w.lambda, &mut w.projection.rates] {
            rows.fill(T::ZERO);
        }
        w.end.a.fill(T::ZERO);

        // -dQ = -Q(u) + Q(u_n)
        let (eq, change) = (&mut w.equations, &mut w.projection.change[..n]);
        let before = load_at(model, (s, s.t), false, &mut eq.terms);
        model.evaluate(&s.q, &mut eq.terms);
        eq.assemble(model, None, T::ONE);
        change.copy_from_slice(&eq.f);
        let after = load_at(model, (s, to), true, &mut eq.terms);
        eq.assemble(model, None, T::ONE);
        for (change, &f) in change.iter_mut().zip(&eq.f) {
            *change = f - *change;
        }

        w.factor_mass(model)?;
        let sweep = |w: &mut Self| {
            let (eq, s, rates) = (&mut w.equations, &w.scale.weights, &mut w.projection.rates);
            set_sum(model.team(), &mut eq.mu, &w.lambda, (s, rates));
            eq.assemble(model, Some(&w.end.a), T::ZERO);
            add(model.team(), &mut eq.f, &w.projection.change);
            eq.solve();
            subtract(model.team(), &mut w.end.a[..n], &eq.f);
            model.multiply_jacobian(&eq.terms, &w.end.a, rates);
            add_product(model.team(), &mut w.lambda, (s, rates));
        };
        solve_response(model, w, sweep, |w| [&w.equations.f, &w.end.a])?;
        w.settled = w.equations.counts;
        let response = (&w.end.a[..n], &w.lambda[..], after - before);
        add_response(model, s, response, &mut w.equations.terms);
        Ok(())
    }
}
