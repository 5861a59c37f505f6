//! The two triangular sweeps through one front, a block of at most [`BLOCK`] pivots at a time.
//!
//! ```text
//! forward:    y_1 <- L_11^-1 y_1,                      y_2 <- y_2 - L_21 y_1
//! backward:   y_1 <- L_11^-T (D^-1 y_1 - L_21^T y_2)
//! ```
//!
//! The pivots of a front are contiguous in `y`; `rows` has the indices of its other unknowns. L_11 has 1 / d on its diagonal.

use crate::front::column;
use crate::kernel::BLOCK;
use mbs_math::Real;
use mbs_math::dense::panel::subtract;

/// Makes the forward sweep through the packed front `a`, whose `p` pivots begin at index `first` of `y`.
pub(crate) fn forward<T: Real>(mut a: &[T], y: &mut [T], (first, p): (usize, usize), rows: &[u32]) {
    let (mut at, mut more) = (first, p);
    while more > BLOCK {
        more -= BLOCK;
        forward_block::<T, BLOCK>(a, y, (at, more), rows);
        a = &a[column(BLOCK + more + rows.len(), BLOCK)..];
        at += BLOCK;
    }
    match more {
        1 => forward_block::<T, 1>(a, y, (at, 0), rows),
        2 => forward_block::<T, 2>(a, y, (at, 0), rows),
        3 => forward_block::<T, 3>(a, y, (at, 0), rows),
        4 => forward_block::<T, 4>(a, y, (at, 0), rows),
        5 => forward_block::<T, 5>(a, y, (at, 0), rows),
        6 => forward_block::<T, 6>(a, y, (at, 0), rows),
        _ => {}
    }
}

/// Makes the backward sweep through the packed front `a`; the unknowns at `rows` are known.
pub(crate) fn backward<T: Real>(a: &[T], y: &mut [T], (first, p): (usize, usize), rows: &[u32]) {
    let f = p + rows.len();
    let mut k = p - p % BLOCK;
    let (last, at) = (&a[column(f, k)..], (first + k, 0));
    match p - k {
        1 => backward_block::<T, 1>(last, y, at, rows),
        2 => backward_block::<T, 2>(last, y, at, rows),
        3 => backward_block::<T, 3>(last, y, at, rows),
        4 => backward_block::<T, 4>(last, y, at, rows),
        5 => backward_block::<T, 5>(last, y, at, rows),
        _ => {}
    }
    while k > 0 {
        k -= BLOCK;
        let at = (first + k, p - k - BLOCK);
        backward_block::<T, BLOCK>(&a[column(f, k)..], y, at, rows);
    }
}

/// Makes the forward sweep through one block of `P` pivots from index `at` on; `more` pivots follow it.
#[inline(never)]
fn forward_block<T: Real, const P: usize>(
    a: &[T],
    y: &mut [T],
    (at, more): (usize, usize),
    rows: &[u32],
) {
    let columns: [&[T]; P] = columns(a, P + more + rows.len());
    let (y1, after) = y[at..at + P + more].split_at_mut(P);
    // Each row uses the value that was computed last as its last operand. So each operation waits for only one product.
    let mut v = [T::ZERO; P];
    for i in 0..P {
        let mut sum = y1[i];
        for k in 0..i {
            sum -= columns[k][i - k] * v[k];
        }
        v[i] = sum;
        y1[i] = sum;
    }
    let mut below = columns;
    for k in 0..P {
        below[k] = &columns[k][P - k..];
    }
    if more > 0 {
        let mut own = below;
        for k in 0..P {
            (own[k], below[k]) = below[k].split_at(more);
        }
        subtract(after, own, v);
    }
    let mut rest = rows;
    while let [r0, r1, r2, r3, others @ ..] = rest {
        spread(&mut below, [*r0, *r1, *r2, *r3], &v, y);
        rest = others;
    }
    if let [r0, r1, others @ ..] = rest {
        spread(&mut below, [*r0, *r1], &v, y);
        rest = others;
    }
    if let [row] = rest {
        spread(&mut below, [*row], &v, y);
    }
}

/// Subtracts the products of the next `C` rows of L_21, and removes these rows from `columns`.
#[inline(always)]
fn spread<T: Real, const P: usize, const C: usize>(
    columns: &mut [&[T]; P],
    rows: [u32; C],
    v: &[T; P],
    y: &mut [T],
) {
    let mut sum = [T::ZERO; C];
    for m in 0..P {
        let (next, rest) = columns[m].split_at(C);
        for i in 0..C {
            sum[i] += next[i] * v[m];
        }
        columns[m] = rest;
    }
    for i in 0..C {
        y[rows[i] as usize] -= sum[i];
    }
}

/// Makes the backward sweep through one block of `P` pivots from index `at` on; `more` pivots follow it.
#[inline(never)]
fn backward_block<T: Real, const P: usize>(
    a: &[T],
    y: &mut [T],
    (at, more): (usize, usize),
    rows: &[u32],
) {
    let columns: [&[T]; P] = columns(a, P + more + rows.len());
    let (y1, after) = y[at..at + P + more].split_at(P);
    let (mut v, mut own, mut below) = ([T::ZERO; P], columns, columns);
    for k in 0..P {
        v[k] = y1[k] * columns[k][0];
        (own[k], below[k]) = columns[k][P - k..].split_at(more);
        below[k] = &below[k][..rows.len()];
    }
    for i in 0..more {
        for k in 0..P {
            v[k] -= own[k][i] * after[i];
        }
    }
    for i in 0..rows.len() {
        let known = y[rows[i] as usize];
        for k in 0..P {
            v[k] -= below[k][i] * known;
        }
    }
    let y1 = &mut y[at..at + P];
    for k in (0..P).rev() {
        let mut sum = v[k];
        for i in (k + 1..P).rev() {
            sum -= columns[k][i - k] * v[i];
        }
        v[k] = sum;
        y1[k] = sum;
    }
}

/// Makes both sweeps through a packed front that eliminates all its unknowns. Returns `false`, without work, for more than [`BLOCK`]
/// unknowns.
#[inline(always)]
pub(crate) fn solve_small<T: Real>(a: &[T], y: &mut [T]) -> bool {
    match y.len() {
        1 => solve_block::<T, 1>(a, y),
        2 => solve_block::<T, 2>(a, y),
        3 => solve_block::<T, 3>(a, y),
        4 => solve_block::<T, 4>(a, y),
        5 => solve_block::<T, 5>(a, y),
        6 => solve_block::<T, 6>(a, y),
        _ => return false,
    }
    true
}

/// Makes both sweeps through one block without further rows.
#[inline(always)]
fn solve_block<T: Real, const P: usize>(a: &[T], y: &mut [T]) {
    let columns: [&[T]; P] = columns(&a[..column(P, P)], P);
    let y = &mut y[..P];
    let mut v = [T::ZERO; P];
    v.copy_from_slice(y);
    for k in 0..P {
        for i in k + 1..P {
            let product = columns[k][i - k] * v[k];
            v[i] -= product;
        }
    }
    for k in 0..P {
        v[k] *= columns[k][0];
    }
    for i in (1..P).rev() {
        for k in 0..i {
            let product = columns[k][i - k] * v[i];
            v[k] -= product;
        }
    }
    y.copy_from_slice(&v);
}

/// Returns the first `P` columns of a packed triangle of `f` unknowns.
#[inline(always)]
fn columns<T, const P: usize>(mut a: &[T], f: usize) -> [&[T]; P] {
    let mut columns: [&[T]; P] = [&a[..0]; P];
    for k in 0..P {
        (columns[k], a) = a.split_at(f - k);
    }
    columns
}
