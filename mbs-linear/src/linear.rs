//! Equations of motion linearised about a state: stiffness and damping in independent coordinates.

use crate::signal_matrices::LinearSignals;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// Equations of motion linearised about a state, z'' + C_r z' + K_r z = f; matrices are stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear<T> {
    /// Number of freedoms f.
    pub n_freedoms: usize,
    /// Stiffness -dz''/dz [1/s^2], f x f.
    pub stiffness: Vec<T>,
    /// Damping -dz''/dz' [1/s], f x f.
    pub damping: Vec<T>,
    /// Basis B = dq/dz, n x f, with B^T M B = 1.
    pub basis: Vec<T>,
    /// Accelerations z'' at the state: zero in an equilibrium.
    pub acceleration: Vec<T>,
    /// Largest acceleration term of the constraints that comes from the rotation of bodies [m/s^2]. Zero at rest and in translation.
    ///
    /// If it is not zero, the coefficients change along the motion. Eigenvalues then hold for one instant and for these coordinates z only.
    pub turning: T,
    /// Rounding error to be expected in `stiffness` [1/s^2]. An eigenvalue whose square is of this size counts as zero.
    pub noise: T,
    /// Largest ratio of a force to the inertia that it moves, relative to the sizes of coordinates [1/s^2]. Accelerations are compared with
    /// it.
    pub lively: T,
    /// Matrices of the states of signals.
    pub signals: LinearSignals<T>,
}

impl<T: Real> Linear<T> {
    /// Order of the linearised motion: twice the number of freedoms, plus the number of states of signals.
    #[must_use]
    pub const fn order(&self) -> usize {
        2 * self.n_freedoms + self.signals.n
    }

    /// Matrix A of d/dt (z, z', x) = A (z, z', x), with the states x of signals, stored column by column.
    #[must_use]
    pub fn state_matrix(&self) -> Vec<T> {
        let (f, s, n) = (self.n_freedoms, self.signals.n, self.order());
        let mut a = vec![T::ZERO; n * n];
        for j in 0..f {
            a[(f + j) * n + j] = T::ONE;
            for i in 0..f {
                a[j * n + f + i] = -self.stiffness[j * f + i];
                a[(f + j) * n + f + i] = -self.damping[j * f + i];
            }
        }
        for j in 0..s {
            let column = (2 * f + j) * n + f;
            a[column..column + f].copy_from_slice(&self.signals.forces[j * f..][..f]);
        }
        let of_signals = self.signals.rates.chunks_exact(s.max(1));
        for (column, rates) in a.chunks_exact_mut(n.max(1)).zip(of_signals) {
            column[2 * f..].copy_from_slice(rates);
        }
        a
    }
}
