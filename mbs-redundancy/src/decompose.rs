//! A null space split into independent groups of joints.
//!
//! ```text
//! P = N Nᵀ,   P_ij: the block of joints i and j
//! ```
//!
//! N has orthonormal columns, so P is the orthogonal projector on the null space V and does not depend on the basis. V is a
//! direct sum of spaces on disjoint sets of joints exactly if P is block diagonal over these sets. Then the projector
//! on the sum is the sum of the projectors, and the other way round P V = V splits. So the finest such sets are the connected
//! components of the graph whose edges are the blocks P_ij ≠ 0. Turning or scaling the axes of a joint's rows turns its blocks.

use super::linkage::Jacobian;
use mbs_core::cluster::root;
use mbs_linear::{Matrix, singular_values};

/// Largest entry of P that is zero [-]: what rounding of σ > 1e-9 leaves.
pub(crate) const ZERO: f64 = 1e-7;

/// Group: places of its joints in the part, and the dimension of its null space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Places of its joints in the part.
    pub places: Vec<usize>,
    /// Dimension of its null space.
    pub redundant: usize,
}

/// All groups of a null space. Cost: m² k operations.
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

/// Dimension of the column space of a matrix whose entries are of order one or zero.
pub(crate) fn dimension(matrix: &Matrix) -> usize {
    let sigma = singular_values(matrix).unwrap_or_default();
    sigma.iter().filter(|&&s| s > ZERO).count()
}
