//! The trapezoidal rule and other integrators of the Newmark and generalised-alpha families, solved by fixed-point iteration [P3
//! (43)-(44)].
//!
//! ```text
//! δ = h ż + h² ((1/2 − β) z̈ + β z̈ₙ₊₁),   zₙ₊₁ = zₙ ⊕ δ       β = 1/4                  [P3 (43)]
//! żₙ₊₁ = żₙ + h ((1 − γ) z̈ + γ z̈ₙ₊₁)                           γ = 1/2                  [P3 (44)]
//! z̈ₙ₊₁ by the three passes at (zₙ₊₁, żₙ₊₁), until h² β Δz̈ is small
//! ```
//!
//! Generalised-alpha and HHT use auxiliary accelerations in both formulas, while z̈ₙ₊₁ satisfies the equations of motion at the end [P1
//! (32)] ([`Integrator::auxiliary`]).
//!
//! Within the passes, the forces of effects depend linearly on Δz̈. The iteration therefore contracts with stiff effects too
//! (`loads::Reach`). Iterates of models with effects are mixed (`anderson`). In models without effects the iteration is that of the source.
//!
//! Differences from the source: the code uses the increments δ in place of the quantities that the source writes with hats, because
//! increments have less rounding error. Rotations are quaternions, q exp(δ). Positions and velocities are projected onto the loops
//! afterwards, and the accelerations are those of the projected state.

pub use crate::passes::slices::Start;

use crate::link::indexing::{Outside, at, at_mut, copy};
use crate::link::options::{Closure, Options};
use crate::loads::Reach;
use crate::passes::anderson::Mixing;
use crate::passes::collapse::check_lines;
use crate::passes::coupled_rows;
use crate::passes::evaluate::{Level, accelerations, accelerations_ahead, is_redundant, note_rank};
use crate::passes::failure::failure;
use crate::passes::overturned::check_rotations;
use crate::passes::slices::{Inputs, Store, TreeSlices};
use crate::space::Space;
use crate::step::project::{advance, project, rounding};
use mbs_core::Real;
use mbs_core::algebra::norm_inf;
use mbs_core::integrator::Integrator;
use mbs_core::step::{StepError, StepReport, Stop, largest, largest_or_nan};

/// Number of consecutive iterates that do not halve the smallest correction, after which the iteration counts as stalled [-]. Chosen, not
/// tuned.
const STALLED: u32 = 4;
/// Growth of the residual between two iterates at which mixing restarts [-]. Chosen, not tuned.
const LOST: f64 = 4.0;
/// Correction that counts as rounding, relative to the displacement by accelerations in a step and in units of machine precision [-].
/// Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;
/// Correction that counts as an effect of the rounding of coordinates on forces, relative to the scene's length and in units of machine
/// precision [-]. Chosen, not tuned.
const PLACE_ROUNDINGS: f64 = 8.0;
/// Largest correction at which a stalled iteration without effects may end, relative to the displacement by accelerations [-]. Chosen, not
/// tuned.
const ENOUGH: f64 = 1e-2;
/// Largest correction at which a stalled iteration with effects may end, relative to the displacement by accelerations [-]. It is smaller
/// because a stiff effect turns a small error of position into a large force. Chosen, not tuned.
const ENOUGH_WITH_EFFECTS: f64 = 1e-6;
/// Largest correction at which a stalled iteration may end near a singular position, relative to the displacement by accelerations [-].
/// Rounding errors are amplified near such a position. Chosen, not tuned.
const PASSAGE: f64 = 0.1;

/// Makes one step of length `dt` [s] from a start and its auxiliary accelerations. The state at the end is written to `s.z`, `s.v`, `s.zdd`
/// and `s.lambda`.
///
/// Cost: three to six evaluations for steps that resolve the motion, with or without stiff effects; no allocation.
///
/// # Errors
/// [`StepError`]. The unknowns in the error are indices of freedoms; the rows are indices of loop equations.
pub fn step<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (dt, options): (T, &Options<T>),
    (start, aux): (Start<'_, T>, &[T]),
    s: &mut Store<'_, T, S>,
) -> Result<StepReport<T>, StepError> {
    s.counts = crate::passes::slices::Counts::default();
    let mut projects = false;
    if options.closure == Closure::Constraints && is_redundant(s) {
        // The projections within the iteration need factored inertias. They are factored at the start of the step.
        inputs.evaluate(start.t, s.guides, s.courses);
        s.z.copy_from_slice(start.z);
        s.v.copy_from_slice(start.v);
        s.begin_signals(T::ZERO, start.signals).map_err(|f| failure(m, f.into()))?;
        accelerations(m, options, Level::Once, s).map_err(|f| failure(m, f))?;
        projects = is_redundant(s);
    }
    inputs.evaluate(start.t + dt, s.guides, s.courses);
    s.begin_signals(dt, start.signals).map_err(|f| failure(m, f.into()))?;
    s.zdd.copy_from_slice(start.a);
    let (iterations, correction, stop) = iterate(m, (dt, options), ((start, aux), projects), s)?;
    let mut violation = [T::ZERO; 3];
    if options.closure == Closure::Constraints && !m.loops.loops.is_empty() {
        let [position, velocity] =
            project(m, (options, rounding()), s).map_err(|f| failure(m, f))?;
        violation = [position, velocity, T::ZERO];
        violation[2] = accelerations(m, options, Level::Fine, s).map_err(|f| failure(m, f))?;
    } else if !m.loops.loops.is_empty() {
        violation = violations(m, s);
    }
    check_rotations(m, inputs, (&start, dt), s)?;
    check_lines(m, inputs, (&start, dt), s)?;
    Ok(StepReport {
        iterations,
        factorizations: s.counts.condensations,
        solves: s.counts.responses,
        correction,
        stop,
        violation,
        ..StepReport::default()
    })
}

/// Runs the fixed-point iteration. Returns the number of iterations, the last correction, and the reason for the end.
fn iterate<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (dt, options): (T, &Options<T>),
    ((start, aux), projects): ((Start<'_, T>, &[T]), bool),
    s: &mut Store<'_, T, S>,
) -> Result<(u32, T, Stop), StepError> {
    let next = |i: usize, next| options.integrator.auxiliary(next, [start.a[i], aux[i]]);
    let reach = reach_of(&options.integrator, dt);
    let share = reach.place;
    let mut mixing = Mixing::default();
    let ([mut last, mut last_rest], mut is_slow) = ([T::ZERO; 2], projects);
    let (mut best, mut stalled) = (T::from_f64(f64::INFINITY), 0);
    for iterations in 1..=options.max_iterations {
        reach_end(m, (dt, options), (&start, aux, next), s).map_err(|f| failure(m, f.into()))?;
        s.scratch.copy_from_slice(s.zdd);
        if is_slow {
            project(m, (options, rounding()), s).map_err(|f| failure(m, f))?;
        }

        // accelerations z̈ₙ₊₁ by the three passes
        if m.loads.is_empty() {
            accelerations(m, options, Level::Coarse, s)
        } else {
            accelerations_ahead(m, options, (Level::Coarse, reach), s)
        }
        .map_err(|f| failure(m, f))?;
        for i in 0..start.v.len() {
            s.scratch[i] -= s.zdd[i];
        }
        // In slowly converging directions the correction is much smaller than the error. The length of the mixed move is therefore used as
        // the estimate of the error.
        let rest = norm_inf(s.scratch) * share;
        let mut correction = rest;
        if !m.loads.is_empty() {
            correction = rest.max(mixing.take(s.scratch, s.zdd, s.history) * share);
        }
        let scale = norm_inf(s.zdd) * dt * dt * T::HALF;
        if !correction.is_finite() {
            return Err(StepError::NotFinite { unknown: largest_or_nan(s.zdd) });
        }
        let is_best = correction + correction <= best;
        (best, stalled) = if is_best { (correction, 0) } else { (best, stalled + 1) };
        // The iteration has also converged if the next correction, extrapolated from the last two corrections, is below the tolerance.
        let goal = scale * options.tolerance;
        let rate = if last > T::ZERO { (correction / last).max(rest / last_rest) } else { T::ONE };
        if correction <= goal || (iterations > 2 && rate < T::HALF && correction * rate <= goal) {
            return Ok((iterations, correction, Stop::Converged));
        }
        if iterations > 2
            && rate >= T::HALF
            && let Some(stop) = given_up(m, options, ([rest, correction], scale, stalled), s)
        {
            return Ok((iterations, correction, stop));
        }
        // Near a singular position accelerations depend on the violations of z and v, so each iteration projects z and v.
        let was_slow = is_slow;
        is_slow |= iterations > 2 && rate >= T::HALF && options.closure == Closure::Constraints;
        let is_lost = iterations > 1 && rest > last_rest * T::from_f64(LOST);
        (last, last_rest) = (correction, rest);
        if !m.loads.is_empty() {
            if is_slow != was_slow || is_lost {
                mixing = Mixing::default();
            } else {
                Mixing::mix(s.zdd, s.history);
            }
        }
    }
    Err(StepError::NotConverged {
        iterations: options.max_iterations,
        correction: (last / m.length).to_f64(),
        unknown: largest(s.scratch),
    })
}

/// Returns the coefficients by which accelerations at the end of a step change positions and velocities at the end.
fn reach_of<T: Real>(integrator: &Integrator<T>, dt: T) -> Reach<T> {
    let share = integrator.share();
    Reach { place: dt * dt * integrator.beta * share, speed: dt * integrator.gamma * share }
}

/// Returns the reason why an iteration that does not contract may end with this correction. Returns `None` if it may not end. `scale` is
/// the displacement by accelerations in the step.
fn given_up<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    ([rest, correction], scale, stalled): ([T; 2], T, u32),
    s: &mut Store<'_, T, S>,
) -> Option<Stop> {
    let rounding = T::EPSILON * T::from_f64(ROUNDINGS);
    let rounded = m.length * T::EPSILON * T::from_f64(PLACE_ROUNDINGS);
    let has_effects = !m.loads.is_empty();
    let enough = if has_effects { T::tolerance(ENOUGH_WITH_EFFECTS) } else { T::from_f64(ENOUGH) };
    let passage = T::from_f64(PASSAGE);
    if correction <= scale * rounding || rest <= rounded {
        return Some(Stop::Rounding);
    }
    if correction <= scale * passage && note_rank(s) {
        return Some(Stop::Passage);
    }
    // The correction is small relative to the scene and the step. The corrections of mixed iterates do not decrease monotonically, so an
    // iteration with mixing must also have stalled.
    let is_small = correction <= m.length * options.tolerance && correction <= scale * enough;
    (is_small && (!has_effects || stalled >= STALLED)).then_some(Stop::Tolerance)
}

/// Computes zₙ₊₁ and żₙ₊₁ from z̈ₙ₊₁. `aux` has the auxiliary accelerations at the start; `next` returns an auxiliary acceleration at the
/// end. The increments are written to `s.scratch`.
#[inline]
pub(crate) fn reach_end<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (dt, options): (T, &Options<T>),
    (start, aux, next): (&Start<'_, T>, &[T], impl Fn(usize, T) -> T),
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    let (beta, gamma) = (options.integrator.beta, options.integrator.gamma);
    for (i, (&v, &a)) in start.v.iter().zip(aux).enumerate() {
        // velocities and increments by [P3 (43)-(44)]
        let next = next(i, *at(s.zdd, i)?);
        *at_mut(s.v, i)? = v + dt * ((T::ONE - gamma) * a + gamma * next);
        *at_mut(s.scratch, i)? = dt * (v + dt * ((T::HALF - beta) * a + beta * next));
    }
    copy(start.z, s.z)?;
    advance(m.links, s.scratch, s.z)
}

/// Returns the largest |Φ|, |Φ̇| and |Φ̈| over all rows, from the last evaluation.
pub(crate) fn violations<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &Store<'_, T, S>,
) -> [T; 3] {
    let n = m.loops.rows.len();
    let mut largest = [T::ZERO; 3];
    for lap in m.loops.cut() {
        let [a, b] = lap.links.map(|i| &s.a[i as usize]);
        for k in lap.first as usize..(lap.first + lap.n) as usize {
            use crate::space::Numbers;
            let [phi, phi_d, bias] = s.rows[k];
            let phi_dd = s.gradient[k].dot(a) + s.gradient[n + k].dot(b) + bias;
            for (most, x) in largest.iter_mut().zip([phi, phi_d, phi_dd]) {
                *most = most.max(x.abs());
            }
        }
    }
    if m.loops.has_coupled() { coupled_rows::violations(m, s, largest) } else { largest }
}
