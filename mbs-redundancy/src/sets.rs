//! Sets of dependent joints, and the components of each joint's reaction that are undetermined.

use super::decompose::{Group, ZERO, dimension, groups};
use super::link::Poses;
use super::linkage::{Jacobian, Linkage};
use super::parts::Part;
use super::perturb::{Nature, neighbours};
use super::rank::Rank;
use super::remedy::{Remedy, remedy};
use mbs_core::rigid::RigidMotion;
use mbs_linear::Matrix;

/// A joint of a dependent set.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Index of the joint.
    pub joint: usize,
    /// Numbers of undetermined directions of the joint's reaction: of forces, of moments about the joint's point, and of both together.
    pub open: [usize; 3],
    /// For each component of the joint's reaction in global axes, whether it is determined: [Fx, Fy, Mz] in a plane, otherwise all six.
    pub is_unique: Vec<bool>,
    /// True if the joint's guide is among the dependent equations.
    pub guide: bool,
}

/// Minimal set of joints whose equations depend on each other. If any joint of the set is removed, the equations of the others are
/// independent.
#[derive(Debug, Clone, PartialEq)]
pub struct Set {
    /// Joints of the set, in the order of the scene.
    pub members: Vec<Member>,
    /// Number of redundant equations, which follow from the others.
    pub redundant: usize,
    /// Positions in which the dependency holds: all, or only this one.
    pub nature: Nature,
    /// True if the equations depend on each other to machine precision. Otherwise they nearly depend, for example because of rounded
    /// numbers in the scene.
    pub is_exact: bool,
    /// Largest singular value that counts as zero, relative to the largest of all [-].
    pub sigma: f64,
    /// Changes that would remove the dependency; `None` if the search found none.
    pub remedy: Option<Remedy>,
}

/// Diagnosis of the joints of a scene at a position.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Number of equations of all joints, number of freedoms of all bodies without joints, and rank.
    pub sizes: [usize; 3],
    /// Smallest gap between nonzero singular values and those that count as zero [-].
    pub gap: f64,
    /// Smallest singular value that counts as nonzero, relative to the largest one of its part [-].
    pub least: f64,
    /// Dependent sets, in the order of their first joints.
    pub sets: Vec<Set>,
    /// First joint of each part that is too large for an analysis.
    pub too_large: Vec<usize>,
}

/// Largest number of entries of a matrix whose singular values are computed. For this size the computation takes some ten seconds.
const LARGEST: usize = 4_000_000;

/// Diagnoses the dependent sets of a mechanism at a position that satisfies its joints.
///
/// Cost: about 20 m n² operations for a part of m equations and n freedoms, and ten times as many if it has dependent sets.
#[must_use]
pub fn diagnose(linkage: &Linkage, at: &Poses) -> Diagnosis {
    let [rows, freedoms] = linkage.sizes();
    let mut all = Diagnosis {
        sizes: [rows, freedoms, rows],
        gap: f64::INFINITY,
        least: 1.0,
        sets: Vec::new(),
        too_large: Vec::new(),
    };
    for part in linkage.parts.iter().filter(|part| part.has_loop()) {
        let jacobian = linkage.jacobian(part, at);
        let size = jacobian.matrix.n_rows() * jacobian.matrix.n_columns();
        let rank = if size > LARGEST { None } else { Rank::of(&jacobian.matrix) };
        let Some(rank) = rank else {
            all.too_large.push(part.joints[0]);
            continue;
        };
        all.sizes[2] -= rank.redundant();
        all.gap = all.gap.min(rank.gap());
        all.least = all.least.min(rank.least());
        let found = Found { linkage, part, at, jacobian, rank };
        all.sets.extend(found.sets());
    }
    all.sets.sort_by_key(|set| (!set.is_exact, set.members[0].joint));
    all
}

/// A part of the mechanism with its rows and their rank.
struct Found<'a> {
    linkage: &'a Linkage,
    part: &'a Part,
    at: &'a Poses,
    jacobian: Jacobian,
    rank: Rank,
}

impl Found<'_> {
    fn sets(&self) -> Vec<Set> {
        let exact = groups(&self.jacobian, &self.rank.null);
        let almost = self.rank.almost_null().map(|null| (groups(&self.jacobian, &null), null));
        let near = if exact.is_empty() {
            Some(Vec::new())
        } else {
            neighbours(self.linkage, self.part, (self.at, &self.rank))
        };
        let is_new = |group: &&Group| !exact.contains(group);
        let sets =
            exact.iter().map(|group| self.set(group, &self.rank.null, true, near.as_deref()));
        let mut sets: Vec<Set> = sets.collect();
        if let Some((groups, null)) = &almost {
            let groups = groups.iter().filter(is_new);
            sets.extend(groups.map(|group| self.set(group, null, false, None)));
        }
        sets
    }

    fn set(
        &self,
        group: &Group,
        null: &Matrix,
        is_exact: bool,
        near: Option<&[Vec<RigidMotion<f64>>]>,
    ) -> Set {
        let nature = near.map_or(Nature::Untried, |near| self.nature(group, near));
        let member = |&place: &usize| self.member(place, null);
        let first = self.rank.sizes[0] - null.n_columns();
        let may_mend = matches!(nature, Nature::Structural | Nature::Rigid | Nature::Both);
        Set {
            members: group.places.iter().map(member).collect(),
            redundant: group.redundant,
            nature,
            is_exact,
            sigma: self.rank.sigma.get(first).map_or(0.0, |s| s / self.rank.sigma[0]),
            remedy: (may_mend || !is_exact)
                .then(|| remedy(self.linkage, (self.part, self.at), (&self.jacobian, null), group))
                .flatten(),
        }
    }

    /// Determines the nature of a group from the rank of its rows alone, at other positions.
    fn nature(&self, group: &Group, near: &[Vec<RigidMotion<f64>>]) -> Nature {
        if self.rank.free.n_columns() == 0 {
            return Nature::Rigid;
        }
        let redundant = |at: &Vec<RigidMotion<f64>>| {
            let jacobian = self.linkage.jacobian(self.part, at);
            let rows: Vec<usize> =
                group.places.iter().flat_map(|&i| jacobian.rows[i].clone()).collect();
            let n = jacobian.matrix.n_columns();
            let own = Matrix::from_fn(rows.len(), n, |i, j| jacobian.matrix[(rows[i], j)]);
            Rank::of(&own).map_or(group.redundant, |rank| rank.redundant())
        };
        match near.iter().map(redundant).min() {
            None => Nature::Untried,
            Some(0) => Nature::Singular,
            Some(left) if left < group.redundant => Nature::Both,
            Some(_) => Nature::Structural,
        }
    }

    /// Returns a joint with the undetermined part of its reaction. This part is the span of the joint's wrenches in the null space.
    fn member(&self, place: usize, null: &Matrix) -> Member {
        let Jacobian { rows, wrenches, .. } = &self.jacobian;
        let joint = self.part.joints[place];
        let link = &self.linkage.links[joint];
        let range = rows[place].clone();
        let k = null.n_columns();
        let mut span = Matrix::zeros(6, k);
        for row in range.clone() {
            let w = &wrenches[row];
            let entries = self.linkage.components(&w.force, &(w.moment / self.part.length));
            for (i, x) in entries.into_iter().enumerate() {
                for j in 0..k {
                    span[(i, j)] += x * null[(row, j)];
                }
            }
        }
        let n = self.linkage.freedoms();
        let n_forces = n / 3 + 1;
        let forces = Matrix::from_fn(n_forces, k, |i, j| span[(i, j)]);
        let moments = Matrix::from_fn(n - n_forces, k, |i, j| span[(n_forces + i, j)]);
        let is_zero = |i| (0..k).all(|j| span[(i, j)].abs() <= ZERO);
        let touches = |row| (0..k).any(|j| null[(row, j)].abs() > ZERO);
        Member {
            joint,
            open: [&forces, &moments, &span].map(dimension),
            is_unique: (0..n).map(is_zero).collect(),
            guide: range.rev().take(link.n_guided()).any(touches),
        }
    }
}
