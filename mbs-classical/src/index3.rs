//! Index-3 classical Lagrangian with projections [P3 2.2].
//!
//! ```text
//! M q'' + J^T lambda = Q,   phi = 0                                                   [P3 (13), (14)]
//! f = (M a/a' + J^T lambda/a' - Q/a', phi)                                            [P3 (19)]
//! [ W  J^T    ] ( d           )
//! [ J  -delta ] ( d_lambda/a' ) = -f,   q += d,   v += v' d,   a += a' d              [P3 (20), (4), (5)]
//! W = M + (v'/a') C + (1/a') (K + K_geo(lambda))
//! then J v + phi_t = 0 and J a + bias = 0 with the same matrix                        [P3 (21), (22)]
//! ```
//!
//! The method differs from the published one. Unknowns are increments. The multipliers are lambda/a' and phi is not scaled, so that without
//! forces the matrix does not depend on the step. The start value of lambda is extrapolated. Projections are in correction form. W contains
//! the geometric stiffness, which the publication neglects. delta is zero unless the option sets it.

use crate::options::Options;
use crate::workspace::{Mass, Workspace};
use mbs_core::implicit::{self, Newton, Solved};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport, Stop, step_scale};
use mbs_core::team::on_stretches;
use mbs_core::{Real, SymmetricSolver};

/// Last correction above which the matrix is factored again for the projections [length of the scene]. The square of this correction is at
/// machine precision.
const MAX_CORRECTION_OF_FACTOR: f64 = 1e-7;

/// Advances `s` by one [`Step`].
///
/// Cost: two or three evaluations, factorisations and solutions for the motion, and three to five solutions for the projections. No
/// allocation.
///
/// # Errors
/// [`StepError`]; the state is then unchanged. [`StepError::RankLost`] names a row that depends on other rows, because of redundant joints or
/// at a singular position.
pub fn step<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    step: Step<T>,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    implicit::step(model, step, options, s, w, |(rule, length), s, w| {
        w.begin(options.regularisation);
        let scale = step_scale(model.team(), rule.dt, &s.a);
        predict(model, (rule, is_far(scale, length)), options, s, w);
        let newton = Newton::new((scale, options.tolerance, length));
        let newton = iterate(model, (rule, newton), options, s, w)?;

        // The iteration has a/a' as its unknown, so the result is multiplied by a'.
        let unit = rule.acceleration;
        w.end.scale_accelerations(model, unit);
        // The factor belongs to the configuration before the last correction. This configuration is close enough if that correction was
        // small.
        if newton.1 > length * T::from_f64(MAX_CORRECTION_OF_FACTOR) {
            factor(model, rule, options, w)?;
        }
        let most = options.max_sweeps;
        let violation = w.project_velocities_and_accelerations(model, (length, unit), most)?;
        Ok(Solved { newton, violation, unit })
    })
}

/// Predicts q, v, a and lambda at the end of the step and evaluates all terms there.
fn predict<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    (rule, is_far): (&Rule<T>, bool),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    let inverse = T::ONE / rule.acceleration;
    w.end.predict(model, (rule, inverse, is_far), s);
    // lambda = 2 lambda_n - lambda_(n-1)   [P3 (3)]
    let expected = s.extrapolated(rule.dt);
    on_stretches(model.team(), [&mut w.lambda], |first, [lambda]| {
        for (k, lambda) in lambda.iter_mut().enumerate() {
            *lambda = expected(first + k) * inverse;
        }
    });
    model.set_inputs(s.t + rule.dt, s, &mut w.terms);
    w.evaluate(model, options.compensated, s);
    w.end.evaluate_rates(model, rule, &mut w.terms);
}

/// Runs the Newton loop. Returns the report of the iteration.
fn iterate<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    (rule, mut newton): (&Rule<T>, Newton<T>),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(u32, T, Stop), StepError> {
    let inverse = T::ONE / rule.acceleration;
    while newton.iterations < options.max_iterations {
        factor(model, rule, options, w)?;
        if newton.iterations == 0 && options.regularisation.is_some() {
            filter(model, w);
        }

        // f = (M a/a' + J^T lambda/a' - Q/a', phi)   [P3 (19)]
        w.mu.copy_from_slice(&w.lambda);
        w.rates.copy_from_slice(&w.terms.phi);
        w.assemble(model, Mass::Acceleration, inverse, true);

        // q += d,   v += v' d,   a += a' d,   lambda += d_lambda   [P3 (20), (4), (5)]
        w.solve();
        w.correct(model, (T::ONE, rule.velocity));
        w.evaluate(model, options.compensated, s);
        w.end.evaluate_rates(model, rule, &mut w.terms);

        let stop = newton.take(model, &w.f[..w.n], (&w.end, options.compensated))?;
        if newton.iterations == 1 {
            w.check_branch(model, newton.length)?;
        }
        if let Some(stop) = stop {
            return Ok(newton.ended(stop));
        }
    }
    w.exhausted(model, &newton)
}

/// Filters multipliers: lambda <- 1/delta J T^-1 J^T lambda, T = W + J^T J / delta. Removes the part that redundant constraints leave
/// undetermined, which would grow with the rounding errors of phi.
fn filter<T: Real, M: Model<T>, S: SymmetricSolver<T>>(model: &M, w: &mut Workspace<T, S>) {
    w.mu.copy_from_slice(&w.lambda);
    w.assemble(model, Mass::None, T::ZERO, false);
    w.solve();
    let n = w.n;
    w.lambda.copy_from_slice(&w.f[n..]);
}

/// Factors the saddle matrix. It contains the geometric stiffness if W stays positive on the motions that the constraints allow.
fn factor<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let weights = (T::ONE / rule.acceleration, rule.velocity / rule.acceleration);
    if options.geometric_stiffness {
        let result = w.factor(model, weights, true, options.rank);
        if result.is_ok() && w.is_positive() {
            return Ok(());
        }
    }
    w.factor(model, weights, false, options.rank)
}
