//! A state that the caller sets: it is projected onto the loops, and its accelerations are evaluated.
//!
//! ```text
//! z ← z ⊕ −M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ,   then v ← v − M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ̇,   each again and again
//! z̈ by the three passes there
//! ```
//!
//! M and J are evaluated at the given state. All loops are closed together. To first order, the change is the smallest in the norm of the
//! mass matrix. Velocities are projected with the same M and J. If the sweeps converge too slowly, M and J are evaluated again.
//!
//! Sweeps end when the remaining violation is rounding. Sweeps also end when the violation no longer halves and is below √ε/10 of the
//! scene's length, with the machine precision ε. Near a singular position this limit is 100 √ε. The report contains the remaining
//! violation; the next step projects it again.

use crate::link::indexing::{Outside, copy, part_mut};
use crate::link::options::{Closure, Options};
use crate::link::{Link, LinkKind};
use crate::loops::Fault;
use crate::passes::collapse::check_lines;
use crate::passes::evaluate::{Level, accelerations};
use crate::passes::failure::failure;
use crate::passes::overturned::check_rotations;
use crate::passes::slices::{Counts, Inputs, Start, Store, TreeSlices};
use crate::space::Space;
use crate::step::project::onto_loops;
use mbs_core::Real;
use mbs_core::step::{StepError, largest_or_nan};

/// Error of a quaternion's squared length below which the quaternion is not normalised, in units of machine precision [-]. The quaternions
/// that steps compute have errors below four units, so that setting such a state does not change their bits.
const UNIT_ROUNDINGS: f64 = 16.0;

/// Work and results of setting a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateReport<T> {
    /// Number of evaluations of the accelerations: one without loops, two with closed loops, and up to five if the loops are far from
    /// closed.
    pub evaluations: u32,
    /// Number of responses of the tree, one for each sweep that closes loops or refines accelerations. A response takes about a fifth of an
    /// evaluation.
    pub responses: u32,
    /// Largest change of a coordinate by closing the loops and normalising quaternions [m; rad; - for quaternions].
    pub moved: T,
    /// Largest remaining |Φ|, |Φ̇| and |Φ̈| [m, m/s, m/s^2].
    pub violation: [T; 3],
}

/// Sets the state `start`. Its positions and velocities are projected onto the loops and written to `s.z` and `s.v`. The accelerations and
/// multipliers of the projected state are written to `s.zdd` and `s.lambda`. The accelerations of `start` are not read. The states of
/// signals are unchanged, and are written to `s.signals.ends` with their rates.
///
/// Three of the `options` are used: the regularisation, the number of sweeps of a projection, and the closure for the accelerations.
///
/// Cost: one evaluation. With loops, one more evaluation and a response for each sweep. Near a closed state there are at most
/// `2 (max_sweeps + 1)` sweeps for the loops and thirty for the accelerations. Far from closure there are at most four evaluations and
/// `5 (max_sweeps + 1)` sweeps for the loops. No allocation.
///
/// # Errors
/// [`StepError::Violated`] if the loops do not close. Other errors are those of [`step`](crate::step::trapezoidal::step).
pub fn set_state<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    options: &Options<T>,
    start: &Start<'_, T>,
    s: &mut Store<'_, T, S>,
) -> Result<StateReport<T>, StepError> {
    s.counts = Counts::default();
    inputs.evaluate(start.t, s.guides, s.courses);
    let report = close(m, options, start, s).map_err(|fault| failure(m, fault))?;
    for numbers in [&*s.z, &*s.v, &*s.zdd, &*s.lambda] {
        if !numbers.iter().all(|x| x.is_finite()) {
            return Err(StepError::NotFinite { unknown: largest_or_nan(numbers) });
        }
    }
    check_rotations(m, inputs, (start, T::ZERO), s)?;
    check_lines(m, inputs, (start, T::ZERO), s)?;
    Ok(report)
}

/// Closes all loops together. The inputs must already be in `s`.
fn close<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    start: &Start<'_, T>,
    s: &mut Store<'_, T, S>,
) -> Result<StateReport<T>, Fault<T>> {
    s.begin_signals(T::ZERO, start.signals)?;
    copy(start.z, s.z)?;
    copy(start.v, s.v)?;
    make_unit(m.links, s.z)?;
    // A projection uses inertias and rows, but no forces: effects are not evaluated.
    let bare = TreeSlices { loads: &[], ..*m };
    let projected = Options { closure: Closure::Constraints, ..*options };
    let [position, velocity] = onto_loops(&bare, &projected, s)?;
    let acceleration = accelerations(m, options, Level::Fine, s)?;
    let moves = s.z.iter().zip(start.z).map(|(&z, &given)| (z - given).abs());
    Ok(StateReport {
        evaluations: s.counts.condensations,
        responses: s.counts.responses,
        moved: moves.fold(T::ZERO, T::max),
        violation: [position, velocity, acceleration],
    })
}

/// Normalises the quaternions of ball joints and free links to unit length.
fn make_unit<T: Real, S: Space<T>>(links: &[Link<T, S>], z: &mut [T]) -> Result<(), Outside> {
    if S::DIMENSION < 3 {
        return Ok(());
    }
    let rounding = T::EPSILON * T::from_f64(UNIT_ROUNDINGS);
    for link in links.iter().skip(1) {
        if !matches!(link.kind, LinkKind::Ball | LinkKind::Free) {
            continue;
        }
        let q = part_mut(z, link.z as usize, S::FREE - 3)?;
        let square = q.iter().fold(T::ZERO, |sum, &x| sum + x * x);
        if (square - T::ONE).abs() > rounding {
            S::normalise_rotation(q);
        }
    }
    Ok(())
}
