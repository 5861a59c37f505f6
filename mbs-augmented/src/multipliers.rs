//! Multipliers of a step: their start values, their update in the iteration, and their balance with the accelerations, which gives reactions.
//!
//! ```text
//! start:    lambda = 2 lambda_n - lambda_(n-1)   [P3 (3)],   then lambda <- s J T^-1 J^T lambda
//! update:   lambda <- lambda + s (phi + J' d), or as published lambda + s phi   [P3 (2)]
//! balance:  sigma <- sigma - s J T^-1 (M a + J^T (lambda + sigma) - Q)
//! ```

use crate::equations::Equations;
use mbs_core::model::{Model, State};
use mbs_core::team::{on_stretches, set_product};
use mbs_core::{Real, SpdSolver};

/// Start of the multipliers of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MultiplierStart {
    /// Extrapolated from the last two steps [P3 (3)], then filtered. Without the filter, the part that no constraint determines would grow
    /// from step to step.
    Filtered,
    /// Extrapolated from the last two steps, and not filtered.
    Extrapolated,
    /// Multipliers of zero [P1 (16)].
    Zero,
}

impl MultiplierStart {
    /// Sets lambda at the end of a step of length `dt` [s], times `unit`.
    pub(crate) fn set<T: Real, M: Model<T>>(
        self,
        model: &M,
        (s, dt, unit): (&State<T>, T, T),
        lambda: &mut [T],
    ) {
        if self == Self::Zero {
            return lambda.fill(T::ZERO);
        }
        let expected = s.extrapolated(dt);
        on_stretches(model.team(), [lambda], |first, [lambda]| {
            for (k, lambda) in lambda.iter_mut().enumerate() {
                *lambda = expected(first + k) * unit;
            }
        });
    }
}

/// Filters multipliers: lambda <- s J' T^-1 J'^T lambda removes the part that no constraint of the factored rows J' determines. Needs T
/// factored. Cost: one solve.
pub(crate) fn filter<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    equations: &mut Equations<T, S>,
    (s, lambda): (&[T], &mut [T]),
) {
    equations.mu.copy_from_slice(lambda);
    equations.with_factored_rows(|eq| {
        eq.assemble(model, None, T::ZERO);
        eq.solve();
        eq.multiply_correction(model);
    });
    set_product(model.team(), lambda, (s, &equations.mu));
}

/// Updates multipliers to balance the correction d = -f: lambda <- lambda + s (phi + J' d). Cost: a product of the Jacobian.
pub(crate) fn update_multipliers<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    equations: &mut Equations<T, S>,
    (s, lambda): (&[T], &mut [T]),
) {
    equations.with_factored_rows(|eq| eq.multiply_correction(model));
    let (phi, mu) = (&equations.terms.phi, &equations.mu);
    on_stretches(model.team(), [lambda], |first, [lambda]| {
        for (i, lambda) in lambda.iter_mut().enumerate() {
            let k = first + i;
            *lambda += s[k] * (phi[k] - mu[k]);
        }
    });
}

/// Balances multipliers with the projected accelerations `a`: sigma <- sigma - s J T^-1 (M a + J^T (lambda + sigma) - Q), with `lambda` in
/// parts of `unit`. Needs T factored. Cost: one solve.
///
/// lambda contains the error of the last correction. Reactions and the power of guides would contain it too. If multipliers grow as
/// published, this error is alpha times the rounding error of phi (4e-4 N for 1 kg at a step of 1 ms).
pub(crate) fn balance<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    equations: &mut Equations<T, S>,
    (a, s): (&[T], &[T]),
    (lambda, unit, sigma): (&[T], T, &mut [T]),
) {
    for (mu, (&lambda, &sigma)) in equations.mu.iter_mut().zip(lambda.iter().zip(&*sigma)) {
        *mu = lambda * unit + sigma;
    }
    equations.assemble(model, Some(a), T::ONE);
    equations.solve();
    equations.multiply_correction(model);
    for (sigma, (&s, &mu)) in sigma.iter_mut().zip(s.iter().zip(&equations.mu)) {
        *sigma -= s * mu;
    }
}
