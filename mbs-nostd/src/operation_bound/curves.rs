//! Operation counts of the curves of couplings and signals.

use super::{Operations, count};
use mbs_core::Real;
use mbs_recursive::link::curves::CurveTable;
use mbs_recursive::rows::coupled::Couplings;
use mbs_recursive::space::Space;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Operations for a cubic spline with its derivatives.
pub(super) const SPLINE: Operations = ops(22, 14).and(4, 0, 0);

/// Operations for a curve with its two derivatives.
pub(super) fn function<T: Real, S: Space<T>>(
    couplings: &Couplings<'_, T, S>,
    curve: u32,
) -> Operations {
    match couplings.curves.get(curve as usize) {
        Some(CurveTable::Polynomial { coefficients }) => {
            ops(3, 4) * count(coefficients.range().len())
        }
        Some(CurveTable::Spline { period, .. }) if *period > T::ZERO => {
            SPLINE + ops(1, 2).and(1, 0, 0)
        }
        Some(CurveTable::Spline { .. }) => SPLINE,
        None => Operations::NONE,
    }
}
