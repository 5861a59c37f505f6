//! Named frames on bodies and on the ground, in the reference configuration. They have no mass and need no computation in a step.

use crate::scene::BodyId;
use alloc::string::String;

/// Named place with axes, which moves with its body or is fixed to the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFrame<T> {
    /// Unique name among the frames and the other bodies, used in place of a body's name. A frame with the name of its own body
    /// gives the default place on that body.
    pub name: String,
    /// Body that the frame moves with, or the ground.
    pub body: BodyId,
    /// Origin of the frame in the reference configuration [m].
    pub at: [T; 3],
    /// First and second axis of the frame, of any length. The second is made perpendicular to the first. `None`: x and y.
    pub axes: Option<[[T; 3]; 2]>,
}
