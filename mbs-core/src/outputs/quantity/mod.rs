//! Quantities of outputs, one file each. A file has the name in scene files, the components with their units, and the evaluation at a
//! state. The list of quantities is in `scene/quantity`.

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
