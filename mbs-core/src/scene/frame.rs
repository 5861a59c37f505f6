//! Named places on bodies and on the ground, in the reference configuration: they carry no mass and cost nothing.

use crate::scene::BodyId;
use alloc::string::String;

/// A named place with axes, which moves with its body or stands on the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFrame<T> {
    /// Unique name among the frames and the other bodies: it stands wherever a body's name does. Of its own body's name it is the place
    /// that stands for this body.
    pub name: String,
    /// Body that the place moves with, or the ground.
    pub body: BodyId,
    /// Place in the reference configuration [m].
    pub at: [T; 3],
    /// First and second axis of the frame, any length; the second is made right-angled to the first. `None`: x and y.
    pub axes: Option<[[T; 3]; 2]>,
}
