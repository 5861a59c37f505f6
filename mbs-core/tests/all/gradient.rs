//! Gradient of the number that an effect measures, compared with difference quotients.

use mbs_core::Cliques;
use mbs_core::model::{Load, Model, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_testkit::{Random, residual};

/// Evaluates all terms that the forces need.
pub(crate) fn evaluate(model: &NaturalModel<f64, 3>, state: &State<f64>, terms: &mut Terms<f64>) {
    model.set_inputs(0.0, state, terms);
    model.evaluate(&state.q, terms);
    model.evaluate_forces(&state.q, &state.v, terms);
}

/// Changes positions at random by up to `way`, so that directions lose their unit length. Velocities are random and up to one.
pub(crate) fn scatter(
    model: &NaturalModel<f64, 3>,
    state: &mut State<f64>,
    way: f64,
    random: &mut Random,
) {
    for (q, v) in state.q.iter_mut().zip(&mut state.v).take(Cliques::n_unknowns(model)) {
        (*q, *v) = (*q + way * random.next(), random.next());
    }
}

/// Gradient of the first measure and its central differences with step `step`, coordinate by coordinate. A spring of stiffness one,
/// without load at zero, acts on the measure.
pub(crate) fn gradients(
    model: &NaturalModel<f64, 3>,
    state: &State<f64>,
    step: f64,
) -> Vec<[f64; 2]> {
    let mut terms = model.terms();
    evaluate(model, state, &mut terms);
    let value = terms.measures[0].value;
    // force of a spring of stiffness one: -Q = m grad m
    let force = residual(model, &terms, &Load { mass: None, multipliers: None, force: 1.0 });
    let mut side = |i: usize, h: f64| {
        let mut moved = state.clone();
        moved.q[i] += h;
        evaluate(model, &moved, &mut terms);
        terms.measures[0].value
    };
    let pair = |(i, force): (usize, &f64)| {
        [force / value, (side(i, step) - side(i, -step)) / (2.0 * step)]
    };
    force.iter().enumerate().map(pair).collect()
}
