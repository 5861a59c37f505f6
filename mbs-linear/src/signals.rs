//! The states of signals in a linearisation: controllers, lags and integrals move with the mechanism.
//!
//! ```text
//! z'' = f(z, z', x),   x' = g(z, z', x):     A = [[0, 1, 0], [-K_r, -C_r, df/dx], [dg/dz, dg/dz', dg/dx]]
//! ```

use crate::error::{EquilibriumError, LinearError};
use crate::linear::Linear;
use crate::linearise::{Field, Instant, difference, linearise};
use crate::near::{equilibrium_near, failed};
use crate::options::{LinearOptions, Options};
use crate::pivoted::Pivoted;
use crate::signal_matrices::LinearSignals;
use crate::workspace::Workspace;
use alloc::vec::Vec;
use mbs_core::algebra::norm_inf;
use mbs_core::model::{Model, State};
use mbs_core::{Real, SymmetricSolver};

impl<T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'_, T, M, S> {
    /// Returns the matrices of the states of signals, and the derivatives of outputs by these states. `rates` has the derivatives of their
    /// rates by coordinates and velocities. Differences change the states by `reach` of their sizes.
    pub(crate) fn signals(
        &mut self,
        reach: T,
        rates: Vec<T>,
    ) -> Result<(LinearSignals<T>, Vec<T>), LinearError> {
        let (f, n) = (self.tangent.n_freedoms(), self.model.n_signal_states());
        let mut all = LinearSignals { n, forces: Vec::new(), rates };
        let mut outputs = Vec::new();
        for k in 0..n {
            let x = self.w.terms.signal_starts[k][0];
            let answer = difference(reach * (T::ONE + x.abs()), |dx| {
                self.w.terms.signal_starts[k][0] = x + dx;
                let answer = self.acceleration_at_start()?;
                self.with_the_rest(answer)
            });
            self.w.terms.signal_starts[k][0] = x;
            let answer = answer?;
            all.forces.extend_from_slice(&answer[..f]);
            all.rates.extend_from_slice(&answer[f..f + n]);
            outputs.extend_from_slice(&answer[f + n..]);
        }
        Ok((all, outputs))
    }

    /// Returns the rates x' of the states of signals at the last evaluation.
    pub(crate) fn signal_rates(&self) -> Vec<T> {
        let states = &self.w.terms.signals[..self.model.n_signal_states()];
        states.iter().map(|[_, rate]| *rate).collect()
    }
}

/// Largest number of steps until the states of signals are at rest [-]. One or two steps are enough where signals are linear. Chosen, not
/// tuned.
const STEPS: u32 = 20;
/// States count as at rest if they change by less than this, relative to their size or to one [-]. Differences give ten digits.
const RESTING: f64 = 1e-9;
/// Fraction of the rates that may remain because no change of the states can remove it [-]. Differences give ten digits.
const LEFT: f64 = 1e-6;
/// Derivative of the rates that counts as zero, relative to the largest one [-]. Chosen, not tuned.
const NO_SLOPE: f64 = 1e-12;

/// Moves the mechanism and the states of signals to an equilibrium in which these states are at rest too. Inputs of integrals are then
/// zero, and the output of each lag equals its input. The mechanism must be at equilibrium with the present states. Does nothing if the
/// signals have no states.
///
/// Cost: a linearisation and a search for an equilibrium in each step.
/// Cost: a linearisation and a search for an equilibrium in each step.
///
/// # Errors
/// [`EquilibriumError::SignalsMove`] if the states do not come to rest, or the error of a search. The state is then undefined.
pub fn rest_signals<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), EquilibriumError> {
    let n = model.n_signal_states();
    for _ in 0..STEPS {
        let rates: Vec<T> = s.signals[..n].iter().map(|[_, rate]| *rate).collect();
        if rates.iter().all(|rate| rate.is_zero()) {
            return Ok(());
        }
        let how = (Instant::Rest, &LinearOptions::default());
        let linear = linearise(model, how, s, w).map_err(failed)?;
        let change = linear.rest(&rates).ok_or(EquilibriumError::SignalsMove)?;
        let mut is_small = true;
        for (state, change) in s.signals.iter_mut().zip(change) {
            is_small &= change.abs() <= T::from_f64(RESTING) * (T::ONE + state[0].abs());
            state[0] += change;
        }
        equilibrium_near(model, options, s, w)?;
        if is_small {
            return Ok(());
        }
    }
    Err(EquilibriumError::SignalsMove)
}

impl<T: Real> Linear<T> {
    /// Returns the change of the signals' states x that makes their rates zero, while the mechanism stays in equilibrium: z = K^-1 (df/dx)
    /// x. Returns `None` if no change makes the rates zero.
    fn rest(&self, rates: &[T]) -> Option<Vec<T>> {
        let (f, n, of) = (self.n_freedoms, self.signals.n, &self.signals);
        let stiffness = Pivoted::new(f, self.stiffness.clone(), self.noise);
        let mut slopes = of.rates[2 * f * n..].to_vec();
        for (slopes, forces) in slopes.chunks_exact_mut(n).zip(of.forces.chunks_exact(f.max(1))) {
            for (z, by) in stiffness.solve(forces).iter().zip(of.rates.chunks_exact(n)) {
                slopes.iter_mut().zip(by).for_each(|(slope, &by)| *slope += *z * by);
            }
        }
        let largest = slopes.iter().fold(T::ZERO, |most, x| most.max(x.abs()));
        let matrix = Pivoted::new(n, slopes.clone(), largest * T::from_f64(NO_SLOPE));
        let change: Vec<T> = matrix.solve(rates).into_iter().map(|x| -x).collect();
        let mut left = rates.to_vec();
        for (column, x) in slopes.chunks_exact(n).zip(&change) {
            left.iter_mut().zip(column).for_each(|(left, &slope)| *left += slope * *x);
        }
        let is_met = norm_inf(&left) <= norm_inf(rates) * T::from_f64(LEFT);
        is_met.then_some(change)
    }
}
