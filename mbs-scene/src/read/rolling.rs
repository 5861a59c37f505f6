//! Reads `[[rolling]]`: bodies that roll without slipping, and blades.

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{BodyId, Number, Rolling, RollingKind, RollingPlane};

/// Reads a rolling of any kind. A rolling without a name gets the name `rolling-N`, where N is its number in the list, from 1.
pub(crate) fn read(index: usize, fields: &Fields<'_>) -> Read<Rolling<Number>> {
    let (kind, fields) = &fields.kind()?;
    let context = &fields.context;
    let body = context.moving_body(fields.need("body")?)?;
    let (kind, at) = match *kind {
        "wheel" => {
            let axis = match fields.get("axis") {
                None if context.is_planar() => [0.0, 0.0, 1.0].map(Number::from),
                _ => fields.vector("axis")?,
            };
            let radius = fields.number("radius")?;
            (RollingKind::Wheel { axis, radius }, fields.vector("center")?)
        }
        "ball" => {
            let radius = fields.number("radius")?;
            (RollingKind::Ball { radius }, fields.vector("center")?)
        }
        _ => {
            let direction = fields.vector("direction")?;
            (RollingKind::Blade { direction }, fields.vector("at")?)
        }
    };
    let on = fields.get("on").map_or(Ok(BodyId::Ground), |item| context.body(item))?;
    let plane = match fields.get("plane") {
        None => None,
        Some(item) => {
            let plane = context.table(item, "a table { point = [..], normal = [..] }", "plane")?;
            Some(RollingPlane { point: plane.vector("point")?, normal: plane.vector("normal")? })
        }
    };
    let name = fields.name_or("rolling", index)?;
    Ok(Rolling { name, kind, body, at, on, plane })
}
