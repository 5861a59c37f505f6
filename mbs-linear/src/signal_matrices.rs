//! What a linearisation has of the states of signals.

use alloc::vec::Vec;

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
