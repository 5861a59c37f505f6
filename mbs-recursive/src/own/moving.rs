//! Columns with their rates, about a common point.
//!
//! ```text
//! Ṡ = w × S        w: the motion of the body in which the column is fixed
//! Ψ̇ = u × S,   Ψ̈ = u̇ × S + u × Ψ̇        u: the motion of the body that is at rest while the freedom moves
//! ```
//!
//! For a column fixed in the child, w is the motion after the joint and u the motion before it. For a column fixed in the parent, w and u
//! are exchanged.

use super::OwnFreedoms;
use super::columns::{ColumnPart, PartKind, six};
use super::mass::moments;
use super::six::{Moments, Six, V3};
use super::sums::Sums;
use crate::build::TreeModel;
use crate::build::own_tables::own;
use crate::host::{TreeState, Workspace};
use crate::link::LinkMotion;
use crate::passes::slices::TreeSlices;
use crate::passes::{inverse, kinematics};
use crate::space::{Numbers, Space};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::algebra::cross;

/// A column S with its rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moving<T: Real> {
    /// Column S of the freedom.
    pub(super) column: Six<T>,
    /// Rate Ṡ of the column by the motion of the body in which it is fixed.
    pub(super) rate: Six<T>,
    /// Rate Ψ̇ of the column by the motion u of the body that is at rest while the freedom moves.
    pub(super) first: Six<T>,
    /// Second rate Ψ̈ of the column by the motion u.
    pub(super) second: Six<T>,
    /// Sum Ṡ + Ψ̇ of both rates.
    pub(super) both: Six<T>,
}

/// Velocity and acceleration about the common point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion<T: Real> {
    pub(super) v: Six<T>,
    pub(super) a: Six<T>,
}

/// Scratch for the derivatives of one tree.
#[derive(Debug, Clone)]
pub struct MovingColumns<T: Real> {
    pub(super) motions: Vec<Motion<T>>,
    pub(super) columns: Vec<Moving<T>>,
    pub(super) sums: Vec<Sums<T>>,
    /// Masses m (s − 1) of the subtrees about the common point, for bodies whose gravity has a factor s.
    pub(super) weights: Vec<Moments<T>>,
    /// Common point, from the tree's base [m].
    pub(super) origin: V3<T>,
}

impl<T: Real> MovingColumns<T> {
    /// Makes the scratch for a tree.
    #[must_use]
    pub fn new<S: Space<T>>(model: &TreeModel<T, S>) -> Self {
        let zero = Six::zero();
        let column = Moving { column: zero, rate: zero, first: zero, second: zero, both: zero };
        Self {
            motions: vec![Motion { v: zero, a: zero }; model.n_links() + 1],
            columns: vec![column; model.n_freedoms()],
            sums: vec![Sums::zero(); model.n_links() + 1],
            weights: vec![Moments::zero(); model.n_links() + 1],
            origin: V3::zeros(),
        }
    }
}

/// Computes the places, velocities and accelerations of the links at a state.
pub(super) fn move_to<T: Real, S: Space<T>>(
    model: &TreeModel<T, S>,
    state: &TreeState<T>,
    workspace: &mut Workspace<T, S>,
) {
    let (m, s) = (model.mechanism(), workspace.store());
    model.prescribed().write(state.t, &state.applied, s.guides, s.courses);
    own(kinematics(m.links, (&state.z, &state.v, s.guides), s.placed));
    s.a[0] = S::motion(S::Spin::zero(), -m.gravity);
    own(inverse::spread(m.links, s.placed, &state.a, s.a));
}

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Writes motions, columns and the sums of single links, for the current places of the links and their accelerations `a`.
    ///
    /// The common point is the first link's origin, so that rounding errors do not grow with the distance of the mechanism from the
    /// ground's origin.
    pub(super) fn write_moving(
        &mut self,
        m: &TreeSlices<'_, T, S>,
        (placed, a): (&[LinkMotion<T, S>], &[S::Motion]),
        to: &mut MovingColumns<T>,
    ) {
        to.origin = placed.get(1).map_or_else(V3::zeros, |p| S::point_into(&p.position));
        self.write_columns(m, placed);
        to.motions[0] = Motion { v: Six::zero(), a: six::<T, S>(&a[0]) };
        for (i, p) in placed.iter().enumerate().skip(1) {
            let r = S::point_into(&p.position) - to.origin;
            let (v, a) = (six::<T, S>(&p.velocity), six::<T, S>(&a[i]));
            let turning = cross(&v.turn, &v.push);
            let a = Six { turn: a.turn, push: a.push - turning }.at(&-r);
            let motion = Motion { v: v.at(&-r), a };
            let own = moments(&m.links[i], p, &self.links[i].tensor).gathered(&r);
            to.sums[i] = Sums::body(own, &motion.v, &motion.a);
            to.motions[i] = motion;
        }
        for part in &self.parts {
            let p = &placed[part.link];
            let r = S::point_into(&p.position) - to.origin;
            let [before, behind] = self.around(part, p, to);
            let (carrier, still) = match part.kind {
                PartKind::ParentBall | PartKind::ParentSlides => (before, behind),
                PartKind::Single | PartKind::ChildBall | PartKind::ChildSlides => (behind, before),
            };
            for c in part.columns.clone() {
                let column = self.columns[c].here.at(&-r);
                let rate = carrier.v.carries(&column);
                let first = still.v.carries(&column);
                let second = still.a.carries(&column) + still.v.carries(&first);
                to.columns[c] = Moving { column, rate, first, second, both: rate + first };
            }
        }
    }

    /// Returns the motions of the bodies before and after a part of a joint. A free joint has two parts, with a fictitious body between
    /// them.
    fn around(
        &self,
        part: &ColumnPart<T>,
        p: &LinkMotion<T, S>,
        to: &MovingColumns<T>,
    ) -> [Motion<T>; 2] {
        let [before, behind] = [to.motions[self.links[part.link].parent], to.motions[part.link]];
        match (part.is_free, part.kind) {
            (true, PartKind::ParentSlides | PartKind::ChildBall) => {
                // translation with the body's point, without rotation
                let arm = S::rotate(&p.rotation, &S::point_from(&part.reference));
                let x = S::point_into(&(p.position + arm)) - to.origin;
                let (v, a) = (behind.v.at(&x).push, behind.a.at(&x).push);
                let a = a + cross(&behind.v.turn, &v);
                let slide = |push| Six { turn: V3::zeros(), push };
                let between = Motion { v: slide(v), a: slide(a) };
                let is_last = part.kind == PartKind::ChildBall;
                if is_last { [between, behind] } else { [before, between] }
            }
            (true, PartKind::ParentBall | PartKind::ChildSlides) => {
                // rotation of the body about the ground's point
                let x = part.point - to.origin;
                let turn = |six: &Six<T>| Six { turn: six.turn, push: cross(&x, &six.turn) };
                let between = Motion { v: turn(&behind.v), a: turn(&behind.a) + before.a };
                let is_last = part.kind == PartKind::ChildSlides;
                if is_last { [between, behind] } else { [before, between] }
            }
            _ => [before, behind],
        }
    }
}
