//! A state that is set from outside: brought onto the loops, with its accelerations.
//!
//! ```text
//! z ← z ⊕ −M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ,   then v ← v − M⁻¹ Jᵀ (J M⁻¹ Jᵀ + ε)⁻¹ Φ̇,   each again and again
//! z̈ by the three passes there
//! ```
//!
//! M and J are those of the state that was given: all loops are closed together, by the smallest move in the norm of the masses to
//! first order. Velocities are projected along the same directions. Where sweeps come nearer too slowly, M and J are taken anew.
//!
//! Sweeps go on until what is left is rounding. They also end where it no longer halves and is below a tenth of √ε of the scene's
//! length, near a singular position below 100 √ε. The report says what is left; the next step projects it again.

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
    /// Evaluations of the accelerations: one, with closed loops two, where they are far from closed up to five.
    pub evaluations: u32,
    /// Responses of the tree, each about a fifth of an evaluation: one for each sweep that closes loops or refines accelerations.
    pub responses: u32,
    /// Largest change of a coordinate by the closing of loops and the unit length of quaternions [m, rad or, of quaternions, -].
    pub moved: T,
    /// Largest |Φ|, |Φ̇| and |Φ̈| that are left [m, m/s, m/s^2].
    pub violation: [T; 3],
}

/// Sets a state: positions and velocities of `start` on the loops are in `s.z` and `s.v`, accelerations and multipliers there in `s.zdd` and
/// `s.lambda`. Accelerations of `start` are not read. States of signals stay, and are in `s.signals.ends` with their rates.
///
/// Of `options` the regularisation, the sweeps of a projection, and for the accelerations the closure count.
///
/// Cost: one evaluation; with loops another one and a response for each sweep. Near a closed state there are at most `2 (max_sweeps + 1)`
/// sweeps for the loops and thirty for the accelerations. Far off there are at most four evaluations and `5 (max_sweeps + 1)` sweeps for
/// the loops. No allocation.
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
    for numbers in [&*s.z, &*s.v, &*s.zdd, &*s.lambda] {
        if !numbers.iter().all(|x| x.is_finite()) {
            return Err(StepError::NotFinite { unknown: largest_or_nan(numbers) });
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
    // A projection reads inertias and rows, no forces: effects are not evaluated here.
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
