//! Derivatives of the efforts against gravity by positions, for bodies that have a factor of gravity.
//!
//! ```text
//! F = m g (s − 1) is what a body at rest of the mass W = m (s − 1) adds where the ground is accelerated by −g:
//! ∂τᵢ/∂qⱼ += Sᵢᵀ W Ψⱼ,   ∂τⱼ/∂qᵢ += Sⱼᵀ (W Ψᵢ + Sᵢ ×* f)        Ψ = (0, −g) × S,   f = W (0, −g)
//! ```

use super::OwnFreedoms;
use super::columns::{ColumnPart, NONE, PartKind};
use super::moving::MovingColumns;
use super::six::Moments;
use crate::build::TreeModel;
use crate::link::LinkMotion;
use crate::loads::Load;
use crate::space::{Numbers, Space};
use mbs_core::Real;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Adds the derivatives due to factors of gravity to the derivatives of the efforts. If no body has such a factor, nothing is added.
    pub(super) fn add_weight_slopes(
        &self,
        model: &TreeModel<T, S>,
        placed: &[LinkMotion<T, S>],
        moving: &mut MovingColumns<T>,
        slopes: &mut [T],
    ) {
        if model.weights().is_empty() {
            return;
        }
        moving.weights.fill(Moments::zero());
        let gravity = model.gravity;
        for load in model.weights() {
            let Load::Constant { link, point, force } = load else { continue };
            let (link, mass) = (*link as usize, force.dot(&gravity) / gravity.dot(&gravity));
            let p = &placed[link];
            let place = p.position + S::rotate(&p.rotation, point);
            let first = (S::point_into(&place) - moving.origin) * mass;
            moving.weights[link] += Moments { mass, first, ..Moments::zero() };
        }
        for i in (1..moving.weights.len()).rev() {
            let (before, behind) = moving.weights.split_at_mut(i);
            before[self.links[i].parent] += behind[0];
        }
        for part in &self.parts {
            for c in part.columns.clone() {
                self.add_weight_slope((part, c), moving, slopes);
            }
        }
    }

    /// Adds the entries between column `c` and the columns on its path to the ground.
    fn add_weight_slope(
        &self,
        (part, c): (&ColumnPart<T>, usize),
        moving: &MovingColumns<T>,
        slopes: &mut [T],
    ) {
        let (weights, ground) = (&moving.weights[part.link], &moving.motions[0].a);
        let s = moving.columns[c].column;
        let (momentum, force) = (weights.times(&s), weights.times(ground));
        let still = weights.times(&ground.carries(&s));
        let carried = still + s.carries_force(&force);
        let (n, own) = (self.columns.len(), self.columns[c].number as usize);
        let mut put = |j: usize, by_q, more| {
            let (there, other) = (&moving.columns[j].column, self.columns[j].number as usize);
            slopes[other * n + own] += there.dot(by_q);
            if other != own {
                slopes[own * n + other] += momentum.dot(&ground.carries(there)) + more;
            }
        };
        for j in part.columns.start..=c {
            if part.kind == PartKind::ParentBall {
                let along = moving.columns[j].column.carries_force(&force);
                put(j, &carried, s.dot(&along));
            } else {
                put(j, &still, T::ZERO);
            }
        }
        let mut j = self.columns[part.columns.start].up;
        while j != NONE {
            put(j as usize, &carried, T::ZERO);
            j = self.columns[j as usize].up;
        }
    }
}
