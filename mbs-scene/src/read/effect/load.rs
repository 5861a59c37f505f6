//! Loads on one body, and torques.

use super::course::course;
use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use mbs_core::scene::{AxisFrame, EffectKind, Number};

/// Density of air, where none is written [kg/m^3].
const AIR: &str = "1.2";

/// On a body (from the ground) or on a joint (first body on second).
pub(super) fn torque(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    fields.exclusive("joint", "body")?;
    if let Some(joint) = fields.get("joint") {
        let joint = fields.context.joint(joint)?;
        return Ok(EffectKind::JointTorque { joint, course: course(fields, true)? });
    }
    let Some(body) = fields.get("body") else {
        return fields.context.fault(fields.header, ReadFault::Missing { key: "body or joint" });
    };
    let body = fields.context.moving_body(body)?;
    let is_scalar = fields.context.is_planar();
    Ok(EffectKind::BodyTorque { body, course: course(fields, is_scalar)? })
}

pub(super) fn force(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    let frame = match fields.get("frame") {
        None => AxisFrame::Global,
        Some(_) => match fields.word("frame")? {
            ("global", _) => AxisFrame::Global,
            ("body", _) => AxisFrame::Body,
            word => return fields.unknown_word("frame", word, &["global", "body"]),
        },
    };
    Ok(EffectKind::Force {
        body: fields.context.moving_body(fields.need("body")?)?,
        at: fields.vector("at")?,
        course: course(fields, false)?,
        frame,
    })
}

pub(super) fn aero_drag(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::AeroDrag {
        body: fields.context.moving_body(fields.need("body")?)?,
        at: fields.vector("at")?,
        area_coefficient: fields.number("area_coefficient")?,
        density: fields.number_or("density", AIR)?,
    })
}

pub(super) fn speed_hold(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::SpeedHold {
        body: fields.context.moving_body(fields.need("body")?)?,
        direction: fields.vector("direction")?,
        speed: fields.number("speed")?,
        gain: fields.number("gain")?,
        limit: fields.number("limit")?,
    })
}
