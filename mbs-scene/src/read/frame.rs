//! Reads `[[frame]]`: named places on bodies.

use super::fields::{Fields, Read};
use mbs_core::scene::{BodyFrame, Number};

/// Reads a frame of a body.
pub(crate) fn read(fields: &Fields<'_>) -> Read<BodyFrame<Number>> {
    Ok(BodyFrame {
        name: fields.name()?,
        body: fields.context.body_alone(fields.need("body")?)?,
        at: fields.vector("at")?,
        axes: fields.get("axes").map(|_| fields.two_vectors("axes")).transpose()?,
    })
}
