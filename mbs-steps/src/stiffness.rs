//! Period of the stiffest force at a state.
//!
//! ```text
//! K x = lambda M x  where J x = 0,   period = 2 pi / sqrt(lambda),   the largest lambda by power iteration:
//! x <- (M + J^T s J)^-1 K x,         K x by a difference of the applied forces
//! ```
//!
//! K is the stiffness of the applied forces, M the mass matrix, J the constraint Jacobian and s the penalty. Dampers, velocities and
//! gravity are not included.

use core::f64::consts::TAU;
use mbs_core::model::{Load, Model, State, System, Tangent};
use mbs_core::natural::NaturalModel;
use mbs_core::once::found;
use mbs_core::{SpdSolver, instances};
use mbs_sparse::Multifrontal;

/// Number of iterations of the power method [-]. They give the square root of the eigenvalue to a few per cent. Close eigenvalues do not
/// matter, because they give the same period.
const ITERATIONS: u32 = 12;
/// Penalty s of the constraints, relative to the effective masses [-]. Motions that violate the constraints are then smaller by a factor of
/// 1e-6.
const PENALTY: f64 = 1e6;
/// Change of coordinates for a difference quotient, relative to the length of the model [-]. Chosen, not tuned.
const DIFFERENCE: f64 = 1e-6;
/// Largest difference of forces, relative to the forces, that counts as rounding error [-]. Chosen, not tuned.
const NOISE: f64 = 1e-9;

/// Returns the shortest period of the forces [s]; `None` if no force grows with a displacement.
///
/// Cost: one factorisation, then one evaluation of the forces and one solution in each iteration; allocates.
pub fn shortest_period<const D: usize>(
    model: &NaturalModel<f64, D>,
    solver: &mut Multifrontal<f64>,
    state: &State<f64>,
) -> Option<f64> {
    found::<Period<D>>(PERIOD)(model, solver, state)
}

type Period<const D: usize> =
    fn(&NaturalModel<f64, D>, &mut Multifrontal<f64>, &State<f64>) -> Option<f64>;
instances!(f64 PERIOD: Period<D> = period::<D>);

fn period<const D: usize>(
    model: &NaturalModel<f64, D>,
    solver: &mut Multifrontal<f64>,
    state: &State<f64>,
) -> Option<f64> {
    if !model.has_forces() {
        return None;
    }
    let n = mbs_core::Cliques::n_unknowns(model);
    let mut terms = model.terms();
    model.set_inputs(state.t, state, &mut terms);
    model.evaluate(&state.q, &mut terms);
    model.evaluate_forces(&state.q, &state.v, &mut terms);
    let mut penalty = vec![0.0; model.n_constraints()];
    model.effective_masses(&terms, &mut penalty);
    penalty.iter_mut().for_each(|s| *s *= PENALTY);
    let tangent = Tangent { stiffness: 0.0, damping: 0.0, penalty: &penalty, geometric: None };
    let load = Load { mass: None, multipliers: None, force: 1.0 };
    solver.factor(&System { model, terms: &terms, tangent, load }).ok()?;
    let mut forces = vec![0.0; n];
    solver.assemble(&System { model, terms: &terms, tangent, load }, &mut forces);
    let size = forces.iter().fold(0.0, |most: f64, f| most.max(f.abs()));
    let mut scratch = vec![0.0; solver.n_scratch()];
    // The start vector has irregular components, so that it contains all eigenvectors: fractional parts of multiples of the golden ratio.
    let mut x: Vec<f64> = (1..=n).map(|i| (i as f64 * 0.618_034).fract() - 0.5).collect();
    let (mut q, mut moved, mut lambda) = (state.q.clone(), vec![0.0; n], 0.0);
    let mut extended = vec![0.0; state.q.len()];
    for _ in 0..ITERATIONS {
        let most = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let step = DIFFERENCE * model.length() / most;
        if !step.is_finite() {
            return None;
        }
        for ((q, at), x) in q.iter_mut().zip(&state.q).zip(&x) {
            *q = at + step * x;
        }
        model.evaluate(&q, &mut terms);
        model.evaluate_forces(&q, &state.v, &mut terms);
        solver.assemble(&System { model, terms: &terms, tangent, load }, &mut moved);
        let change =
            moved.iter().zip(&forces).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        if !(change > NOISE * size) {
            return None;
        }
        let y: Vec<f64> = {
            let mut y: Vec<f64> = moved.iter().zip(&forces).map(|(a, b)| (a - b) / step).collect();
            solver.solve(&mut y, &mut scratch);
            y
        };
        let mut energy = |x: &[f64]| {
            extended[..n].copy_from_slice(x);
            model.kinetic_energy(&extended)
        };
        lambda = (energy(&y) / energy(&x)).sqrt();
        x = y;
    }
    let period = TAU / lambda.sqrt();
    (period > 0.0 && period.is_finite()).then_some(period)
}
