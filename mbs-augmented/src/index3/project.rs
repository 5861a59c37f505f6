//! Projections of velocities and accelerations at the end of a step in index-3: choice of factor, rows and penalties.

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

/// Penalty factor above which penalties are reset before velocities and accelerations are projected [-]. Below it, an almost lost direction
/// is enforced at most a hundred times as strongly as others.
const MAX_FACTOR_OF_PROJECTION: f64 = 100.0;
/// Sum of corrections since the factorisation up to which a projection may reuse the factor [length of the scene]. Rows have then rotated
/// by at most 1e-7.
const MAX_TURN_OF_ROWS: f64 = 1e-7;

/// Projects velocities and accelerations; `since` is the sum of corrections since the factorisation. Returns the violation of the three
/// levels.
pub(super) fn project<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, since, length): (&Rule<T>, T, T),
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<[T; 3], StepError> {
    // Where only constraints act and all of them are well determined, T is close to M + J^T s J, and its rows are close to the present
    // ones.
    let is_reusable = options.adaptive_penalty
        && !model.has_forces()
        && w.adaptation.is_well_conditioned(&w.scale);
    let strategy = if is_reusable { Reused } else { Exact };
    // A combination of constraints that is almost lost must not be enforced too strongly on velocities and accelerations. They would grow
    // like 1 / sigma in its direction, where sigma is the smallest singular value of J.
    let raised = w.scale.factor;
    if raised > T::from_f64(MAX_FACTOR_OF_PROJECTION) {
        w.scale.scale(T::ONE / raised);
    }
    // An exact projection needs a new factor. If the rows of the factor differed from those of the right-hand side, s times their
    // difference would move x along free directions. Stiffness and damping in the factor would also move x along free directions, in
    // proportion to their ratio to the mass.
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

/// Projects velocities or accelerations onto one level. Returns the remaining violation.
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
