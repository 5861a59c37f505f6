//! Reads the table `[[body]]`.

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{Body, Inertia, Number};

pub(crate) fn read(fields: &Fields<'_>) -> Read<Body<Number>> {
    let context = fields.context;
    let (name, mass) = (fields.name()?, fields.number("mass")?);
    let gravity_scale = fields.optional("gravity_scale")?;
    if fields.get("point").is_some() {
        for other in ["center", "inertia", "rod"] {
            fields.exclusive("point", other)?;
        }
        let center = fields.vector("point")?;
        return Ok(Body { name, mass, center, inertia: Inertia::Point, gravity_scale });
    }
    if let Some(item) = fields.get("rod") {
        fields.exclusive("rod", "center")?;
        fields.exclusive("rod", "inertia")?;
        let ends = context.table(item, "a table: { from = [..], to = [..] }", "rod")?;
        let (from, to) = (ends.vector("from")?, ends.vector("to")?);
        let center = core::array::from_fn(|i| Number::HALF * (from[i].clone() + to[i].clone()));
        let inertia = Inertia::Rod { from, to };
        return Ok(Body { name, mass, center, inertia, gravity_scale });
    }
    // A body without mass needs neither a centre of mass nor an inertia.
    let center = match fields.get("center") {
        None if mass.is_zero() => [const { Number::ZERO }; 3],
        _ => fields.vector("center")?,
    };
    let inertia = match (fields.get("inertia"), context.is_planar()) {
        (None, true) if mass.is_zero() => Inertia::Planar(Number::ZERO),
        (None, false) if mass.is_zero() => Inertia::Spatial([const { Number::ZERO }; 6]),
        (_, true) => Inertia::Planar(fields.number("inertia")?),
        (_, false) => {
            let form = "a list of six numbers: [Ixx, Iyy, Izz, Ixy, Iyz, Izx]";
            Inertia::Spatial(fields.numbers_of("inertia", form)?)
        }
    };
    Ok(Body { name, mass, center, inertia, gravity_scale })
}
