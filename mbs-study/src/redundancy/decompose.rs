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

/// A group: places of its joints in the part, and the dimension of its null space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Group {
    pub(crate) places: Vec<usize>,
    pub(crate) redundant: usize,
}

/// All groups of a null space. Cost: m² k operations.
pub(crate) fn groups(jacobian: &Jacobian, null: &Matrix) -> Vec<Group> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use mbs_core::outputs::Wrench;

    #[test]
    fn groups_of_a_null_space_do_not_depend_on_its_basis() {
        // joints of two rows each; (1, 0, 1, 0, ...) on joints 0 and 1, (0, 0, 0, 0, 1, -2, 0, 1) on 2 and 3, 4 free
        let zero =
            Wrench { force: super::super::Vector::zeros(), moment: super::super::Vector::zeros() };
        let rows = (0..5).map(|i| 2 * i..2 * i + 2).collect();
        let jacobian = Jacobian { matrix: Matrix::zeros(0, 0), rows, wrenches: vec![zero; 10] };
        let (a, b) = (0.5_f64.sqrt(), (1.0_f64 / 6.0).sqrt());
        let mut n = Matrix::zeros(10, 2);
        (n[(0, 0)], n[(2, 0)]) = (a, a);
        (n[(4, 1)], n[(5, 1)], n[(7, 1)]) = (b, -2.0 * b, b);
        let (c, s) = (0.6, 0.8);
        let turn = Matrix::from_fn(2, 2, |i, j| [[c, -s], [s, c]][i][j]);
        let expected = [vec![0, 1], vec![2, 3]].map(|places| Group { places, redundant: 1 });
        assert_eq!(groups(&jacobian, &n), expected);
        assert_eq!(groups(&jacobian, &n.times(&turn)), expected);
    }
}
