//! Projection of positions and velocities onto their constraints, within an iteration of index-1.

use crate::options::Options;
use crate::workspace::Workspace;
use mbs_core::implicit::{ConstraintLevel, ResidualLimits};
use mbs_core::integrator::Rule;
use mbs_core::model::{Model, State};
use mbs_core::step::StepError;
use mbs_core::team::{norm_inf, on_stretches, set_product, subtract};
use mbs_core::{Real, SpdSolver};

/// Violation of constraints that rounding errors cause [EPSILON of the displacement of the coordinates]. It is six binary digits. Penalties
/// are not raised for a smaller violation.
const ROUNDING: f64 = 64.0;
/// Contraction of a violation of positions above which penalties are raised [-]. The contraction is the fraction of the violation that a
/// sweep leaves. At this value ten sweeps reduce a violation by ten digits.
const SLOW_CONTRACTION: f64 = 0.1;
/// Number of slow sweeps after which the penalties of rows of velocities are lowered [-]. If these rows depend on no others, raised
/// penalties prevent a second slow sweep.
const SLOW_SWEEPS: u32 = 1;
/// Factor on lowered penalties of rows of velocities [-]. A sweep then leaves about this fraction of a violation of positions that depends
/// on these rows. The independent rows of velocities are still enforced. A power of two causes no rounding error.
const LOOSE: f64 = 1.0 / 8_192.0;
/// Contraction of a violation of positions above which a sweep is useless [-].
const USELESS: f64 = 0.9;

/// Integrates the accelerations to q and v and projects both. Leaves the matrix W at q factored. Returns |phi'|, the violation of velocities.
pub(super) fn constrain<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (rule, length, is_first): (&Rule<T>, T, bool),
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    let inverse = T::ONE / rule.acceleration;
    let (n, a) = (w.equations.f.len(), &w.end.a);
    let predicted = |i: usize| rule.predict(s.v[i], s.a[i], s.a_aux[i]);
    on_stretches(model.team(), [&mut w.end.dq[..n]], |first, [dq]| {
        for (k, dq) in dq.iter_mut().enumerate() {
            let (dq_p, _, a_p) = predicted(first + k);
            *dq = dq_p + (a[first + k] - a_p) * inverse;
        }
    });
    positions(model, length, options, s, w)?;
    // The velocity follows the projected position, so that both describe the same motion near a singular position.
    let dq = &w.end.dq;
    on_stretches(model.team(), [&mut w.end.v[..n]], |first, [v]| {
        for (k, v) in v.iter_mut().enumerate() {
            let (dq_p, v_p, _) = predicted(first + k);
            *v = v_p + rule.velocity * (dq[first + k] - dq_p);
        }
    });
    velocities(model, (length, is_first), options, w)
}

/// Projects the velocities at q with the factor of W, and leaves W factored. Returns |phi'|, the violation of velocities.
pub(super) fn velocities<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    (length, is_first): (T, bool),
    options: &Options<T>,
    w: &mut Workspace<T, S>,
) -> Result<T, StepError> {
    let level = ConstraintLevel::Velocity;
    let limits = level.limits(model, &w.end, length, &mut w.equations.terms)?;
    if is_first {
        w.projector(model, level).violation();
        w.penalty_energy = w.scale.energy(model.team(), &w.projection.rates);
    }
    let left = w.projector(model, level).project(limits, options.max_sweeps)?;
    if w.scale.restore() {
        w.factor_mass(model)?;
    }
    Ok(left)
}

/// Projects the positions by W d = -J^T s phi, q += d, until phi is at machine precision. Here s are the penalties.
///
/// Rows of velocities have phi = 0 here. They may depend on rows of positions, such as those of two wheels on one axle. A sweep then
/// reduces a joint's violation only by a fraction. If that is slow, the penalties of rows of velocities are lowered. The rolling contacts
/// then slip by the correction, which is of third order in the step.
///
/// Every sweep starts from the positions of the last sweep, with multipliers of zero. The published method [P1 (8)-(10)] accumulates the
/// multipliers of all sweeps. Then the total correction is orthogonal, rather than each part of it. The difference is of second order in
/// the correction. But the rows rotate during the sweeps. Accumulated multipliers would then push light bodies away if these carry heavy
/// bodies.
fn positions<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    length: T,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let limits = ResidualLimits::of_positions(length, options.tolerance, options.compensated);
    w.end.evaluate(model, options.compensated, s, &mut w.equations.terms);
    // Components of directions have no unit. In a scene of the size of a millimetre they change by more than the coordinates of points do.
    let moved = norm_inf(model.team(), w.end.moved()).max(length * T::EPSILON);
    let moved = if options.compensated { moved } else { length.max(T::ONE) };
    let rounding = moved * T::EPSILON * T::from_f64(ROUNDING);
    let mut violation = norm_inf(model.team(), &w.terms().phi);
    let (mut n_slow, mut is_loosened) = (0, false);
    for _ in 0..options.max_sweeps {
        w.scale.factor(model, &mut w.equations)?;
        if violation <= limits.goal {
            break;
        }
        let (eq, n) = (&mut w.equations, w.end.moved().len());
        set_product(model.team(), &mut eq.mu, (&w.scale.weights, &eq.terms.phi));
        eq.assemble(model, None, T::ZERO);
        eq.solve();
        subtract(model.team(), &mut w.end.dq[..n], &eq.f);
        w.end.evaluate(model, options.compensated, s, &mut eq.terms);
        let left = norm_inf(model.team(), &eq.terms.phi);
        let contraction = left / violation;
        violation = left;
        let is_slow = contraction > T::from_f64(SLOW_CONTRACTION) && violation > rounding;
        n_slow += u32::from(is_slow);
        if is_slow && n_slow > SLOW_SWEEPS && model.has_velocity_rows() && !is_loosened {
            w.scale.restore();
            w.scale.scale_velocity_rows(model, T::from_f64(LOOSE));
            is_loosened = true;
            continue;
        }
        // With three or more wheels, rows of heights contradict the rows of unit lengths until the latter are satisfied. Each sweep reduces
        // that violation to a half or less.
        let is_slow = is_slow && !(is_loosened && contraction < T::HALF);
        let is_raised = is_slow && w.scale.raise(contraction);
        if contraction > T::from_f64(USELESS) && !is_raised {
            break;
        }
    }
    if is_loosened {
        w.scale.scale_velocity_rows(model, T::ONE / T::from_f64(LOOSE));
    }
    // The raised penalties enforce an almost lost direction on positions only. Velocities and accelerations would grow like 1 / sigma in
    // that direction, where sigma is the smallest singular value of J.
    if w.scale.restore() || is_loosened {
        w.factor_mass(model)?;
    }
    limits.check_positions(violation, rounding, &w.terms().phi)
}
