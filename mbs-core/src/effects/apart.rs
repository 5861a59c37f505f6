//! Check of a law that acts on one side only: whether it exerts no force at a value.

use super::Law;
use crate::Real;

/// True if the law acts on one side only and all its gaps are open at this value, so that it exerts no force.
///
/// Cost: one evaluation of the gaps.
#[must_use]
pub fn is_apart<T: Real>(law: &Law<T>, value: T) -> bool {
    let gaps = law.gaps(value, T::ZERO);
    law.n_gaps() > 0 && gaps.iter().take(law.n_gaps()).all(|gap| gap[0] >= T::ZERO)
}
