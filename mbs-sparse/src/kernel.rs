//! Partial L D L^T of one packed front, a block of at most [`BLOCK`] pivots at a time.
//!
//! ```text
//! [ A_11        ]  =  [ L_11   ] [ D    ] [ L_11^T  L_21^T ]        A_11 = L_11 D L_11^T
//! [ A_21   A_22 ]     [ L_21 I ] [    U ] [         I      ]        L_21 = A_21 L_11^-T D^-1
//!                                                                   U    = A_22 - L_21 D L_21^T
//! ```
//!
//! Closures over arrays are avoided here, since their inlining depends on the number of codegen units of the build. The remaining triangle is
//! a packed front again, and the next block starts with it. Block sizes are known to the compiler. The diagonal of L_11 contains 1 / d.

use crate::front::column;
use mbs_math::Real;
use mbs_math::dense::panel::subtract_products;

/// Largest number of pivots that are eliminated together [-]. Each later column is then read and written once for all of them. Chosen, not
/// tuned.
pub(crate) const BLOCK: usize = 6;

/// A pivot that is not positive: the column of the front, and the pivot's value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BadPivot<T> {
    pub(crate) column: usize,
    pub(crate) pivot: T,
}

/// Eliminates the first `d.len()` unknowns of the packed front `a` of `f` unknowns; `d` receives the pivots.
#[inline(never)]
pub(crate) fn eliminate<T: Real>(
    mut a: &mut [T],
    d: &mut [T],
    mut f: usize,
) -> Result<(), BadPivot<T>> {
    let mut done = 0;
    let mut d = d;
    loop {
        let p = d.len().min(BLOCK);
        let result = match p {
            6 => block::<T, 6>(a, d, f),
            5 => block::<T, 5>(a, d, f),
            4 => block::<T, 4>(a, d, f),
            3 => block::<T, 3>(a, d, f),
            2 => block::<T, 2>(a, d, f),
            1 => block::<T, 1>(a, d, f),
            _ => return Ok(()),
        };
        result.map_err(|bad| BadPivot { column: bad.column + done, ..bad })?;
        if p == d.len() {
            return Ok(());
        }
        a = &mut a[column(f, p)..];
        d = &mut d[p..];
        f -= p;
        done += p;
    }
}

/// Eliminates the first `P` unknowns of a packed front. The compiler knows all sizes for the most frequent numbers of further rows, which
/// come from bodies with two or three coordinates per point.
#[inline(always)]
fn block<T: Real, const P: usize>(a: &mut [T], d: &mut [T], f: usize) -> Result<(), BadPivot<T>> {
    match f - P {
        0 => fixed::<T, P, 0>(a, d),
        2 if P.is_multiple_of(2) => fixed::<T, P, 2>(a, d),
        3 if P.is_multiple_of(3) => fixed::<T, P, 3>(a, d),
        4 if P.is_multiple_of(2) => fixed::<T, P, 4>(a, d),
        6 if P > 1 => fixed::<T, P, 6>(a, d),
        9 if P.is_multiple_of(3) => fixed::<T, P, 9>(a, d),
        12 if P.is_multiple_of(3) => fixed::<T, P, 12>(a, d),
        15 if P.is_multiple_of(3) => fixed::<T, P, 15>(a, d),
        18 if P.is_multiple_of(3) => fixed::<T, P, 18>(a, d),
        _ => block_sized::<T, P>(a, d, f),
    }
}

/// Eliminates the first `P` unknowns of a packed front of `P + R` unknowns.
#[inline(never)]
fn fixed<T: Real, const P: usize, const R: usize>(
    a: &mut [T],
    d: &mut [T],
) -> Result<(), BadPivot<T>> {
    block_sized::<T, P>(&mut a[..column(P + R, P + R)], d, P + R)
}

/// Eliminates the first `P` unknowns of the packed front `a` of `f` unknowns.
#[inline(always)]
fn block_sized<T: Real, const P: usize>(
    a: &mut [T],
    d: &mut [T],
    f: usize,
) -> Result<(), BadPivot<T>> {
    let (panel, update) = a.split_at_mut(column(f, P));
    let d = &mut d[..P];

    // A_11 = L_11 D L_11^T
    let l = factor_diagonal_block::<T, P>(panel, f, d)?;
    let r = f - P;
    if r == 0 {
        return Ok(());
    }

    // L_21 = A_21 L_11^-T D^-1
    let mut starts = [0; P];
    for k in 0..P {
        starts[k] = column(f, k) + P - k;
    }
    let mut i = 0;
    while i + 2 <= r {
        divide_rows::<T, P, 2>(panel, &starts, &l, i);
        i += 2;
    }
    if i < r {
        divide_rows::<T, P, 1>(panel, &starts, &l, i);
    }

    // U = A_22 - L_21 D L_21^T
    let panel = &*panel;
    let mut below: [&[T]; P] = [&panel[..0]; P];
    for k in 0..P {
        below[k] = &panel[starts[k]..starts[k] + r];
    }
    subtract_products(update, r, below, d);
    Ok(())
}

/// Factors the first `P` rows of the columns of a front of `f` unknowns. Returns L_11 as `l[column][row]`, with 1 / d on its diagonal.
#[inline(always)]
fn factor_diagonal_block<T: Real, const P: usize>(
    panel: &mut [T],
    f: usize,
    d: &mut [T],
) -> Result<[[T; P]; P], BadPivot<T>> {
    let mut l = [[T::ZERO; P]; P];
    for k in 0..P {
        l[k][k..].copy_from_slice(&panel[column(f, k)..][..P - k]);
    }
    for k in 0..P {
        let pivot = l[k][k];
        let inverse = checked_inverse(pivot, k)?;
        d[k] = pivot;
        for j in k + 1..P {
            let ljk = l[k][j] * inverse;
            for i in j..P {
                l[j][i] -= l[k][i] * ljk;
            }
        }
        l[k][k] = inverse;
        for i in k + 1..P {
            l[k][i] *= inverse;
        }
    }
    for k in 0..P {
        panel[column(f, k)..][..P - k].copy_from_slice(&l[k][k..]);
    }
    Ok(l)
}

/// Converts rows `i`, ..., `i + R - 1` of A_21, whose columns begin at `starts`, into rows of L_21.
#[inline(always)]
fn divide_rows<T: Real, const P: usize, const R: usize>(
    panel: &mut [T],
    starts: &[usize; P],
    l: &[[T; P]; P],
    i: usize,
) {
    let mut v = [[T::ZERO; R]; P];
    for k in 0..P {
        v[k].copy_from_slice(&panel[starts[k] + i..][..R]);
    }
    for k in 0..P {
        for m in 0..k {
            for lane in 0..R {
                let product = v[m][lane] * l[m][k];
                v[k][lane] -= product;
            }
        }
    }
    for k in 0..P {
        let row = &mut panel[starts[k] + i..][..R];
        for lane in 0..R {
            row[lane] = v[k][lane] * l[k][k];
        }
    }
}

/// Returns 1 / pivot if the pivot is positive and finite.
#[inline(always)]
pub(crate) fn checked_inverse<T: Real>(pivot: T, column: usize) -> Result<T, BadPivot<T>> {
    if pivot > T::ZERO && pivot.is_finite() {
        Ok(T::ONE / pivot)
    } else {
        Err(BadPivot { column, pivot })
    }
}
