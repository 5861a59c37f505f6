//! Roads: heights as functions of x, equal at all y. The heights of all features add up.

pub use super::feature::{Feature, Height};

use super::{LawInputs, Part};
use crate::Real;

/// Height of a road at `x`, with its derivatives.
pub fn height<T: Real>(road: Part, law_inputs: &LawInputs<'_, T>, x: T) -> Height<T> {
    let mut sum = Height::default();
    for feature in road.of(law_inputs.features()) {
        let h = feature.at(x, law_inputs.knots());
        sum.value += h.value;
        sum.slope += h.slope;
        sum.curvature += h.curvature;
    }
    sum
}

/// Largest h'' [1/m] of a road between `lower` and `upper`, or an upper bound; `None` if the road is level there.
///
/// Cost: a few operations for each feature of the road, and for each knot of a spline in the range.
pub fn hollow<T: Real>(
    road: Part,
    law_inputs: &LawInputs<'_, T>,
    [lower, upper]: [T; 2],
) -> Option<T> {
    let mut sum = None;
    for feature in road.of(law_inputs.features()) {
        if let Some(hollow) = feature.hollow([lower, upper], law_inputs.knots()) {
            sum = Some(sum.unwrap_or(T::ZERO) + hollow);
        }
    }
    sum
}
