//! [`Model`]: a scene as constant tables.

use crate::inputs::Prescriptions;
use mbs_core::Real;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::space::Space;

/// A scene as tables, in flash or in memory of the caller's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model<'a, T: Real, S: Space<T>> {
    /// Links, loops, effects and gravity.
    pub mechanism: TreeSlices<'a, T, S>,
    /// Guides and courses as functions of time, or as inputs.
    pub prescriptions: Prescriptions<'a, T>,
    /// The state to start from.
    pub start: StartState<'a, T>,
    /// Number of effects that are kept at each rung of the degrade ladder, fewer on each: the least needed stand last. Empty: all
    /// are always kept.
    pub rungs: &'a [u32],
}

/// A consistent state that a run starts from.
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
