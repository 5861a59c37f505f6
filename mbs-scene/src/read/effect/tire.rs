//! Tires.

use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use mbs_core::scene::{CalspanCoefficients, EffectKind, Number};

pub(super) fn tire(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    let context = fields.context;
    Ok(EffectKind::Tire {
        body: context.moving_body(fields.need("body")?)?,
        center: fields.vector("center")?,
        axis: fields.get("axis").map(|item| context.vector(item)).transpose()?,
        radius: fields.number("radius")?,
        stiffness: fields.number("stiffness")?,
        damping: fields.number_or_zero("damping")?,
        rolling_resistance: fields.number_or_zero("rolling_resistance")?,
        side: side(fields)?,
    })
}

/// `side = "calspan"` with `coefficients`, where they are left out those of the Iltis.
fn side(fields: &Fields<'_>) -> Read<Option<CalspanCoefficients<Number>>> {
    let model = fields.get("side").map(|_| fields.word("side")).transpose()?;
    match model {
        Some(("calspan", _)) => {}
        None | Some(("none", _)) => {
            if fields.get("coefficients").is_some() {
                let fault = ReadFault::Missing { key: "side = \"calspan\"" };
                return fields.context.fault(fields.header, fault);
            }
            return Ok(None);
        }
        Some(word) => return fields.unknown_word("side", word, &["none", "calspan"]),
    }
    let Some(item) = fields.get("coefficients") else {
        return Ok(Some(CalspanCoefficients::of_iltis()));
    };
    let form = "a table: { a = [..], omega = .., b = [..], skid = .., trail = [..] }";
    let table = fields.context.table(item, form)?;
    table.allow(&["a", "omega", "b", "skid", "trail"], &[])?;
    let context = table.context;
    Ok(Some(CalspanCoefficients {
        a: context.numbers_of(table.need("a")?, "five numbers: [A0, A1, A2, A3, A4]")?,
        omega: table.number("omega")?,
        b: context.numbers_of(table.need("b")?, "three numbers: [B1, B3, B4]")?,
        skid: table.number("skid")?,
        trail: context.numbers_of(table.need("trail")?, "two numbers: [AF1, AF2]")?,
    }))
}
