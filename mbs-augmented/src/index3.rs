//! Index-3 augmented Lagrangian with mass-orthogonal projections [P1 2.3], [P3 2.1].
//!
//! ```text
//! M q'' + J^T (alpha phi + lambda) = Q          lambda <- lambda + alpha phi        [P3 (1), (2)]
//! f = M a/a' + J^T (s phi + lambda/a') - Q/a'                                        [P3 (9)]
//! T = M + (v'/a') C + (1/a') K + J^T s J,   s = alpha / a'                           [P3 (10)]
//! T d = -f,   q += d,   v += v' d,   a += a' d                                       [P3 (8), (4), (5)]
//! ```
//!
//! The method differs from the published one. Unknowns are increments. s is proportional to the mass, so that the condition of T does not
//! depend on the step. Where the constraints do not determine all of lambda, its start value is filtered: lambda <- s J T^-1 J^T lambda.
//! Projections are in correction form, and one sweep is enough where only constraints act.
//!
//! A factor is reused while stiffness and damping are close to those that were factored. The term s phi then uses the factored rows J', and
//! multipliers grow by lambda <- lambda + s (phi + J' d). Where effects act, the iteration may end when the remaining correction is a small
//! fraction of the first one. docs/INDEX3.md derives these differences. The published forms are in [`printed`](crate::printed).

mod project;

use crate::multipliers::MultiplierStart::{self, Filtered};
use crate::multipliers::{filter, update_multipliers};
use crate::newton::{FactorReuse, StopRule, residual_with_reused_jacobian};
use crate::options::{Options, Penalty};
use crate::workspace::Workspace;
use mbs_core::implicit::{self, Newton, Solved};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport, Stop, step_scale};
use mbs_core::team::{add_product, set_sum};
use mbs_core::{Real, SpdSolver};
use project::project;

/// Advances `s` by one [`Step`].
///
/// Cost where only constraints act and all of them are well determined: about three evaluations, a factorisation and five
/// back-substitutions. In other steps: at least two factorisations and eight back-substitutions. No allocation.
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
        let (newton, since) = solve(model, (rule, length), (options, Filtered), s, w)?;
        let violation = project(model, (rule, since, length), options, w)?;
        Ok(Solved { newton, violation, unit: rule.acceleration })
    })
}

/// Solves for q, v, a and lambda at the end of the step, where the equations of motion and phi = 0 hold. Returns the report of the iteration,
/// and the sum of the corrections since the last factorisation [m].
pub(crate) fn solve<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, length): (&Rule<T>, T),
    (options, start): (&Options<T>, MultiplierStart),
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<((u32, T, Stop), T), StepError> {
    let scale = step_scale(model.team(), rule.dt, &s.a[..w.equations.f.len()]);
    // predict q, v, a by the rule and lambda by extrapolation, then evaluate the terms there
    let inverse = T::ONE / rule.acceleration;
    w.begin(model, (options.penalty, inverse, w.adaptation.carried(w.scale.factor)));
    w.end.predict(model, (rule, inverse, is_far(scale, length)), s);
    start.set(model, (s, rule.dt, inverse), &mut w.lambda);
    model.set_inputs(s.t + rule.dt, s, &mut w.equations.terms);
    w.evaluate(model, (rule, options.compensated), s);

    let newton = Newton::new((scale, options.tolerance, length));
    let done = iterate(model, (rule, newton), (options, start), s, w)?;
    if has_loose_rows(model, (options, start), w) {
        filter(model, &mut w.equations, (&w.scale.weights, &mut w.lambda));
    }
    // the iteration has a/a' as its unknown, so the result is multiplied by a'
    w.end.scale_accelerations(model, rule.acceleration);
    Ok(done)
}

/// Runs the Newton loop. Returns its report, and the sum of the corrections since the last factorisation [m].
fn iterate<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, mut newton): (&Rule<T>, Newton<T>),
    (options, start): (&Options<T>, MultiplierStart),
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<((u32, T, Stop), T), StepError> {
    let inverse = T::ONE / rule.acceleration;
    // with a fixed alpha, multipliers grow by alpha phi, as published
    let is_balanced = matches!(options.penalty, Penalty::Scaled(_));
    let rule_of_stop = StopRule::new(model, options, is_balanced);
    let mut reuse = FactorReuse::new(is_balanced, rule_of_stop.is_tolerance_alone());
    while newton.iterations < options.max_iterations {
        let is_loose = has_loose_rows(model, (options, start), w);
        let is_corrected = newton.iterations == 1;
        if is_loose && newton.iterations > 0 {
            filter(model, &mut w.equations, (&w.scale.weights, &mut w.lambda));
        }
        let is_reused = reuse.can_reuse(&newton, rule, &w.equations) && !(is_corrected && is_loose);
        if !is_reused {
            w.factor(model, rule, options.geometric_stiffness)?;
            reuse.since = T::ZERO;
        }
        if newton.iterations == 0 || is_corrected && is_loose {
            adapt(model, rule, (options, start), w)?;
        }

        // f = M a/a' + J^T (s phi + lambda/a') - Q/a'   [P3 (9)]
        // At predicted positions, the contradiction between dependent rows cannot be separated from the violation that a correction
        // removes. The multipliers then keep their values, and the next correction updates them.
        let is_predicted = newton.iterations == 0 && has_loose_rows(model, (options, start), w);
        let Workspace { equations: eq, end, lambda, scale, .. } = w;
        if is_reused && is_balanced {
            let rows = (&scale.weights[..], &lambda[..]);
            residual_with_reused_jacobian(model, eq, (&end.a, inverse), rows);
        } else {
            set_sum(model.team(), &mut eq.mu, lambda, (&scale.weights, &eq.terms.phi));
            eq.assemble(model, Some(&end.a), inverse);
        }

        // T d = -f,   lambda <- lambda + s (phi + J' d)   [P3 (8)]
        eq.solve();
        if is_balanced && !is_predicted {
            update_multipliers(model, eq, (&scale.weights, lambda));
        }

        // q += d,   v += v' d,   a += a' d   [P3 (4), (5)]
        end.correct(model, (T::ONE, rule.velocity), &eq.f);
        w.evaluate(model, (rule, options.compensated), s);
        let Workspace { equations: eq, end, lambda, scale, .. } = w;
        if newton.iterations == 0 {
            w.penalty_energy = scale.energy(model.team(), &eq.terms.phi) * rule.acceleration;
        }
        // lambda <- lambda + alpha phi   [P3 (2)]
        if !is_balanced {
            add_product(model.team(), lambda, (&scale.weights, &eq.terms.phi));
        }

        let stop = newton.take(model, &eq.f, (end, options.compensated))?;
        reuse.since += newton.last();
        let is_below = rule_of_stop.is_below_truncation(&newton);
        if let Some(stop) = stop.or(is_below.then_some(Stop::Converged)) {
            return Ok((newton.ended(stop), reuse.since));
        }
    }
    if newton.is_accepted() {
        return Ok((newton.ended(Stop::Tolerance), reuse.since));
    }
    Err(newton.failure(&w.equations.f))
}

/// Adapts penalties and multipliers with the first factor of a step. Raises penalties for the weakest combination of constraints, and removes
/// the part of the multipliers that no constraint determines.
fn adapt<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    (options, start): (&Options<T>, MultiplierStart),
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    if options.adaptive_penalty && w.adaptation.adapt_penalty(model, &mut w.equations, &mut w.scale)
    {
        w.factor(model, rule, options.geometric_stiffness)?;
    }
    if is_filtered((options, start), w) {
        filter(model, &mut w.equations, (&w.scale.weights, &mut w.lambda));
    }
    Ok(())
}

/// True if multipliers must be filtered, because constraints may leave a part of them undetermined.
fn is_filtered<T: Real, S: SpdSolver<T>>(
    (options, start): (&Options<T>, MultiplierStart),
    w: &Workspace<T, S>,
) -> bool {
    let is_well_conditioned =
        options.adaptive_penalty && w.adaptation.is_well_conditioned(&w.scale);
    start == Filtered && !is_well_conditioned
}

/// True if rows of velocities may depend on other rows, such as those of two wheels on one axle.
///
/// For these rows phi = h/2 J v, where h is the step. It contradicts the other rows by the rule's error of order h^3, which no correction
/// removes. Each correction adds s times this error to multipliers that no constraint determines. Such multipliers act on the motion after
/// the rows have rotated. So multipliers are filtered after each correction.
///
/// Rows depend on each other exactly only at positions that satisfy the constraints. At predicted positions their combination looks weakly
/// determined. So the matrix is factored again after the first correction, and penalties are not raised for the combination.
fn has_loose_rows<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    how: (&Options<T>, MultiplierStart),
    w: &Workspace<T, S>,
) -> bool {
    model.has_velocity_rows() && is_filtered(how, w)
}
