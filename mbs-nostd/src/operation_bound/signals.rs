//! Operation counts of the operations on signals, with their derivatives. Each count is that of the most expensive branch.

use super::Operations;
use super::curves::function;
use mbs_core::Real;
use mbs_core::feedback::FeedbackOperation;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::space::Space;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Returns the number of operations for all signals at an instant.
pub(super) fn evaluation<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Operations {
    let mut sum = Operations::NONE;
    for step in m.feedback.steps {
        sum += match step.operation {
            FeedbackOperation::Add { .. } => ops(5, 5),
            FeedbackOperation::Multiply { .. } => ops(11, 5),
            FeedbackOperation::Curve { curve, .. } => {
                ops(6, 1) + function(&m.loops.couplings, curve)
            }
            FeedbackOperation::LimitRatio { .. } => ops(6, 2).and(3, 0, 0),
            FeedbackOperation::Lag { .. } => ops(7, 5).and(5, 0, 0),
            FeedbackOperation::Integral { .. } => ops(5, 2),
            FeedbackOperation::Pid { .. } => ops(16, 11),
            FeedbackOperation::Value { .. }
            | FeedbackOperation::Rate { .. }
            | FeedbackOperation::Constant(_)
            | FeedbackOperation::Clamp { .. }
            | FeedbackOperation::Component { .. }
            | FeedbackOperation::Force { .. } => Operations::NONE,
        };
    }
    sum
}
