//! Rank of the constraint Jacobian at a state, by Householder QR of J^T with column pivoting on rows of unit length.

use crate::Real;
use crate::blocks::Cliques;
use crate::model::{Model, Terms};
use alloc::vec;
use alloc::vec::Vec;

/// The rank of J as last evaluated in `terms`; `None` when the dense factorisation would be too large (n m > 4e6).
///
/// Counts pivots above max(n, m) eps^(2/3) of the largest. Cost: about 2 n m^2 operations, dense; meant for reports.
pub fn constraint_rank<T: Real, M: Model<T> + Cliques>(
    model: &M,
    terms: &Terms<T>,
) -> Option<usize> {
    let (n, m) = (model.n_unknowns(), model.n_constraints());
    if n * m > 4_000_000 {
        return None;
    }
    // Column k of A is row k of J, by multiplying unit vectors.
    let mut a = vec![T::ZERO; n * m];
    let (mut unit, mut column) = (vec![T::ZERO; model.n_extended()], vec![T::ZERO; m]);
    for i in 0..n {
        unit[i] = T::ONE;
        model.multiply_jacobian(terms, &unit, &mut column);
        unit[i] = T::ZERO;
        for k in 0..m {
            a[k * n + i] = column[k];
        }
    }
    for row in a.chunks_exact_mut(n.max(1)) {
        let length = row.iter().fold(T::ZERO, |s, &x| s + x * x).sqrt();
        if length > T::ZERO {
            row.iter_mut().for_each(|x| *x /= length);
        }
    }
    Some(pivoted_rank(a, n, m))
}

fn pivoted_rank<T: Real>(mut a: Vec<T>, n: usize, m: usize) -> usize {
    let tolerance = T::from_f64(n.max(m) as f64 * libm::pow(T::EPSILON.to_f64(), 2.0 / 3.0));
    let mut columns: Vec<usize> = (0..m).collect();
    let mut largest = T::ZERO;
    for step in 0..n.min(m) {
        let tail = |c: usize, a: &[T]| {
            a[c * n + step..(c + 1) * n].iter().fold(T::ZERO, |s, &x| s + x * x)
        };
        let mut best = step;
        for j in step..m {
            if tail(columns[j], &a) > tail(columns[best], &a) {
                best = j;
            }
        }
        columns.swap(step, best);
        let c = columns[step];
        let norm = tail(c, &a).sqrt();
        largest = largest.max(norm);
        if norm <= tolerance * largest || norm == T::ZERO {
            return step;
        }
        // Householder vector in place; the other columns are reflected.
        let head = a[c * n + step];
        let alpha = if head > T::ZERO { -norm } else { norm };
        a[c * n + step] = head - alpha;
        let v: Vec<T> = a[c * n + step..(c + 1) * n].to_vec();
        let vv = v.iter().fold(T::ZERO, |s, &x| s + x * x);
        for &j in &columns[step + 1..] {
            let column = &mut a[j * n + step..(j + 1) * n];
            let dot = v.iter().zip(column.iter()).fold(T::ZERO, |s, (&x, &y)| s + x * y);
            let f = T::TWO * dot / vv;
            column.iter_mut().zip(&v).for_each(|(x, &y)| *x -= f * y);
        }
    }
    n.min(m)
}
