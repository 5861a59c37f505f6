//! Conversion of a fault of a pass into a step error.

use crate::loops::Fault;
use crate::passes::slices::TreeSlices;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::step::StepError;

/// Converts the fault of a pass into the error of a step.
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
