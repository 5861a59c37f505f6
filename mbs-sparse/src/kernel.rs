//! Partial L D L^T of one packed front, column by column.
//!
//! ```text
//! for j = 0, ..., f - 1:    a_j <- a_j - sum_{m < min(j, p)}  l_m  d_m  l_jm        (rows j, ..., f - 1)
//!                if j < p:  d_j = a_jj,   l_j = a_j / d_j
//! ```
//!
//! After it the first p columns hold L with 1 / d on the diagonal, and the rest the update for the parent.

use crate::plan::column;
use mbs_core::Real;

/// A pivot that is not positive: its column in the front and its value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BadPivot<T> {
    pub(crate) column: usize,
    pub(crate) pivot: T,
}

/// Adds `from` to `to`, entry by entry.
#[inline(always)]
pub(crate) fn add<T: Real>(to: &mut [T], from: &[T]) {
    for (to, &from) in to.iter_mut().zip(from) {
        *to += from;
    }
}

/// target_i <- target_i - sum_m w_m column_m,i
#[inline(always)]
fn subtract<T: Real, const M: usize>(target: &mut [T], columns: [&[T]; M], w: [T; M]) {
    let len = target.len();
    let columns = columns.map(|c| &c[..len]);
    for i in 0..len {
        let mut sum = columns[0][i] * w[0];
        for m in 1..M {
            sum += columns[m][i] * w[m];
        }
        target[i] -= sum;
    }
}

/// Subtracts from column `j` what `M` columns of L from `m` on give.
#[inline(always)]
fn reduce<T: Real, const M: usize>(
    target: &mut [T],
    panel: &[T],
    d: &[T],
    (f, j, m): (usize, usize, usize),
) {
    let columns: [&[T]; M] = std::array::from_fn(|i| {
        let from = column(f, m + i) + j - m - i;
        &panel[from..from + f - j]
    });
    let w = std::array::from_fn(|i| columns[i][0] * d[m + i]);
    subtract(target, columns, w);
}

/// Subtracts from column `j` of a front of `f` unknowns what its first `k` columns of L give.
#[inline(always)]
fn reduce_by_all<T: Real>(
    target: &mut [T],
    panel: &[T],
    d: &[T],
    (f, j, k): (usize, usize, usize),
) {
    let mut m = 0;
    while m + 6 <= k {
        reduce::<T, 6>(target, panel, d, (f, j, m));
        m += 6;
    }
    match k - m {
        1 => reduce::<T, 1>(target, panel, d, (f, j, m)),
        2 => reduce::<T, 2>(target, panel, d, (f, j, m)),
        3 => reduce::<T, 3>(target, panel, d, (f, j, m)),
        4 => reduce::<T, 4>(target, panel, d, (f, j, m)),
        5 => reduce::<T, 5>(target, panel, d, (f, j, m)),
        _ => {}
    }
}

/// Eliminates the first `d.len()` unknowns of the packed front `a` of `f` unknowns; `d` receives the pivots.
pub(crate) fn eliminate<T: Real>(a: &mut [T], d: &mut [T], f: usize) -> Result<(), BadPivot<T>> {
    eliminate_sized(a, d, f, d.len())
}

/// [`eliminate`] for sizes that the compiler sees where it is called with constants.
#[inline(always)]
fn eliminate_sized<T: Real>(
    a: &mut [T],
    d: &mut [T],
    f: usize,
    p: usize,
) -> Result<(), BadPivot<T>> {
    let (a, d) = (&mut a[..column(f, f)], &mut d[..p]);
    for j in 0..f {
        let (panel, rest) = a.split_at_mut(column(f, j));
        let target = &mut rest[..f - j];
        reduce_by_all(target, panel, d, (f, j, j.min(p)));
        if j < p {
            let pivot = target[0];
            let inverse = checked_inverse(pivot, j)?;
            d[j] = pivot;
            target[0] = inverse;
            for l in &mut target[1..] {
                *l *= inverse;
            }
        }
    }
    Ok(())
}

/// 1 / pivot, if the pivot is positive and finite.
#[inline(always)]
pub(crate) fn checked_inverse<T: Real>(pivot: T, column: usize) -> Result<T, BadPivot<T>> {
    if pivot > T::ZERO && pivot.is_finite() {
        Ok(T::ONE / pivot)
    } else {
        Err(BadPivot { column, pivot })
    }
}
