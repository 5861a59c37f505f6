//! Rollings as constraint rows. Each rolling is a group over the rolling body and the body that it rolls on.

use super::build::Builder;
use super::group::Group;
use super::layout::{Columns, Layout};
use super::model::NaturalModel;
use super::row_builder::{GroupDraft, RollingDraft, RowDraft};
use crate::Real;
use crate::algebra::unit;
use crate::elements::{RollingFrame, RollingRows, Span};
use crate::measure::RollingInput;
use crate::model::{Owner, Terms};
use alloc::boxed::Box;

impl<T: Real> Builder<'_, T> {
    /// Adds the rows of the rollings.
    pub(super) fn add_rollings(&mut self) {
        let (scene, dimension) = (self.scene, self.scene.dimension);
        for (i, rolling) in scene.rollings.iter().enumerate() {
            let input = RollingInput::new(rolling, dimension);
            if self.clusters.of(input.bodies[0]) == self.clusters.of(input.bodies[1]) {
                continue;
            }
            let places = [input.center, input.base];
            let frames = [0, 1].map(|side| {
                let body = input.bodies[side];
                let axes = (0..dimension.count()).map(|k| self.direction(body, unit(k))).collect();
                (self.point(body, places[side].into()), axes)
            });
            let mut group = GroupDraft::new(Owner::Rolling(i));
            let n_rows = input.n_rows(dimension);
            group.rows.push(RowDraft::Rolling(Box::new(RollingDraft { input, n_rows, frames })));
            self.groups.push(group);
        }
    }
}

impl<T: Real, const D: usize> Layout<T, D> {
    pub(super) fn add_rolling(
        &mut self,
        draft: &RollingDraft<T>,
        (columns, group): (&Columns<'_>, &Group),
        (row, place): (u32, Span),
    ) {
        let frames = draft.frames.each_ref().map(|(point, axes)| {
            let mut all = [Span::default(); 3];
            for (to, axis) in all.iter_mut().zip(axes) {
                *to = self.span(axis, columns);
            }
            RollingFrame { point: self.span(point, columns), axes: all }
        });
        debug_assert_eq!(place.len(), draft.n_rows * group.width as usize);
        let [body, on] = frames;
        let RollingInput { radius, is_blade, axis, plane, .. } = draft.input;
        let n = super::group::index(draft.n_rows);
        self.model.rollings.push(RollingRows {
            radius,
            is_blade,
            body,
            on,
            axis,
            plane,
            row,
            n,
            place,
        });
        self.model.rolling_cliques.push(group.clique);
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Sets the gradients of the velocity rows to zero, for the assembly of positions, which these rows do not restrict.
    pub(crate) fn release_slips(&self, terms: &mut Terms<T>) {
        for rolling in &self.rollings {
            let rows = rolling.place.of_mut(&mut terms.jacobian);
            let width = rows.len() / (rolling.n as usize).max(1);
            let held = rolling.slip_rows().start - rolling.row as usize;
            rows[held * width..].fill(T::ZERO);
        }
    }

    /// Writes phi = `unit` J v for the velocity rows.
    pub(super) fn write_slips(&self, v: &[T], unit: T, terms: &mut Terms<T>) {
        for (rolling, clique) in self.rollings.iter().zip(&self.rolling_cliques) {
            let gradients = rolling.place.of(&terms.jacobian);
            let width = gradients.len() / (rolling.n as usize).max(1);
            for row in rolling.slip_rows() {
                let gradient = &gradients[(row - rolling.row as usize) * width..];
                let products = clique.of(&self.cliques).iter().zip(gradient);
                let rate = products.fold(T::ZERO, |sum, (&u, &g)| sum + g * v[u as usize]);
                terms.phi[row] = rate * unit;
            }
        }
    }

    /// First rolling whose disc is flat on its plane; `None` if there is none.
    pub(super) fn flat(&self, q: &[T]) -> Option<usize> {
        let flat = self.rollings.iter().find(|rolling| rolling.is_flat::<D>(&self.pool, q))?;
        match self.row_owner[flat.row as usize] {
            Owner::Rolling(rolling) => Some(rolling),
            _ => None,
        }
    }
}
