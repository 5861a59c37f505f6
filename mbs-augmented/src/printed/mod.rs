//! Index-3 as published in P1 and P3: fixed alpha, plain arithmetic, and a fixed number of sweeps in each projection.
//!
//! ```text
//! M q'' + J^T (alpha phi + lambda) = Q,      lambda <- lambda + alpha phi              [P3 (1), (2)]
//! publication 1: lambda from zero [P1 (16)], then W x <- M x - J^T alpha b, once       [P1 (13), (19)]
//! publication 3: lambda extrapolated [P3 (3)], then T x = (T - J^T s J) x* - J^T s b   [P3 (11), (12)]
//! ```
//!
//! These forms serve for comparison only. They lose their digits in small steps; [`index3`](crate::index3) does not.

mod projection;

use crate::index3;
use crate::multipliers::{MultiplierStart, balance};
use crate::options::Penalty;
use crate::workspace::Workspace;
use mbs_core::implicit::{self, ConstraintLevel, Solved};
use mbs_core::integrator::Integrator;
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport};
use mbs_core::team::norm_inf;
use mbs_core::{Real, SpdSolver};
use projection::{Published, project};

/// Largest number of iterations of a step [-]. The steps of the published tables need far fewer.
const MAX_ITERATIONS: u32 = 20;

/// Options of a step as published.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the steps.
    pub integrator: Integrator<T>,
    /// Penalty alpha, the same on every row [N/m].
    pub alpha: T,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step [-].
    pub tolerance: T,
    /// Largest number of iterations of a step.
    pub max_iterations: u32,
}

impl<T: Real> Options<T> {
    /// Creates options: trapezoidal rule, the tolerance of [`Options::index3`](crate::Options::index3), 20 iterations.
    #[must_use]
    pub fn new(alpha: T) -> Self {
        let crate::Options { integrator, tolerance, .. } = crate::Options::index3();
        Self { integrator, alpha, tolerance, max_iterations: MAX_ITERATIONS }
    }

    /// Returns these options for the solver of `index3`, with all its additions to the published method switched off.
    fn of_index3(&self) -> crate::Options<T> {
        let Self { integrator, alpha, tolerance, max_iterations } = *self;
        crate::Options {
            integrator,
            penalty: Penalty::Fixed(alpha),
            tolerance,
            truncation_share: T::ZERO,
            max_iterations,
            compensated: false,
            adaptive_penalty: false,
            ..crate::Options::index3()
        }
    }
}

/// Makes one step as in publication 1.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn publication1<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    step: Step<T>,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    published(model, step, options, (MultiplierStart::Zero, Published::ByMass), s, w)
}

/// Makes one step as in publication 3.
///
/// # Errors
/// [`StepError`]; the state is then unchanged.
pub fn publication3<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    step: Step<T>,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    published(model, step, options, (MultiplierStart::Extrapolated, Published::ByTangent), s, w)
}

fn published<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    step: Step<T>,
    options: &Options<T>,
    (start, projection): (MultiplierStart, Published),
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<StepReport<T>, StepError> {
    let options = &options.of_index3();
    implicit::step(model, step, options, s, w, |(rule, length), s, w| {
        let (newton, _) = index3::solve(model, (rule, length), (options, start), s, w)?;
        let unit = rule.acceleration;
        let mut violation = [norm_inf(model.team(), &w.terms().phi), T::ZERO, T::ZERO];
        if projection == Published::ByMass {
            // W = M + J^T alpha J needs alpha itself. The weights of the iteration are alpha / a'.
            w.scale.weights.iter_mut().for_each(|s| *s *= unit);
        }
        for (k, level) in [(1, ConstraintLevel::Velocity), (2, ConstraintLevel::Acceleration)] {
            level.limits(model, &w.end, length, &mut w.equations.terms)?;
            if projection == Published::ByMass && k == 1 {
                w.factor_mass(model)?;
            }
            violation[k] = project(w.projector(model, level), projection);
        }
        if model.has_guides() {
            let Workspace { equations: eq, end, lambda, scale, projection, .. } = w;
            let multipliers = (&lambda[..], unit, &mut projection.sigma[..]);
            balance(model, eq, (&end.a, &scale.weights), multipliers);
        }
        Ok(Solved { newton, violation, unit })
    })
}
