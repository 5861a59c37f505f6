//! Index-1 augmented Lagrangian with projections of positions and velocities inside the iteration [P1 2.2].
//!
//! ```text
//! q, v <- projected from the integrator's q*, v*                                     [P1 (8)-(14)]
//! f = M a + J^T (alpha (J a + bias) + lambda) - Q                                     [P1 (5)]
//! T = M + J^T alpha J + (v'/a') C + (1/a') K                                          [P1 (36)]
//! T d = -f,   a += d,   q* += d/a',   v* += v' d/a',   lambda <- lambda + alpha phi'' [P1 (7), (34)]
//! ```
//!
//! Differs from the source: positions and velocities are projected within the iteration, in correction form; multipliers start
//! from the last step; alpha is in proportion to the mass and does not grow with 1/dt^2. Iterated to convergence with the
//! projections after the step, as printed, the method fails at the first singular position.

use crate::inputs::take_inputs;
use crate::options::{Options, Penalty};
use crate::projection::{Level, ResidualLimits};
use crate::workspace::{Mass, Workspace};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Model, State};
use mbs_core::step::{
    Counts, Step, StepError, StepReport, Stop, check_guides, check_rotations, largest,
    largest_or_nan,
};
use mbs_core::team::{add_product, norm_inf, on_stretches, set_product, set_sum, subtract};
use mbs_core::{Real, SpdSolver};

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
    let Step { dt, length } = step.checked()?;
    options.validate()?;
    take_inputs(model, s, w)?;
    let rule = options.integrator.rule(dt);
    w.counts = Counts::default();
    w.boost = T::ONE;
    w.base = options.penalty.factor();
    begin(model, &rule, options, s, w);
    let (mut last, mut done) = (T::ZERO, None);
    let size = norm_inf(model.team(), &s.a);
    if is_far(size * dt * dt * T::HALF, length) {
        let n = w.f.len();
        rule.hold_back(T::ONE, [&mut w.dq[..n], &mut w.v, &mut w.a], &s.a_aux);
    }
    let goal = size.max(norm_inf(model.team(), &s.v) / dt * T::EPSILON) * options.tolerance;
    // What no longer shrinks, or is left after few iterations, is enough where it is small beside the accelerations or in the
    // coordinates. A joint that sticks and slips by turns leaves more.
    let digits = length * options.tolerance * rule.acceleration;
    let enough = |size: T, w: &Workspace<T, S>| {
        size.max(norm_inf(model.team(), &w.a)) * T::from_f64(1e-2) + digits
    };
    let mut iterations = 0;
    let most = options.max_iterations.saturating_mul(HARD);
    while done.is_none() && iterations < most {
        if iterations >= options.max_iterations && last <= enough(size, w) {
            break;
        }
        iterations += 1;
        constrain(model, (&rule, length, iterations == 1), options, s, w)?;
        let correction = newton(model, &rule, w)?;
        done = if correction <= goal || (iterations > 1 && correction * correction <= goal * last) {
            Some(Stop::Converged)
        } else if iterations > 1 && correction > last * T::HALF && correction <= enough(size, w) {
            Some(Stop::Rounding)
        } else {
            None
        };
        last = correction;
    }
    let correction = last / rule.acceleration;
    if done.is_none() && !(last <= enough(size, w)) {
        let relative = (correction / length).to_f64();
        return Err(StepError::NotConverged {
            iterations,
            correction: relative,
            unknown: largest(&w.f),
        });
    }
    let velocity = constrain(model, (&rule, length, false), options, s, w)?;
    model.evaluate_bias(&w.q, &w.v, &mut w.terms);
    let size = norm_inf(model.team(), &w.a).max(norm_inf(model.team(), &w.terms.phi_bias));
    let rounding = T::EPSILON * T::from_f64(1024.0);
    let limit = (T::ONE + size) * T::from_f64(5e-10).max(rounding);
    let goal = size * rounding;
    let left = ResidualLimits { goal, enough: goal, limit };
    let acceleration = w.project(model, Level::Acceleration, left, options.max_sweeps)?;
    check_rotations(model, &w.terms)?;
    w.commit(model, &rule, options.compensated, T::ONE, s);
    let violation = [norm_inf(model.team(), &w.terms.phi), velocity, acceleration];
    let newton = (iterations, correction, done.unwrap_or(Stop::Tolerance));
    Ok(w.report(newton, violation))
}

/// Corrections of [`settle`] at most.
const MOST_SETTLING: u32 = 12;

/// Makes velocities, accelerations and multipliers consistent at the present positions [P2 (5)]: what a change of index begins
/// with. Positions stay.
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
    // A step of no length: nothing moves, and stiffness and damping have no part in the matrix.
    let rule = Rule {
        dt: T::ZERO,
        velocity: T::ZERO,
        acceleration: T::ONE,
        auxiliary: T::ZERO,
        alpha_f: T::ZERO,
    };
    w.counts = Counts::default();
    w.boost = T::ONE;
    w.base = options.penalty.factor();
    begin(model, &rule, options, s, w);
    w.q.copy_from_slice(&s.q);
    w.v.copy_from_slice(&s.v);
    w.dq.fill(T::ZERO);
    move_to(model, options, s, w);
    w.factor(model, (T::ZERO, T::ZERO), false)?;
    velocities(model, (length, false), options, w)?;
    if model.has_forces() {
        model.evaluate_forces(&w.q, &w.v, &mut w.terms);
    }
    model.evaluate_bias(&w.q, &w.v, &mut w.terms);
    let goal = norm_inf(model.team(), &s.a).max(T::ONE) * options.tolerance;
    let mut last = T::ZERO;
    let mut iterations = 0;
    while iterations < MOST_SETTLING {
        iterations += 1;
        let correction = correct(model, w)?;
        let is_slow = iterations > 1 && correction > last * T::HALF;
        last = correction;
        if correction <= goal || is_slow {
            break;
        }
    }
    if !(last <= norm_inf(model.team(), &w.a).max(T::ONE) * options.tolerance.sqrt()) {
        let (correction, unknown) = ((last / length).to_f64(), largest(&w.f));
        return Err(StepError::NotConverged { iterations, correction, unknown });
    }
    w.settled = w.counts;
    w.sigma.fill(T::ZERO);
    let n = w.f.len();
    s.v[..n].copy_from_slice(&w.v[..n]);
    s.a[..n].copy_from_slice(&w.a[..n]);
    s.a_aux[..n].copy_from_slice(&w.a[..n]);
    for to in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
        to.copy_from_slice(&w.lambda);
    }
    s.applied.copy_from_slice(&s.inputs);
    if model.has_forces() || model.has_guides() {
        s.power = model.power(&s.q, &s.v, &s.reaction, &w.terms);
    }
    Ok(())
}

/// Accelerations and multipliers of the last step are the first guess.
fn begin<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    let n = w.f.len();
    on_stretches(model.team(), [&mut w.a[..n]], |first, [a]| {
        for (k, a) in a.iter_mut().enumerate() {
            let i = first + k;
            *a = rule.predict(s.v[i], s.a[i], s.a_aux[i]).2;
        }
    });
    for k in 0..w.lambda.len() {
        w.lambda[k] = s.lambda[k];
        w.penalty[k] = match options.penalty {
            Penalty::Scaled(factor) => factor * w.masses[k],
            Penalty::Fixed(alpha) => alpha,
        };
    }
    model.set_inputs(s.t + rule.dt, s, &mut w.terms);
}

/// q, v from the accelerations by the integrator, projected; the matrix W at q is left factored. Returns |phi'|.
fn constrain<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, length, is_first): (&Rule<T>, T, bool),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    let inverse = T::ONE / rule.acceleration;
    let (n, a) = (w.f.len(), &w.a);
    let vectors = [&mut w.dq[..n], &mut w.v[..n], &mut w.dq_predicted[..n]];
    on_stretches(model.team(), vectors, |first, [dq, v, dq_predicted]| {
        for k in 0..dq.len() {
            let i = first + k;
            let predicted = rule.predict(s.v[i], s.a[i], s.a_aux[i]);
            dq[k] = predicted.0 + (a[i] - predicted.2) * inverse;
            v[k] = predicted.1;
            dq_predicted[k] = predicted.0;
        }
    });
    positions(model, length, options, s, w)?;
    // The velocity follows the projected position, so that both tell of the same motion near a singular position.
    let (dq, dq_predicted) = (&w.dq, &w.dq_predicted);
    on_stretches(model.team(), [&mut w.v[..n]], |first, [v]| {
        for k in 0..v.len() {
            v[k] += rule.velocity * (dq[first + k] - dq_predicted[first + k]);
        }
    });
    velocities(model, (length, is_first), options, w)
}

/// Projects the velocities at q with W factored there, which is left so. Returns |phi'|.
fn velocities<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (length, is_first): (T, bool),
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    let speed = norm_inf(model.team(), &w.v);
    let rounding = T::EPSILON * T::from_f64(16.0);
    if model.has_guides() {
        model.evaluate_phi_t(&w.q, &mut w.terms);
        check_guides(model, &w.q, &w.terms)?;
    }
    if is_first {
        w.violation(model, Level::Velocity);
        w.penalty_energy = w.stored(model.team(), &w.rates);
    }
    let limit = (length + speed) * T::from_f64(5e-10).max(rounding * T::from_f64(64.0));
    let goal = speed * rounding;
    let left = ResidualLimits { goal, enough: goal, limit };
    let left = w.project(model, Level::Velocity, left, options.max_sweeps)?;
    if w.restore_penalties() {
        w.factor(model, (T::ZERO, T::ZERO), false)?;
    }
    Ok(left)
}

/// Times the allowed iterations that are made where what is left is not small after them: of friction, or of stiff effects let go.
const HARD: u32 = 8;
/// What rounding leaves of the constraints, in EPSILON of what their coordinates went: penalties are not raised for it.
const ROUNDING: f64 = 64.0;

/// W d = -J^T s phi,   q += d: until phi is at rounding.
///
/// Every sweep begins from where the last one ended. The multipliers of all together, as [P1 (8)-(10)] carries them, would make the whole way
/// orthogonal and not each part of it, which differs by the square of the way; as their rows turn they push light pieces off, the more
/// the heavier those are that they carry.
fn positions<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    length: T,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let goal = length * T::EPSILON * T::from_f64(if options.compensated { 0.01 } else { 4.0 });
    // The iteration knows positions to its tolerance: a residual below it that no sweep lowers says nothing more.
    let limit = length * options.tolerance.max(T::EPSILON * T::from_f64(256.0));
    move_to(model, options, s, w);
    // Directions are numbers without a unit: in a scene of a millimetre they go further than the places.
    let moved = norm_inf(model.team(), &w.dq[..w.f.len()]).max(length * T::EPSILON);
    let moved = if options.compensated { moved } else { length.max(T::ONE) };
    let rounding = moved * T::EPSILON * T::from_f64(ROUNDING);
    let mut violation = norm_inf(model.team(), &w.terms.phi);
    for _ in 0..options.max_sweeps {
        w.factor_raised(model)?;
        if violation <= goal {
            break;
        }
        set_product(model.team(), &mut w.mu, (&w.penalty, &w.terms.phi));
        w.assemble(model, Mass::None, T::ZERO);
        w.solve();
        let n = w.f.len();
        subtract(model.team(), &mut w.dq[..n], &w.f);
        move_to(model, options, s, w);
        let left = norm_inf(model.team(), &w.terms.phi);
        let contraction = left / violation;
        violation = left;
        let is_slow = contraction > T::from_f64(0.1) && violation > rounding;
        let is_raised = is_slow && w.raise_penalties(contraction);
        if contraction > T::from_f64(0.9) && !is_raised {
            break;
        }
    }
    // What is almost lost is enforced on positions only: velocities and accelerations would grow like 1 / sigma there.
    if w.restore_penalties() {
        w.factor(model, (T::ZERO, T::ZERO), false)?;
    }
    if violation <= limit.max(rounding) {
        return Ok(());
    }
    Err(StepError::Violated { level: 0, violation: violation.to_f64(), row: largest(&w.terms.phi) })
}

fn move_to<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    let (n, dq) = (w.f.len(), &w.dq);
    on_stretches(model.team(), [&mut w.q[..n]], |first, [q]| {
        for k in 0..q.len() {
            q[k] = s.q[first + k] + dq[first + k];
        }
    });
    if options.compensated {
        model.advance(&s.q, &w.dq, &s.phi, &mut w.terms);
    } else {
        model.evaluate(&w.q, &mut w.terms);
    }
}

/// One correction of the accelerations at (q, v); returns its size [m/s^2].
fn newton<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    if model.has_forces() {
        // With stiffness or damping the matrix of the accelerations is not that of the projections.
        model.evaluate_forces(&w.q, &w.v, &mut w.terms);
        w.factor(model, (T::ONE / rule.acceleration, rule.velocity / rule.acceleration), false)?;
    }
    model.evaluate_bias(&w.q, &w.v, &mut w.terms);
    correct(model, w)
}

/// One correction of accelerations and multipliers with the matrix in hand; returns its size [m/s^2].
fn correct<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    w.violation(model, Level::Acceleration);
    set_sum(model.team(), &mut w.mu, &w.lambda, (&w.penalty, &w.rates));
    w.assemble(model, Mass::Acceleration, T::ONE);
    w.solve();
    let n = w.f.len();
    subtract(model.team(), &mut w.a[..n], &w.f);
    w.violation(model, Level::Acceleration);
    add_product(model.team(), &mut w.lambda, (&w.penalty, &w.rates));
    let correction = norm_inf(model.team(), &w.f);
    if correction.is_finite() {
        Ok(correction)
    } else {
        Err(StepError::NotFinite { unknown: largest_or_nan(&w.f) })
    }
}
