//! Forces and effects in the tables of a model.

use super::basis::Combination;
use super::forces::{BodyTorque, Measure, MeasureElement, PointForce};
use super::group::{Group, index};
use super::layout::{Columns, Layout, extend};
use super::on_body::BodyElement;
use super::row_builder::{CoupledDraft, EffectDraft, GroupDraft};
use crate::Real;
use crate::effects::Law;
use crate::elements::{Measurand, Signed, Span};
use alloc::vec;

impl<T: Real, const D: usize> Layout<T, D> {
    pub(super) fn add_forces(
        &mut self,
        draft: &GroupDraft<T>,
        columns: &Columns<'_>,
        n_unknown: usize,
        group: &mut Group,
    ) {
        if draft.forces.is_empty() && draft.effects.is_empty() {
            return;
        }
        let mut force = vec![T::ZERO; n_unknown * D];
        for (e, f) in &draft.forces {
            let column = columns.of(*e);
            if column < n_unknown {
                for i in 0..D {
                    force[column * D + i] += f[i];
                }
            }
        }
        group.force = extend(&mut self.model.constant_force, force.into_iter());
        for effect in &draft.effects {
            self.add_effect(effect, columns, group);
        }
        if group.measures.is_empty() {
            group.measures.end = index(self.model.measures.len());
        }
    }

    fn add_effect(&mut self, effect: &EffectDraft<T>, columns: &Columns<'_>, group: &mut Group) {
        match effect {
            EffectDraft::Length { x, law } => {
                let x = self.span(x, columns);
                self.add_measure(Measure::Length { x }, *law, group);
            }
            EffectDraft::Angle { x1, x2, y, law } => {
                let (x1, x2) = (self.span(x1, columns), self.span(x2, columns));
                let y = self.span(y, columns);
                let memory = index(self.model.n_memory);
                self.model.n_memory += 1;
                self.model.angles.push((group.owner, memory));
                self.add_measure(Measure::Angle { x1, x2, y, memory }, *law, group);
            }
            EffectDraft::Sum { terms, law } => self.add_sum((terms, *law), columns, group),
            EffectDraft::Force { point, frame, course } => {
                let point = self.span(point, columns);
                let frame = frame.as_ref().map(|f| self.frame(f, columns));
                let (course, force) = (*course, group.force);
                self.model.point_forces.push(PointForce { point, course, frame, force });
            }
            EffectDraft::Torque { frame, course } => {
                let frame = self.frame(frame, columns);
                let (course, force) = (*course, group.force);
                self.model.torques.push(BodyTorque { frame, course, force });
            }
            EffectDraft::Along { x, d, offset, law } => {
                let (x, d) = (self.span(x, columns), self.span(d, columns));
                self.add_measure(Measure::Along { x, d, offset: *offset }, *law, group);
            }
            EffectDraft::Rotation { frames, number, law } => {
                let frames = [0, 1].map(|i| self.frame(&frames[i], columns));
                if *number == 0 {
                    // The three components of a rotation follow each other and use the same remembered numbers.
                    let (first, owner) = (index(self.model.n_memory), group.owner);
                    self.model.angles.extend([0, 1, 2].map(|i| (owner, first + i)));
                    self.model.rotations.push((index(self.model.measures.len()), owner));
                    self.model.n_memory += 3;
                }
                let memory = index(self.model.n_memory - 3);
                self.add_measure(
                    Measure::Rotation { frames, number: *number, memory },
                    *law,
                    group,
                );
            }
            EffectDraft::BodyLoad { point, frame, axis, law } => {
                let point = self.span(point, columns);
                let frame = frame.as_ref().map_or([Span::default(); 3], |f| self.frame(f, columns));
                let m = &mut self.model;
                let (first, start) = (m.n_measures, m.n_jacobian);
                m.n_measures += law.n_actions();
                m.n_jacobian += law.n_actions() * group.width as usize;
                let measures = Span { start: index(first), end: index(m.n_measures) };
                let place = Span { start: index(start), end: index(m.n_jacobian) };
                let (axis, law) = (*axis, *law);
                m.body_elements.push(BodyElement { point, frame, axis, law, measures, place });
                group.measures = measures;
                group.has_body_law = true;
            }
        }
    }

    fn add_sum(
        &mut self,
        (terms, law): (&[CoupledDraft<T>], Law<T>),
        columns: &Columns<'_>,
        group: &Group,
    ) {
        let first = self.model.n_memory;
        let terms = self.coupled_terms(terms, columns);
        let remembered = first..self.model.n_memory;
        let owned = remembered.map(|place| (group.owner, index(place)));
        self.model.angles.extend(owned);
        let of_terms = terms.of(&self.model.coupled_terms).iter();
        let mut of_terms = of_terms.flat_map(|term| term.measures.of(&self.model.coupled_measures));
        let has_end = |measure: &Signed<T>| {
            matches!(measure.of, Measurand::Length { .. } | Measurand::Twist { .. })
        };
        if of_terms.any(has_end) {
            self.model.lines.push((index(self.model.measures.len()), group.owner));
        }
        self.add_measure(Measure::Sum { terms }, law, group);
    }

    fn frame(&mut self, directions: &[Combination<T>], columns: &Columns<'_>) -> [Span; 3] {
        let mut frame = [Span::default(); 3];
        for (span, direction) in frame.iter_mut().zip(directions) {
            *span = self.span(direction, columns);
        }
        frame
    }

    /// Adds a measure, whose gradient follows the constraint rows of its group in the Jacobian store.
    fn add_measure(&mut self, gauge: Measure<T>, law: Law<T>, group: &Group) {
        let m = &mut self.model;
        let start = m.n_jacobian;
        m.n_jacobian += group.width as usize;
        let place = Span { start: index(start), end: index(m.n_jacobian) };
        m.measures.push(MeasureElement { gauge, law, place });
    }
}
