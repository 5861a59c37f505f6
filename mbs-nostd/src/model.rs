//! [`Model`]: a scene as constant tables.

use crate::inputs::Prescriptions;
use mbs_core::Real;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::space::Space;

/// A scene as tables, which are in flash memory or in memory of the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model<'a, T: Real, S: Space<T>> {
    /// Links, loops, effects and gravity.
    pub mechanism: TreeSlices<'a, T, S>,
    /// Laws of guides and signals: functions of time, or inputs.
    pub prescriptions: Prescriptions<'a, T>,
    /// State at the start of a run.
    pub start: StartState<'a, T>,
    /// Number of effects that act on each rung of the degradation ladder, beginning with rung 1. On a higher rung fewer effects act. The
    /// effect that is dropped first is the last in the list of effects. If `rungs` is empty, all effects always act.
    pub rungs: &'a [u32],
}

/// Consistent state at the start of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartState<'a, T> {
    /// Time of the start [s].
    pub t: T,
    /// Coordinates at the start.
    pub z: &'a [T],
    /// Velocities at the start.
    pub v: &'a [T],
    /// Accelerations at the start.
    pub a: &'a [T],
    /// States of signals, each with its rate.
    pub signals: &'a [[T; 2]],
}
