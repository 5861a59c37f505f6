//! Accelerations of a mechanism, loops included, at the coordinates and velocities of a [`Store`].
//!
//! ```text
//! M a + p + Jᵀ λ = 0,   J a + bias = 0            λ from (J M⁻¹ Jᵀ + ε) Δλ = J a + bias, a −= M⁻¹ Jᵀ Δλ, until it is zero
//! ```
//!
//! M is the mass matrix, a the accelerations, and p the bias forces. J is the Jacobian of the loops' rows, λ are their multipliers, and ε
//! is the regularisation.
//!
//! One sweep (solution of the regularised system) leaves the fraction ε of the residual J a + bias. Further sweeps reduce the residual to
//! rounding. They recompute the forces and the right-hand sides of rows only, with the factored inertias. Redundant rows need no special
//! treatment: their forces are the solution of least norm.
//!
//! The closure of the report is an option: λ = α (Φ̈ + 2 μ Ω Φ̇ + Ω² Φ)   [P3 (39)–(41)]. It is the same elimination with ε = 1/α, one
//! sweep, and bias + 2 μ Ω Φ̇ + Ω² Φ in place of the bias.

use crate::link::ArticulatedInertia;
use crate::link::indexing::{Outside, at, at_mut, copy};
use crate::link::options::{Closure, Options};
use crate::loads::Reach;
use crate::loops::{Fault, Regularisation, index};
use crate::passes;
use crate::passes::coupled_rows::{self, Largest};
use crate::passes::feedback::follow_motion;
use crate::passes::slices::{Store, TreeSlices};
use crate::passes::{inverse, rotor};
use crate::rows::closed_loop::ClosedLoop;
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Largest number of sweeps [-]. The evaluation fails if the residual is still too large after them. Chosen, not tuned.
const MAX_SWEEPS: u32 = 30;
/// Largest pivot of a redundant row, in units of the square root of machine precision [-]. Rounding errors alone leave smaller pivots.
/// Chosen, not tuned.
const NO_EFFECT: f64 = 64.0;
/// Pivot below which rows are nearly redundant [-]. A displacement by a projection may then change accelerations by 10,000 times as much.
const TIGHT: f64 = 1e-4;
/// Residual of an evaluation within an iteration, in units of the square root of machine precision [-]. Later iterations reduce the
/// residual. Chosen, not tuned.
const COARSE: f64 = 0.01;
/// Residual of an evaluation for rates, relative to the required error of the method [-]. A residual of a hundredth hardly adds to that
/// error. Chosen, not tuned.
const RATES_FRACTION: f64 = 0.01;
/// Residual that counts as rounding, relative to a row's terms and in units of machine precision [-]. Chosen, not tuned.
const FINE_ROUNDINGS: f64 = 256.0;
/// Residual that is accepted if sweeps stall near a singular position [-]. Chosen, not tuned.
const SINGULAR_RESIDUAL: f64 = 1e-3;

/// Level of the residual at which sweeps end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    /// One sweep; the remaining residual is accepted.
    Once,
    /// Tolerance of an iteration that is not yet converged.
    Coarse,
    /// A hundredth of the required error of a step.
    Rates,
    /// Rounding of a row's terms.
    Fine,
    /// This number of sweeps after the first sweep; the remaining residual is accepted.
    Fixed(u32),
}

/// Evaluates the accelerations `s.zdd` at the coordinates `s.z`, velocities `s.v`, guides `s.guides` and signals `s.courses`. Returns the
/// largest remaining |Φ̈|.
pub(crate) fn accelerations<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    level: Level,
    s: &mut Store<'_, T, S>,
) -> Result<T, Fault<T>> {
    let mut condensed = begin(m, s)?;
    for load in m.loads {
        load.apply(&s.instant(m), condensed)?;
    }
    core::mem::swap(&mut s.condensed, &mut condensed);
    finish(m, options, level, s)
}

/// Evaluates accelerations on which the forces of effects depend linearly. On entry `s.zdd` has the accelerations from which the step
/// computed `s.z` and `s.v`. If the new accelerations differ from `s.zdd`, the forces of effects change by stiffness and damping times
/// `reach` (see [`Reach`]) times the difference. Without a difference the result is that of [`accelerations`].
///
/// Cost: that of [`accelerations`], one outward pass without velocity products, and a rank-one update of an inertia for each effect.
pub(crate) fn accelerations_ahead<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    (level, reach): (Level, Reach<T>),
    s: &mut Store<'_, T, S>,
) -> Result<T, Fault<T>> {
    let mut condensed = begin(m, s)?;
    *at_mut(s.a, 0)? = S::motion(S::Spin::zero(), -m.gravity);
    inverse::spread(m.links, s.placed, s.zdd, s.a)?;
    for load in m.loads {
        load.apply_ahead(&s.instant(m), (reach, s.zdd, s.a), condensed)?;
    }
    core::mem::swap(&mut s.condensed, &mut condensed);
    finish(m, options, level, s)
}

/// Evaluates places and the inertia of each single body. Returns the table of articulated inertias, so that loads can add to it. Builds for
/// controllers do not inline this function, so that its code exists once.
#[cfg_attr(feature = "alloc", inline(always))]
pub(crate) fn begin<'b, T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'b, T, S>,
) -> Result<&'b mut [ArticulatedInertia<T, S>], Outside> {
    s.counts.condensations += 1;
    passes::kinematics(m.links, (s.z, s.v, s.guides), s.placed)?;
    follow_motion(m, s)?;
    passes::inertias(m.links, s.placed, s.condensed);
    rotor::resist(m.rotors, s.condensed)?;
    Ok(core::mem::take(&mut s.condensed))
}

/// Runs the second and third pass, then the sweeps.
pub(crate) fn finish<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    level: Level,
    s: &mut Store<'_, T, S>,
) -> Result<T, Fault<T>> {
    let ground = S::motion(S::Spin::zero(), -m.gravity);
    *at_mut(s.a, 0)? = ground;
    let regularisation = begin_loops(m, options, s)?;
    passes::condense(
        m.links,
        s.placed,
        (&m.loops, regularisation, &ground),
        s.condensed,
        &mut s.loops,
    )?;
    let parts = (&*s.placed, &*s.condensed);
    passes::accelerate(m.links, parts, (&m.loops, true), &mut s.loops, (s.zdd, s.a))?;
    if m.loops.loops.is_empty() {
        return Ok(T::ZERO);
    }
    copy(s.loops.lambda, s.lambda)?;
    match options.closure {
        Closure::Constraints => sweep(m, options, level, s),
        Closure::Report { .. } => Ok(residual(m, s)?.0),
    }
}

/// Evaluates the rows and initialises K, l and Λ = 0. Returns the regularisation ε.
fn begin_loops<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    s: &mut Store<'_, T, S>,
) -> Result<Regularisation<T>, Outside> {
    evaluate_rows(m, s)?;
    copy(s.gradient, s.loops.k)?;
    s.loops.blocks.fill(T::ZERO);
    s.loops.scales.fill(T::ZERO);
    for (l, &[phi, phi_d, bias]) in s.loops.l.iter_mut().zip(&*s.rows) {
        *l = match options.closure {
            Closure::Constraints => bias,
            // closure of the report: γ = Φ̇_Z Z + 2 μ Ω Φ̇ + Ω² Φ   [P3 (41)]
            Closure::Report { omega, mu, .. } => {
                bias + T::TWO * mu * omega * phi_d + omega * omega * phi
            }
        };
    }
    Ok(match options.closure {
        Closure::Constraints => Regularisation::Scaled(options.regularisation),
        Closure::Report { alpha, .. } => Regularisation::Fixed(T::ONE / alpha),
    })
}

/// Evaluates Φ, Φ̇, the bias of Φ̈ and the gradients of all rows for the current places of the links.
pub(crate) fn evaluate_rows<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    #[inline(never)]
    fn with_coupled<T: Real, S: Space<T>>(
        m: &TreeSlices<'_, T, S>,
        s: &mut Store<'_, T, S>,
    ) -> Result<(), Outside> {
        evaluate_cut(m, m.loops.cut(), s)?;
        coupled_rows::evaluate(m, s)
    }
    if m.loops.has_coupled() { with_coupled(m, s) } else { evaluate_cut(m, m.loops.loops, s) }
}

#[inline(always)]
fn evaluate_cut<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    cut: &[ClosedLoop<T, S>],
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    let n = m.loops.rows.len();
    for lap in cut {
        lap.evaluate(m.loops.rows, s.placed, |k, row| {
            let [first, second] = row.gradient;
            *at_mut(s.gradient, k)? = first;
            *at_mut(s.gradient, n + k)? = second;
            *at_mut(s.rows, k)? = [row.value, row.rate, row.bias];
            Ok(())
        })?;
    }
    Ok(())
}

/// Writes J a + bias into l. Returns the largest absolute value, the index of its row, and the scale of its terms. Builds for controllers
/// do not inline this function, so that its code exists once.
#[cfg_attr(feature = "alloc", inline(always))]
fn residual<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<Largest<T>, Outside> {
    #[inline(never)]
    fn with_coupled<T: Real, S: Space<T>>(
        m: &TreeSlices<'_, T, S>,
        s: &mut Store<'_, T, S>,
    ) -> Result<Largest<T>, Outside> {
        let found = residual_of_cut(m, m.loops.cut(), s)?;
        coupled_rows::residual(m, s, found)
    }
    if m.loops.has_coupled() { with_coupled(m, s) } else { residual_of_cut(m, m.loops.loops, s) }
}

#[inline(always)]
fn residual_of_cut<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    cut: &[ClosedLoop<T, S>],
    s: &mut Store<'_, T, S>,
) -> Result<Largest<T>, Outside> {
    let n = m.loops.rows.len();
    let (mut worst, mut row, mut scale) = (T::ZERO, 0, T::ZERO);
    for lap in cut {
        let [a, b] = lap.links;
        let (a, b) = (at(s.a, a as usize)?, at(s.a, b as usize)?);
        for k in lap.range() {
            let (first, second) = (at(s.gradient, k)?, at(s.gradient, n + k)?);
            let bias = at(s.rows, k)?[2];
            let left = first.dot(a) + second.dot(b) + bias;
            scale = scale.max(first.parts(a) + second.parts(b) + bias.abs());
            *at_mut(s.loops.l, k)? = left;
            if !(left.abs() <= worst) {
                (worst, row) = (left.abs(), index(k));
            }
        }
    }
    Ok((worst, row, scale))
}

/// True if the last factorisation is near a singular position: its rank is lower than the largest rank so far. Updates the largest rank.
pub(crate) fn note_rank<T: Real, S: Space<T>>(s: &mut Store<'_, T, S>) -> bool {
    let least = T::EPSILON.sqrt() * T::from_f64(NO_EFFECT);
    let rank = s.loops.pivots.iter().filter(|&&pivot| pivot > least).count();
    *s.rank = rank.max(*s.rank);
    rank < *s.rank
}

/// True if rows are redundant or a singular position is near. If Φ is not zero, redundant rows contradict each other. Positions and
/// velocities are therefore projected before accelerations are evaluated.
pub(crate) fn is_redundant<T: Real, S: Space<T>>(s: &Store<'_, T, S>) -> bool {
    has_pivot_below(T::EPSILON.sqrt(), s)
}

/// True if rows are nearly redundant. A small displacement by a projection may then change accelerations much.
pub(crate) fn is_tight<T: Real, S: Space<T>>(s: &Store<'_, T, S>) -> bool {
    has_pivot_below(T::from_f64(TIGHT).max(T::EPSILON.sqrt()), s)
}

/// True if a pivot of the last factorisation is NaN or at most `least`.
fn has_pivot_below<T: Real, S: Space<T>>(least: T, s: &Store<'_, T, S>) -> bool {
    s.loops.pivots.iter().any(|&pivot| !(pivot > least))
}

/// Repeats the solution for new right-hand sides until J a + bias is at its level. Returns the remaining residual.
fn sweep<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    level: Level,
    s: &mut Store<'_, T, S>,
) -> Result<T, Fault<T>> {
    let rounding = || T::EPSILON * T::from_f64(FINE_ROUNDINGS);
    let share = match level {
        Level::Once => return Ok(residual(m, s)?.0),
        Level::Fixed(sweeps) => {
            for _ in 0..sweeps {
                residual(m, s)?;
                improve(m, s)?;
            }
            return Ok(residual(m, s)?.0);
        }
        Level::Coarse => T::EPSILON.sqrt() * T::from_f64(COARSE),
        Level::Rates => (options.error * T::from_f64(RATES_FRACTION)).max(rounding()),
        Level::Fine => rounding(),
    };
    // Near a singular position a combination of rows is weakly determined, so that a part of its residual may remain.
    let enough = if note_rank(s) { T::from_f64(SINGULAR_RESIDUAL) } else { T::EPSILON.sqrt() };
    let mut last: Option<T> = None;
    for _ in 0..MAX_SWEEPS {
        let (worst, row, scale) = residual(m, s)?;
        let is_stuck = last.is_some_and(|last| !(worst < last * T::HALF));
        if worst <= share * scale || (is_stuck && worst <= enough * scale.max(acting(m, row, s)?)) {
            return Ok(worst);
        }
        if is_stuck || !worst.is_finite() {
            return Err(Fault::Unreached { level: 2, row, violation: worst });
        }
        last = Some(worst);
        improve(m, s)?;
    }
    let (worst, row, scale) = residual(m, s)?;
    if worst <= enough * scale.max(acting(m, row, s)?) {
        Ok(worst)
    } else {
        Err(Fault::Unreached { level: 2, row, violation: worst })
    }
}

/// Returns the largest acceleration along a row that gravity, the rows' speeds, or the rows' forces alone would cause. A residual that is
/// caused by rounding is small relative to this acceleration. This also holds if all accelerations cancel, for example in a structure at
/// rest or in free fall. The lower limit is the machine precision, so that the value is never zero.
fn acting<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    row: u32,
    s: &Store<'_, T, S>,
) -> Result<T, Outside> {
    let size = |k: usize| Ok(if at(m.loops.rows, k)?.is_angle() { T::ONE } else { m.length });
    let n = m.loops.rows.len();
    // Largest acceleration found so far, divided by the length for rows that are lengths [1/s^2].
    let mut acting = T::EPSILON.max(m.gravity.dot(&m.gravity).sqrt() / m.length);
    let forced = |k: usize| Ok(at(s.lambda, k)?.abs() * *at(s.loops.scales, k)? / size(k)?);
    for lap in m.loops.cut() {
        let [a, b] = lap.links;
        let speeds = [at(s.placed, a as usize)?.velocity, at(s.placed, b as usize)?.velocity];
        for k in lap.range() {
            let (first, second) = (at(s.gradient, k)?, at(s.gradient, n + k)?);
            let rate = (first.parts(&speeds[0]) + second.parts(&speeds[1])) / size(k)?;
            acting = acting.max(rate * rate).max(forced(k)?);
        }
    }
    for row in m.loops.coupled() {
        let here = (m.links, &*s.placed, (&*s.z, &*s.v, &*s.guides));
        let rate = m.loops.couplings.evaluate(row, here, None)?.parts[1] / size(row.1)?;
        acting = acting.max(rate * rate).max(forced(row.1)?);
    }
    Ok(acting * size(row as usize)?)
}

/// Computes the response to the residual l = J a + bias, and adds it to accelerations and multipliers.
#[inline(never)]
fn improve<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    respond(m, s)?;
    for (a, response) in s.a.iter_mut().zip(&*s.a_response) {
        *a += *response;
    }
    for (x, &response) in s.zdd.iter_mut().zip(&*s.v_response) {
        *x += response;
    }
    for (x, &response) in s.lambda.iter_mut().zip(&*s.loops.lambda) {
        *x += response;
    }
    Ok(())
}

/// Computes by one sweep the change of motion x with J x = −l that is smallest in the norm of the mass matrix. Writes x to `s.v_response`
/// (freedoms) and `s.a_response` (links).
pub(crate) fn respond<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    s.counts.responses += 1;
    for c in s.condensed.iter_mut() {
        (c.force, c.effort) = (S::Motion::zero(), T::ZERO);
    }
    passes::condense_again(m.links, s.placed, &m.loops, s.condensed, &mut s.loops)?;
    *at_mut(s.a_response, 0)? = S::Motion::zero();
    let parts = (&*s.placed, &*s.condensed);
    let out = (&mut *s.v_response, &mut *s.a_response);
    passes::accelerate(m.links, parts, (&m.loops, false), &mut s.loops, out)
}
