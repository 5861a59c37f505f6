//! Faults by which a pass ends.

use super::RankLost;
use crate::link::indexing::Outside;
use crate::link::joint::NoInertia;

/// Reason why a pass ends with a fault.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault<T> {
    /// The tables do not fit each other.
    Outside,
    /// A joint moves no inertia.
    NoInertia(NoInertia<T>),
    /// The regularised rows of loops cannot be factored.
    RankLost(RankLost<T>),
    /// The sweeps do not reach the level of the loops' equations.
    Unreached {
        /// Level of the equations: 0 position, 1 velocity, 2 acceleration.
        level: u8,
        /// Number of the row with the largest violation.
        row: u32,
        /// Violation that the sweeps leave.
        violation: T,
    },
}

impl<T> From<Outside> for Fault<T> {
    #[inline(always)]
    fn from(_: Outside) -> Self {
        Self::Outside
    }
}
