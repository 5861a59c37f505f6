//! Symmetric equilibration of a sum of blocks, and its products.
//!
//! ```text
//! a_ii > 0:   s_i = 1 / sqrt(a_ii)                                  coordinates in units of their inertia
//! else:       r_i = max_j |s_i a_ij s_j|,   s_i <- s_i / sqrt(r_i)  (Ruiz, 2001): tends to a largest entry of 1
//! ```
//!
//! A row of constraints and its multiplier can be scaled freely, so the diagonal sets the scale of the coordinates. Scaled by their
//! inertia, even light coordinates pass the test for a pivot of one unknown. Unscaled, such coordinates would be eliminated in pairs or in
//! a later front.

use crate::Real;
use crate::team::{Team, on_stretches};

/// Number of rounds of the scaling [-]. Each round takes the square root of the remaining spread, so that three rounds reduce 1e8 to 10.
const ROUNDS: u32 = 3;

/// Finds `scale` (n places) for a matrix with this `diagonal`; `rows` (n places) is scratch. `measure(scale, rows)` writes the largest
/// entry of every row of the matrix scaled by `scale` into `rows`.
///
/// Cost: three calls of `measure`, and at most three square roots for each of the n unknowns.
pub fn equilibrate<W: Team, T: Real>(
    team: &W,
    (scale, rows): (&mut [T], &mut [T]),
    diagonal: &[T],
    mut measure: impl FnMut(&[T], &mut [T]),
) {
    on_stretches(team, [&mut *scale], |first, [scale]| {
        for (s, &d) in scale.iter_mut().zip(&diagonal[first..]) {
            *s = if is_unit(d) { T::ONE / d.sqrt() } else { T::ONE };
        }
    });
    for _ in 0..ROUNDS {
        measure(scale, rows);
        let rows = &*rows;
        on_stretches(team, [&mut *scale], |first, [scale]| {
            for ((s, &r), &d) in scale.iter_mut().zip(&rows[first..]).zip(&diagonal[first..]) {
                if !is_unit(d) && r > T::ZERO && r.is_finite() {
                    *s /= r.sqrt();
                }
            }
        });
    }
}

/// True if a diagonal entry can be scaled to one: the entry must be positive and finite, and its reciprocal finite.
#[inline(always)]
fn is_unit<T: Real>(d: T) -> bool {
    d > T::ZERO && d.is_finite() && (T::ONE / d).is_finite()
}

/// Writes the diagonal of one packed block of `diagonal.len()` unknowns.
#[inline(always)]
pub fn write_diagonal<T: Real>(block: &[T], diagonal: &mut [T]) {
    let (k, mut at) = (diagonal.len(), 0);
    for (j, d) in diagonal.iter_mut().enumerate() {
        *d = block[at];
        at += k - j;
    }
}

/// The larger of two numbers; a NaN in `b` is ignored.
#[inline(always)]
pub fn larger<T: Real>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// Writes rows_j = max_i |s_i a_ij s_j| of one packed block, in the order of its clique.
#[inline(always)]
pub fn measure_rows<T: Real>(clique: &[u32], block: &[T], scale: &[T], rows: &mut [T]) {
    rows.fill(T::ZERO);
    let mut rest = block;
    for (j, &v) in clique.iter().enumerate() {
        let (column, next) = rest.split_at(clique.len() - j);
        rest = next;
        let (s, mut most) = (scale[v as usize], rows[j]);
        for ((&u, &x), row) in clique[j..].iter().zip(column).zip(&mut rows[j..]) {
            let x = (x * s * scale[u as usize]).abs();
            most = larger(most, x);
            *row = larger(*row, x);
        }
        rows[j] = most;
    }
}

/// Subtracts A x of one packed block from `b`.
pub fn subtract_product<T: Real>(clique: &[u32], block: &[T], x: &[T], b: &mut [T]) {
    let mut rest = block;
    for (j, &v) in clique.iter().enumerate() {
        let (column, next) = rest.split_at(clique.len() - j);
        rest = next;
        b[v as usize] -= column[0] * x[v as usize];
        for (&u, &a) in clique[j + 1..].iter().zip(&column[1..]) {
            b[u as usize] -= a * x[v as usize];
            b[v as usize] -= a * x[u as usize];
        }
    }
}
