//! The projections of a step in index-3: with which factor, rows and penalties velocities and accelerations are projected.

use crate::multipliers::balance;
use crate::options::Options;
use crate::projection::ProjectionStrategy::{self, Exact, Reused};
use crate::workspace::Workspace;
use mbs_core::implicit::ConstraintLevel;
use mbs_core::integrator::Rule;
use mbs_core::model::Model;
use mbs_core::step::StepError;
use mbs_core::team::norm_inf;
use mbs_core::{Real, SpdSolver};

/// Penalty factor above which penalties are taken back before velocities and accelerations are projected [-]. Below it what is almost lost
/// is enforced no more than a hundred times as much as anything else.
const MAX_FACTOR_OF_PROJECTION: f64 = 100.0;
/// Corrections since the factor was made up to which a reused projection may use it [scene's length]. Rows have turned by 1e-7 then, and
/// s times a tenth of that of a violation goes along free directions.
const MAX_TURN_OF_ROWS: f64 = 1e-7;

/// Projects velocities and accelerations, `since` the corrections after the factor. Returns the violation of the three levels.
pub(super) fn project<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, since, length): (&Rule<T>, T, T),
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<[T; 3], StepError> {
    // Where only constraints act, and all are well determined, T differs from M + J^T s J by little, and its rows serve for those of now.
    let is_reusable = options.adaptive_penalty
        && !model.has_forces()
        && w.adaptation.is_well_conditioned(&w.scale);
    let strategy = if is_reusable { Reused } else { Exact };
    // A combination of constraints that is almost lost must not be enforced on velocities and accelerations beyond need: they
    // would grow like 1 / sigma there.
    let raised = w.scale.factor;
    if raised > T::from_f64(MAX_FACTOR_OF_PROJECTION) {
        w.scale.scale(T::ONE / raised);
    }
    // With rows of now and a factor that has others, s times their turn of a violation would go along free directions. With a factor
    // that has stiffness and damping, their part of the mass would.
    match strategy {
        Exact => w.factor_mass(model)?,
        Reused if since > length * T::from_f64(MAX_TURN_OF_ROWS) => {
            w.factor(model, rule, options.geometric_stiffness)?;
        }
        Reused => {}
    }
    let velocity =
        project_level(model, (ConstraintLevel::Velocity, strategy), (length, options), w)?;
    let acceleration =
        project_level(model, (ConstraintLevel::Acceleration, strategy), (length, options), w)?;
    if model.has_guides() {
        let Workspace { equations: eq, end, lambda, scale, projection, .. } = w;
        let multipliers = (&lambda[..], rule.acceleration, &mut projection.sigma[..]);
        balance(model, eq, (&end.a, &scale.weights), multipliers);
    }
    w.scale.factor = raised;
    Ok([norm_inf(model.team(), &w.terms().phi), velocity, acceleration])
}

/// Projects velocities or accelerations. Returns the violation left.
fn project_level<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (level, strategy): (ConstraintLevel, ProjectionStrategy),
    (length, options): (T, &Options<T>),
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    let limits = level.limits(model, &w.end, length, &mut w.equations.terms)?;
    let limits = strategy.limits(model, level, limits);
    let projector = w.projector(model, level);
    match strategy {
        Exact => projector.project(limits, options.max_sweeps),
        Reused => projector.project_reused(limits, options.max_sweeps),
    }
}
