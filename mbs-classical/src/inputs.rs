//! Response of the state to inputs that were changed between two steps.

use crate::options::Options;
use crate::workspace::{Mass, Workspace};
use mbs_core::implicit::{InputResponse, add_response, load_at, solve_response};
use mbs_core::model::{Model, State};
use mbs_core::step::StepError;
use mbs_core::team::add;
use mbs_core::{Real, SymmetricSolver};

impl<T: Real, S: SymmetricSolver<T>> InputResponse<T> for Workspace<T, S> {
    type Options = Options<T>;

    /// Solves for the changes of accelerations and multipliers that changed loads cause, with the saddle matrix of the masses.
    ///
    /// ```text
    /// [ M  J^T    ] ( da )   ( dQ )
    /// [ J  -delta ] ( dl ) = ( 0  )
    /// ```
    ///
    /// Cost: two evaluations, a factorisation and two solutions; no allocation.
    fn take_loads<M: Model<T>>(
        &mut self,
        model: &M,
        options: &Options<T>,
        s: &mut State<T>,
        to: T,
    ) -> Result<(), StepError> {
        let w = self;
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

        let sweep = |w: &mut Self| {
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
}
