//! Laws that act on one side only: where they do not act.

use super::Law;
use crate::Real;

/// Does a law act on one side only, and not at this value? Its gaps are open.
///
/// Cost: one look at its gaps.
#[must_use]
pub fn is_apart<T: Real>(law: &Law<T>, value: T) -> bool {
    let gaps = law.gaps(value, T::ZERO);
    law.n_gaps() > 0 && gaps.iter().take(law.n_gaps()).all(|gap| gap[0] >= T::ZERO)
}
