//! Index-1 classical Lagrangian [P1 (4)] with the trapezoidal rule: plain, with Baumgarte's stabilisation, or projected.
//!
//! ```text
//! [ M  J^T ] ( q''    )   ( Q                                   )
//! [ J   0  ] ( lambda ) = ( -bias - 2 alpha phi' - beta^2 phi   )          [P1 (4)]; alpha = beta = 0 unless stabilised
//! ```
//!
//! Corrections solve the system together with the equations of the integrator, with W = M + (v'/a') C + (1/a') K in place of M:
//!
//! ```text
//! [ W  J^T    ] ( d        )     ( M a + J^T lambda - Q               )
//! [ J  -delta ] ( d_lambda ) = - ( J a + bias + 2 alpha phi' + beta^2 phi ),    a += d,  q += d/a',  v += v' d/a'
//! ```
//!
//! The method differs from the published one, which solves the system once per evaluation. Here an implicit rule is solved by corrections.
//! The projection of positions is mass-orthogonal and in correction form, like those of velocities and accelerations.

use crate::options::{Options, Stabilisation};
use crate::workspace::{Mass, Workspace};
use mbs_core::implicit::{self, ConstraintLevel, Newton, ResidualLimits, Solved, check_guides};
use mbs_core::integrator::{Rule, is_far};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport, Stop, step_scale};
use mbs_core::team::{norm_inf, on_stretches};
use mbs_core::{Real, SymmetricSolver};

/// Contraction of a violation of positions above which a sweep is useless [-]. The contraction is the fraction of the violation that a
/// sweep leaves.
const USELESS: f64 = 0.9;

/// Advances `s` by one [`Step`].
///
/// Cost for each iteration: an evaluation, a factorisation and a solution; three to five iterations are usual. A projection adds one or two
/// factorisations and about six solutions. No allocation.
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
        w.end.predict(model, (rule, T::ONE, is_far(scale, length)), s);
        w.lambda.copy_from_slice(&s.lambda);
        model.set_inputs(s.t + rule.dt, s, &mut w.terms);
        evaluate(model, options, s, w);
        let scale = scale.max(norm_inf(model.team(), &s.v) * rule.dt * T::EPSILON);
        let newton = Newton::new((scale, options.tolerance, length));
        let newton = iterate(model, (rule, newton), options, s, w)?;
        let violation = if options.stabilisation == Stabilisation::Projection {
            positions(model, rule, length, options, s, w)?;
            w.project_velocities_and_accelerations(model, (length, T::ONE), options.max_sweeps)?
        } else {
            violations(model, w)?
        };
        Ok(Solved { newton, violation, unit: T::ONE })
    })
}

/// Returns the violations of the three levels after the iteration, and copies the multipliers to `mu`.
fn violations<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    w: &mut Workspace<T, S>,
) -> Result<[T; 3], StepError> {
    check_guides(model, &w.end.q, &w.terms)?;
    w.mu.copy_from_slice(&w.lambda);
    let velocity = w.violation(model, ConstraintLevel::Velocity);
    model.evaluate_bias(&w.end.q, &w.end.v, &mut w.terms);
    let acceleration = w.violation(model, ConstraintLevel::Acceleration);
    Ok([norm_inf(model.team(), &w.terms.phi), velocity, acceleration])
}

/// Evaluates phi, J, phi_t, bias and forces at the present q and v.
fn evaluate<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) {
    w.evaluate(model, options.compensated, s);
    if model.has_guides() {
        model.evaluate_phi_t(&w.end.q, &mut w.terms);
    }
    model.evaluate_bias(&w.end.q, &w.end.v, &mut w.terms);
}

/// Evaluates rates = J a + bias + 2 alpha (J v + phi_t) + beta^2 phi.
fn demand<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    stabilisation: Stabilisation<T>,
    w: &mut Workspace<T, S>,
) {
    let Stabilisation::Baumgarte { alpha, beta } = stabilisation else {
        w.violation(model, ConstraintLevel::Acceleration);
        return;
    };
    w.violation(model, ConstraintLevel::Velocity);
    for k in 0..w.mu.len() {
        w.mu[k] = T::TWO * alpha * w.rates[k] + beta * beta * w.terms.phi[k];
    }
    w.violation(model, ConstraintLevel::Acceleration);
    for k in 0..w.mu.len() {
        w.rates[k] += w.mu[k];
    }
}

/// Iterates on accelerations and multipliers. Returns the report of the iteration, in which the last correction is that of the coordinates.
fn iterate<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    (rule, mut newton): (&Rule<T>, Newton<T>),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(u32, T, Stop), StepError> {
    let inverse = T::ONE / rule.acceleration;
    let Newton { scale, length, .. } = newton;
    while newton.iterations < options.max_iterations {
        factor(model, rule, options, w)?;
        demand(model, options.stabilisation, w);
        w.mu.copy_from_slice(&w.lambda);
        w.assemble(model, Mass::Acceleration, T::ONE, true);
        w.solve();
        w.correct(model, (inverse, rule.velocity * inverse));
        let f = &w.f[..w.n];
        newton.count(norm_inf(model.team(), f) * inverse, f)?;
        evaluate(model, options, s, w);
        let moved = norm_inf(model.team(), &w.end.dq).max(length * rule.dt);
        if let Some(stop) = newton.stop(scale * options.tolerance, Newton::rounding(moved)) {
            return Ok(newton.ended(stop));
        }
    }
    w.exhausted(model, &newton)
}

/// Projects q onto phi = 0 and moves v by the integrator's relation, so that both describe the same motion. Leaves the matrix at the new q
/// factored.
fn positions<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    length: T,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let limits = ResidualLimits::of_positions(length, options.tolerance, options.compensated);
    w.sigma.fill(T::ZERO);
    w.change.fill(T::ZERO);
    let mut violation = norm_inf(model.team(), &w.terms.phi);
    for sweeps in 0..options.max_sweeps {
        factor(model, rule, options, w)?;
        if violation <= limits.goal {
            break;
        }
        w.rates.copy_from_slice(&w.terms.phi);
        w.sweep(model, sweeps > 0);
        w.check_branch(model, length)?;
        let (n, d) = (w.n, &w.f);
        on_stretches(model.team(), [&mut w.end.dq[..n], &mut w.end.v[..n]], |first, [dq, v]| {
            for ((dq, v), &d) in dq.iter_mut().zip(v).zip(&d[first..]) {
                *dq -= d;
                *v -= rule.velocity * d;
            }
        });
        w.evaluate(model, options.compensated, s);
        let left = norm_inf(model.team(), &w.terms.phi);
        let contraction = left / violation;
        violation = left;
        if contraction > T::from_f64(USELESS) {
            break;
        }
    }
    limits.check_positions(violation, T::ZERO, &w.terms.phi)
}

/// Factors the saddle matrix at the present terms.
fn factor<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    rule: &Rule<T>,
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let weights = (T::ONE / rule.acceleration, rule.velocity / rule.acceleration);
    w.factor(model, weights, false, options.rank)
}
