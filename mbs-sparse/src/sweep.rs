//! The two triangular sweeps through one front.
//!
//! ```text
//! forward:    y_1 <- L_11^-1 y_1,                      y_2 <- y_2 - L_21 y_1
//! backward:   y_1 <- L_11^-T (D^-1 y_1 - L_21^T y_2)
//! ```
//!
//! L_11 is p x p with 1 / d on its diagonal, L_21 is (f - p) x p, both in the first p columns of the packed front.

use crate::plan::column;
use mbs_core::Real;

/// Forward sweep: `y` holds the p pivots, `w` the f - p remaining rows.
#[inline(always)]
pub(crate) fn forward<T: Real>(a: &[T], y: &mut [T], w: &mut [T]) {
    let (p, f) = (y.len(), y.len() + w.len());
    for k in 0..p {
        let from = column(f, k);
        let (l11, l21) = a[from..from + f - k].split_at(p - k);
        let yk = y[k];
        for (y, &l) in y[k + 1..].iter_mut().zip(&l11[1..]) {
            *y -= l * yk;
        }
        for (w, &l) in w.iter_mut().zip(l21) {
            *w -= l * yk;
        }
    }
}

/// Backward sweep: `y` holds the p pivots, `w` the f - p remaining rows, which are known.
#[inline(always)]
pub(crate) fn backward<T: Real>(a: &[T], y: &mut [T], w: &[T]) {
    let (p, f) = (y.len(), y.len() + w.len());
    for k in (0..p).rev() {
        let from = column(f, k);
        let (l11, l21) = a[from..from + f - k].split_at(p - k);
        let (head, tail) = y.split_at_mut(k + 1);
        let inverse = l11[0];
        head[k] = head[k] * inverse - dot(&l11[1..], tail) - dot(l21, w);
    }
}

/// Sum of products in two interleaved chains.
#[inline(always)]
fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    let mut even = T::ZERO;
    let mut odd = T::ZERO;
    let (mut a, mut b) = (a.chunks_exact(2), b.chunks_exact(2));
    for (a, b) in (&mut a).zip(&mut b) {
        even += a[0] * b[0];
        odd += a[1] * b[1];
    }
    for (&a, &b) in a.remainder().iter().zip(b.remainder()) {
        even += a * b;
    }
    even + odd
}
