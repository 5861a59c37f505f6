//! Jacobians of points and of frames fixed in bodies.

use super::OwnFreedoms;
use super::moving::{MovingColumns, move_to};
use super::six::V3;
use crate::build::TreeModel;
use crate::host::{TreeState, Workspace};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::algebra::cross;
use mbs_core::scene::BodyId;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Writes the Jacobian of a body's point by rows, in global axes. The point was at `at` in the reference configuration. The first three
    /// rows give the velocity of the point. If there are six rows, the last three give the body's angular velocity.
    ///
    /// Cost: proportional to the number of links on the path to the ground; no allocation.
    ///
    /// # Panics
    /// If `rows` has neither three nor six rows.
    pub fn write_jacobian(
        &mut self,
        model: &TreeModel<T, S>,
        (state, body, at): (&TreeState<T>, BodyId, [T; 3]),
        workspace: &mut Workspace<T, S>,
        rows: &mut [T],
    ) {
        let n = self.columns.len();
        assert!(rows.len() == 3 * n || rows.len() == 6 * n, "rows of the Jacobian");
        let (link, point) = model.seat_point(body, at);
        self.place_way(model, (state, link as usize), workspace);
        let placed = workspace.store().placed;
        rows.fill(T::ZERO);
        let mut arm = S::point_into(&S::rotate(&placed[link as usize].rotation, &point));
        for &i in self.way.iter().rev() {
            for c in self.links[i].columns.clone() {
                let column = self.columns[c].here.at(&arm);
                put(rows, (n, self.columns[c].number as usize), [column.push, column.turn]);
            }
            arm += S::point_into(&placed[i].arm);
        }
    }

    /// Writes the rate of [`write_jacobian`](Self::write_jacobian) at the state's velocities. The rate times the velocities is the
    /// acceleration of the point at constant velocities.
    ///
    /// Cost: two outward passes; no allocation.
    ///
    /// # Panics
    /// If `rows` has neither three nor six rows.
    pub fn write_jacobian_rate(
        &mut self,
        model: &TreeModel<T, S>,
        (state, body, at): (&TreeState<T>, BodyId, [T; 3]),
        (workspace, moving): (&mut Workspace<T, S>, &mut MovingColumns<T>),
        rows: &mut [T],
    ) {
        let n = self.columns.len();
        assert!(rows.len() == 3 * n || rows.len() == 6 * n, "rows of the Jacobian");
        move_to(model, state, workspace);
        let store = workspace.store();
        self.write_moving(&model.mechanism(), (store.placed, store.a), moving);
        let placed = store.placed;
        rows.fill(T::ZERO);
        let (link, point) = model.seat_point(body, at);
        let mut i = link as usize;
        let p = &placed[i];
        let x = S::point_into(&(p.position + S::rotate(&p.rotation, &point))) - moving.origin;
        let velocity = moving.motions[i].v.at(&x).push;
        while i > 0 {
            for c in self.links[i].columns.clone() {
                let there = &moving.columns[c];
                // rate d/dt (S_v + S_ω × x) of the column
                let rate = there.rate.at(&x);
                let push = rate.push + cross(&there.column.turn, &velocity);
                put(rows, (n, self.columns[c].number as usize), [push, rate.turn]);
            }
            i = self.links[i].parent;
        }
    }

    /// Writes the Jacobian of the velocity of the centre of mass by rows. `total` is the mass of all bodies.
    ///
    /// Cost: an outward pass without velocities, and an inward one; no allocation.
    ///
    /// # Panics
    /// If `rows` does not have three rows.
    pub fn write_center_jacobian(
        &mut self,
        model: &TreeModel<T, S>,
        (state, total): (&TreeState<T>, T),
        workspace: &mut Workspace<T, S>,
        rows: &mut [T],
    ) {
        let n = self.columns.len();
        assert_eq!(rows.len(), 3 * n, "rows of the Jacobian");
        self.place(model, state, workspace);
        let (links, placed) = (model.mechanism().links, workspace.store().placed);
        rows.fill(T::ZERO);
        for ((to, link), p) in self.composite.iter_mut().zip(links).zip(&*placed) {
            (to.mass, to.first) = (link.mass, S::point_into(&p.center) * link.mass);
        }
        let part = if total > T::ZERO { T::ONE / total } else { T::ZERO };
        for i in (1..links.len()).rev() {
            let (mass, first) = (self.composite[i].mass, self.composite[i].first);
            for c in self.links[i].columns.clone() {
                let column = &self.columns[c].here;
                let moved = (column.push * mass + cross(&column.turn, &first)) * part;
                put(rows, (n, self.columns[c].number as usize), [moved, V3::zeros()]);
            }
            let parent = &mut self.composite[self.links[i].parent];
            parent.mass += mass;
            parent.first += first + S::point_into(&placed[i].arm) * mass;
        }
    }
}

/// Writes one column of a matrix with three or six rows.
#[inline(always)]
pub(super) fn put<T: Real>(rows: &mut [T], (n, number): (usize, usize), column: [V3<T>; 2]) {
    assert!(number < n, "numbers of the columns");
    for (rows, half) in rows.chunks_exact_mut(3 * n).zip(&column) {
        (rows[number], rows[n + number], rows[2 * n + number]) = (half[0], half[1], half[2]);
    }
}
