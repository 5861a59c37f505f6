//! `[[effect]]`.

use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use crate::read::tree::{Item, Node};
use mbs_core::Real;
use mbs_core::scene::{AxisFrame, Course, Effect, EffectKind};

/// Kinds that are read.
const BUILT: [&str; 4] = ["spring-damper", "torque", "force", "torsion-spring"];
/// Kinds of the format that no model builder knows yet.
const PLANNED: [&str; 9] = [
    "bumper",
    "polynomial-spring",
    "polynomial-damper",
    "tire",
    "limit",
    "friction",
    "bushing",
    "aero-drag",
    "speed-hold",
];
const KEYS: [&str; 16] = [
    "name",
    "kind",
    "enabled",
    "bodies",
    "points",
    "body",
    "joint",
    "at",
    "stiffness",
    "damping",
    "free_length",
    "free_value",
    "value",
    "table",
    "frame",
    "direction",
];

/// Reads an effect; without a name it is called `effect-N`, counted from 1.
pub(crate) fn read<T: Real>(index: usize, fields: &Fields<'_>) -> Read<Effect<T>> {
    let kind = match fields.word("kind")? {
        ("spring-damper", _) => spring_damper(fields)?,
        ("torque", _) => torque(fields)?,
        ("force", _) => force(fields)?,
        ("torsion-spring", _) => torsion_spring(fields)?,
        (planned, span) if PLANNED.contains(&planned) => {
            let found = format!("effect kind `{planned}`");
            let fault = ReadFault::NotBuilt { found, built: BUILT.to_vec() };
            return fields.context.fault(span, fault);
        }
        word => return fields.unknown_word("kind", word, &BUILT),
    };
    let name = match fields.get("name") {
        Some(_) => fields.name()?,
        None => format!("effect-{}", index + 1),
    };
    Ok(Effect { name, enabled: fields.flag("enabled", true)?, kind })
}

fn allow(fields: &Fields<'_>, own: &[&'static str]) -> Read<()> {
    let known = [&["name", "kind", "enabled"], own].concat();
    fields.allow(&known, &KEYS)
}

fn spring_damper<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    allow(fields, &["bodies", "points", "stiffness", "damping", "free_length"])?;
    let stiffness: T = fields.number_or_zero("stiffness")?;
    let free_length = match fields.get("free_length") {
        // a pure damper has no free length
        None if stiffness.is_zero() => T::ZERO,
        _ => fields.number("free_length")?,
    };
    Ok(EffectKind::SpringDamper {
        bodies: fields.pair()?,
        points: fields.two_vectors("points")?,
        stiffness,
        damping: fields.number_or_zero("damping")?,
        free_length,
    })
}

fn torsion_spring<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    allow(fields, &["joint", "stiffness", "damping", "free_value"])?;
    Ok(EffectKind::TorsionSpring {
        joint: fields.context.joint(fields.need("joint")?)?,
        stiffness: fields.number_or_zero("stiffness")?,
        damping: fields.number_or_zero("damping")?,
        free_value: fields.number_or_zero("free_value")?,
    })
}

fn torque<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    allow(fields, &["body", "joint", "value", "table"])?;
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

fn force<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    allow(fields, &["body", "at", "value", "table", "frame"])?;
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

/// `value`, or `table` with rows `[time, value]`; a vector may also stand flat: `[time, x, y, z]`.
fn course<T: Real>(fields: &Fields<'_>, is_scalar: bool) -> Read<Course<T>> {
    fields.exclusive("value", "table")?;
    let context = fields.context;
    let value = |item| {
        if is_scalar {
            return Ok([context.number(item)?, T::ZERO, T::ZERO]);
        }
        context.vector(item)
    };
    let Some(table) = fields.get("table") else {
        let Some(item) = fields.get("value") else {
            return context.fault(fields.header, ReadFault::Missing { key: "value or table" });
        };
        return Ok(Course::Constant(value(item)?));
    };
    let rows = context.list(table, "a list of rows [time, value]")?;
    let read_row = |row| match context.list(row, "a row [time, value]")? {
        [time, flat @ ..]
            if !is_scalar && matches!(flat, [Item { node: Node::Number(_), .. }, ..]) =>
        {
            Ok((context.number(time)?, context.components(row, flat)?))
        }
        _ => {
            let [time, item] = context.exactly(row, "a row [time, value]")?;
            Ok((context.number(time)?, value(item)?))
        }
    };
    rows.iter().map(read_row).collect::<Read<Vec<_>>>().map(Course::Table)
}
