//! Actions of a scene: the forces of all its effects, and the points, directions and rotations that its entries need.

mod error;
mod from_scene;
mod needs;

pub use crate::effects::action::{Action, Actions, Attachment, Tables, track_heights};
pub use error::ActionError;
pub(crate) use needs::{Need, needs};
