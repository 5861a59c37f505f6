//! Lines of effects whose parts lose their length: while the effect acts they have no direction.

use super::forces::Measure;
use super::model::NaturalModel;
use crate::Real;
use crate::elements::{Span, combine, measured_value};
use crate::laws::scalar::is_apart;
use crate::model::{Owner, State};

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// The part of an effect's lines that has no length left after a step `dq` from a state, if the effect acts before or after it.
    ///
    /// Cost: nothing without such effects; else the gap of each part.
    pub(super) fn collapsed_effect(&self, state: &State<T>, dq: &[T]) -> Option<(Owner, usize)> {
        self.lines.iter().find_map(|&(number, owner)| {
            let element = &self.measures[number as usize];
            let Measure::Sum { terms } = element.gauge else { return None };
            let part = self.collapsed_part(terms, (&state.q, &state.v, dq))?;
            let before = self.sum_at(terms, (&state.q, &[], &state.memory));
            let after = self.sum_at(terms, (&state.q, dq, &state.memory));
            let is_slack = [before, after].iter().all(|&sum| is_apart(&element.law, sum));
            (!is_slack).then_some((owner, part))
        })
    }

    /// A sum at `q + dq`.
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
