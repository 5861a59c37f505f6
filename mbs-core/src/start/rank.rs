//! Rank of the constraint Jacobian J at a state. A small Jacobian is factored by Householder QR of J^T with column pivoting, with rows
//! scaled to unit length. A large one is eliminated sparsely.

use super::sparse_rank::sparse_rank;
use crate::Real;
use crate::blocks::Cliques;
use crate::model::{Model, Terms};
use alloc::vec;
use alloc::vec::Vec;

/// Largest number of entries of a Jacobian for the dense method [-]: about a hundred bodies, and a few hundredths of a second.
const MAX_DENSE: usize = 250_000;

/// Rank of the Jacobian J as last evaluated in `terms`.
///
/// n is the number of unknowns, m the number of rows. If n m is at most 250,000, the method is dense and needs about 2 n m^2 operations. It
/// counts pivots above max(n, m) eps^(2/3) of the largest. For larger Jacobians, products of rows are eliminated sparsely, and distances
/// below 30 eps^(1/2) count as zero. The cost is then proportional to the rows of chains and trees, and grows somewhat faster in nets. It
/// is quadratic in the number of rows at one body. Reports use this function; steps do not.
pub fn constraint_rank<T: Real, M: Model<T> + Cliques>(model: &M, terms: &Terms<T>) -> usize {
    let (n, m) = (model.n_unknowns(), model.n_constraints());
    if n.saturating_mul(m) > MAX_DENSE {
        return sparse_rank(sparse_rows(model, terms), n);
    }
    // Column k of A is row k of J; multiplying J by unit vectors gives its entries.
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
    pivoted_rank(a, n, m)
}

/// Rows of J, element by element, without zeros.
fn sparse_rows<T: Real, M: Model<T> + Cliques>(model: &M, terms: &Terms<T>) -> Vec<Vec<(u32, T)>> {
    let mut rows = Vec::with_capacity(model.n_constraints());
    let mut dense = Vec::new();
    for element in 0..model.n_elements() {
        let (n_rows, clique) = (model.rows(element).len(), model.clique(element));
        if n_rows == 0 || clique.is_empty() {
            continue;
        }
        dense.clear();
        dense.resize(n_rows * clique.len(), T::ZERO);
        model.write_jacobian(terms, element, &mut dense);
        for row in dense.chunks_exact(clique.len()) {
            let entries = clique.iter().copied().zip(row.iter().copied());
            rows.push(entries.filter(|(_, x)| *x != T::ZERO).collect());
        }
    }
    rows
}

/// Number of linearly independent rows among `m` rows of `n` numbers each. The rows are stored one after the other.
pub fn pivoted_rank<T: Real>(mut a: Vec<T>, n: usize, m: usize) -> usize {
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
        // The Householder vector overwrites its column, and the other columns are reflected.
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
