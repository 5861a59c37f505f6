//! Rotation vector of one body relative to another, measured by their directions.
//!
//! ```text
//! w = log(R1^T R2),   w_i' = g.(omega2 - omega1),   g = R1 (gradient of w_i)
//! u_k' = omega x u_k:   dw_i/du_k = g x u_k / 2 in the second body, less in the first
//! ```
//!
//! Up to half a turn w follows from the matrix. Beyond, it continues from the last rotation vector.

use crate::Real;
use crate::algebra::{
    Matrix, Vector, add_to, cross, lowered, norm, raised, rotation_gradient, rotation_vector,
};
use crate::elements::{Term, combine};

/// Rotation vector of the same rotation as `w`, nearest to `last`. Its length may exceed half a turn.
#[must_use]
pub fn unwrap_rotation<T: Real>(w: &Vector<T, 3>, last: &Vector<T, 3>) -> Vector<T, 3> {
    let angle = norm(w);
    // After whole turns, the axis of a vanishing angle is a rounding error, and the last axis is used.
    let axis = if angle <= T::EPSILON.sqrt() && norm(last) > T::PI { last } else { w };
    let length = norm(axis);
    if length == T::ZERO {
        return *w;
    }
    let n = axis * (T::ONE / length);
    n * unwrap(n.dot(w), n.dot(last))
}

/// Component `number` of the rotation vector nearest to `last`, and its rate. The gradient is added to the row.
pub(super) fn rotation<T: Real, const D: usize>(
    frames: [[&[Term<T>]; 3]; 2],
    number: usize,
    (q, v): (&[T], &[T]),
    last: &[T],
    row: &mut [T],
) -> (T, T) {
    let axes = frames.map(|frame| frame.map(|x| raised(&combine::<T, D>(x, q))));
    let [first, second] = axes.map(|axes| Matrix::from_columns(&axes));
    let last = Vector::<T, 3>::new(last[0], last[1], last[2]);
    let w = unwrap_rotation(&rotation_vector(&(first.transpose() * second)), &last);
    let g = first * rotation_gradient(&w, number);
    let mut rate = T::ZERO;
    for (body, share) in [(0, -T::HALF), (1, T::HALF)] {
        for (terms, u) in frames[body].iter().zip(&axes[body]) {
            let f = cross(&g, u) * share;
            rate += f.dot(&raised(&combine::<T, D>(terms, v)));
            let f = lowered::<T, D>(&f);
            for term in *terms {
                add_to(row, term.column as usize, &term.coef.apply_transposed(&f));
            }
        }
    }
    (w[number], rate)
}

/// Angle that differs from `angle` by full turns and is nearest to `last` [rad].
pub fn unwrap<T: Real>(angle: T, last: T) -> T {
    let turn = T::TWO * T::PI;
    let mut unwrapped = angle;
    let gap = (last - unwrapped) / turn;
    // Rounding to the nearest whole number, without a floor function in the scalar trait.
    let whole = T::from_f64(libm::round(gap.to_f64()));
    unwrapped += whole * turn;
    unwrapped
}
