//! The two triangular sweeps through one front, a block of at most [`BLOCK`] pivots at a time.
//!
//! ```text
//! forward:    y_1 <- L_11^-1 y_1,                      y_2 <- y_2 - L_21 y_1
//! backward:   y_1 <- L_11^-T (D^-1 y_1 - L_21^T y_2)
//! ```
//!
//! `y` holds all f unknowns of the front, pivots first; L_11 has 1 / d on its diagonal.

use crate::kernel::{BLOCK, subtract};
use crate::plan::column;
use mbs_core::Real;

/// Forward sweep through a packed front that eliminates `p` unknowns.
#[inline(always)]
pub(crate) fn forward<T: Real>(mut a: &[T], mut y: &mut [T], mut p: usize) {
    loop {
        match p {
            0 => return,
            1 => return forward_block::<T, 1>(a, y),
            2 => return forward_block::<T, 2>(a, y),
            3 => return forward_block::<T, 3>(a, y),
            4 => return forward_block::<T, 4>(a, y),
            5 => return forward_block::<T, 5>(a, y),
            _ => forward_block::<T, BLOCK>(a, y),
        }
        a = &a[column(y.len(), BLOCK)..];
        y = &mut y[BLOCK..];
        p -= BLOCK;
    }
}

/// Backward sweep through a packed front that eliminates `p` unknowns; the others are known.
#[inline(always)]
pub(crate) fn backward<T: Real>(a: &[T], y: &mut [T], p: usize) {
    let f = y.len();
    let mut k = p - p % BLOCK;
    let (last, z) = (&a[column(f, k)..], &mut y[k..]);
    match p % BLOCK {
        1 => backward_block::<T, 1>(last, z),
        2 => backward_block::<T, 2>(last, z),
        3 => backward_block::<T, 3>(last, z),
        4 => backward_block::<T, 4>(last, z),
        5 => backward_block::<T, 5>(last, z),
        _ => {}
    }
    while k > 0 {
        k -= BLOCK;
        backward_block::<T, BLOCK>(&a[column(f, k)..], &mut y[k..]);
    }
}

/// Both sweeps through a packed front that eliminates all its unknowns, if there are at most [`BLOCK`]; else `false`.
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

/// Both sweeps through one block without further rows.
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

/// The first `P` columns of a packed triangle of `f` unknowns.
#[inline(always)]
fn columns<T, const P: usize>(mut a: &[T], f: usize) -> [&[T]; P] {
    let mut columns: [&[T]; P] = [&a[..0]; P];
    for k in 0..P {
        (columns[k], a) = a.split_at(f - k);
    }
    columns
}

/// Forward sweep through one block.
#[inline(always)]
fn forward_block<T: Real, const P: usize>(a: &[T], y: &mut [T]) {
    let columns: [&[T]; P] = columns(a, y.len());
    let (y1, y2) = y.split_at_mut(P);
    let mut v = [T::ZERO; P];
    v.copy_from_slice(y1);
    for k in 0..P {
        for i in k + 1..P {
            let product = columns[k][i - k] * v[k];
            v[i] -= product;
        }
    }
    y1.copy_from_slice(&v);
    if !y2.is_empty() {
        let mut below = columns;
        for k in 0..P {
            below[k] = &columns[k][P - k..];
        }
        subtract(y2, below, v);
    }
}

/// Backward sweep through one block.
#[inline(always)]
fn backward_block<T: Real, const P: usize>(a: &[T], y: &mut [T]) {
    let columns: [&[T]; P] = columns(a, y.len());
    let (y1, y2) = y.split_at_mut(P);
    let (mut v, mut below) = ([T::ZERO; P], columns);
    for k in 0..P {
        v[k] = y1[k] * columns[k][0];
        below[k] = &columns[k][P - k..][..y2.len()];
    }
    for i in 0..y2.len() {
        for k in 0..P {
            v[k] -= below[k][i] * y2[i];
        }
    }
    for i in (1..P).rev() {
        for k in 0..i {
            let product = columns[k][i - k] * v[i];
            v[k] -= product;
        }
    }
    y1.copy_from_slice(&v);
}
