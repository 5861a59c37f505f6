//! Linearisation about a state: stiffness and damping in independent coordinates.

use crate::signal_matrices::LinearSignals;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// Equations of motion linearised about a state, z'' + C_r z' + K_r z = f; matrices are stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct Linear<T> {
    /// Number of freedoms f.
    pub n_freedoms: usize,
    /// -dz''/dz [1/s^2], f x f.
    pub stiffness: Vec<T>,
    /// -dz''/dz' [1/s], f x f.
    pub damping: Vec<T>,
    /// dq/dz, n x f, with B^T M B = 1.
    pub basis: Vec<T>,
    /// z'' at the state: zero in an equilibrium.
    pub acceleration: Vec<T>,
    /// Largest acceleration that the constraints ask for because bodies turn [m/s^2]: zero at rest and in translation.
    ///
    /// Where it is not, the coefficients change along the motion, and eigenvalues hold for an instant and for these z alone.
    pub turning: T,
    /// Rounding to be expected in `stiffness` [1/s^2]: eigenvalues whose square is of this size are zero.
    pub noise: T,
    /// Largest force over the inertia that it moves, in sizes of coordinates [1/s^2]: what accelerations are compared with.
    pub lively: T,
    /// The states of signals.
    pub signals: LinearSignals<T>,
}

impl<T: Real> Linear<T> {
    /// Order of the linearised motion: twice the freedoms, and the states of signals.
    #[must_use]
    pub const fn order(&self) -> usize {
        2 * self.n_freedoms + self.signals.n
    }

    /// A of d/dt (z, z', x) = A (z, z', x) with the states x of signals, column by column.
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
