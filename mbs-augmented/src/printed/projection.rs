//! The projections of publications 1 and 3, each with a fixed number of sweeps.

use crate::equations::Equations;
use crate::projection::{Projection, Projector};
use mbs_core::implicit::ConstraintLevel;
use mbs_core::model::Model;
use mbs_core::{Real, SpdSolver};

/// Matrix with which a vector is projected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Published {
    /// W = M + J^T alpha J [P1 (13), (19)].
    ByMass,
    /// The tangent T of the last iteration [P3 (11), (12)].
    ByTangent,
}

/// Projects x in one sweep:
///
/// ```text
/// W x <- M x - J^T alpha b
/// T x = (T - J^T s J) x* - J^T s b,   that is   T (x - x*) = -J^T s (J x* + b)
/// ```
///
/// The first form solves for x itself and so loses cond(W) EPSILON of x each time. Returns the remaining violation, for which there is no
/// limit.
pub(super) fn project<T: Real, M: Model<T>, S: SpdSolver<T>>(
    mut p: Projector<'_, T, M, S>,
    by: Published,
) -> T {
    p.begin();
    p.violation();
    match by {
        Published::ByMass => solve_for_x(&mut p),
        Published::ByTangent => p.sweep(false),
    }
    let violation = p.violation();
    let Projection { sigma, rates, .. } = &mut *p.scratch;
    for (k, sigma) in sigma.iter_mut().enumerate() {
        *sigma = p.scale.weights[k] * rates[k];
    }
    violation
}

fn solve_for_x<T: Real, M: Model<T>, S: SpdSolver<T>>(p: &mut Projector<'_, T, M, S>) {
    let Equations { terms, mu, .. } = &mut *p.equations;
    let b = match p.level {
        ConstraintLevel::Velocity => &terms.phi_t,
        ConstraintLevel::Acceleration => &terms.phi_bias,
    };
    for (k, mu) in mu.iter_mut().enumerate() {
        *mu = -p.scale.weights[k] * b[k];
    }
    p.equations.assemble(p.model, Some(p.x), T::ZERO);
    p.equations.solve();
    p.x[..p.equations.f.len()].copy_from_slice(&p.equations.f);
}
