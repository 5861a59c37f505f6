//! One linear system of the scene by our solver and by faer: assembly, factorisation, solution, interleaved in one run. The blocks are
//! given, or they are evaluated each time, which adds the same cost to both.
//!
//! ```text
//! T = M + (v'/a') C + (1/a') K + J^T s J,   s = 1e6 effective masses        as the index-3 step has it
//! ours:   T = sum T_e = L D L^T,  x = T^-1 b               faer:  slot map: sum T_e into one matrix, L L^T, x = T^-1 b
//! ```

use crate::bench::distance::distance;
use crate::bench::faer_rival::Rival;
use crate::bench::race::{Work, race};
use crate::bench::request::{Request, merge, say};
use crate::bench::scenes::Prepared;
use faer::sparse::linalg::SupernodalThreshold;
use mbs_augmented::{Options, Penalty, Workspace, index3};
use mbs_core::integrator::Integrator;
use mbs_core::model::{Load, Model, State, System, Tangent, Terms};
use mbs_core::step::Step;
use mbs_core::{BlockSource, Cliques, SpdSolver};
use mbs_sparse::Multifrontal;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::hint::black_box;

/// Number of steps between the two measurements. Chosen, not tuned.
const STEPS: u32 = 20;

/// Measures at the start and after some steps, and prints a line for each.
pub(crate) fn measure<const D: usize>(
    prepared: &Prepared<D>,
    solver: &Multifrontal<f64>,
    request: &Request,
) {
    let mut state = prepared.start.clone();
    beside(prepared, &state, (0, solver), request);
    let mut workspace = Workspace::new(&prepared.model, solver.clone());
    let step = Step { dt: prepared.dt, length: prepared.model.length() };
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
    model.set_inputs(state.t, state, &mut terms);
    model.evaluate(&state.q, &mut terms);
    if model.has_forces() {
        model.evaluate_forces(&state.q, &state.v, &mut terms);
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
    let (model, rule) = (&prepared.model, Integrator::trapezoidal().rule(prepared.dt));
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
    let mut line = json!({ "kind": "faer", "after": after });
    let (written, difference) = interleaved(model, &mut ours, &system, &b, request.seconds);
    let (given, _) = interleaved(model, &mut ours, &Given::of(model, &system), &b, request.seconds);
    merge(&mut line, [written, json!({ "given": given, "difference": difference })]);
    say(&line);
}

/// Times of the three solvers with blocks from `source`, and the distances of their solutions.
fn interleaved(
    cliques: &impl Cliques,
    ours: &mut Multifrontal<f64>,
    source: &impl BlockSource<f64>,
    b: &[f64],
    seconds: f64,
) -> (Value, f64) {
    let mut scratch = vec![0.0; ours.n_scratch()];
    let found = [(); 3].map(|()| RefCell::new(b.to_vec()));
    let mut own = Work(|| {
        let x = &mut *found[0].borrow_mut();
        x.copy_from_slice(b);
        // the result is ignored: the same blocks have been factored before without an error
        let _ = black_box(ours.factor(black_box(source)));
        ours.solve(x, &mut scratch);
    });
    let rival = |threshold, place: usize| {
        let mut rival = Rival::analyse_by(cliques, threshold);
        let found = &found[place];
        move || {
            let x = &mut *found.borrow_mut();
            x.copy_from_slice(b);
            rival.assemble(cliques, black_box(source));
            rival.factor_and_solve(x);
        }
    };
    let mut simplicial = Work(rival(SupernodalThreshold::FORCE_SIMPLICIAL, 1));
    let mut supernodal = Work(rival(SupernodalThreshold::FORCE_SUPERNODAL, 2));
    let timings = race(&mut [&mut own, &mut simplicial, &mut supernodal], seconds);
    let mut times = json!({});
    for (name, timing) in ["ours", "simplicial", "supernodal"].into_iter().zip(timings) {
        // none of the three runners can fail
        let timing = timing.map(|timing| timing.json()).unwrap_or_default();
        merge(&mut times, [json!({ name: timing })]);
    }
    let difference = |i: usize| distance(&found[0].borrow(), &found[i].borrow());
    (times, difference(1).max(difference(2)))
}

/// Blocks that are evaluated once.
struct Given {
    blocks: Vec<f64>,
    starts: Vec<usize>,
}

impl Given {
    fn of(cliques: &impl Cliques, source: &impl BlockSource<f64>) -> Self {
        let (mut blocks, mut starts) = (Vec::new(), Vec::new());
        for e in 0..cliques.n_elements() {
            let (start, k) = (blocks.len(), cliques.clique(e).len());
            blocks.resize(start + k * (k + 1) / 2, 0.0);
            source.write_block(e, &mut blocks[start..]);
            starts.push(start);
        }
        Self { blocks, starts }
    }
}

impl BlockSource<f64> for Given {
    fn write_block(&self, element: usize, block: &mut [f64]) {
        block.copy_from_slice(&self.blocks[self.starts[element]..][..block.len()]);
    }
    /// right-hand sides are given as vectors, so that no residual is assembled
    fn write_residual(&self, _: usize, residual: &mut [f64]) {
        residual.fill(0.0);
    }
}
