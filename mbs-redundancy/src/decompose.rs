//! Splitting of a null space into independent groups of joints.
//!
//! ```text
//! P = N Nᵀ,   P_ij: the block of joints i and j
//! ```
//!
//! N is a basis of the null space V with orthonormal columns. So P is the orthogonal projector on V and does not depend on the basis. Let
//! the joints be divided into disjoint sets. V is a direct sum of spaces on these sets exactly if P is block diagonal over them. (The
//! projector on a direct sum of such spaces is the sum of their projectors. Conversely, a block diagonal P splits V = P V.)
//!
//! So the finest sets are the connected components of the graph with an edge for each block P_ij ≠ 0. A rotation or scaling of the axes of a
//! joint's rows rotates or scales the blocks, and does not change the sets.

use super::linkage::Jacobian;
use mbs_core::cluster::root;
use mbs_linear::{Matrix, singular_values};

/// Largest entry of P that counts as zero [-]. Rounding errors are smaller if the singular values are above 1e-9.
pub(crate) const ZERO: f64 = 1e-7;

/// Group of joints with mutually dependent rows, and the dimension of its null space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Indices of the group's joints within the part.
    pub places: Vec<usize>,
    /// Dimension of the null space of the group: its number of redundant equations.
    pub redundant: usize,
}

/// Returns all groups of a null space. Cost: m² k operations for m rows and a null space of dimension k.
pub fn groups(jacobian: &Jacobian, null: &Matrix) -> Vec<Group> {
    let p = null.times(&null.transpose());
    let rows = &jacobian.rows;
    let n = rows.len();
    let touches = |i: usize, j: usize| {
        rows[i].clone().any(|r| rows[j].clone().any(|s| p[(r, s)].abs() > ZERO))
    };
    let mut parent: Vec<usize> = (0..n).collect();
    for i in 0..n {
        for j in i + 1..n {
            if touches(i, j) {
                let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    let mut found: Vec<(usize, Vec<usize>)> = Vec::new();
    for i in (0..n).filter(|&i| touches(i, i)) {
        let of = root(&mut parent, i);
        match found.iter_mut().find(|(root, _)| *root == of) {
            Some((_, places)) => places.push(i),
            None => found.push((of, vec![i])),
        }
    }
    let group = |(_, places): (usize, Vec<usize>)| {
        let trace: f64 = places.iter().flat_map(|&i| rows[i].clone()).map(|r| p[(r, r)]).sum();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let redundant = trace.round() as usize;
        Group { places, redundant }
    };
    found.into_iter().map(group).collect()
}

/// Returns the dimension of the column space of a matrix whose entries are of order one or zero.
pub(crate) fn dimension(matrix: &Matrix) -> usize {
    let sigma = singular_values(matrix).unwrap_or_default();
    sigma.iter().filter(|&&s| s > ZERO).count()
}
