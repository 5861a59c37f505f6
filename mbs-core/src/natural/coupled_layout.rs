//! Terms of couplings in the tables of a model.

use super::group::index;
use super::layout::{Columns, Layout, extend};
use super::row_builder::{CoupledDraft, MeasureDraft};
use crate::Real;
use crate::elements::{CoupledTerm, Measurand, NONE, Signed, Span};
use alloc::vec::Vec;

impl<T: Real, const D: usize> Layout<T, D> {
    /// Adds the terms of a coupling, with their measures and curves.
    pub(super) fn coupled_terms(
        &mut self,
        drafts: &[CoupledDraft<T>],
        columns: &Columns<'_>,
    ) -> Span {
        let mut terms = Vec::with_capacity(drafts.len());
        for draft in drafts {
            let measures: Vec<_> =
                draft.measures.iter().map(|measure| self.signed(measure, columns)).collect();
            let m = &mut self.model;
            let curve = if draft.curve.is_identity() {
                NONE
            } else {
                m.curves.push(draft.curve.clone());
                index(m.curves.len() - 1)
            };
            let measures = extend(&mut m.coupled_measures, measures.into_iter());
            terms.push(CoupledTerm { factor: draft.factor, measures, curve });
        }
        extend(&mut self.model.coupled_terms, terms.into_iter())
    }

    pub(super) fn signed(&mut self, draft: &MeasureDraft<T>, columns: &Columns<'_>) -> Signed<T> {
        match draft {
            MeasureDraft::Angle { x1, x2, y, sign, of } => {
                let (x1, x2) = (self.span(x1, columns), self.span(x2, columns));
                let y = self.span(y, columns);
                let memory = index(self.model.n_memory);
                self.model.n_memory += 1;
                self.model.coupled_angles.push((*of, *sign, memory));
                Signed { sign: *sign, of: Measurand::Angle { x1, x2, y, memory } }
            }
            MeasureDraft::Slide { x, y } => {
                let (x, y) = (self.span(x, columns), self.span(y, columns));
                Signed { sign: T::ONE, of: Measurand::Slide { x, y } }
            }
            MeasureDraft::Length { x, reference } => {
                let x = self.span(x, columns);
                Signed { sign: T::ONE, of: Measurand::Length { x, reference: *reference } }
            }
            MeasureDraft::Swing { a, b } => {
                let (a, b) = (self.span(a, columns), self.span(b, columns));
                Signed { sign: T::ONE, of: Measurand::Swing { a, b } }
            }
            MeasureDraft::Twist { first, second } => {
                let [first, second] =
                    [first, second].map(|[x, y]| [self.span(x, columns), self.span(y, columns)]);
                let memory = index(self.model.n_memory);
                self.model.n_memory += 1;
                Signed { sign: T::ONE, of: Measurand::Twist { first, second, memory } }
            }
        }
    }
}
