//! `value`, or `table` over time.

use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use crate::read::tree::{Item, Node};
use mbs_core::Real;
use mbs_core::scene::Signal;

/// `value`, or `table` with rows `[time, value]`; a vector may also stand flat: `[time, x, y, z]`.
pub(super) fn course<T: Real>(fields: &Fields<'_>, is_scalar: bool) -> Read<Signal<T>> {
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
        return Ok(Signal::Constant(value(item)?));
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
