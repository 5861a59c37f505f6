//! `value`, or `table` over time; with `input = true` a value that is set between steps.

use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use crate::read::tree::{Item, Node};
use mbs_core::scene::{Number, Signal};

/// `value`, or `table` with rows `[time, value]`; a vector may also stand flat: `[time, x, y, z]`.
pub(super) fn course(fields: &Fields<'_>, is_scalar: bool) -> Read<Signal<Number>> {
    fields.exclusive("value", "table")?;
    fields.exclusive("table", "input")?;
    let context = fields.context;
    let value = |item| {
        if is_scalar {
            return Ok([context.number(item)?, Number::ZERO, Number::ZERO]);
        }
        context.vector(item)
    };
    let Some(table) = fields.get("table") else {
        let Some(item) = fields.get("value") else {
            return context.fault(fields.header, ReadFault::Missing { key: "value or table" });
        };
        let is_input = fields.flag("input", false)?;
        let value = value(item)?;
        return Ok(if is_input { Signal::Input(value) } else { Signal::Constant(value) });
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
    rows.iter().map(read_row).collect::<Read<Vec<_>>>().map(Signal::Table)
}
