//! Independent coordinates chosen at the start of a step.

use crate::workspace::Workspace;
use mbs_core::Real;
use mbs_core::model::{Model, State};
use mbs_core::step::StepError;

/// Chooses independent coordinates at the start of a step. Fails if the rank differs from that at the start of the motion.
///
/// The choice needs positions that satisfy the constraints, because redundant rows depend on each other only there.
pub(crate) fn select_pivots<T: Real, M: Model<T>>(
    model: &M,
    s: &State<T>,
    w: &mut Workspace<T>,
) -> Result<(), StepError> {
    model.set_inputs(s.t, s, &mut w.terms);
    w.dq.fill(T::ZERO);
    w.evaluate(model, s);
    w.is_stale = true;
    w.choose_columns()?;
    w.is_stale = false;
    w.check_pivots()?;
    w.usual = w.usual.max(w.pivots.smallest);
    Ok(())
}
