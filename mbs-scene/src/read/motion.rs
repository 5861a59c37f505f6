//! Reads the tables `[[initial]]` and `[[guide]]`.

use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use crate::read::table;
use mbs_core::scene::{Guide, InitialCondition, InitialTarget, Joint, Motion, Number};

pub(crate) fn read_initial(
    fields: &Fields<'_>,
    joints: &[Joint<Number>],
) -> Read<InitialCondition<Number>> {
    let context = fields.context;
    fields.exclusive("joint", "body")?;
    let fields = &fields.by("body", "joint")?;
    let target = match fields.get("body") {
        Some(body) => InitialTarget::Body {
            body: context.moving_body(body)?,
            velocity: point_velocity(fields)?,
            angular_velocity: angular_velocity(fields)?,
        },
        None => {
            let joint = context.joint(fields.need("joint")?)?;
            let numbers = |key| {
                fields
                    .get(key)
                    .map(|item| fields.at(key).coordinates(item, joints[joint.index()].kind))
                    .transpose()
            };
            InitialTarget::Joint { joint, value: numbers("value")?, rate: numbers("rate")? }
        }
    };
    Ok(InitialCondition { target })
}

/// Reads `at` and `velocity`. Each of these keys requires the other.
fn point_velocity(fields: &Fields<'_>) -> Read<Option<([Number; 3], [Number; 3])>> {
    if fields.get("at").is_none() && fields.get("velocity").is_none() {
        return Ok(None);
    }
    Ok(Some((fields.vector("at")?, fields.vector("velocity")?)))
}

/// Reads an angular velocity [rad/s]: in the plane one number about z, in space a vector in global axes.
fn angular_velocity(fields: &Fields<'_>) -> Read<Option<[Number; 3]>> {
    if fields.context.is_planar() {
        let about_z = fields.optional("angular_velocity")?;
        return Ok(about_z.map(|x| [Number::ZERO, Number::ZERO, x]));
    }
    fields.optional_vector("angular_velocity")
}

/// The guides of an entry. An entry guides one coordinate, or with `signals` all coordinates of a joint. The joint may be the free joint of
/// a guided `body`.
pub(crate) fn read_guides(
    fields: &Fields<'_>,
    joints: &[Joint<Number>],
) -> Read<Vec<Guide<Number>>> {
    let context = fields.context;
    for (one, other) in [("joint", "body"), ("coordinate", "signals")] {
        fields.exclusive(one, other)?;
    }
    for law in LAWS {
        fields.exclusive(law, "signals")?;
    }
    let is_of_body = fields.get("body").is_some();
    let fields = &fields.by("body", "joint")?;
    if !is_of_body && fields.get("table").is_none() {
        fields.unused(&["ends", "interpolation"])?;
    }
    // The free joint of a guided body has the body's name.
    let of = if is_of_body { "body" } else { "joint" };
    let joint = context.joint(fields.need(of)?)?;
    if let Some(item) = fields.get("signals") {
        let expected = "a list of names of signals, one for each coordinate";
        let names = context.filled_list(item, expected)?.iter().enumerate();
        let guide = |(number, name)| {
            Ok(Guide { joint, number, law: Motion::Signal(context.signal(name)?) })
        };
        return names.map(guide).collect();
    }
    let number = match fields.get("coordinate") {
        Some(item) => fields.coordinate(item, &joints[joint.index()])?,
        None => 0,
    };
    let fields = &fields.about(joints[joint.index()].kind, number);
    match read_motion(fields)? {
        Some(law) => Ok(vec![Guide { joint, number, law }]),
        None => {
            let key = if is_of_body { "signals" } else { "table, sine, ramp, input or signal" };
            context.fault(fields.header, ReadFault::Missing { key })
        }
    }
}

/// The keys that define a function of time; an entry has at most one of them.
const LAWS: [&str; 5] = ["table", "sine", "ramp", "input", "signal"];

/// Reads a function of time; `None` when none of its keys is written.
pub(crate) fn read_motion(fields: &Fields<'_>) -> Read<Option<Motion<Number>>> {
    for (i, one) in LAWS.iter().enumerate() {
        LAWS[i + 1..].iter().try_for_each(|other| fields.exclusive(one, other))?;
    }
    if fields.get("table").is_none() {
        fields.unused(&["interpolation"])?;
    }
    let context = fields.context;
    let law = if let Some(item) = fields.get("sine") {
        let sine = context.table(
            item,
            "a table: { amplitude = .., frequency = .., phase = .. }",
            "sine",
        )?;
        Motion::Sine {
            amplitude: sine.number("amplitude")?,
            frequency: sine.number("frequency")?,
            phase: sine.number_or_zero("phase")?,
        }
    } else if let Some(item) = fields.get("ramp") {
        let ramp = context.table(item, "a table: { rate = .. }", "ramp")?;
        Motion::Ramp { rate: ramp.number("rate")? }
    } else if let Some(item) = fields.get("input") {
        let form = "a table: { value = .., rate = .., acceleration = .. }";
        let input = context.table(item, form, "motion input")?;
        let number = |key| input.number_or_zero(key);
        Motion::Input([number("value")?, number("rate")?, number("acceleration")?])
    } else if let Some(item) = fields.get("signal") {
        Motion::Signal(context.signal(item)?)
    } else if fields.get("table").is_some() {
        table::of_motion(fields)?
    } else {
        return Ok(None);
    };
    Ok(Some(law))
}
