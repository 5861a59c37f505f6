//! Faults that stop a pass.

use super::RankLost;
use crate::link::indexing::Outside;
use crate::link::joint::NoInertia;

/// Reason why a pass stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault<T> {
    /// The tables do not fit each other.
    Outside,
    /// A joint meets no inertia.
    NoInertia(NoInertia<T>),
    /// The regularised rows of loops cannot be factored.
    RankLost(RankLost<T>),
    /// The equations of loops do not come to their level.
    Unreached {
        /// 0 position, 1 velocity, 2 acceleration.
        level: u8,
        /// The row that is violated most.
        row: u32,
        /// Violation that is left.
        violation: T,
    },
}

impl<T> From<Outside> for Fault<T> {
    #[inline(always)]
    fn from(_: Outside) -> Self {
        Self::Outside
    }
}
