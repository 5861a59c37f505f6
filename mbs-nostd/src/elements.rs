//! Machine elements of a model. Each element has a Cargo feature, so that a program contains code only for the elements of its model.

use crate::inputs::{Motion, SignalLaw};
use crate::model::Model;
use mbs_core::Real;
use mbs_recursive::link::curves;
use mbs_recursive::loads::{Load, sum};
use mbs_recursive::passes::{feedback, rotor};
use mbs_recursive::rows::coupled::{self, NONE, SumMeasure};
use mbs_recursive::rows::{Row, rolling};
use mbs_recursive::space::Space;

/// A machine element that a build may omit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Element {
    /// Cargo feature that adds the element.
    pub(crate) feature: &'static str,
    /// True if this build supports the element.
    is_built: bool,
    /// True if the model has such an element.
    pub(crate) is_needed: bool,
}

/// Returns all machine elements. Each says whether this build supports it and whether the model has it.
pub(crate) fn all<T: Real, S: Space<T>>(model: &Model<'_, T, S>) -> [Element; 7] {
    let (m, laws) = (&model.mechanism, &model.prescriptions);
    let has_coupled = m.loops.rows.iter().any(|row| matches!(row, Row::Coupled(_)));
    let rolls = m.loops.rows.iter().any(Row::begins_rolling);
    let terms = m.loops.couplings.terms;
    let has_curve = terms.iter().any(|term| term.curve != NONE);
    let has_line = terms.iter().any(|term| matches!(term.of, SumMeasure::Line { .. }));
    let has_sum = m.loads.iter().any(|load| matches!(load, Load::Sum(_)));
    let has_signal = !m.feedback.steps.is_empty()
        || m.feedback.n_states > 0
        || laws.guides.iter().any(|law| matches!(law, Motion::Step(_)))
        || laws.courses.iter().any(|law| matches!(law, SignalLaw::Spline(_) | SignalLaw::Step(_)));
    [
        ("couplings", coupled::IS_BUILT, has_coupled),
        ("curves", curves::IS_BUILT, has_curve),
        ("lines", coupled::HAS_LINES, has_line),
        ("rolling", rolling::IS_BUILT, rolls),
        ("rotors", rotor::IS_BUILT, !m.rotors.is_empty()),
        ("signals", feedback::IS_BUILT, has_signal),
        ("sums", sum::IS_BUILT, has_sum),
    ]
    .map(|(feature, is_built, is_needed)| Element { feature, is_built, is_needed })
}

/// Returns the feature of the first element that the model has but this build does not support.
pub(crate) fn missing<T: Real, S: Space<T>>(model: &Model<'_, T, S>) -> Option<&'static str> {
    all(model).into_iter().find(Element::is_missing).map(|element| element.feature)
}

impl Element {
    fn is_missing(&self) -> bool {
        self.is_needed && !self.is_built
    }
}

#[cfg(test)]
mod tests {
    use super::Element;

    #[test]
    fn an_element_is_missing_where_a_model_has_it_and_the_build_has_not() {
        for (is_built, is_needed) in [(true, true), (true, false), (false, false)] {
            assert!(!Element { feature: "signals", is_built, is_needed }.is_missing());
        }
        assert!(Element { feature: "signals", is_built: false, is_needed: true }.is_missing());
    }
}
