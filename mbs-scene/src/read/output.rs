//! `[[output]]` and `[solver]`.

use crate::read::ReadFault;
use crate::read::error::OWNER;
use crate::read::fields::{Fields, Read};
use mbs_core::outputs::{QUANTITIES, Quantity, QuantityRow, Target, TargetKind};
use mbs_core::scene::{Number, Output, SolverTable};

pub(crate) fn read(fields: &Fields<'_>) -> Read<Output<Number>> {
    fields.exclusive("joint", "body")?;
    let keys = |of: &[&'static str]| [&["name"], of, &["quantity"]].concat();
    let mut every = Vec::new();
    for key in QUANTITIES.iter().flat_map(|row| row.target.keys()) {
        if !every.contains(key) {
            every.push(*key);
        }
    }
    let is_here = |row: &&QuantityRow| fields.get(row.target.keys()[0]).is_some();
    let rows: Vec<&QuantityRow> = QUANTITIES.iter().filter(is_here).collect();
    let Some(first) = rows.first() else {
        fields.allow(&keys(&every), &[])?;
        return fields.context.fault(fields.header, ReadFault::Missing { key: OWNER });
    };
    let word = fields.get("quantity").map(|_| fields.word("quantity")).transpose()?;
    let word = word.unwrap_or((first.name, fields.header));
    let unknown = || {
        let known: Vec<_> = rows.iter().map(|row| row.name).collect();
        fields.unknown_word("quantity", word, &known)
    };
    // before keys are missed that another quantity has
    let Some(kind) = rows.iter().find(|row| row.name == word.0).map(|row| row.target) else {
        return unknown();
    };
    fields.allow(&keys(kind.keys()), &keys(&every))?;
    let owner = fields.need(kind.keys()[0])?;
    let body = || fields.context.moving_body(owner);
    let target = match kind {
        TargetKind::Point => Target::Point(body()?, fields.vector("at")?),
        TargetKind::Body => Target::Body(body()?),
        TargetKind::Joint => Target::Joint(fields.context.joint(owner)?),
    };
    let Some(quantity) = Quantity::of(word.0, target) else { return unknown() };
    Ok(Output { name: fields.name()?, quantity })
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
