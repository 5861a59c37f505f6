//! Effects without a direction: lines with a part of zero length while the effect acts, and twists about opposite axes.

use super::forces::Measure;
use super::group::index;
use super::model::NaturalModel;
use crate::Real;
use crate::effects::apart::is_apart;
use crate::elements::{Span, combine, measured_value};
use crate::model::{Owner, State};
use crate::step::StepError;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Returns the error of an effect that has no direction after a step `dq` from a state. The cause is a twist about opposite
    /// axes, or a part of a line that has no length while the effect acts.
    ///
    /// Cost: nothing if no effect has lines or twists; else the vector of each part.
    pub(super) fn undirected_effect(&self, state: &State<T>, dq: &[T]) -> Option<StepError> {
        self.lines.iter().find_map(|&(number, owner)| {
            let element = &self.measures[number as usize];
            let Measure::Sum { terms } = element.gauge else { return None };
            let Owner::Effect(effect) = owner else { return None };
            let effect = index(effect);
            if self.has_open_twist(terms, (&state.q, dq)) {
                return Some(StepError::TwistOpen { effect });
            }
            let part = self.collapsed_part(terms, (&state.q, &state.v, dq))?;
            let before = self.sum_at(terms, (&state.q, &[], &state.memory));
            let after = self.sum_at(terms, (&state.q, dq, &state.memory));
            let is_slack = [before, after].iter().all(|&sum| is_apart(&element.law, sum));
            (!is_slack).then_some(StepError::LineCollapsed { effect, part: index(part) })
        })
    }

    fn has_open_twist(&self, terms: Span, (q, dq): (&[T], &[T])) -> bool {
        let at =
            |x: Span| combine::<T, D>(x.of(&self.pool), q) + combine::<T, D>(x.of(&self.pool), dq);
        let terms = terms.of(&self.coupled_terms).iter();
        let mut measures = terms.flat_map(|term| term.measures.of(&self.coupled_measures));
        measures.any(|measure| measure.of.is_open(at))
    }

    /// Value of a sum of terms at `q + dq`.
    fn sum_at(&self, terms: Span, (q, dq, memory): (&[T], &[T], &[T])) -> T {
        let at = |x: Span| {
            let place = combine::<T, D>(x.of(&self.pool), q);
            if dq.is_empty() { place } else { place + combine::<T, D>(x.of(&self.pool), dq) }
        };
        let tables = self.coupled_tables();
        terms.of(tables.terms).iter().fold(T::ZERO, |sum, term| {
            let measures = term.measures.of(tables.measures).iter();
            let m = measures.fold(T::ZERO, |m, measure| {
                m + measure.sign * measured_value(&measure.of, at, memory)
            });
            sum + term.factor * tables.function(term.curve, m)[0]
        })
    }
}
