//! Check that rotations in space on which laws depend are below a whole turn. The laws are valid up to a whole turn only.
//!
//! Beyond a whole turn the half angles of the tree describe the opposite rotation: the rotation vector changes its sign.

use crate::link::LinkMotion;
use crate::link::indexing::Outside;
use crate::loads::{Instant, Load, Measure};
use crate::passes::failure::failure;
use crate::passes::slices::{Inputs, Start, Store, TreeSlices};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::effects::bushing;
use mbs_core::laws::LawInputs;
use mbs_core::step::StepError;

/// Checks that no rotation has passed a whole turn in the step of `dt` [s] from `start` to the state (`s.z`, `s.v`).
///
/// Cost: one comparison for each effect. A rotation also takes the half angles of the joints between its links, at the start and at the end
/// of the step.
///
/// # Errors
/// [`StepError::Overturned`] with the index of the load in place of the index of the effect.
#[inline(always)]
pub(crate) fn check_rotations<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    step: (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    let is_rotation =
        |load: &Load<T, S>| matches!(load, Load::Between { gauge: Measure::Rotation { .. }, .. });
    if bushing::IS_BUILT && m.loads.iter().any(is_rotation) {
        check(m, inputs, step, s)
    } else {
        Ok(())
    }
}

fn check<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (start, dt): (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    for (number, load) in m.loads.iter().enumerate() {
        let Load::Between { links, gauge: Measure::Rotation { number: 0 }, .. } = load else {
            continue;
        };
        let failed = |outside: Outside| failure(m, outside.into());
        inputs.evaluate(start.t, s.guides, s.courses);
        let before = instant(m, (start.z, start.v, s.guides), s.placed);
        let before = before.rotation(*links).map_err(failed)?;
        inputs.evaluate(start.t + dt, s.guides, s.courses);
        let now = instant(m, (s.z, s.v, s.guides), s.placed).rotation(*links).map_err(failed)?;
        let [b, n] = [before, now].map(|w| w.dot(&w).sqrt());
        if before.dot(&now) < T::ZERO && b + n > T::TWO * T::PI {
            return Err(StepError::Overturned {
                effect: u32::try_from(number).unwrap_or(u32::MAX),
            });
        }
    }
    Ok(())
}

fn instant<'a, T: Real, S: Space<T>>(
    m: &'a TreeSlices<'_, T, S>,
    coordinates: (&'a [T], &'a [T], &'a [[T; 3]]),
    placed: &'a [LinkMotion<T, S>],
) -> Instant<'a, T, S> {
    Instant {
        links: m.links,
        placed,
        coordinates,
        couplings: &m.loops.couplings,
        law_inputs: LawInputs::courses(&[]),
        base: m.base,
    }
}
