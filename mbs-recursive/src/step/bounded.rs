//! A step with a bounded number of operations: the trapezoidal rule with a fixed number of evaluations, sweeps and projections.
//!
//! ```text
//! z̈ ← z̈ₙ;   k times:   zₙ₊₁, żₙ₊₁ from z̈   [P3 (43)–(44)],   z̈ by the three passes, effects ahead (`loads::Reach`)
//! zₙ₊₁, żₙ₊₁ from the last z̈
//! p times:   z ← z ⊕ −M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ,   v ← v − M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ̇      both at the same places
//! ```
//!
//! k is the number of evaluations and p the number of projections. M is the mass matrix, J the Jacobian of the loops' equations Φ, and ε
//! the regularisation.
//!
//! The number of iterations is fixed, so that the work of a step depends on the mechanism alone. The remaining residuals are reported. The
//! method is `trapezoidal` with a fixed number of iterations. It does not mix iterates, does not evaluate accelerations at the projected
//! end, and uses one outward pass for both projections. A step starts from the accelerations of the last evaluation, which differ from the
//! converged accelerations by O(h²).

use crate::link::indexing::{Outside, at_mut, copy};
use crate::link::options::{Closure, Options};
use crate::loads::Reach;
use crate::loops::Fault;
use crate::passes::collapse::check_parts;
use crate::passes::coupled_rows;
use crate::passes::evaluate::{Level, accelerations, accelerations_ahead, respond};
use crate::passes::failure::failure;
use crate::passes::kinematics;
use crate::passes::overturned::check_rotations;
use crate::passes::slices::{Counts, Inputs, Start, Store, TreeSlices};
use crate::space::Space;
use crate::step::project::advance;
use crate::step::trapezoidal::reach_end;
use mbs_core::Real;
use mbs_core::algebra::norm_inf;
use mbs_core::step::{OptionError, StepError, largest_or_nan};

/// Limits of the work of a step: numbers of evaluations, sweeps and projections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bounds {
    /// Number of evaluations of the accelerations, at least one.
    pub evaluations: u32,
    /// Number of sweeps of the loops' equations in each evaluation, after the first sweep.
    pub sweeps: u32,
    /// Number of projections of positions and velocities.
    pub projections: u32,
}

impl Default for Bounds {
    /// Returns one evaluation, no further sweep, one projection.
    fn default() -> Self {
        Self { evaluations: 1, sweeps: 0, projections: 1 }
    }
}

/// Clock that reports whether time remains. A step calls it before each evaluation except the first, and before each projection.
pub trait Watch {
    /// True if time remains for a further evaluation or projection.
    fn has_time(&mut self) -> bool;
}

/// Clock for steps without a time limit: it always reports that time remains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    #[inline(always)]
    fn has_time(&mut self) -> bool {
        true
    }
}

impl<F: FnMut() -> bool> Watch for F {
    #[inline(always)]
    fn has_time(&mut self) -> bool {
        self()
    }
}

/// Work of a bounded step and its remaining errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundedReport<T> {
    /// Number of evaluations made.
    pub evaluations: u32,
    /// Number of projections made.
    pub projections: u32,
    /// Largest last correction of a coordinate: β h² times the last change of an acceleration [m or rad].
    pub correction: T,
    /// Largest |Φ| and |Φ̇| before the last projection [m, m/s], and largest |Φ̈| after the last sweep [m/s^2]. The projection multiplies
    /// |Φ| and |Φ̇| by about ε, and adds a part of second order.
    pub violation: [T; 3],
    /// Is true if time ran out, so that evaluations or projections were omitted.
    pub is_cut_short: bool,
}

/// Makes one step of length `dt` [s]. The state at the end is written to `s.z`, `s.v`, `s.zdd` and `s.lambda`.
///
/// Three of the `options` are used: the integrator (of the Newmark family), the closure and the regularisation.
///
/// Cost: `bounds.evaluations` evaluations, one response for each further sweep, and two for each projection; no allocation.
///
/// # Errors
/// [`StepError::NotFinite`], [`StepError::Singular`], [`StepError::RankLost`], [`StepError::Tables`], [`StepError::BadOption`];
/// [`StepError::RopeCollapsed`] and [`StepError::LineCollapsed`] if a part of a line has length zero.
pub fn step<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (dt, options, bounds): (T, &Options<T>, Bounds),
    (start, watch): (Start<'_, T>, &mut impl Watch),
    s: &mut Store<'_, T, S>,
) -> Result<BoundedReport<T>, StepError> {
    if !options.integrator.is_newmark() {
        return Err(OptionError::NotBuilt("integrator").into());
    }
    s.counts = Counts::default();
    inputs.evaluate(start.t + dt, s.guides, s.courses);
    s.begin_signals(dt, start.signals).map_err(|outside| failure(m, outside.into()))?;
    let report = advance_by(m, (dt, options, bounds), (start, watch), s);
    let report = report.map_err(|fault| failure(m, fault))?;
    check_rotations(m, inputs, (&start, dt), s)?;
    check_parts(m, inputs, (&start, dt), s)?;
    if report.correction.is_finite() {
        Ok(report)
    } else {
        Err(StepError::NotFinite { unknown: largest_or_nan(s.zdd) })
    }
}

/// Evaluates accelerations and multipliers at the coordinates `z` and velocities `v`, with the guides and signals in `s`. Writes them to
/// `s.zdd` and `s.lambda`. `signals` are the states of signals. They are written to `s.signals.ends` with their rates. After a change of
/// inputs, the next step starts from these accelerations.
///
/// Cost: one evaluation; no allocation.
///
/// # Errors
/// The errors of [`step`].
pub fn begin<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (options, bounds): (&Options<T>, Bounds),
    (z, v, signals): (&[T], &[T], &[[T; 2]]),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    let place = |s: &mut Store<'_, T, S>| -> Result<(), Fault<T>> {
        s.begin_signals(T::ZERO, signals)?;
        copy(z, s.z)?;
        copy(v, s.v)?;
        accelerations(m, options, Level::Fixed(bounds.sweeps), s).map(drop)
    };
    place(s).map_err(|fault| failure(m, fault))?;
    if s.zdd.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(StepError::NotFinite { unknown: largest_or_nan(s.zdd) })
    }
}

/// Makes the bounded step. The inputs must already be in `s`.
fn advance_by<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (dt, options, bounds): (T, &Options<T>, Bounds),
    (start, watch): (Start<'_, T>, &mut impl Watch),
    s: &mut Store<'_, T, S>,
) -> Result<BoundedReport<T>, Fault<T>> {
    copy(start.a, s.zdd)?;
    let share = dt * dt * options.integrator.beta;
    let reach = Reach { place: share, speed: dt * options.integrator.gamma };
    let level = Level::Fixed(bounds.sweeps);
    let mut report = BoundedReport {
        evaluations: 0,
        projections: 0,
        correction: T::ZERO,
        violation: [T::ZERO; 3],
        is_cut_short: false,
    };
    let evaluations = bounds.evaluations.max(1);
    loop {
        reach_end(m, (dt, options), (&start, start.a, |_, next| next), s)?;
        if report.evaluations == evaluations {
            break;
        }
        if report.evaluations > 0 && !watch.has_time() {
            report.is_cut_short = true;
            break;
        }
        copy(s.zdd, s.scratch)?;
        report.violation[2] = if m.loads.is_empty() {
            accelerations(m, options, level, s)?
        } else {
            accelerations_ahead(m, options, (level, reach), s)?
        };
        for (x, &zdd) in s.scratch.iter_mut().zip(&*s.zdd) {
            *x -= zdd;
        }
        report.correction = norm_inf(s.scratch) * share;
        report.evaluations += 1;
    }
    if options.closure == Closure::Constraints && !m.loops.loops.is_empty() {
        for _ in 0..bounds.projections {
            if !watch.has_time() {
                report.is_cut_short = true;
                break;
            }
            let [position, velocity] = project(m, s)?;
            (report.violation[0], report.violation[1]) = (position, velocity);
            report.projections += 1;
        }
    }
    Ok(report)
}

/// Projects positions and velocities once with the inertias that were factored last. Returns the largest |Φ| and |Φ̇| before the
/// projection.
fn project<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<[T; 2], Outside> {
    kinematics(m.links, (s.z, s.v, s.guides), s.trial)?;
    let mut largest = [T::ZERO; 2];
    for lap in m.loops.cut() {
        lap.evaluate(m.loops.rows, s.trial, |k, values| {
            *at_mut(s.loops.l, k)? = values.value;
            at_mut(s.rows, k)?[1] = values.rate;
            largest = [largest[0].max(values.value.abs()), largest[1].max(values.rate.abs())];
            Ok(())
        })?;
    }
    if m.loops.has_coupled() {
        largest = coupled_rows::at_trial(m, s, largest)?;
    }
    respond(m, s)?;
    advance(m.links, s.v_response, s.z)?;
    for (l, row) in s.loops.l.iter_mut().zip(&*s.rows) {
        *l = row[1];
    }
    respond(m, s)?;
    for (v, &response) in s.v.iter_mut().zip(&*s.v_response) {
        *v += response;
    }
    Ok(largest)
}
