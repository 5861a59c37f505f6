//! The quantities of outputs, a file each: name in scene files, components with their units, and how it is read of a state. `list` has
//! them all.

mod channel;
mod components;
mod kind;
mod list;
mod output;
mod row;
mod seen;
mod table;
mod wheel;

pub(super) use channel::Channel;
pub use components::{Component, ComponentForm, Magnitude, in_radians, magnitudes};
pub(super) use kind::{Instant, Maker};
pub use row::{
    OutputPicture, QuantityDefinition, QuantityRow, RelativePoint, Target, TargetKind, VehicleSide,
    WheelCarrier,
};

use crate::scene::{BodyId, CouplingId, EffectId, JointId, RollingId, SignalId};

list::list!(quantities);
