//! Division of a model into parts that can be evaluated in parallel. A part has neighbouring groups and their ranges in every
//! table.
//!
//! ```text
//! tables follow the order of the groups, so a cut between two groups cuts each table and each store once:
//! [ groups | rows | Jacobian | forces | measures ]  =  [ those of part 1 ] [ those of part 2 ] ...
//! ```
//!
//! The cuts depend on the number of groups alone, not on the team.

use super::group::Group;
use super::model::{Cursor, NaturalModel};
use crate::Real;
use crate::elements::{Coupled, Distance, Dot, Guided, Linear, RollingRows, Span};
use crate::laws::scalar::ScalarForce;
use crate::team::Team;
use alloc::vec::Vec;
use core::ops::Range;

/// Number of groups in a part [-]. One thread evaluates a part, which takes about ten microseconds.
const GROUPS: usize = 64;

/// Part of a model: neighbouring groups, from one cursor to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    pub(super) from: Cursor,
    to: Cursor,
}

/// Ranges of the stores that the evaluation of a part writes. Ranges that an evaluation does not write are empty.
#[derive(Debug)]
pub(super) struct Out<'a, T> {
    /// One number for each row.
    pub(super) rows: &'a mut [T],
    pub(super) jacobian: &'a mut [T],
    pub(super) force: &'a mut [T],
    pub(super) measures: &'a mut [ScalarForce<T>],
    pub(super) body_measures: &'a mut [ScalarForce<T>],
}

impl<T> Default for Out<'_, T> {
    fn default() -> Self {
        Self {
            rows: &mut [],
            jacobian: &mut [],
            force: &mut [],
            measures: &mut [],
            body_measures: &mut [],
        }
    }
}

impl Part {
    pub(super) fn groups<'a>(&self, all: &'a [Group]) -> &'a [Group] {
        &all[self.from.group..self.to.group]
    }
    pub(super) fn rows(&self) -> Range<usize> {
        self.from.row..self.to.row
    }
    pub(super) fn distances<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.distance..self.to.distance]
    }
    pub(super) fn dots<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.dot..self.to.dot]
    }
    pub(super) fn linears<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.linear..self.to.linear]
    }
    pub(super) fn guided<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.guided..self.to.guided]
    }
    pub(super) fn coupled<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.coupled..self.to.coupled]
    }
    pub(super) fn rollings<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.rolling..self.to.rolling]
    }
    pub(super) fn measures<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.measure..self.to.measure]
    }
    pub(super) fn body_elements<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.body_element..self.to.body_element]
    }
    pub(super) fn point_forces<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.point_force..self.to.point_force]
    }
    pub(super) fn torques<'a, T>(&self, all: &'a [T]) -> &'a [T] {
        &all[self.from.torque..self.to.torque]
    }

    /// Converts a span of the Jacobian store to the range of the part.
    #[inline(always)]
    pub(super) fn place(&self, span: Span) -> Span {
        shifted(span, self.from.jacobian)
    }
    /// Converts a span of the force store to the range of the part.
    #[inline(always)]
    pub(super) fn force(&self, span: Span) -> Span {
        shifted(span, self.from.force)
    }
    /// Converts a span of the measures of body laws to the range of the part.
    #[inline(always)]
    pub(super) fn body_measures(&self, span: Span) -> Span {
        shifted(span, self.from.body_measure)
    }
    /// Converts the places of a distance row to the ranges of the part.
    #[inline(always)]
    pub(super) fn distance<T: Real>(&self, row: &Distance<T>) -> Distance<T> {
        let places = row.places.map(|at| at - narrow(self.from.jacobian));
        Distance { places, row: row.row - narrow(self.from.row), ..*row }
    }
    /// Converts the places of a dot-product row to the ranges of the part.
    #[inline(always)]
    pub(super) fn dot<T: Real>(&self, row: &Dot<T>) -> Dot<T> {
        Dot { place: self.place(row.place), row: row.row - narrow(self.from.row), ..*row }
    }
    /// Converts the places of linear rows to the ranges of the part.
    #[inline(always)]
    pub(super) fn linear(&self, row: &Linear) -> Linear {
        Linear { place: self.place(row.place), row: row.row - narrow(self.from.row), ..*row }
    }
    /// Converts the places of a coupling row to the ranges of the part.
    #[inline(always)]
    pub(super) fn coupling<T: Real>(&self, row: &Coupled<T>) -> Coupled<T> {
        Coupled { place: self.place(row.place), row: row.row - narrow(self.from.row), ..*row }
    }
    /// Converts the places of rolling rows to the ranges of the part.
    #[inline(always)]
    pub(super) fn rolling<T: Real>(&self, row: &RollingRows<T>) -> RollingRows<T> {
        RollingRows { place: self.place(row.place), row: row.row - narrow(self.from.row), ..*row }
    }
    /// Converts the places of a guided row to the ranges of the part.
    #[inline(always)]
    pub(super) fn guide(&self, row: &Guided) -> Guided {
        Guided { place: self.place(row.place), row: row.row - narrow(self.from.row), ..*row }
    }
}

#[inline(always)]
fn shifted(span: Span, by: usize) -> Span {
    Span { start: span.start - narrow(by), end: span.end - narrow(by) }
}

#[inline(always)]
fn narrow(i: usize) -> u32 {
    super::group::index(i)
}

impl<'a, T> Out<'a, T> {
    /// Splits the ranges at the cursor `at`; they begin at the cursor `first`.
    fn split(self, first: &Cursor, at: &Cursor) -> (Self, Self) {
        let (rows, rows_after) = cut(self.rows, at.row - first.row);
        let (jacobian, jacobian_after) = cut(self.jacobian, at.jacobian - first.jacobian);
        let (force, force_after) = cut(self.force, at.force - first.force);
        let (measures, measures_after) = cut(self.measures, at.measure - first.measure);
        let (body, body_after) = cut(self.body_measures, at.body_measure - first.body_measure);
        (
            Self { rows, jacobian, force, measures, body_measures: body },
            Self {
                rows: rows_after,
                jacobian: jacobian_after,
                force: force_after,
                measures: measures_after,
                body_measures: body_after,
            },
        )
    }
}

fn cut<T>(x: &mut [T], at: usize) -> (&mut [T], &mut [T]) {
    x.split_at_mut(at.min(x.len()))
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Cursors between the parts, computed when all tables are filled.
    pub(super) fn cursors(&self) -> Vec<Cursor> {
        let mut cursors = Vec::with_capacity(self.groups.len() / GROUPS + 2);
        let mut force = 0;
        for (g, group) in self.groups.iter().enumerate() {
            if g % GROUPS == 0 {
                cursors.push(self.cursor(g, group, force));
            }
            force = force.max(group.force.end as usize);
        }
        cursors.push(Cursor {
            group: self.groups.len(),
            row: self.n_rows,
            jacobian: self.n_jacobian,
            force,
            distance: self.distances.len(),
            dot: self.dots.len(),
            linear: self.linears.len(),
            guided: self.guided.len(),
            coupled: self.coupled.len(),
            rolling: self.rollings.len(),
            measure: self.measures.len(),
            body_element: self.body_elements.len(),
            body_measure: self.n_measures,
            point_force: self.point_forces.len(),
            torque: self.torques.len(),
        });
        cursors
    }

    fn cursor(&self, g: usize, group: &Group, force: usize) -> Cursor {
        let (row, jacobian) = (group.rows.start, group.jacobian);
        let body_element = self.body_elements.partition_point(|e| e.place.start < jacobian);
        let body_measure = self.body_elements[..body_element]
            .last()
            .map_or(self.measures.len(), |element| element.measures.end as usize);
        Cursor {
            group: g,
            row: row as usize,
            jacobian: jacobian as usize,
            force,
            distance: group.distances.start as usize,
            dot: group.dots.start as usize,
            linear: self.linears.partition_point(|r| r.row < row),
            guided: self.guided.partition_point(|r| r.row < row),
            coupled: self.coupled.partition_point(|r| r.row < row),
            rolling: self.rollings.partition_point(|r| r.row < row),
            measure: self.measures.partition_point(|m| m.place.start < jacobian),
            body_element,
            body_measure,
            point_force: self.point_forces.partition_point(|f| (f.force.start as usize) < force),
            torque: self.torques.partition_point(|t| (t.force.start as usize) < force),
        }
    }

    /// Calls `work` on each part of the model with the ranges that it writes. A team of one thread gets the model as a single part.
    #[inline(always)]
    pub(super) fn on_parts<W: Team>(
        &self,
        team: &W,
        out: Out<'_, T>,
        work: impl Fn(&Part, Out<'_, T>) + Sync,
    ) {
        if let ([from, .., to], 1) = (&self.cursors[..], team.size()) {
            work(&Part { from: *from, to: *to }, out);
        } else {
            on_cursors(team, &self.cursors, out, &work);
        }
    }

    /// Sum of `part` over the parts, added in pairs in a fixed order: bitwise equal for every team.
    pub(super) fn sum_of_parts<W: Team>(&self, team: &W, part: impl Fn(&Part) -> T + Sync) -> T {
        sum_of_cursors(team, &self.cursors, &part)
    }
}

fn on_cursors<W: Team, T: Real>(
    team: &W,
    cursors: &[Cursor],
    out: Out<'_, T>,
    work: &(impl Fn(&Part, Out<'_, T>) + Sync),
) {
    match cursors {
        [from, to] => work(&Part { from: *from, to: *to }, out),
        [from, .., _] => {
            let half = cursors.len() / 2;
            let (left, right) = out.split(from, &cursors[half]);
            team.join(
                || on_cursors(team, &cursors[..=half], left, work),
                || on_cursors(team, &cursors[half..], right, work),
            );
        }
        _ => {}
    }
}

fn sum_of_cursors<W: Team, T: Real>(
    team: &W,
    cursors: &[Cursor],
    part: &(impl Fn(&Part) -> T + Sync),
) -> T {
    match cursors {
        [from, to] => part(&Part { from: *from, to: *to }),
        [_, .., _] => {
            let half = cursors.len() / 2;
            let (a, b) = team.join(
                || sum_of_cursors(team, &cursors[..=half], part),
                || sum_of_cursors(team, &cursors[half..], part),
            );
            a + b
        }
        _ => T::ZERO,
    }
}
