//! Jacobian rows of closed loops and couplings, over the columns.

use super::OwnFreedoms;
use super::columns::six;
use crate::build::TreeModel;
use crate::build::own_tables::own;
use crate::host::{TreeState, Workspace};
use crate::link::LinkMotion;
use crate::link::indexing::{Outside, at, part_mut};
use crate::passes::evaluate::evaluate_rows;
use crate::passes::slices::Store;
use crate::space::Space;
use mbs_core::Real;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Writes the Jacobian of the equations of cut joints and couplings, by rows over the freedoms.
    ///
    /// Cost: for each row proportional to the number of links on the paths to the ground; no allocation.
    ///
    /// # Panics
    /// If the length of `rows` is not the number of equations times the number of freedoms.
    pub fn write_loop_rows(
        &mut self,
        model: &TreeModel<T, S>,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
        rows: &mut [T],
    ) {
        let n = self.columns.len();
        assert_eq!(rows.len(), model.n_rows() * n, "numbers of the rows");
        let (m, mut s) = (model.mechanism(), workspace.store());
        model.place_in(state, &mut s);
        self.write_columns(&m, s.placed);
        rows.fill(T::ZERO);
        for lap in m.loops.cut() {
            own(lap.evaluate(m.loops.rows, s.placed, |k, value| {
                let row = part_mut(rows, k * n, n)?;
                for (&link, gradient) in lap.links.iter().zip(&value.gradient) {
                    self.add_along((link as usize, gradient), s.placed, row);
                }
                Ok(())
            }));
        }
        own(self.write_coupled_rows(model, &mut s, rows));
    }

    fn write_coupled_rows(
        &self,
        model: &TreeModel<T, S>,
        s: &mut Store<'_, T, S>,
        rows: &mut [T],
    ) -> Result<(), Outside> {
        let (m, n) = (model.mechanism(), self.columns.len());
        evaluate_rows(&m, s)?;
        for (row, k, n_rows) in m.loops.coupled() {
            let out = part_mut(rows, k * n, n)?;
            for start in m.loops.couplings.starts_of(row)? {
                let gradient = at(s.gradient, start.side as usize * n_rows + k)?;
                self.add_along((start.link as usize, gradient), s.placed, out);
            }
            for (link, _, slope) in m.loops.couplings.joints_of(row, s.loops.slopes)? {
                // a guided joint has no column
                for c in self.links[link as usize].columns.clone() {
                    out[self.columns[c].number as usize] += slope;
                }
            }
        }
        Ok(())
    }

    /// Adds the products of a force on a link, about the link's origin, with the columns on the path to the ground.
    fn add_along(
        &self,
        (mut i, force): (usize, &S::Motion),
        placed: &[LinkMotion<T, S>],
        row: &mut [T],
    ) {
        let mut force = six::<T, S>(force);
        while i > 0 {
            for c in self.links[i].columns.clone() {
                row[self.columns[c].number as usize] += self.columns[c].here.dot(&force);
            }
            force = force.gathered(&S::point_into(&placed[i].arm));
            i = self.links[i].parent;
        }
    }
}
