//! One step of the modified state space [P1 2.4, 3.3].
//!
//! ```text
//! z: independent coordinates,  z = z_p + d,  z' = z'_p + v' d,  z'' = z''_p + a' d             [P1 (40)]
//! q, v, a: from z by the position, velocity and acceleration problems                          [P1 (22)]
//! f = R^T (M a - Q) = 0                                                                        [P1 (43)]
//! R^T (M + (v'/a') C + (1/a') (K + K_geo(lambda))) R d = -f/a'                                  [P1 (42), (44)]
//! J_d^T lambda = (Q - M a)_d                                                                   [P1 (3)]
//! ```
//!
//! The method differs from the published one. Unknowns are increments. The acceleration a replaces R z'' + R' z', so R' is never formed.
//! The tangent contains the geometric stiffness, which is the curvature of the constraint surface. Newton's method then converges
//! quadratically, apart from terms of velocities. An option leaves the geometric stiffness out, as published. The residual f is evaluated
//! as (M a - Q)_i + J_i^T lambda, which equals R^T (M a - Q).

use crate::options::{Coordinates, Options, PivotChange};
use crate::pivots::select_pivots;
use crate::workspace::Workspace;
use mbs_core::algebra::norm_inf;
use mbs_core::implicit::{
    add_work, check_guides, check_lines, check_rotations, take_coordinates, take_inputs,
};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Load, Model, State, System, Tangent};
use mbs_core::step::{
    Counts, Step, StepError, StepReport, Stop, largest, largest_or_nan, step_scale,
};
use mbs_core::{FactorError, Real, SpdSolver};

/// Constraint residual of velocities and accelerations that counts as a violation, relative to their size [-]. Chosen, not tuned.
const VIOLATION: f64 = 5e-10;
/// Smallest residual that counts as a violation, in units of EPSILON [-]. It has an effect in single precision only. Chosen, not tuned.
const VIOLATION_ROUNDINGS: f64 = 1024.0;
/// Corrections that count as rounding errors, in units of EPSILON times the displacement, and in units of EPSILON times the scene's length
/// [-]. Chosen, not tuned.
const NOISE: [f64; 2] = [64.0, 4.0];
/// Correction with which a step may end after the allowed iterations, relative to the displacement by accelerations [-]. Chosen, not tuned.
const ENOUGH: f64 = 1e-6;

/// Advances `s` by one [`Step`].
///
/// A step fails at singular positions with [`StepError::RankLost`], which names one of the dependent rows.
///
/// Cost of an iteration: one or two evaluations and sparse factorisations of J, and three sparse solves. An iteration also computes n f
/// entries of R and makes a dense factorisation of size f, where f is the number of freedoms. No allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn step<T: Real, M: Model<T>>(
    model: &M,
    step: Step<T>,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T>,
) -> Result<StepReport<T>, StepError> {
    let Step { dt, length } = step.checked()?;
    if model.has_velocity_rows() {
        return Err(StepError::VelocityRows);
    }
    options.validate()?;
    take_inputs(model, options, s, w)?;
    let rule = options.integrator.rule(dt);
    w.counts = Counts::default();
    let is_new = w.is_stale || options.pivot_change == PivotChange::EveryStep;
    let mut outcome = attempt(model, (&rule, length), options, s, (w, is_new));
    if outcome.is_err() && !is_new {
        outcome = attempt(model, (&rule, length), options, s, (w, true));
    }
    w.is_stale |= outcome.is_err();
    let (newton, violation) = outcome?;
    take_coordinates(model.team(), (&rule, true, model.n_unknowns()), s, (&w.dq, &w.v, &w.a));
    s.phi.copy_from_slice(&w.terms.phi);
    for k in 0..w.lambda.len() {
        s.lambda_previous[k] = s.lambda[k];
        s.lambda[k] = w.lambda[k];
        s.reaction[k] = w.lambda[k];
    }
    s.t += dt;
    add_work(model, dt, s, &mut w.terms);
    Ok(StepReport::of_newton(newton, w.counts, violation))
}

/// Report of the iteration (iterations, last correction, reason of its end), and the violations that remain.
type Done<T> = ((u32, T, Stop), [T; 3]);

/// Tries the step with the present independent coordinates or, if `is_new`, with newly selected ones.
fn attempt<T: Real, M: Model<T>>(
    model: &M,
    (rule, length): (&Rule<T>, T),
    options: &Options<T>,
    s: &State<T>,
    (w, is_new): (&mut Workspace<T>, bool),
) -> Result<Done<T>, StepError> {
    let n = model.n_unknowns();
    if is_new {
        select_pivots(model, s, w)?;
    }
    predict(model, (rule, length), s, w);
    if !norm_inf(&w.dq[..n]).is_finite() {
        return Err(StepError::NotFinite { unknown: largest_or_nan(&w.dq[..n]) });
    }
    if options.coordinates == Coordinates::Tangent {
        w.set_chart(model, rule.dt, s)?;
        predict(model, (rule, length), s, w);
        w.predict_chart();
    }
    model.set_inputs(s.t + rule.dt, s, &mut w.terms);
    w.place(model, (rule, length), options, s)?;
    let newton = iterate(model, (rule, length), options, s, w)?;
    check_guides(model, &w.q, &w.terms)?;
    check_rotations(model, &w.terms)?;
    check_lines(model, s, &w.dq)?;
    let violation = check_violation(model, length, w)?;
    Ok((newton, violation))
}

/// Predicts the increment, velocity and acceleration of all unknowns.
fn predict<T: Real, M: Model<T>>(
    model: &M,
    (rule, length): (&Rule<T>, T),
    s: &State<T>,
    w: &mut Workspace<T>,
) {
    let n = model.n_unknowns();
    for i in 0..n {
        (w.dq[i], w.v[i], w.a[i]) = rule.predict(s.v[i], s.a[i], s.a_aux[i]);
    }
    if is_far(step_scale(model.team(), rule.dt, &s.a[..n]), length) {
        rule.hold_back(T::ONE, [&mut w.dq[..n], &mut w.v, &mut w.a], &s.a_aux);
    }
}

/// Runs the Newton loop in the independent coordinates. Leaves q, v and a consistent, and lambda in balance with them.
fn iterate<T: Real, M: Model<T>>(
    model: &M,
    (rule, length): (&Rule<T>, T),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T>,
) -> Result<(u32, T, Stop), StepError> {
    let n = model.n_unknowns();
    let team = model.team();
    let scale = step_scale(team, rule.dt, &s.a[..n]).max(step_scale(team, rule.dt, &w.a[..n]));
    let mut last = T::ZERO;
    residual(model, w);
    for iterations in 1..=options.max_iterations {
        if w.d.is_empty() {
            break;
        }
        check_finite(w)?;
        factor(model, rule, options, w)?;

        // R^T (M + ...) R d = -f/a'   [P1 (42)]
        for d in &mut w.d {
            *d = -*d / rule.acceleration;
        }
        SpdSolver::solve(&w.solver, &mut w.d, &mut w.wanted);

        // z += d,  z' += v' d,  z'' += a' d   [P1 (40)]; the dependent unknowns change by R d
        w.basis.expand(&w.elimination, &w.d, &mut w.change);
        for i in 0..n {
            w.dq[i] += w.change[i];
            w.v[i] += rule.velocity * w.change[i];
            w.a[i] += rule.acceleration * w.change[i];
        }
        let correction = norm_inf(&w.d);
        check_finite(w)?;
        w.place(model, (rule, length), options, s)?;
        residual(model, w);

        let [moved, place] = NOISE.map(T::from_f64);
        let digits = moved * norm_inf(&w.dq[..n]) + place * length;
        let noise = T::EPSILON * digits;
        if let Some(stop) = stopping((correction, last), (scale * options.tolerance, noise)) {
            return Ok((iterations, correction, stop));
        }
        last = correction;
    }
    if last <= scale * T::from_f64(ENOUGH) {
        let iterations = if w.d.is_empty() { 0 } else { options.max_iterations };
        let stop = if w.d.is_empty() { Stop::Converged } else { Stop::Tolerance };
        return Ok((iterations, last, stop));
    }
    let unknown = w.elimination.independent()[largest(&w.d) as usize];
    let (iterations, correction) = (options.max_iterations, (last / length).to_f64());
    Err(StepError::NotConverged { iterations, correction, unknown })
}

/// Writes f = (M a - Q)_i + J_i^T lambda into `d`, with J_d^T lambda = (Q - M a)_d   [P1 (43)].
fn residual<T: Real, M: Model<T>>(model: &M, w: &mut Workspace<T>) {
    if model.has_forces() {
        model.evaluate_forces(&w.q, &w.v, &mut w.terms);
    }
    w.balance(model, T::ONE);
    w.solve_transposed();
    w.jacobian.add_transposed(&w.lambda, &mut w.balance);
    for (d, &i) in w.d.iter_mut().zip(w.elimination.independent()) {
        *d = w.balance[i as usize];
    }
}

/// Fails if the residual or correction in `d` is not finite.
fn check_finite<T: Real>(w: &Workspace<T>) -> Result<(), StepError> {
    if norm_inf(&w.d).is_finite() {
        return Ok(());
    }
    let unknown = w.elimination.independent()[largest_or_nan(&w.d) as usize];
    Err(StepError::NotFinite { unknown })
}

/// Factors R^T (M + (v'/a') C + (1/a') (K + K_geo(lambda))) R. K_geo is left out where it makes the matrix indefinite.
fn factor<T: Real, M: Model<T>>(
    model: &M,
    rule: &Rule<T>,
    options: &Options<T>,
    w: &mut Workspace<T>,
) -> Result<(), StepError> {
    for (mu, &lambda) in w.mu.iter_mut().zip(&w.lambda) {
        *mu = lambda / rule.acceleration;
    }
    let mut failure = FactorError { unknown: 0, pivot: 0.0 };
    for is_geometric in [true, false] {
        if is_geometric && !options.geometric_stiffness {
            continue;
        }
        let tangent = Tangent {
            stiffness: T::ONE / rule.acceleration,
            damping: rule.velocity / rule.acceleration,
            penalty: &[],
            geometric: is_geometric.then_some(&w.mu[..]),
        };
        let load = Load { mass: None, multipliers: None, force: T::ZERO };
        let system = System { model, terms: &w.terms, tangent, load };
        w.basis.project(&w.elimination, &system, &mut w.tangent);
        match SpdSolver::factor(&mut w.solver, &w.tangent) {
            Ok(()) => return Ok(()),
            Err(error) => failure = error,
        }
    }
    failure.unknown = w.elimination.independent()[failure.unknown as usize];
    Err(StepError::Singular(failure))
}

/// Decides from the last two corrections whether the iteration ends.
fn stopping<T: Real>((correction, last): (T, T), (goal, noise): (T, T)) -> Option<Stop> {
    if correction <= goal {
        return Some(Stop::Converged);
    }
    let is_slow = correction > last * T::HALF;
    if last > T::ZERO && !is_slow && correction * correction <= goal * last {
        Some(Stop::Converged)
    } else if last > T::ZERO && is_slow && correction <= noise {
        Some(Stop::Rounding)
    } else {
        None
    }
}

/// Checks the violations of all rows. A dropped row that is violated is no longer dependent.
fn check_violation<T: Real, M: Model<T>>(
    model: &M,
    length: T,
    w: &mut Workspace<T>,
) -> Result<[T; 3], StepError> {
    let share = T::from_f64(VIOLATION).max(T::EPSILON * T::from_f64(VIOLATION_ROUNDINGS));
    let mut violation = [norm_inf(&w.terms.phi), T::ZERO, T::ZERO];
    let mut limit = share * length;
    for level in 0..3 {
        let rows = match level {
            0 => &w.terms.phi,
            1 => {
                limit = share * (length + norm_inf(&w.v));
                violation[1] = w.velocity_rates(model);
                &w.rates
            }
            _ => {
                limit = share * (T::ONE + norm_inf(&w.a).max(norm_inf(&w.terms.phi_bias)));
                violation[2] = w.acceleration_rates(model);
                &w.rates
            }
        };
        if violation[level] <= limit {
            continue;
        }
        let row = largest(rows);
        let violation = violation[level].to_f64();
        if w.elimination.dropped_rows().contains(&row) {
            w.is_stale = true;
            w.choose_columns()?;
        }
        let level = [0_u8, 1, 2][level];
        return Err(StepError::Violated { level, violation, row });
    }
    Ok(violation)
}
