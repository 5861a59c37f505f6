//! `[[output]]` and `[solver]`.

use crate::read::ReadFault;
use crate::read::error::OWNER;
use crate::read::fields::{Fields, Read};
use mbs_core::scene::{Number, Output, Quantity, SolverTable};

const KEYS: [&str; 5] = ["name", "body", "at", "joint", "quantity"];
const BODY_WORDS: [&str; 3] = ["position", "velocity", "acceleration"];
const JOINT_WORDS: [&str; 3] = ["value", "rate", "reaction"];

pub(crate) fn read(fields: &Fields<'_>) -> Read<Output<Number>> {
    fields.exclusive("joint", "body")?;
    let quantity = if let Some(joint) = fields.get("joint") {
        fields.allow(&["name", "joint", "quantity"], &KEYS)?;
        let joint = fields.context.joint(joint)?;
        match quantity_word(fields, "value")? {
            "value" => Quantity::JointValue { joint },
            "rate" => Quantity::JointRate { joint },
            "reaction" => Quantity::Reaction { joint },
            _ => return fields.unknown_word("quantity", fields.word("quantity")?, &JOINT_WORDS),
        }
    } else if let Some(body) = fields.get("body") {
        fields.allow(&["name", "body", "at", "quantity"], &KEYS)?;
        let body = fields.context.moving_body(body)?;
        let at = fields.vector("at")?;
        match quantity_word(fields, "position")? {
            "position" => Quantity::Position { body, at },
            "velocity" => Quantity::Velocity { body, at },
            "acceleration" => Quantity::Acceleration { body, at },
            _ => return fields.unknown_word("quantity", fields.word("quantity")?, &BODY_WORDS),
        }
    } else {
        fields.allow(&KEYS, &[])?;
        return fields.context.fault(fields.header, ReadFault::Missing { key: OWNER });
    };
    Ok(Output { name: fields.name()?, quantity })
}

fn quantity_word<'a>(fields: &Fields<'a>, default: &'static str) -> Read<&'a str> {
    if fields.get("quantity").is_none() {
        return Ok(default);
    }
    Ok(fields.word("quantity")?.0)
}

pub(crate) fn read_solver(fields: &Fields<'_>) -> Read<SolverTable<Number>> {
    fields.allow(
        &[
            "formulation",
            "integrator",
            "step",
            "step_max",
            "tolerance",
            "penalty",
            "step_control",
            "energy_tolerance",
            "error_tolerance",
            "locate_events",
            "energy_alarm",
        ],
        &[],
    )?;
    let context = fields.context;
    let word = |key| -> Read<Option<String>> {
        fields.get(key).map(|item| context.text(item).map(str::to_owned)).transpose()
    };
    let flag = |key| -> Read<Option<bool>> {
        fields.get(key).map(|_| fields.flag(key, false)).transpose()
    };
    let energy_tolerance = match fields.get("energy_tolerance") {
        None => None,
        Some(item) => {
            let [upper, lower] = context.exactly(item, "a list of two numbers: [U, L]")?;
            Some([context.number(upper)?, context.number(lower)?])
        }
    };
    Ok(SolverTable {
        formulation: word("formulation")?,
        integrator: word("integrator")?,
        step: fields.optional("step")?,
        step_max: fields.optional("step_max")?,
        tolerance: fields.optional("tolerance")?,
        penalty: fields.optional("penalty")?,
        step_control: word("step_control")?,
        energy_tolerance,
        error_tolerance: fields.optional("error_tolerance")?,
        locate_events: flag("locate_events")?,
        energy_alarm: fields.optional("energy_alarm")?,
        unused: Vec::new(),
    })
}
