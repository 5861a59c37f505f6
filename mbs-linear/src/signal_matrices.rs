//! Matrices of the states of signals in a linearisation.

use alloc::vec::Vec;

/// Matrices between the states of signals and a linearised motion, stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearSignals<T> {
    /// Number of states s.
    pub n: usize,
    /// Derivatives dz''/dx, f x s.
    pub forces: Vec<T>,
    /// Derivatives dx'/d(z, z', x), s x (2 f + s).
    pub rates: Vec<T>,
}
