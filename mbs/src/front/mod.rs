//! The front door: a mechanism as a list of named parts, in code or from a file.

mod error;
mod mechanism;
mod part;
#[cfg(test)]
mod tests;
pub mod tree;

pub use error::{Error, PathError, SceneError, UnknownName};
pub use mechanism::Mechanism;
pub use part::{Id, Part};

use mbs_core::scene;
use mbs_core::scene::Number;

/// A rigid body.
pub type Body = scene::Body<Number>;
/// A joint between two bodies.
pub type Joint = scene::Joint<Number>;
/// What holds exactly at the start.
pub type InitialCondition = scene::InitialCondition<Number>;
/// Prescribed motion of a joint coordinate.
pub type Guide = scene::Guide<Number>;
/// A force, a spring, friction, a tire, ...
pub type Effect = scene::Effect<Number>;
/// A quantity that is recorded.
pub type Output = scene::Output<Number>;
