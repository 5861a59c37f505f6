//! Accelerations and multipliers by the index-1 equations: the last level of a consistent state.

use super::error::AssemblyError;
use super::problem::{MAX_SWEEPS, RAISE, raises};
use super::weak::{SIEVES, TILT};
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::SpdSolver;
use crate::model::{Load, Model, State, System, Tangent, Terms};
use alloc::vec;
use alloc::vec::Vec;

/// Computes accelerations and multipliers at (q, v) of `s` by the index-1 equations, by repeated corrections. It also sets the stored phi
/// and the power. Returns the remaining residual of the accelerations.
///
/// # Errors
/// [`AssemblyError::NoInertia`] or [`AssemblyError::Acceleration`].
pub fn accelerations<T: Real, M: Model<T>>(
    model: &M,
    solver: &mut impl SpdSolver<T>,
    s: &mut State<T>,
    terms: &mut Terms<T>,
) -> Result<T, AssemblyError> {
    let (n, m) = (model.n_unknowns(), model.n_constraints());
    model.set_inputs(s.t, s, terms);
    model.evaluate(&s.q, terms);
    model.evaluate_forces(&s.q, &s.v, terms);
    model.evaluate_phi_t(&s.q, terms);
    model.evaluate_bias(&s.q, &s.v, terms);
    let mut penalty = vec![T::ZERO; m];
    model.effective_masses(terms, &mut penalty);
    let mut alpha = super::problem::penalty::<T>();
    penalty.iter_mut().for_each(|p| *p *= alpha);
    let (mut f, mut scratch) = (vec![T::ZERO; n], vec![T::ZERO; solver.n_scratch()]);
    let (mut lambda, mut mu, mut rates) = (vec![T::ZERO; m], vec![T::ZERO; m], vec![T::ZERO; m]);
    factor(model, solver, terms, &penalty)?;
    check_pivots(model, solver, terms, &penalty)?;
    let (mut last, mut raises) = (None, raises::<T>());
    for _ in 0..MAX_SWEEPS {
        model.multiply_jacobian(terms, &s.a, &mut rates);
        for k in 0..m {
            rates[k] += terms.phi_bias[k];
            mu[k] = lambda[k] + penalty[k] * rates[k];
        }
        let load = Load { mass: Some(&s.a), multipliers: Some(&mu), force: T::ONE };
        let tangent = tangent(&penalty);
        solver.assemble(&System { model, terms: &*terms, tangent, load }, &mut f);
        solver.solve(&mut f, &mut scratch);
        for i in 0..n {
            s.a[i] -= f[i];
        }
        model.multiply_jacobian(terms, &s.a, &mut rates);
        for k in 0..m {
            rates[k] += terms.phi_bias[k];
            lambda[k] += penalty[k] * rates[k];
        }
        // Residuals are compared, not corrections, since the second correction mainly compensates for the finite penalty of the first
        // correction.
        let left = norm_inf(&rates);
        let slower = |share: f64| last.is_some_and(|last| !(left < last * T::from_f64(share)));
        let (is_slow, stalls) = (slower(0.5), slower(STALLED));
        last = Some(left);
        let is_met = left <= limit(model, terms, &s.a);
        if is_slow && raises > 0 && !is_met {
            alpha *= T::from_f64(RAISE);
            penalty.iter_mut().for_each(|p| *p *= T::from_f64(RAISE));
            factor(model, solver, terms, &penalty)?;
            raises -= 1;
            last = None;
        } else if stalls || (is_slow && is_met) {
            break;
        }
    }
    let residual = norm_inf(&rates);
    let met = Met { accepted: limit(model, terms, &s.a), penalty: &penalty, alpha };
    if !(residual <= met.accepted) && !met.but_for_tilt(model, solver, (terms, &s.a), &rates) {
        let row = (0..m).find(|&k| !(rates[k].abs() < residual)).unwrap_or(0);
        let owner = model.owner_of_row(row);
        return Err(AssemblyError::Acceleration { residual: residual.to_f64(), owner });
    }
    keep(model, s, &lambda, terms);
    Ok(residual)
}

/// Writes all parts of a state that follow from its accelerations: auxiliary accelerations, multipliers, `phi`, remembered angles, signals,
/// applied inputs and power.
fn keep<T: Real, M: Model<T>>(model: &M, s: &mut State<T>, lambda: &[T], terms: &Terms<T>) {
    s.a_aux.copy_from_slice(&s.a);
    for x in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
        x.copy_from_slice(lambda);
    }
    s.phi.copy_from_slice(&terms.phi);
    model.remember(&s.q, terms, &mut s.memory);
    s.signals.copy_from_slice(&terms.signals);
    s.applied.copy_from_slice(&s.inputs);
    s.power = model.power(&s.q, &s.v, &s.reaction, terms);
}

/// Criterion for the residuals of accelerations; see `weak.rs`.
struct Met<'a, T> {
    accepted: T,
    penalty: &'a [T],
    /// Penalty, relative to the effective masses of the rows.
    alpha: T,
}

impl<T: Real> Met<'_, T> {
    /// True if the residuals are acceptable. The tilt of weakly determined rows may leave a part that grows with the accelerations `a`. The
    /// solver must have the factor of M + J^T alpha J.
    fn but_for_tilt<M: Model<T>>(
        &self,
        model: &M,
        solver: &mut impl SpdSolver<T>,
        (terms, a): (&Terms<T>, &[T]),
        rates: &[T],
    ) -> bool {
        if !norm_inf(rates).is_finite() {
            return false;
        }
        let (n, m) = (model.n_unknowns(), rates.len());
        let (mut d, mut scratch) =
            (vec![T::ZERO; model.n_extended()], vec![T::ZERO; solver.n_scratch()]);
        let (mut weak, mut mu, mut moved) = (rates.to_vec(), vec![T::ZERO; m], vec![T::ZERO; m]);
        let mut tilt = T::ZERO;
        for _ in 0..SIEVES {
            (0..m).for_each(|k| mu[k] = self.penalty[k] * weak[k]);
            let load = Load { mass: None, multipliers: Some(&mu), force: T::ZERO };
            let system = System { model, terms, tangent: tangent(self.penalty), load };
            solver.assemble(&system, &mut d[..n]);
            solver.solve(&mut d[..n], &mut scratch);
            model.multiply_jacobian(terms, &d, &mut moved);
            let product = |x: &[T]| mu.iter().zip(x).fold(T::ZERO, |sum, (&mu, &x)| sum + mu * x);
            // a sweep removes the fraction alpha sigma^2 of the weak residual; sigma is the tilt
            tilt = (product(&moved) / (product(&weak) * self.alpha)).sqrt();
            weak.iter_mut().zip(&moved).for_each(|(y, &d)| *y -= d);
        }
        let determined =
            rates.iter().zip(&weak).fold(T::ZERO, |s, (&all, &w)| s.max((all - w).abs()));
        let squares = weak.iter().zip(self.penalty).fold(T::ZERO, |s, (&y, &p)| s + p * y * y);
        let size = (squares / self.alpha).sqrt();
        let way = (model.kinetic_energy(a) * T::TWO).sqrt();
        determined <= self.accepted && tilt <= T::from_f64(TILT) && size <= T::TWO * tilt * way
    }
}

/// Accepted residual of accelerations, relative to accelerations and to the largest sum of a row's terms [-]. Chosen, not tuned.
const ACCEPTED: f64 = 1e-9;
/// Smallest accepted residual, in multiples of machine precision [-]. It counts only in single precision. Chosen, not tuned.
const ACCEPTED_ROUNDINGS: f64 = 1e4;
/// Largest pivot that counts as zero, in multiples of machine precision of its original diagonal entry [-]. Chosen, not tuned.
const PIVOT_ROUNDINGS: f64 = 32.0;
/// Ratio of the residuals after and before a sweep above which the sweeps end [-]. Chosen, not tuned.
const STALLED: f64 = 0.9;

/// Accepted residual of accelerations. It is relative to the accelerations and to the largest sum of a row's terms.
fn limit<T: Real, M: Model<T>>(model: &M, terms: &Terms<T>, a: &[T]) -> T {
    let mut size = T::ONE + norm_inf(a);
    let mut jacobian = Vec::new();
    for e in 0..model.n_elements() {
        let (clique, rows) = (model.clique(e), model.rows(e));
        jacobian.clear();
        jacobian.resize(clique.len() * rows.len(), T::ZERO);
        model.write_jacobian(terms, e, &mut jacobian);
        for (row, k) in jacobian.chunks_exact(clique.len().max(1)).zip(rows) {
            let products = row.iter().zip(clique);
            let sum = products.fold(T::ZERO, |sum, (&g, &u)| sum + (g * a[u as usize]).abs());
            size = size.max(sum + terms.phi_bias[k].abs());
        }
    }
    size * T::from_f64(ACCEPTED).max(T::EPSILON * T::from_f64(ACCEPTED_ROUNDINGS))
}

fn tangent<T: Real>(penalty: &[T]) -> Tangent<'_, T> {
    Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty, geometric: None }
}

/// Factors the matrix M + J^T alpha J.
fn factor<T: Real, M: Model<T>>(
    model: &M,
    solver: &mut impl SpdSolver<T>,
    terms: &Terms<T>,
    penalty: &[T],
) -> Result<(), AssemblyError> {
    let load = Load { mass: None, multipliers: None, force: T::ZERO };
    let system = System { model, terms, tangent: tangent(penalty), load };
    solver.factor(&system).map_err(|e| no_inertia(model, e.unknown))
}

fn no_inertia<T: Real>(model: &impl Model<T>, unknown: u32) -> AssemblyError {
    AssemblyError::NoInertia { owner: model.owner_of_unknown(unknown as usize) }
}

/// Checks the pivots of the factor. A pivot at machine precision of its original diagonal entry means that nothing determines the coordinate.
fn check_pivots<T: Real, M: Model<T>>(
    model: &M,
    solver: &impl SpdSolver<T>,
    terms: &Terms<T>,
    penalty: &[T],
) -> Result<(), AssemblyError> {
    let tangent = tangent(penalty);
    let mut diagonal = vec![T::ZERO; model.n_unknowns()];
    let mut block = Vec::new();
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let k = clique.len();
        block.clear();
        block.resize(k * (k + 1) / 2, T::ZERO);
        model.write_block(terms, &tangent, e, &mut block);
        for (j, &u) in clique.iter().enumerate() {
            diagonal[u as usize] += block[crate::natural::packed(k, j, j)];
        }
    }
    for (&u, &pivot) in solver.elimination_order().iter().zip(solver.pivots()) {
        if pivot <= diagonal[u as usize] * T::EPSILON * T::from_f64(PIVOT_ROUNDINGS) {
            return Err(no_inertia(model, u));
        }
    }
    Ok(())
}
