//! Pivots of a front that are not yet applied to some later columns, and the products that apply them.
//!
//! ```text
//! a_j <- a_j - sum_m  d_m l_jm l_m          pivots m of the panel, together: each column is read and written once
//! ```

use crate::Real;
use core::ops::Range;

/// Largest number of pivots in a panel [-]. The later columns are read and written once for the whole panel. Chosen, not tuned.
const MAX_PIVOTS: usize = 6;

/// Consecutive pivots of one unknown each.
#[derive(Debug)]
pub(super) struct Panel<T> {
    /// Place of the first pivot.
    start: usize,
    pivots: [T; MAX_PIVOTS],
    len: usize,
}

impl<T: Real> Default for Panel<T> {
    fn default() -> Self {
        Self::starting_at(0)
    }
}

impl<T: Real> Panel<T> {
    /// Panel without any pivots; the first will be at place `start`.
    pub(super) fn starting_at(start: usize) -> Self {
        Self { start, pivots: [T::ZERO; MAX_PIVOTS], len: 0 }
    }

    /// Adds the pivot of the next place.
    pub(super) fn push(&mut self, pivot: T) {
        self.pivots[self.len] = pivot;
        self.len += 1;
    }

    pub(super) fn is_full(&self) -> bool {
        self.len == MAX_PIVOTS
    }

    /// Applies the pivots to `columns`, which must all come after the panel.
    #[inline(always)]
    pub(super) fn apply(&self, a: &mut [T], f: usize, columns: Range<usize>) {
        match self.len {
            0 => {}
            1 => self.apply_sized::<1>(a, f, columns),
            2 => self.apply_sized::<2>(a, f, columns),
            3 => self.apply_sized::<3>(a, f, columns),
            4 => self.apply_sized::<4>(a, f, columns),
            5 => self.apply_sized::<5>(a, f, columns),
            _ => self.apply_sized::<MAX_PIVOTS>(a, f, columns),
        }
    }

    #[inline(always)]
    fn apply_sized<const P: usize>(&self, a: &mut [T], f: usize, columns: Range<usize>) {
        let first = columns.start;
        let (done, rest) = a.split_at_mut(column(f, first));
        let mut known: [&[T]; P] = [&done[..0]; P];
        for m in 0..P {
            let k = self.start + m;
            known[m] = &done[column(f, k) + first - k..][..f - first];
        }
        subtract_products(rest, columns.len(), known, &self.pivots);
    }
}

/// Subtracts sum_m d_m l_im l_jm from a_ij in the first `n` columns of the packed triangle `a`. Each column of `l` has as many rows as the
/// triangle.
#[inline(always)]
pub fn subtract_products<T: Real, const P: usize>(
    a: &mut [T],
    n: usize,
    l: [&[T]; P],
    pivots: &[T],
) {
    let rows = l[0].len();
    let mut rest = a;
    for j in 0..n {
        let (target, next) = rest.split_at_mut(rows - j);
        rest = next;
        let (mut below, mut w) = (l, [T::ZERO; P]);
        for m in 0..P {
            below[m] = &l[m][j..rows];
            w[m] = below[m][0] * pivots[m];
        }
        subtract(target, below, w);
    }
}

/// Subtracts the weighted columns: target_i <- target_i - sum_m w_m column_m,i.
///
/// The function handles four rows at a time, then two, then one, as blocks of a size that the compiler knows. A loop over rows would not be
/// vectorised in some of the functions that this one is inlined into.
#[inline(always)]
pub fn subtract<T: Real, const M: usize>(target: &mut [T], mut columns: [&[T]; M], w: [T; M]) {
    let len = target.len();
    for c in &mut columns {
        *c = &c[..len];
    }
    let mut i = 0;
    while i + 4 <= len {
        subtract_rows::<T, M, 4>(target, &columns, &w, i);
        i += 4;
    }
    if i + 2 <= len {
        subtract_rows::<T, M, 2>(target, &columns, &w, i);
        i += 2;
    }
    if i < len {
        subtract_rows::<T, M, 1>(target, &columns, &w, i);
    }
}

/// Subtracts the weighted columns in the rows i, ..., i + R - 1.
#[inline(always)]
fn subtract_rows<T: Real, const M: usize, const R: usize>(
    target: &mut [T],
    columns: &[&[T]; M],
    w: &[T; M],
    i: usize,
) {
    let mut sum = [T::ZERO; R];
    for m in 0..M {
        let column = &columns[m][i..][..R];
        for lane in 0..R {
            let product = column[lane] * w[m];
            sum[lane] = if m == 0 { product } else { sum[lane] + product };
        }
    }
    let target = &mut target[i..][..R];
    for lane in 0..R {
        target[lane] -= sum[lane];
    }
}

/// Start of column `j` in a packed front of `f` unknowns.
#[inline(always)]
#[must_use]
pub fn column(f: usize, j: usize) -> usize {
    j * (2 * f + 1 - j) / 2
}
