//! One linear system of the scene, ours and faer's: assemble, factor, solve, by turns in one run.
//!
//! ```text
//! T = M + (v'/a') C + (1/a') K + J^T s J,   s = 1e6 effective masses        as the index-3 step has it
//! ours:   T = sum T_e = L D L^T,  x = T^-1 b               faer:  slot map: sum T_e into one matrix, L L^T, x = T^-1 b
//! ```

use crate::augmented::merge;
use crate::faer_rival::Rival;
use crate::race::{Work, race};
use crate::scenes::Prepared;
use crate::{Request, say};
use faer::sparse::linalg::SupernodalThreshold;
use mbs_augmented::{Options, Penalty, Workspace, index3};
use mbs_core::SpdSolver;
use mbs_core::model::{Load, Model, State, System, Tangent, Terms};
use mbs_sparse::Multifrontal;
use serde_json::json;
use std::cell::RefCell;
use std::hint::black_box;

/// Steps after which it is measured again.
const STEPS: u32 = 20;

/// Measures at the start and after some steps, and tells a line of each.
pub(crate) fn measure<const D: usize>(
    prepared: &Prepared<D>,
    solver: &Multifrontal<f64>,
    request: &Request,
) {
    let mut state = prepared.start.clone();
    beside(prepared, &state, (0, solver), request);
    let mut workspace = Workspace::new(&prepared.model, solver.clone());
    let step = (prepared.dt, prepared.model.length());
    for _ in 0..STEPS {
        let report =
            index3::step(&prepared.model, step, &Options::index3(), &mut state, &mut workspace);
        if let Err(error) = report {
            return say(&json!({ "kind": "faer", "after": STEPS, "reason": error.to_string() }));
        }
    }
    beside(prepared, &state, (STEPS, solver), request);
}

/// Terms and penalties at a state.
fn terms<const D: usize>(prepared: &Prepared<D>, state: &State<f64>) -> (Terms<f64>, Vec<f64>) {
    let model = &prepared.model;
    let mut terms = model.terms();
    model.set_inputs(state.t, &mut terms);
    model.evaluate(&state.q, &mut terms);
    if model.has_forces() {
        model.evaluate_forces(&state.q, &state.v, &state.memory, &mut terms);
    }
    let mut penalty = vec![0.0; model.n_constraints()];
    model.effective_masses(&terms, &mut penalty);
    let (Penalty::Scaled(factor) | Penalty::Fixed(factor)) = Options::<f64>::index3().penalty;
    penalty.iter_mut().for_each(|mass| *mass *= factor);
    (terms, penalty)
}

fn beside<const D: usize>(
    prepared: &Prepared<D>,
    state: &State<f64>,
    (after, solver): (u32, &Multifrontal<f64>),
    request: &Request,
) {
    let (model, rule) = (&prepared.model, prepared.rule());
    let (terms, penalty) = terms(prepared, state);
    let tangent = Tangent {
        stiffness: 1.0 / rule.acceleration,
        damping: rule.velocity / rule.acceleration,
        penalty: &penalty,
        geometric: None,
    };
    let load = Load { mass: Some(&state.a), multipliers: Some(&state.lambda), force: 0.5 };
    let system = System { model, terms: &terms, tangent, load };
    let mut ours = solver.clone();
    let n = mbs_core::Cliques::n_unknowns(model);
    let mut b = vec![0.0; n];
    ours.assemble(&system, &mut b);
    if let Err(error) = ours.factor(&system) {
        return say(&json!({ "kind": "faer", "after": after, "reason": error.to_string() }));
    }
    let mut scratch = vec![0.0; ours.n_scratch()];
    let found = [(); 3].map(|()| RefCell::new(vec![0.0; n]));
    let mut own = Work(|| {
        let x = &mut *found[0].borrow_mut();
        x.copy_from_slice(&b);
        // It has been factored before.
        let _ = black_box(ours.factor(black_box(&system)));
        ours.solve(x, &mut scratch);
    });
    let rival = |threshold, place: usize| {
        let mut rival = Rival::analyse_by(model, threshold);
        let (found, b, system) = (&found[place], &b, &system);
        move || {
            let x = &mut *found.borrow_mut();
            x.copy_from_slice(b);
            rival.assemble(model, black_box(system));
            rival.factor_and_solve(x);
        }
    };
    let mut simplicial = Work(rival(SupernodalThreshold::FORCE_SIMPLICIAL, 1));
    let mut supernodal = Work(rival(SupernodalThreshold::FORCE_SUPERNODAL, 2));
    let timings = race(&mut [&mut own, &mut simplicial, &mut supernodal], request.seconds);
    let mut line = json!({ "kind": "faer", "after": after });
    for (name, timing) in ["ours", "simplicial", "supernodal"].into_iter().zip(timings) {
        // None of them can fail.
        let told = timing.map(|timing| timing.told()).unwrap_or_default();
        merge(&mut line, [json!({ name: told })]);
    }
    let difference = |i: usize| distance(&found[0].borrow(), &found[i].borrow());
    merge(&mut line, [json!({ "difference": difference(1).max(difference(2)) })]);
    say(&line);
}

/// Largest difference of two vectors over the largest number of the first.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().fold(0.0, |most, x| x.abs().max(most));
    let apart = a.iter().zip(b).fold(0.0, |most, (x, y)| (x - y).abs().max(most));
    if size > 0.0 { apart / size } else { apart }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_shares_of_the_largest_number() {
        assert!((distance(&[1.0, -4.0], &[1.0, -3.0]) - 0.25).abs() < 1e-15);
        assert!(distance(&[0.0], &[0.0]).abs() < 1e-15);
    }
}
