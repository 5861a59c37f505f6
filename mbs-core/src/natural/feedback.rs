//! Signals that depend on the motion, in natural coordinates. They use joint coordinates measured by points and directions.

use super::build::Builder;
use super::group::index;
use super::layout::{Columns, Layout};
use super::model::NaturalModel;
use super::row_builder::MeasureDraft;
use crate::Real;
use crate::elements::{Span, combine, measured_value, rate_and_bias};
use crate::feedback::{SignalStates, follow, note_followed};
use crate::inputs::Feedback;
use crate::model::Terms;
use alloc::vec::Vec;
use core::convert::Infallible;

impl<T: Real> Builder<'_, T> {
    /// Adds the measures that signals use. The check of a scene refuses coordinates that have no measure.
    pub(super) fn add_measured(&mut self, feedback: &Feedback<T>) {
        for term in &feedback.measured {
            let measures = self.coupled_draft(term, T::ONE).measures;
            self.measured.push(measures);
        }
    }
}

impl<T: Real, const D: usize> Layout<T, D> {
    /// Adds one measured number, which is the sum of these measures.
    pub(super) fn add_measured(&mut self, drafts: &[MeasureDraft<T>]) {
        let first = index(self.model.measured.len());
        for draft in drafts {
            let entities = draft.combinations().into_iter().flatten();
            let slots: Vec<usize> = entities.map(|(entity, _)| *entity).collect();
            let measured = self.signed(draft, &Columns { slots: &slots });
            self.model.measured.push(measured);
        }
        let end = index(self.model.measured.len());
        self.model.measured_numbers.push(Span { start: first, end });
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Evaluates at (q, v) the signals that depend on the motion, and the force signals that use them.
    pub(super) fn follow_motion(&self, (q, v): (&[T], &[T]), terms: &mut Terms<T>) {
        if self.feedback.is_empty() {
            return;
        }
        let at = |x: Span| combine::<T, D>(x.of(&self.pool), q);
        let rate = |x: Span| combine::<T, D>(x.of(&self.pool), v);
        let Terms { angles, courses, signals, signal_starts, signal_dt, course_slopes, .. } = terms;
        let measure = |number: u32| {
            let of = self.measured_numbers.get(number as usize).copied().unwrap_or_default();
            let parts = of.of(&self.measured).iter().map(|measured| {
                let value = measured_value(&measured.of, at, angles);
                let [speed, _] = rate_and_bias(&measured.of, at, rate);
                [measured.sign * value, measured.sign * speed]
            });
            let sum = parts.reduce(|a, b| [a[0] + b[0], a[1] + b[1]]);
            Ok::<_, Infallible>(sum.unwrap_or([T::ZERO; 2]))
        };
        let curve = |number: u32, x: T| Ok(self.feedback.curves[number as usize].at(x));
        let mut states = SignalStates {
            dt: *signal_dt,
            starts: signal_starts,
            ends: signals,
            slopes: course_slopes,
        };
        let Ok(()) = follow(&self.feedback.steps, measure, curve, &mut states, courses);
        let of = (&self.feedback.signals[..], self.feedback.starts.len());
        note_followed(of, courses, signals);
    }
}
