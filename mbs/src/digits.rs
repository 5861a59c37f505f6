//! Which scalars have more digits than `f64`.

use mbs_core::Real;

/// Does this scalar have more digits than `f64`?
pub(crate) fn is_finer<T: Real>() -> bool {
    T::EPSILON.to_f64() < f64::EPSILON
}
