//! Projection of positions and velocities onto the loops' equations. The change is the smallest in the norm of the mass matrix.
//!
//! ```text
//! δ = −M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ,   z ← z ⊕ δ       until Φ is at its level
//! v ← v − M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ̇                 until Φ̇ is
//! ```
//!
//! z are the coordinates, v the velocities, and ⊕ moves coordinates along the freedoms. M is the mass matrix, J the Jacobian of the loops'
//! equations Φ, and ε the regularisation.
//!
//! The level is the violation at which sweeps end. At the end of a step or of a call it is rounding. Between the steps of a call with error
//! control it is a hundredth of the required error, or rounding near singular positions.
//!
//! Both changes are responses of the tree with its last factored inertias. These are accurate enough after a step, because the residuals
//! are always evaluated at the new state. The inertias include the resistance of effects to accelerations, so that the projection deforms
//! stiff springs little. Cost: an evaluation of the rows and about a fifth of a condensation for each sweep.

use crate::link::indexing::{Outside, at, at_mut, part, part_mut};
use crate::link::options::Options;
use crate::link::{Link, LinkKind};
use crate::loops::{Fault, index};
use crate::passes::coupled_rows::{self, Largest};
use crate::passes::evaluate::{Level, accelerations, note_rank, respond};
use crate::passes::inverse::spread_each;
use crate::passes::kinematics;
use crate::passes::slices::{Store, TreeSlices};
use crate::rows::closed_loop::ClosedLoop;
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Moves coordinates along the freedoms: z ← z ⊕ δ.
pub(crate) fn advance<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    delta: &[T],
    z: &mut [T],
) -> Result<(), Outside> {
    let turn = S::FREE - S::Point::N;
    for link in links.iter().skip(1) {
        let (first, from) = (link.z as usize, link.v as usize);
        match link.kind {
            LinkKind::Revolute | LinkKind::Prismatic => *at_mut(z, first)? += *at(delta, from)?,
            LinkKind::Ball => {
                let delta = part(delta, from, S::Spin::N)?;
                S::advance_rotation(part_mut(z, first, turn)?, delta);
            }
            LinkKind::Free => {
                let angles = part(delta, from, S::Spin::N)?;
                S::advance_rotation(part_mut(z, first, turn)?, angles);
                let place = part_mut(z, first + turn, S::Point::N)?;
                let way = part(delta, from + S::Spin::N, S::Point::N)?;
                for (z, &way) in place.iter_mut().zip(way) {
                    *z += way;
                }
            }
            LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => {}
        }
    }
    Ok(())
}

/// Violation that counts as rounding, relative to its scale and in units of machine precision [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 16.0;
/// Violation allowed between the steps of a call with error control, relative to the required error [-]. A hundredth hardly adds to this
/// error. Chosen, not tuned.
const ERROR_FRACTION: f64 = 0.01;
/// Violation that is accepted if sweeps stall, relative to its scale and in units of the square root of machine precision [-]. Chosen, not
/// tuned.
const STALLED: f64 = 0.1;
/// Violation that is accepted near a singular position, relative to its scale and in units of the square root of machine precision [-]. A
/// combination of rows has no effect on the motion at such a position. Chosen, not tuned.
const STALLED_SINGULAR: f64 = 1e2;

/// Largest number of attempts to close the loops [-]. Each attempt factors inertias and rows at the positions that the last attempt
/// reached. Chosen, not tuned.
const MAX_CLOSINGS: u32 = 4;
/// Violation below which a further attempt is made, relative to the scene's length [-]. Below it the sweeps converged, although slowly.
/// Chosen, not tuned.
const NEARING: f64 = 0.1;

/// Returns the smallest level of a projection: the rounding error, relative to the scales of Φ and Φ̇.
pub(crate) fn rounding<T: Real>() -> T {
    T::EPSILON * T::from_f64(ROUNDINGS)
}

/// Returns the level of a projection between the steps of a call with error control: a fraction of the required `error`.
pub(crate) fn share_of<T: Real>(error: T) -> T {
    (error * T::from_f64(ERROR_FRACTION)).min(T::EPSILON.sqrt()).max(rounding())
}

/// Projects positions and velocities of the store onto the loops, from any state. Inertias are factored at that state first. If the sweeps
/// converge too slowly, inertias are factored again.
///
/// Cost: without loops nothing. With loops one evaluation, and one response for each sweep. If the loops are far from closed, up to
/// [`MAX_CLOSINGS`] evaluations.
pub(crate) fn onto_loops<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    s: &mut Store<'_, T, S>,
) -> Result<[T; 2], Fault<T>> {
    if m.loops.rows.is_empty() {
        return Ok([T::ZERO; 2]);
    }
    let (mut enough, mut left) = (m.length * T::from_f64(NEARING), MAX_CLOSINGS);
    loop {
        accelerations(m, options, Level::Once, s)?;
        left -= 1;
        match project(m, (options, rounding()), s) {
            Err(Fault::Unreached { level: 0, violation, .. }) if left > 0 && violation < enough => {
                enough = violation * T::HALF;
            }
            done => return done,
        }
    }
}

/// Projects the positions and velocities of the store until their violations are at most the fraction `share` of their scales. Returns the
/// largest remaining |Φ| and |Φ̇|.
pub(crate) fn project<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (options, share): (&Options<T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<[T; 2], Fault<T>> {
    if m.loops.loops.is_empty() {
        return Ok([T::ZERO; 2]);
    }
    kinematics(m.links, (s.z, s.v, s.guides), s.trial)?;
    let position = settle(m, (options, share), 0, s)?;
    let velocity = settle(m, (options, share), 1, s)?;
    Ok([position, velocity])
}

/// Corrects positions (level 0) or velocities (level 1) by sweeps until the violation is at most `share` of its scale. Before and after the
/// call, `s.trial` has the places and motions of the state.
fn settle<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (options, share): (&Options<T>, T),
    level: u8,
    s: &mut Store<'_, T, S>,
) -> Result<T, Fault<T>> {
    // Near a singular position a combination of rows hardly affects the motion, so that a part of its violation may remain.
    let leave = if note_rank(s) { STALLED_SINGULAR } else { STALLED };
    let enough = T::EPSILON.sqrt() * T::from_f64(leave);
    let mut last: Option<T> = None;
    for _ in 0..=options.max_sweeps {
        let Violation { worst, row, scale, is_within } = violation(m, (level, share), s)?;
        let is_stuck = last.is_some_and(|last| !(worst < last * T::HALF));
        if is_within
            || (is_stuck && (worst <= enough * scale || is_elsewhere(m, (level, worst), s)))
        {
            return Ok(worst);
        }
        // The first sweep may overshoot if the loops are far from closed. Later sweeps must not grow.
        if !worst.is_finite() || last.is_some_and(|last| worst > last * T::TWO) {
            return Err(Fault::Unreached { level, row, violation: worst });
        }
        last = Some(worst);
        respond(m, s)?;
        if level == 0 {
            advance(m.links, s.v_response, s.z)?;
        } else {
            for (v, &response) in s.v.iter_mut().zip(&*s.v_response) {
                *v += response;
            }
        }
        kinematics(m.links, (s.z, s.v, s.guides), s.trial)?;
    }
    let Violation { worst, row, scale, .. } = violation(m, (level, share), s)?;
    if worst <= enough * scale || is_elsewhere(m, (level, worst), s) {
        Ok(worst)
    } else {
        Err(Fault::Unreached { level, row, violation: worst })
    }
}

/// True if this velocity violation is only the rounding error of larger velocities of other links. A link may be at rest although the
/// joints between it and the ground move. The speeds of its rows are then rounding errors of these joints' rates.
#[inline(never)]
fn is_elsewhere<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (level, worst): (u8, T),
    s: &Store<'_, T, S>,
) -> bool {
    let fastest = s.v.iter().fold(T::ZERO, |most, v| most.max(v.abs()));
    // The rates are in m/s or rad/s. The length is therefore replaced by one if it is smaller.
    level > 0 && worst <= rounding::<T>() * fastest * m.length.max(T::ONE)
}

/// Removes from an error δ of velocities, or of freedoms, the part that a projection removes: δ − M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ J δ. The rows and
/// inertias are those of the last evaluation, at `s.z` and `s.v`. Near a singular position most of the rounding error has directions that
/// the constraints forbid slightly further along the motion. If this part counted as an error, error control would reduce the step without
/// effect.
pub(crate) fn keep<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    delta: &mut [T],
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    *at_mut(s.a_response, 0)? = S::Motion::zero();
    spread_each(m.links, (s.placed, false), delta, s.a_response)?;
    let n = m.loops.rows.len();
    for lap in m.loops.cut() {
        let [a, b] = lap.links;
        let (a, b) = (at(s.a_response, a as usize)?, at(s.a_response, b as usize)?);
        for k in lap.range() {
            let (first, second) = (at(s.gradient, k)?, at(s.gradient, n + k)?);
            *at_mut(s.loops.l, k)? = first.dot(a) + second.dot(b);
        }
    }
    if m.loops.has_coupled() {
        coupled_rows::along(m, delta, s)?;
    }
    respond(m, s)?;
    for (delta, &response) in delta.iter_mut().zip(&*s.v_response) {
        *delta += response;
    }
    Ok(())
}

/// Violation of the loops' equations, with the scale to which it is compared.
struct Violation<T> {
    /// The largest |Φ| or |Φ̇|.
    worst: T,
    /// Index of the row with the largest violation.
    row: u32,
    /// Scale of the violation: the scene's length for positions, the speed of the fastest row for velocities.
    scale: T,
    /// True if two conditions hold: the violation of each row is within the tolerance relative to max(1, speed of the row), and the largest
    /// violation is within the tolerance relative to `scale`. Also true if the largest violation is rounding.
    is_within: bool,
}

/// Writes Φ or Φ̇ at the trial state into l, and returns the violation.
fn violation<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (level, share): (u8, T),
    s: &mut Store<'_, T, S>,
) -> Result<Violation<T>, Outside> {
    #[inline(never)]
    fn with_coupled<T: Real, S: Space<T>>(
        m: &TreeSlices<'_, T, S>,
        limits: (u8, T),
        s: &mut Store<'_, T, S>,
    ) -> Result<(Largest<T>, bool), Outside> {
        let found = violation_of_cut(m, m.loops.cut(), limits, s)?;
        coupled_rows::violation(m, limits, s, found)
    }
    let limits = (level, share);
    let ((worst, row, scale), is_within) = if m.loops.has_coupled() {
        with_coupled(m, limits, s)?
    } else {
        violation_of_cut(m, m.loops.loops, limits, s)?
    };
    let is_within = (is_within && worst <= share * scale) || worst <= rounding::<T>() * scale;
    Ok(Violation { worst, row, scale, is_within })
}

#[inline(always)]
fn violation_of_cut<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    cut: &[ClosedLoop<T, S>],
    (level, share): (u8, T),
    s: &mut Store<'_, T, S>,
) -> Result<(Largest<T>, bool), Outside> {
    let (mut worst, mut row, mut is_within) = (T::ZERO, 0, true);
    // A speed below the rounding error of one length per second counts as zero.
    let mut scale = if level == 0 { m.length } else { m.length * T::EPSILON };
    for lap in cut {
        let [a, b] = lap.links;
        let speeds = [at(s.trial, a as usize)?.velocity, at(s.trial, b as usize)?.velocity];
        lap.evaluate(m.loops.rows, s.trial, |k, values| {
            let x = if level == 0 { values.value } else { values.rate };
            // The tolerance is that of the error of a step: absolute for positions, absolute and relative for velocities.
            let mut own = T::ONE;
            if level > 0 {
                let [first, second] = &values.gradient;
                let speed = first.parts(&speeds[0]) + second.parts(&speeds[1]);
                (scale, own) = (scale.max(speed), own.max(speed));
            }
            is_within &= x.abs() <= share * own;
            *at_mut(s.loops.l, k)? = x;
            if !(x.abs() <= worst) {
                (worst, row) = (x.abs(), index(k));
            }
            Ok(())
        })?;
    }
    Ok(((worst, row, scale), is_within))
}
