//! Faults that stop a pass, and the step error that each of them becomes.

use crate::indexing::Outside;
use crate::joint::NoInertia;
use crate::loops::RankLost;
use crate::slices::TreeSlices;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::step::StepError;

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

/// The fault of a pass as the error of a step.
pub(crate) fn failure<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    fault: Fault<T>,
) -> StepError {
    let freedom = |link: u32| m.links.get(link as usize).map_or(u32::MAX, |link| link.v);
    match fault {
        Fault::Outside => StepError::Tables,
        Fault::NoInertia(fault) if fault.pivot.is_finite() => {
            StepError::Singular(mbs_core::FactorError {
                unknown: freedom(fault.link),
                pivot: fault.pivot.to_f64(),
            })
        }
        Fault::NoInertia(fault) => StepError::NotFinite { unknown: freedom(fault.link) },
        Fault::RankLost(fault) => {
            StepError::RankLost { row: fault.row, pivot: fault.pivot.to_f64() }
        }
        Fault::Unreached { level, row, violation } => {
            StepError::Violated { level, violation: violation.to_f64(), row }
        }
    }
}
