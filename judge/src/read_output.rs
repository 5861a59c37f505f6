//! Reads the channels of a scene.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::scene::{Body, Leaning, Output, Quantity, Relative, Scene};
use crate::vector::{Vector, ZERO, cross, dot, scale, sub, unit};

/// Reads the key `at`, a point of a body. Without the key, a quantity of a point is that of the centre of mass.
fn place(table: &mut Table, kind: &str, body: usize, all: &[Body]) -> Read<Option<Vector>> {
    let at = table.vector_or_none("at")?;
    Ok(at.or_else(|| Quantity::OF_POINTS.contains(&kind).then(|| all[body].center)))
}

/// The index of a name in a list.
fn number<'a>(name: &str, mut all: impl Iterator<Item = &'a String>) -> Option<usize> {
    all.position(|known| known == name)
}

/// Reads a channel of the outputs.
pub(crate) fn output(mut table: Table, names: &Names, scene: &Scene) -> Read<Output> {
    let name = table.text("name")?;
    let default = match (table.has("coupling"), table.has("rolling") || table.has("effect")) {
        (true, _) => "effort",
        (_, true) => "force",
        _ => "value",
    };
    let kind = if table.has("quantity") { table.text("quantity")? } else { default.to_owned() };
    let t = &mut table;
    let quantity = if let Some(Node::Text(signal)) = t.take("signal") {
        let number = number(&signal, scene.signals.iter().map(|s| &s.name));
        number.map(|number| Quantity::Signal(number, kind == "rate"))
    } else if let Some(Node::Text(rolling)) = t.take("rolling") {
        let number = number(&rolling, scene.rollings.iter().map(|r| &r.name));
        number.filter(|_| kind == "force").map(Quantity::Contact)
    } else if let Some(Node::Text(coupling)) = t.take("coupling") {
        let number = number(&coupling, scene.couplings.iter().map(|c| &c.name));
        number.and_then(|number| Quantity::of_coupling(&kind, number))
    } else if let Some(Node::Text(effect)) = t.take("effect") {
        let number = number(&effect, scene.effect_names.iter());
        number.and_then(|number| Quantity::of_effect(&kind, number))
    } else if let Some(Node::Text(joint)) = t.take("joint") {
        Quantity::of_joint(&kind, names.joint(&joint)?)
    } else if let Some(Node::Text(body)) = t.take("body") {
        let body = names.body(&body)?;
        match t.take("relative_to") {
            Some(Node::Text(other)) => {
                let other = names.carrier(&other)?;
                seen(t, &kind, (body, other), scene)?
            }
            _ => Quantity::of_body(&kind, body, place(t, &kind, body, &scene.bodies)?),
        }
    } else {
        Quantity::of_scene(&kind)
    };
    let Some(quantity) = quantity else { return fault(format!("no quantity `{kind}`")) };
    let degrees = matches!(table.take("unit"), Some(Node::Text(unit)) if unit == "deg");
    if degrees && !matches!(quantity, Quantity::Leaning(_)) {
        return fault("degrees of what is not an angle of a wheel");
    }
    table.done("output")?;
    Ok(Output { name, quantity, degrees })
}

/// Reads a quantity of a body that is seen from another body.
fn seen(
    t: &mut Table,
    kind: &str,
    (body, other): (usize, Option<usize>),
    scene: &Scene,
) -> Read<Option<Quantity>> {
    if kind == "angular-velocity" {
        let global = t.has("frame") && t.text("frame")? == "global";
        return Ok(Some(Quantity::RelativeAngularVelocity(body, other, global)));
    }
    if let Some(angle) = Quantity::OF_CARRIERS.iter().position(|known| *known == kind) {
        let leaning = leaning(t, (body, other), angle)?;
        return Ok(Some(Quantity::Leaning(leaning)));
    }
    let at = t.vector_or_none("at")?.unwrap_or(scene.bodies[body].center);
    let center = other.map_or(ZERO, |b| scene.bodies[b].center);
    let origin = t.vector_or_none("origin")?.unwrap_or(center);
    Ok(Quantity::of_seen(kind, Relative { body, at, other, origin }))
}

/// Reads camber, toe or caster: the vehicle's axes forwards, inwards and upwards, and the carrier's direction with the sign of the
/// contract.
fn leaning(t: &mut Table, (body, vehicle): (usize, Option<usize>), angle: usize) -> Read<Leaning> {
    if t.planar {
        return fault("camber, toe and caster of the plane");
    }
    let is_left = t.text("side")? == "left";
    let up = unit(t.vector_or_none("up")?.unwrap_or([0.0, 0.0, 1.0]));
    let forward = t.vector_or_none("forward")?.unwrap_or([1.0, 0.0, 0.0]);
    let forward = unit(sub(forward, scale(dot(forward, up), up)));
    let inward = if is_left { cross(forward, up) } else { cross(up, forward) };
    // the steering axis points upwards, the axis of the wheel inwards
    let drawn = if angle == 2 { up } else { inward };
    let direction = t.vector_or_none("axis")?.map_or(drawn, |axis| {
        let axis = unit(axis);
        if dot(axis, drawn) < 0.0 { scale(-1.0, axis) } else { axis }
    });
    Ok(Leaning { body, vehicle, axes: [forward, inward, up], direction, angle })
}
