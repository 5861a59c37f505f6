//! Derivatives of inverse dynamics: derivatives of efforts by positions, velocities and accelerations.
//!
//! ```text
//! for columns j on the way from i to the ground, with the sums of the subtree of i        [Singh, Russo, Wensing 2022 (15)-(18)]
//! ∂τᵢ/∂qⱼ = Sᵢᵀ (2 B Ψ̇ⱼ + I Ψ̈ⱼ)            ∂τᵢ/∂vⱼ = Sᵢᵀ (2 B Sⱼ + I (Ψ̇ⱼ + Ṡⱼ))
//! ∂τⱼ/∂qᵢ = Sⱼᵀ (2 B Ψ̇ᵢ + I Ψ̈ᵢ + Sᵢ ×* f)   ∂τⱼ/∂vᵢ = Sⱼᵀ (2 B Sᵢ + I (Ψ̇ᵢ + Ṡᵢ))        Mⱼᵢ = Sⱼᵀ I Sᵢ
//! ```
//!
//! τ are the efforts and S the columns of the freedoms. I, B and f are sums over a subtree (`sums`). Ṡ, Ψ̇ and Ψ̈ are rates of columns
//! (`moving`).
//!
//! ∂/∂q is the derivative along velocities: ∂/∂qᵢ is the change while freedom i moves at unit rate. The source treats ball joints with axes
//! fixed in the child: no column of the ball joint rotates the force. If the axes are fixed in the parent, every column of the ball joint
//! rotates the force.

use super::columns::{ColumnPart, NONE, PartKind};
use super::moving::{MovingColumns, move_to};
use super::{OwnFreedoms, six::Six};
use crate::build::TreeModel;
use crate::host::{TreeState, Workspace};
use crate::space::Space;
use mbs_core::Real;

/// Matrices to which the derivatives of efforts are written. Each is a square matrix over the freedoms, stored by rows, with one row for
/// each effort.
#[derive(Debug)]
pub struct EffortSlopes<'a, T> {
    /// Derivatives of the efforts by positions, in the directions of the freedoms' velocities.
    pub q: &'a mut [T],
    /// Derivatives of the efforts by velocities.
    pub v: &'a mut [T],
    /// Derivatives of the efforts by accelerations: the mass matrix.
    pub a: &'a mut [T],
}

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Writes the derivatives of the efforts that cause the state's accelerations, under gravity and without effects, with open loops.
    ///
    /// Cost: an outward pass, and about 40 multiplications for each pair of freedoms on a common path to the ground; no allocation.
    ///
    /// # Panics
    /// If the length of a matrix in `slopes` is not the square of the number of freedoms.
    pub fn write_effort_slopes(
        &mut self,
        model: &TreeModel<T, S>,
        state: &TreeState<T>,
        (workspace, moving): (&mut Workspace<T, S>, &mut MovingColumns<T>),
        slopes: &mut EffortSlopes<'_, T>,
    ) {
        move_to(model, state, workspace);
        self.write_effort_slopes_here(model, (workspace, moving), slopes);
    }

    /// Writes the derivatives of the efforts for the places and accelerations that [`accelerate_under`](TreeModel::accelerate_under) left
    /// in the scratch.
    ///
    /// # Panics
    /// If the length of a matrix in `slopes` is not the square of the number of freedoms.
    pub fn write_effort_slopes_here(
        &mut self,
        model: &TreeModel<T, S>,
        (workspace, moving): (&mut Workspace<T, S>, &mut MovingColumns<T>),
        slopes: &mut EffortSlopes<'_, T>,
    ) {
        let n = self.columns.len();
        for square in [&mut *slopes.q, slopes.v, slopes.a] {
            assert_eq!(square.len(), n * n, "numbers of a square of freedoms");
            square.fill(T::ZERO);
        }
        let (m, s) = (model.mechanism(), workspace.store());
        self.write_moving(&m, (s.placed, s.a), moving);
        for i in (1..m.links.len()).rev() {
            let (before, behind) = moving.sums.split_at_mut(i);
            before[self.links[i].parent] += behind[0];
        }
        for part in &self.parts {
            for c in part.columns.clone() {
                self.write_slopes((part, c), moving, slopes);
            }
        }
        self.add_weight_slopes(model, s.placed, moving, slopes.q);
        for rotor in m.rotors {
            for c in self.links[rotor.link as usize].columns.clone() {
                slopes.a[self.columns[c].number as usize * (n + 1)] += rotor.inertia;
            }
        }
    }

    /// Writes the entries between column `c` and the columns on its path to the ground.
    #[inline(always)]
    fn write_slopes(
        &self,
        (part, c): (&ColumnPart<T>, usize),
        moving: &MovingColumns<T>,
        slopes: &mut EffortSlopes<'_, T>,
    ) {
        let (sums, here) = (&moving.sums[part.link], &moving.columns[c]);
        let s = here.column;
        let momentum = sums.moments.times(&s);
        let back = sums.streams_back(&s);
        let by_v = sums.streams(&s) + sums.moments.times(&here.both);
        let by_q = sums.streams(&here.first) + sums.moments.times(&here.second);
        let carried = by_q + s.carries_force(&sums.force);
        let n = self.columns.len();
        let own = self.columns[c].number as usize;
        let mut put = |j: usize, by_q: &Six<T>, more: T| {
            let (there, other) = (&moving.columns[j], self.columns[j].number as usize);
            let (up, down) = (other * n + own, own * n + other);
            let x = there.column.dot(&momentum);
            (slopes.a[up], slopes.a[down]) = (x, x);
            slopes.v[down] = super::six::dot(&back, &there.column.turn) + momentum.dot(&there.both);
            slopes.v[up] = there.column.dot(&by_v);
            slopes.q[down] =
                super::six::dot(&back, &there.first.turn) + momentum.dot(&there.second) + more;
            slopes.q[up] = there.column.dot(by_q);
        };
        // the force rotates with the axes if they are fixed in the parent
        let is_carried = part.kind == PartKind::ParentBall;
        for j in part.columns.start..=c {
            if is_carried {
                let along = moving.columns[j].column.carries_force(&sums.force);
                put(j, &carried, s.dot(&along));
            } else {
                put(j, &by_q, T::ZERO);
            }
        }
        let mut j = self.columns[part.columns.start].up;
        while j != NONE {
            put(j as usize, &carried, T::ZERO);
            j = self.columns[j as usize].up;
        }
    }
}
