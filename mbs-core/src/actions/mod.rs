//! The actions of a scene: what all its effects do, and what its entries need of its bodies.

mod error;
mod from_scene;
mod needs;

pub use crate::effects::action::{Action, Actions, Attachment, Tables, track_heights};
pub use error::ActionError;
pub(crate) use needs::{Need, needs};
