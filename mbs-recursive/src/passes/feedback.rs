//! Signals that depend on the motion, in relative coordinates: each joint coordinate is the coordinate of a link.

use crate::link::indexing::{Outside, at, copy};
pub use crate::passes::slices::{FeedbackMeasure, FeedbackSlices};
use crate::passes::slices::{Store, TreeSlices};
use crate::rows::coupled::{self, NONE};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::feedback::{follow, note_followed};

impl<T: Real, S: Space<T>> Store<'_, T, S> {
    /// Sets the states of signals at the start of a step, `dt` [s] before the instants that are evaluated, to `starts`.
    #[inline(always)]
    pub(crate) fn begin_signals(&mut self, dt: T, starts: &[[T; 2]]) -> Result<(), Outside> {
        self.signals.dt = dt;
        if IS_BUILT { copy(starts, self.signals.starts) } else { Ok(()) }
    }
}

/// True if this build supports signals that depend on the motion, and signals that are splines or steps over time.
pub const IS_BUILT: bool = cfg!(feature = "signals");

/// Evaluates the signals that depend on the motion at the coordinates `s.z` and velocities `s.v`. Writes them to `s.courses`.
#[inline(always)]
pub(crate) fn follow_motion<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    if IS_BUILT && !m.feedback.steps.is_empty() { evaluate(m, s) } else { Ok(()) }
}

#[inline(never)]
fn evaluate<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    let coordinates = (&*s.z, &*s.v, &*s.guides);
    let placed = &*s.placed;
    let measure = |number: u32| {
        let link = *at(m.feedback.links, number as usize)?;
        if coupled::IS_BUILT && link == NONE {
            let mut measures = m.feedback.measures.iter();
            let found = measures.find(|measure| measure.number == number).ok_or(Outside)?;
            let here = (m.links, placed, coordinates);
            let ([value, rate, _], _) =
                m.loops.couplings.measure((&found.of, found.starts), here)?;
            return Ok([value, rate]);
        }
        let [value, rate, _] = at(m.links, link as usize)?.coordinate(coordinates)?;
        Ok([value, rate])
    };
    let curve = |number: u32, x: T| m.loops.couplings.function(number, x);
    follow(m.feedback.steps, measure, curve, &mut s.signals, s.courses)?;
    note_followed((m.feedback.signals, m.feedback.n_states), s.courses, s.signals.ends);
    Ok(())
}
