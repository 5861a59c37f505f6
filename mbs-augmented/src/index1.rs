//! Index-1 augmented Lagrangian with projections of positions and velocities inside the iteration [P1 2.2].
//!
//! ```text
//! q, v <- projected from the integrator's q*, v*                                     [P1 (8)-(14)]
//! f = M a + J^T (alpha (J a + bias) + lambda) - Q                                     [P1 (5)]
//! T = M + J^T alpha J + (v'/a') C + (1/a') K                                          [P1 (36)]
//! T d = -f,   a += d,   q* += d/a',   v* += v' d/a',   lambda <- lambda + alpha phi'' [P1 (7), (34)]
//! ```
//!
//! The method differs from the published one. Positions and velocities are projected within the iteration, in correction form. Multipliers
//! start from the last step. alpha is proportional to the mass and does not grow with 1/dt^2. With the published order, which projects after
//! the converged iteration, the method fails at the first singular position.

mod constrain;

use crate::options::Options;
use crate::workspace::Workspace;
use constrain::{constrain, velocities};
use mbs_core::implicit::{self, ConstraintLevel, Solved};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport, Stop, largest, largest_or_nan};
use mbs_core::team::{add_product, norm_inf, set_sum, subtract};
use mbs_core::{Real, SpdSolver};

/// Factor on the allowed number of iterations while the last correction is not small [-]. Friction and suddenly released stiff effects need
/// more iterations.
const HARD: u32 = 8;
/// Largest correction, relative to the accelerations, with which an iteration is accepted that does not converge [-]. A joint that sticks
/// and slips leaves corrections of this size.
const ACCEPTED: f64 = 1e-2;
/// Largest number of corrections of [`settle`] [-]. The first correction leaves 1e-6 of an acceleration. The others reduce the error to
/// machine precision.
const MAX_SETTLING: u32 = 12;

/// Advances `s` by one [`Step`].
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn step<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    step: Step<T>,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    implicit::step(model, step, options, s, w, |(rule, length), s, w| {
        let size = norm_inf(model.team(), &s.a);
        begin(model, (rule, is_far(size * rule.dt * rule.dt * T::HALF, length)), options, s, w);
        let newton = iterate(model, (rule, size, length), options, s, w)?;
        let velocity = constrain(model, (rule, length, false), options, s, w)?;
        let level = ConstraintLevel::Acceleration;
        let limits = level.limits(model, &w.end, length, &mut w.equations.terms)?;
        let acceleration = w.projector(model, level).project(limits, options.max_sweeps)?;
        let violation = [norm_inf(model.team(), &w.terms().phi), velocity, acceleration];
        Ok(Solved { newton, violation, unit: T::ONE })
    })
}

/// Iterates on the accelerations; `size` is the size of the accelerations in the last step. Returns the report of the iteration.
fn iterate<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, size, length): (&Rule<T>, T, T),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(u32, T, Stop), StepError> {
    let moved = norm_inf(model.team(), &s.v) / rule.dt * T::EPSILON;
    let goal = size.max(moved) * options.tolerance;
    // A correction is accepted if it is small relative to the accelerations or to the coordinates. This applies to a correction that no
    // longer shrinks, and to the last allowed one.
    let digits = length * options.tolerance * rule.acceleration;
    let enough = |w: &Workspace<T, S>| {
        size.max(norm_inf(model.team(), &w.end.a)) * T::from_f64(ACCEPTED) + digits
    };
    let (mut last, mut iterations) = (T::ZERO, 0);
    let most = options.max_iterations.saturating_mul(HARD);
    let stop = loop {
        let is_used = iterations >= options.max_iterations;
        if iterations >= most || is_used && last <= enough(w) {
            break None;
        }
        iterations += 1;
        constrain(model, (rule, length, iterations == 1), options, s, w)?;
        let correction = newton(model, rule, w)?;
        let before = core::mem::replace(&mut last, correction);
        if correction <= goal || (iterations > 1 && correction * correction <= goal * before) {
            break Some(Stop::Converged);
        }
        if iterations > 1 && correction > before * T::HALF && correction <= enough(w) {
            break Some(Stop::Rounding);
        }
    };
    let correction = last / rule.acceleration;
    if stop.is_none() && !(last <= enough(w)) {
        let (correction, unknown) = ((correction / length).to_f64(), largest(&w.equations.f));
        return Err(StepError::NotConverged { iterations, correction, unknown });
    }
    Ok((iterations, correction, stop.unwrap_or(Stop::Tolerance)))
}

/// Makes velocities, accelerations and multipliers consistent at the present positions [P2 (5)], before a change of index. Positions do not
/// change.
///
/// Cost: one or two factorisations and a few solutions; no allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn settle<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    length: T,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    // In a step of zero length nothing moves. So stiffness and damping are not part of the matrix.
    let zero = T::ZERO;
    let rule =
        Rule { dt: zero, velocity: zero, acceleration: T::ONE, auxiliary: zero, alpha_f: zero };
    begin(model, (&rule, false), options, s, w);
    w.end.v.copy_from_slice(&s.v);
    w.end.dq.fill(T::ZERO);
    w.end.evaluate(model, options.compensated, s, &mut w.equations.terms);
    w.factor_mass(model)?;
    velocities(model, (length, false), options, w)?;
    w.end.evaluate_forces(model, &mut w.equations.terms);
    model.evaluate_bias(&w.end.q, &w.end.v, &mut w.equations.terms);
    settle_accelerations(model, length, options, s, w)?;

    w.settled = w.equations.counts;
    w.projection.sigma.fill(T::ZERO);
    let n = w.equations.f.len();
    s.v[..n].copy_from_slice(&w.end.v[..n]);
    for to in [&mut s.a, &mut s.a_aux] {
        to[..n].copy_from_slice(&w.end.a[..n]);
    }
    for to in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
        to.copy_from_slice(&w.lambda);
    }
    s.applied.copy_from_slice(&s.inputs);
    if model.has_forces() || model.has_guides() {
        s.power = model.power(&s.q, &s.v, &s.reaction, w.terms());
    }
    Ok(())
}

/// Solves for accelerations and multipliers with the terms of the last evaluation.
fn settle_accelerations<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    length: T,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let goal = norm_inf(model.team(), &s.a).max(T::ONE) * options.tolerance;
    let (mut last, mut iterations) = (T::ZERO, 0);
    while iterations < MAX_SETTLING {
        iterations += 1;
        let correction = correct(model, w)?;
        let is_slow = iterations > 1 && correction > last * T::HALF;
        last = correction;
        if correction <= goal || is_slow {
            break;
        }
    }
    if last <= norm_inf(model.team(), &w.end.a).max(T::ONE) * options.tolerance.sqrt() {
        return Ok(());
    }
    let (correction, unknown) = ((last / length).to_f64(), largest(&w.equations.f));
    Err(StepError::NotConverged { iterations, correction, unknown })
}

/// Begins a step with the accelerations and multipliers of the last step as first guess.
fn begin<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, is_far): (&Rule<T>, bool),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    w.begin(model, (options.penalty, T::ONE, T::ONE));
    w.end.predict(model, (rule, T::ONE, is_far), s);
    w.lambda.copy_from_slice(&s.lambda);
    model.set_inputs(s.t + rule.dt, s, &mut w.equations.terms);
}

/// Makes one correction of the accelerations at (q, v). Returns its size [m/s^2].
fn newton<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    if model.has_forces() {
        // The factor for the projections contains the mass alone. Stiffness and damping need another factor.
        w.end.evaluate_forces(model, &mut w.equations.terms);
        w.factor(model, rule, false)?;
    }
    model.evaluate_bias(&w.end.q, &w.end.v, &mut w.equations.terms);
    correct(model, w)
}

/// Makes one correction of accelerations and multipliers with the present factor. Returns its size [m/s^2].
fn correct<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    w.projector(model, ConstraintLevel::Acceleration).violation();
    let (eq, s, rates) = (&mut w.equations, &w.scale.weights, &w.projection.rates);
    set_sum(model.team(), &mut eq.mu, &w.lambda, (s, rates));
    eq.assemble(model, Some(&w.end.a), T::ONE);
    eq.solve();
    subtract(model.team(), &mut w.end.a[..eq.f.len()], &eq.f);
    w.projector(model, ConstraintLevel::Acceleration).violation();
    add_product(model.team(), &mut w.lambda, (&w.scale.weights, &w.projection.rates));
    let correction = norm_inf(model.team(), &w.equations.f);
    if correction.is_finite() {
        Ok(correction)
    } else {
        Err(StepError::NotFinite { unknown: largest_or_nan(&w.equations.f) })
    }
}
