//! The states of signals in a linearisation: controllers, lags and integrals move with the mechanism.
//!
//! ```text
//! z'' = f(z, z', x),   x' = g(z, z', x):     A = [[0, 1, 0], [-K_r, -C_r, df/dx], [dg/dz, dg/dz', dg/dx]]
//! ```

use crate::error::LinearError;
use crate::linearise::{Field, difference};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::model::Model;
use mbs_core::{Real, SymmetricSolver};

/// What the states of signals do to a linearised motion, and the motion to them; matrices are stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearSignals<T> {
    /// Number of states s.
    pub n: usize,
    /// dz''/dx, f x s.
    pub forces: Vec<T>,
    /// dx'/d(z, z', x), s x (2 f + s).
    pub rates: Vec<T>,
}

impl<T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'_, T, M, S> {
    /// By differences that move coordinates, velocities and states by `reach` of their sizes.
    pub(crate) fn signals(&mut self, reach: T) -> Result<LinearSignals<T>, LinearError> {
        let (f, n) = (self.tangent.n_freedoms(), self.model.n_signal_states());
        let mut all = LinearSignals { n, forces: Vec::new(), rates: Vec::new() };
        if n == 0 {
            return Ok(all);
        }
        let mut change = vec![T::ZERO; f];
        for j in 0..f {
            let h = reach / self.w.extent(self.tangent.direction(j));
            all.rates.extend(difference(h, |z| {
                change[j] = z;
                self.displaced(&change)?;
                Ok(self.signal_rates())
            })?);
            change[j] = T::ZERO;
        }
        self.return_to_start()?;
        for j in 0..f {
            let h = reach / self.w.extent(self.tangent.direction(j));
            all.rates.extend(difference(h, |z| {
                self.hurried(j, z)?;
                Ok(self.signal_rates())
            })?);
        }
        for k in 0..n {
            let x = self.w.terms.signal_starts[k][0];
            let answer = difference(reach * (T::ONE + x.abs()), |dx| {
                self.w.terms.signal_starts[k][0] = x + dx;
                let mut answer = self.acceleration_at_start()?;
                answer.extend(self.signal_rates());
                Ok(answer)
            });
            self.w.terms.signal_starts[k][0] = x;
            let answer = answer?;
            all.forces.extend_from_slice(&answer[..f]);
            all.rates.extend_from_slice(&answer[f..]);
        }
        Ok(all)
    }

    /// x' as last evaluated.
    fn signal_rates(&self) -> Vec<T> {
        let states = &self.w.terms.signals[..self.model.n_signal_states()];
        states.iter().map(|[_, rate]| *rate).collect()
    }
}
