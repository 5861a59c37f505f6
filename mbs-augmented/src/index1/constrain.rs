//! Positions and velocities on their constraints, within an iteration of index-1.

use crate::options::Options;
use crate::workspace::Workspace;
use mbs_core::implicit::{ConstraintLevel, ResidualLimits};
use mbs_core::integrator::Rule;
use mbs_core::model::{Model, State};
use mbs_core::step::StepError;
use mbs_core::team::{norm_inf, on_stretches, set_product, subtract};
use mbs_core::{Real, SpdSolver};

/// Violation that rounding leaves of the constraints, for which penalties are not raised [EPSILON of what their coordinates went]: six binary
/// digits.
const ROUNDING: f64 = 64.0;
/// Part of a violation of positions that a slow sweep leaves, for which penalties are raised [-]: ten sweeps would make ten digits.
const SLOW_CONTRACTION: f64 = 0.1;
/// Slow sweeps until rows of velocities give way [-]: where they depend on no others, raised penalties leave no second one.
const SLOW_SWEEPS: u32 = 1;
/// Factor on penalties of rows of velocities that give way to rows of positions [-]: what a sweep leaves of these, and enough to hold the rest.
/// A power of two, which takes no digits.
const LOOSE: f64 = 1.0 / 8_192.0;
/// Part of a violation of positions that a sweep leaves which is of no use [-].
const USELESS: f64 = 0.9;

/// q, v from the accelerations by the integrator, projected; the matrix W at q is left factored. Returns |phi'|.
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

/// Projects the velocities at q with W factored there, which is left so. Returns |phi'|.
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

/// W d = -J^T s phi,   q += d: until phi is at rounding.
///
/// Rows of velocities are zero here, and may depend on rows of positions, as of two wheels on one axle. A sweep then closes its share of a
/// joint alone. Where that is slow such rows give way: the correction, of third order in the step, slips.
///
/// Every sweep begins from where the last one ended. The multipliers of all together, as [P1 (8)-(10)] carries them, would make the whole way
/// orthogonal, not each part of it. That differs by the square of the way. As their rows turn they push light pieces off, the more the
/// heavier those are that they carry.
fn positions<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    length: T,
    options: &Options<T>,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(), StepError> {
    let limits = ResidualLimits::of_positions(length, options.tolerance, options.compensated);
    w.end.evaluate(model, options.compensated, s, &mut w.equations.terms);
    // Directions are numbers without a unit: in a scene of a millimetre they go further than the places.
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
        // The heights of a third and a fourth wheel contradict the rows of unit lengths until these hold, by a half or less from sweep to sweep.
        let is_slow = is_slow && !(is_loosened && contraction < T::HALF);
        let is_raised = is_slow && w.scale.raise(contraction);
        if contraction > T::from_f64(USELESS) && !is_raised {
            break;
        }
    }
    if is_loosened {
        w.scale.scale_velocity_rows(model, T::ONE / T::from_f64(LOOSE));
    }
    // What is almost lost is enforced on positions only: velocities and accelerations would grow like 1 / sigma there.
    if w.scale.restore() || is_loosened {
        w.factor_mass(model)?;
    }
    limits.check_positions(violation, rounding, &w.terms().phi)
}
