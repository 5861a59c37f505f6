//! Check of the operations on signals.

use super::{Look, ensure};
use crate::check::LoadError;
use crate::model::Model;
use mbs_core::Real;
use mbs_core::feedback::{FeedbackOperation as Operation, NO_STATE};
use mbs_recursive::rows::coupled::NONE;
use mbs_recursive::space::Space;

impl<T: Real, S: Space<T>> Look<'_, '_, T, S> {
    pub(super) fn signals(&self, model: &Model<'_, T, S>) -> Result<(), LoadError> {
        let feedback = &self.m.feedback;
        let is_course = |course: u32| (course as usize) < self.sizes.courses;
        let is_measured = |number: u32| (number as usize) < feedback.links.len();
        let is_state = |state: u32| (state as usize) < feedback.n_states;
        let is_curve =
            |curve: u32| curve == NONE || (curve as usize) < self.m.loops.couplings.curves.len();
        for (i, step) in feedback.steps.iter().enumerate() {
            let holds = match step.operation {
                Operation::Value { number } | Operation::Rate { number } => is_measured(number),
                Operation::Constant(_) => true,
                Operation::Add { from, .. }
                | Operation::Multiply { from }
                | Operation::Clamp { from, .. }
                | Operation::LimitRatio { from, .. } => is_course(from),
                Operation::Curve { from, curve } => is_course(from) && is_curve(curve),
                Operation::Lag { from, state, .. } | Operation::Integral { from, state, .. } => {
                    is_course(from) && is_state(state)
                }
                Operation::Pid { from: [target, measured], state, gains, .. } => {
                    let has_none = state == NO_STATE && gains[1].is_zero();
                    is_course(target) && is_course(measured) && (is_state(state) || has_none)
                }
                Operation::Component { from, component } => is_course(from) && component < 3,
                Operation::Force { from, on } => is_course(from) && is_measured(on),
            };
            ensure(is_course(step.to) && holds, "operations", i)?;
        }
        for (i, &link) in feedback.links.iter().enumerate() {
            ensure(link > 0 && self.has_one_coordinate(link), "measured coordinates", i)?;
        }
        ensure(model.start.signals.len() == feedback.n_states, "states of signals", 0)?;
        Ok(())
    }
}
