//! A state that is set from outside: brought onto the loops, with its accelerations.
//!
//! ```text
//! z ← z ⊕ −M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ   until Φ is rounding,   v ← v − M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ̇   until Φ̇ is
//! z̈ by the three passes there
//! ```
//!
//! M is the mass matrix at the state that was given: each loop is closed by the moves that are smallest in the masses' norm.

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

/// Error of a quaternion's squared length that is left as it is, in units of rounding [-]. The quaternions of steps are within four:
/// their bits stay.
const UNIT_ROUNDINGS: f64 = 16.0;

/// Work of a state that was set, and what it changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateReport<T> {
    /// Evaluations of the accelerations: one, with closed loops two.
    pub evaluations: u32,
    /// Responses of the tree, each about a fifth of an evaluation: one for each sweep that closes loops or betters accelerations.
    pub responses: u32,
    /// Largest change of a coordinate by the closing of loops and the unit length of quaternions [m or rad].
    pub moved: T,
    /// Largest |Φ|, |Φ̇| and |Φ̈| that are left [m, m/s, m/s^2].
    pub violation: [T; 3],
}

/// Sets a state: positions and velocities of `start` on the loops, and accelerations there, are in `s.z`, `s.v`, `s.zdd`, `s.lambda`. Those of
/// `start` are not read. States of signals stay, and are in `s.signals.ends` with their rates.
///
/// Of `options` the regularisation, the sweeps of a projection, and for the accelerations the closure count.
///
/// Cost: one evaluation; with loops another one and a response for each sweep, of which there are at most twice `max_sweeps` and two, and thirty
/// for the accelerations. No allocation.
///
/// # Errors
/// [`StepError::Violated`] if the loops do not close; else as for [`step`](crate::step::trapezoidal::step).
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
    for numbers in [&*s.z, &*s.v, &*s.zdd] {
        if !numbers.iter().all(|x| x.is_finite()) {
            return Err(StepError::NotFinite { unknown: largest_or_nan(s.zdd) });
        }
    }
    check_rotations(m, inputs, (start, T::ZERO), s)?;
    check_lines(m, inputs, (start, T::ZERO), s)?;
    Ok(report)
}

/// Closes the loops at given inputs.
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
    // Effects do not count where loops are closed: their work would be lost.
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

/// Gives the quaternions of balls and free links unit length.
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
