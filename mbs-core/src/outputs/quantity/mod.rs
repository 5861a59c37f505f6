//! The quantities of outputs, a file each: name in scene files, components with their units, and how it is read of a state. Their list is in
//! `scene/quantity`.

mod channel;
mod components;
mod kind;
mod output;
mod row;
mod seen;
mod table;
mod wheel;

pub(super) use channel::Channel;
pub use components::{Component, ComponentForm, Magnitude, in_radians, magnitudes};
pub(super) use kind::{Instant, Maker};
pub use row::{OutputPicture, QuantityDefinition, QuantityRow, TargetKind};

use crate::scene::quantity::list;
use crate::scene::{Quantity, Target};

list::list!(table::rows);
