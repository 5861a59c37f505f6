//! Partial L D L^T of one packed front, with the largest remaining diagonal first.
//!
//! ```text
//! for k = 0, ..., p - 1:    q = argmax_{k <= i < p} a_ii,   swap rows and columns k and q
//!                           d_k = a_kk,   l_k = a_k / d_k,   a_ij <- a_ij - l_ik d_k l_jk     (i >= j > k)
//! ```

use crate::front::column;
use crate::kernel::{BadPivot, checked_inverse};
use mbs_math::Real;
use mbs_math::dense::front::swap;

/// Eliminates the first `d.len()` unknowns of the packed front `a` of `f` unknowns. `taken[k]` receives the row that became pivot `k`.
/// After a failure, it also has the row of the failed pivot.
pub(crate) fn eliminate_largest<T: Real>(
    a: &mut [T],
    d: &mut [T],
    taken: &mut [u32],
    f: usize,
) -> Result<(), BadPivot<T>> {
    let p = d.len();
    for (row, taken) in (0_u32..).zip(taken.iter_mut()) {
        *taken = row;
    }
    for k in 0..p {
        let q = largest_diagonal(a, f, k, p);
        if q != k {
            swap(a, f, k, q);
            taken.swap(k, q);
        }
        let (head, rest) = a.split_at_mut(column(f, k + 1));
        let pivot_column = &mut head[column(f, k)..];
        d[k] = pivot_column[0];
        let inverse = checked_inverse(pivot_column[0], k)?;
        for j in k + 1..f {
            let from = column(f, j) - column(f, k + 1);
            let below = &pivot_column[j - k..];
            let l = below[0] * inverse;
            for (target, &a) in rest[from..from + f - j].iter_mut().zip(below) {
                *target -= l * a;
            }
        }
        pivot_column[0] = inverse;
        for l in &mut pivot_column[1..] {
            *l *= inverse;
        }
    }
    Ok(())
}

/// Returns the row of the largest diagonal among `k..p`.
fn largest_diagonal<T: Real>(a: &[T], f: usize, k: usize, p: usize) -> usize {
    let mut q = k;
    for i in k + 1..p {
        if a[column(f, i)] > a[column(f, q)] {
            q = i;
        }
    }
    q
}
