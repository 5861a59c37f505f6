//! Faults that end a pass.

use super::RankLost;
use crate::link::indexing::Outside;
use crate::link::joint::NoInertia;

/// Fault that ends a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault<T> {
    /// Tables of the mechanism are inconsistent.
    Outside,
    /// A joint moves no inertia.
    NoInertia(NoInertia<T>),
    /// The regularised rows of loops cannot be factored.
    RankLost(RankLost<T>),
    /// The sweeps leave a violation of the loops' equations that is too large.
    Unreached {
        /// Level of the equations: 0 for positions, 1 for velocities, 2 for accelerations.
        level: u8,
        /// Index of the row with the largest violation.
        row: u32,
        /// Violation that remains after the sweeps.
        violation: T,
    },
}

impl<T> From<Outside> for Fault<T> {
    #[inline(always)]
    fn from(_: Outside) -> Self {
        Self::Outside
    }
}
