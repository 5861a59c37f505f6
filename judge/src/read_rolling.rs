//! Reads contacts that roll, and blades.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::scene::{Rolling, Shape};
use crate::vector::unit;

/// Reads a contact that rolls, or a blade.
pub(crate) fn rolling(mut table: Table, names: &Names, number: usize) -> Read<Rolling> {
    let name = match table.take("name") {
        Some(Node::Text(name)) => name,
        _ => format!("rolling-{}", number + 1),
    };
    let (kind, planar) = (table.text("kind")?, table.planar);
    let body = Some(names.body(&table.text("body")?)?);
    let on = if table.has("on") { names.carrier(&table.text("on")?)? } else { None };
    let is_blade = kind == "blade";
    let up = if planar && !is_blade { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let center = table.vector(if is_blade { "at" } else { "center" })?;
    let shape = match kind.as_str() {
        "wheel" => {
            let axis = table.vector_or_none("axis")?.unwrap_or([0.0, 0.0, 1.0]);
            Shape::Disc(table.number("radius")?, unit(axis))
        }
        "ball" => Shape::Ball(table.number("radius")?),
        "blade" => Shape::Blade(unit(table.vector("direction")?)),
        other => return fault(format!("nothing that rolls is a `{other}`")),
    };
    let mut rolling =
        Rolling { name, bodies: [body, on], shape, center, point: center, normal: up };
    if let Some(mut plane) = table.table("plane")? {
        rolling.normal = unit(plane.vector("normal")?);
        rolling.point = plane.vector("point")?;
        plane.done("plane")?;
    } else {
        rolling.point = rolling.contact();
    }
    table.done("rolling")?;
    Ok(rolling)
}
