//! Index-3 augmented Lagrangian with mass-orthogonal projections [P1 2.3], [P3 2.1].
//!
//! ```text
//! M q'' + J^T (alpha phi + lambda) = Q          lambda <- lambda + alpha phi        [P3 (1), (2)]
//! f = M a/a' + J^T (s phi + lambda/a') - Q/a'                                        [P3 (9)]
//! T = M + (v'/a') C + (1/a') K + J^T s J,   s = alpha / a'                           [P3 (10)]
//! T d = -f,   q += d,   v += v' d,   a += a' d                                       [P3 (8), (4), (5)]
//! ```
//!
//! Differs from the source: unknowns are increments; s is in proportion to the mass, so that conditioning does not depend on the
//! step; the start value of lambda is filtered, lambda <- s J T^-1 J^T lambda, where the constraints do not feel all of it; projections are
//! in correction form, by one sweep where nothing but constraints acts; a factor is kept while laws are like those that were factored,
//! with its own rows J' beside s phi and lambda <- lambda + s (phi + J' d); where effects act a share of the first correction may be
//! left. The printed forms are options.

use crate::inputs::take_inputs;
use crate::options::{Multipliers, Options, Penalty, Projection};
use crate::pace::Pace;
use crate::projection::Level;
use crate::workspace::{Mass, Workspace};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Model, State};
use mbs_core::step::{
    ConvergenceCriterion, Counts, Step, StepError, StepReport, Stop, check_guides, check_rotations,
    largest, largest_or_nan, step_scale, stopping,
};
use mbs_core::team::{add_product, norm_inf, on_stretches, set_product, set_sum};
use mbs_core::{Real, SpdSolver};

/// Advances `s` by one [`Step`].
///
/// Cost: about three evaluations, a factorisation and five back-substitutions where nothing but constraints acts and all of them
/// are well determined; else two factorisations and eight back-substitutions or more. No allocation.
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
    w.boost = w.kept_boost();
    w.base = options.penalty.factor();
    let scale = step_scale(model.team(), rule.dt, &s.a[..w.f.len()]);
    begin(model, (&rule, is_far(scale, length)), options, s, w);

    let (newton, since) = iterate(model, &rule, (scale, length), options, s, w)?;

    // The accelerations leave the scaling of the iteration.
    on_stretches(model.team(), [&mut w.a], |_, [a]| {
        a.iter_mut().for_each(|a| *a *= rule.acceleration)
    });
    let violation = clean(model, &rule, (since, length), options, w)?;
    check_rotations(model, &w.terms)?;
    w.commit(model, &rule, options.compensated, rule.acceleration, s);
    Ok(w.report(newton, violation))
}

/// Predicts q, v, a and lambda at the end of the step, and evaluates there.
fn begin<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, is_far): (&Rule<T>, bool),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    let inverse = T::ONE / rule.acceleration;
    let n = w.f.len();
    let coordinates = [&mut w.dq[..n], &mut w.v[..n], &mut w.a[..n], &mut w.q[..n]];
    on_stretches(model.team(), coordinates, |first, [dq, v, a, q]| {
        for k in 0..q.len() {
            let i = first + k;
            let predicted = rule.predict(s.v[i], s.a[i], s.a_aux[i]);
            (dq[k], v[k], a[k]) = (predicted.0, predicted.1, predicted.2 * inverse);
            q[k] = s.q[i] + dq[k];
        }
    });
    if is_far {
        rule.hold_back(inverse, [&mut w.dq[..n], &mut w.v, &mut w.a], &s.a_aux);
        for (k, q) in w.q[..n].iter_mut().enumerate() {
            *q = s.q[k] + w.dq[k];
        }
    }
    let (expected, boost, masses) = (s.extrapolated(rule.dt), w.boost, &w.masses);
    let rows = [&mut w.lambda[..], &mut w.penalty];
    on_stretches(model.team(), rows, |first, [lambda, penalty]| {
        for k in 0..lambda.len() {
            lambda[k] = match options.multipliers {
                Multipliers::FromZero => T::ZERO,
                _ => expected(first + k) * inverse,
            };
            penalty[k] = match options.penalty {
                Penalty::Scaled(factor) => factor * boost * masses[first + k],
                Penalty::Fixed(alpha) => alpha * inverse,
            };
        }
    });
    model.set_inputs(s.t + rule.dt, s, &mut w.terms);
    evaluate(model, options, s, w);
}

/// phi, J and forces at the current q, v.
fn evaluate<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    if options.compensated {
        model.advance(&s.q, &w.dq, &s.phi, &mut w.terms);
    } else {
        model.evaluate(&w.q, &mut w.terms);
    }
    if model.has_forces() {
        model.evaluate_forces(&w.q, &w.v, &mut w.terms);
    }
}

/// The Newton loop. Returns iterations, the last correction and the sum of those since the factor, and what ended it.
fn iterate<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    (scale, length): (T, T),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<((u32, T, Stop), T), StepError> {
    let inverse = T::ONE / rule.acceleration;
    let mut pace = Pace::new(model, options);
    for iterations in 1..=options.max_iterations {
        let is_kept = pace.keeps_factor(rule, w);
        if !is_kept {
            factor(model, rule, options, w)?;
            pace.since = T::ZERO;
        }
        if iterations == 1 {
            if options.adaptive_penalty && w.adapt(model) {
                factor(model, rule, options, w)?;
            }
            if options.multipliers == Multipliers::Filtered
                && !(options.adaptive_penalty && w.is_all_felt())
            {
                filter(model, w);
            }
        }

        // f = M a/a' + J^T (s phi + lambda/a') - Q/a'   [P3 (9)]
        if is_kept && pace.is_balanced {
            w.balance_nearby(model, inverse);
        } else {
            set_sum(model.team(), &mut w.mu, &w.lambda, (&w.penalty, &w.terms.phi));
            w.assemble(model, Mass::Acceleration, inverse);
        }

        // T d = -f,   q += d,   v += v' d,   a += a' d   [P3 (8), (4), (5)]
        w.solve();
        if pace.is_balanced {
            w.take_multipliers(model);
        }
        correct(model, rule, s, w);
        evaluate(model, options, s, w);
        if iterations == 1 {
            w.penalty_energy = w.stored(model.team(), &w.terms.phi) * rule.acceleration;
        }

        // lambda <- lambda + alpha phi   [P3 (2)]
        if !pace.is_balanced {
            add_product(model.team(), &mut w.lambda, (&w.penalty, &w.terms.phi));
        }

        let correction = norm_inf(model.team(), &w.f);
        if !correction.is_finite() {
            return Err(StepError::NotFinite { unknown: largest_or_nan(&w.f) });
        }
        pace.since += correction;
        // the first correction, and a small one, are not measured by rounding
        let is_small = correction <= scale * options.tolerance;
        let is_measured = options.compensated && iterations > 1 && !is_small;
        let moved = is_measured.then(|| norm_inf(model.team(), &w.dq[..w.f.len()]));
        let measures = (scale, options.tolerance);
        let sizes = (length, || norm_inf(model.team(), &w.q));
        let criterion = ConvergenceCriterion::of_coordinates(iterations, measures, sizes, moved);
        let stop = stopping(iterations, correction, pace.last(), &criterion);
        let stop = stop.or(pace.is_enough(correction).then_some(Stop::Converged));
        if let Some(stop) = stop {
            return Ok(((iterations, correction, stop), pace.since));
        }
        pace.note(correction);
    }
    let last = pace.last();
    if last <= scale * T::from_f64(1e-6) {
        return Ok(((options.max_iterations, last, Stop::Tolerance), pace.since));
    }
    let (iterations, unknown) = (options.max_iterations, largest(&w.f));
    Err(StepError::NotConverged { iterations, correction: (last / length).to_f64(), unknown })
}

/// q += d,   v += v' d,   a += a' d   with d = -f
fn correct<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    let (n, f) = (w.f.len(), &w.f);
    let coordinates = [&mut w.dq[..n], &mut w.v[..n], &mut w.a[..n], &mut w.q[..n]];
    on_stretches(model.team(), coordinates, |first, [dq, v, a, q]| {
        let n = q.len();
        let (f, q_n) = (&f[first..][..n], &s.q[first..][..n]);
        for k in 0..n {
            dq[k] -= f[k];
            q[k] = q_n[k] + dq[k];
            v[k] -= rule.velocity * f[k];
            a[k] -= f[k];
        }
    });
}

/// Do only constraints act, all of which are felt, so that T differs from M + J^T s J by little, and the rows that it was made with
/// serve in place of those of now?
fn is_nearby<T: Real, M: Model<T>, S>(model: &M, options: &Options<T>, w: &Workspace<T, S>) -> bool
where
    S: SpdSolver<T>,
{
    let is_default = options.projection == Projection::Correction && options.adaptive_penalty;
    is_default && !model.has_forces() && w.is_all_felt()
}

/// T, with the geometric stiffness where it is wanted and leaves T positive definite.
fn factor<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let weights = (T::ONE / rule.acceleration, rule.velocity / rule.acceleration);
    if options.geometric_stiffness && w.factor(model, weights, true).is_ok() {
        return Ok(());
    }
    Ok(w.factor(model, weights, false)?)
}

/// lambda <- s J T^-1 J^T lambda: removes what the constraints cannot feed.
fn filter<T: Real, M: Model<T>, S: SpdSolver<T>>(model: &M, w: &mut Workspace<T, S>) {
    w.mu.copy_from_slice(&w.lambda);
    w.assemble(model, Mass::None, T::ZERO);
    w.solve();
    w.multiply_correction(model);
    set_product(model.team(), &mut w.lambda, (&w.penalty, &w.mu));
}

/// Penalties raised by more than this are taken back before velocities and accelerations are projected.
const MILD: f64 = 100.0;

/// Projects velocities and accelerations. Returns the violation of the three levels.
fn clean<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    (since, length): (T, T),
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<[T; 3], StepError> {
    // The factor belongs to the configuration before the last corrections: near enough when they were small.
    let is_nearby = is_nearby(model, options, w);
    // A combination of constraints that is almost lost must not be enforced on velocities and accelerations beyond need: they
    // would grow like 1 / sigma there. Penalties raised far for the iteration are taken back, but where its own factor projects.
    let raised = w.boost;
    let is_taken_back =
        raised > T::from_f64(MILD) && options.projection != Projection::PrintedTangent;
    if is_taken_back {
        w.scale_penalties(T::ONE / raised);
    }
    // With rows of now and a factor that has others, s times their turn of a violation would go along free directions; with a factor that
    // has stiffness and damping, what their share of the mass is.
    let is_stale = is_taken_back || !is_nearby || since > length * T::from_f64(1e-7);
    if options.projection == Projection::Correction && is_stale {
        if is_nearby {
            factor(model, rule, options, w)?;
        } else {
            // Nothing but the mass and the rows: a sweep leaves what the penalties leave.
            w.factor(model, (T::ZERO, T::ZERO), false)?;
        }
    }
    if model.has_guides() {
        model.evaluate_phi_t(&w.q, &mut w.terms);
        check_guides(model, &w.q, &w.terms)?;
    }
    let sweeps = options.max_sweeps;
    let n = w.f.len();
    let speed = norm_inf(model.team(), &w.v[..n]);
    let velocity = match options.projection {
        Projection::Correction => {
            let size = [length + speed, speed];
            w.clean(model, (Level::Velocity, is_nearby), size, sweeps)?
        }
        Projection::Printed { sweeps } => {
            // W = M + J^T alpha J with alpha as it is: the penalty of the iteration is alpha / a'.
            for p in &mut w.penalty {
                *p *= rule.acceleration;
            }
            w.factor(model, (T::ZERO, T::ZERO), false)?;
            w.project_as_printed(model, Level::Velocity, sweeps)
        }
        Projection::PrintedTangent => w.project_with_tangent(model, Level::Velocity),
    };
    model.evaluate_bias(&w.q, &w.v, &mut w.terms);
    let size = norm_inf(model.team(), &w.a[..n]).max(norm_inf(model.team(), &w.terms.phi_bias));
    let acceleration = match options.projection {
        Projection::Correction => {
            let size = [T::ONE + size, size];
            w.clean(model, (Level::Acceleration, is_nearby), size, sweeps)?
        }
        Projection::Printed { sweeps } => w.project_as_printed(model, Level::Acceleration, sweeps),
        Projection::PrintedTangent => w.project_with_tangent(model, Level::Acceleration),
    };
    if model.has_guides() {
        balance(model, rule, w);
    }
    w.boost = raised;
    Ok([norm_inf(model.team(), &w.terms.phi), velocity, acceleration])
}

/// sigma <- sigma - s J T^-1 (M a + J^T (lambda + sigma) - Q): multipliers in balance with the projected accelerations.
///
/// What the last correction left stands in lambda, and with it in the power of guides; where multipliers grow as printed, alpha times the
/// rounding of phi (4e-4 N for 1 kg at 1 ms).
fn balance<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    w: &mut Workspace<T, S>,
) {
    for k in 0..w.mu.len() {
        w.mu[k] = w.lambda[k] * rule.acceleration + w.sigma[k];
    }
    w.assemble(model, Mass::Acceleration, T::ONE);
    w.solve();
    w.multiply_correction(model);
    for k in 0..w.sigma.len() {
        w.sigma[k] -= w.penalty[k] * w.mu[k];
    }
}
