//! Reads `[[shape]]`: shapes on bodies and on the ground, for pictures.

use super::ReadFault;
use super::fields::{Fields, Read};
use super::tree::{Item, Node};
use crate::keys::{COLOURS, SHAPES};
use mbs_core::scene::{BodyShape, Number, ShapeKind};

/// Reads a shape of any kind. A shape without a name gets the name `shape-N`, where N is its number in the list, from 1.
pub(crate) fn read(index: usize, fields: &Fields<'_>) -> Read<BodyShape<Number>> {
    let context = fields.context;
    let written = SHAPES.into_iter().filter_map(|form| Some((form, fields.get(form)?)));
    let form = match written.collect::<Vec<_>>()[..] {
        [] => {
            let fault =
                ReadFault::Missing { key: "box, sphere, capsule, cylinder, disc, polygon or mesh" };
            return context.fault(fields.header, fault);
        }
        [(form, item)] => kind(fields, form, item)?,
        [(one, _), (other, item), ..] => {
            return context.fault(&item.span, ReadFault::Both { keys: [one, other] });
        }
    };
    Ok(BodyShape {
        name: fields.name_or("shape", index)?,
        body: context.body(fields.need("body")?)?,
        form,
        colour: fields.get("colour").map(|item| colour(fields, item)).transpose()?,
        opacity: fields.number_or("opacity", "1")?,
        is_visual: fields.flag("visual", true)?,
    })
}

fn kind<'a>(fields: &Fields<'a>, form: &str, item: &'a Item) -> Read<ShapeKind<Number>> {
    let table = fields.context.table(item, "a table with the sizes of the form", form)?;
    Ok(match form {
        "box" => {
            let size = table.numbers_of("size", "three lengths: [x, y, z]")?;
            let axes = table.get("axes").map(|_| table.two_vectors("axes")).transpose()?;
            ShapeKind::Box { center: table.vector("center")?, size, axes }
        }
        "polygon" => {
            let item = table.need("points")?;
            let points = table.context.list(item, "a list of places, one after the other")?;
            let points = points.iter().map(|point| table.at("points").place(point));
            ShapeKind::Polygon { points: points.collect::<Read<_>>()? }
        }
        "mesh" => mesh(&table)?,
        "capsule" | "cylinder" => {
            let (from, to) = (table.vector("from")?, table.vector("to")?);
            let radius = table.number("radius")?;
            match form {
                "capsule" => ShapeKind::Capsule { from, to, radius },
                _ => ShapeKind::Cylinder { from, to, radius },
            }
        }
        _ => {
            let (center, radius) = (table.vector("center")?, table.number("radius")?);
            match form {
                "sphere" => ShapeKind::Sphere { center, radius },
                _ => ShapeKind::Disc { center, radius },
            }
        }
    })
}

/// Reads a file of triangles; its path is made absolute.
fn mesh(table: &Fields<'_>) -> Read<ShapeKind<Number>> {
    let file = table.need("file")?;
    let path = table.context.text(file)?;
    let scale = match table.get("scale").map(|item| table.at("scale").numbers(item)).transpose()? {
        None => core::array::from_fn(|_| Number::from(1)),
        Some(factors) => match &factors[..] {
            [factor] => core::array::from_fn(|_| factor.clone()),
            [x, y, z] => [x.clone(), y.clone(), z.clone()],
            other => {
                let fault = ReadFault::WrongCount { needed: 3, found: other.len() };
                return table.context.fault(&table.need("scale")?.span, fault);
            }
        },
    };
    let at = table.optional_vector("at")?.unwrap_or_default();
    let axes = table.get("axes").map(|_| table.two_vectors("axes")).transpose()?;
    Ok(ShapeKind::Mesh { file: table.context.texts.path(&file.span, path), at, axes, scale })
}

/// Reads a colour: a name of the list, or `#rrggbb`.
fn colour(fields: &Fields<'_>, item: &Item) -> Read<[u8; 3]> {
    let known = COLOURS.map(|(name, _)| name);
    let Node::Text(text) = &item.node else {
        return fields.context.text(item).map(|_| [0; 3]);
    };
    let byte = |i: usize| u8::from_str_radix(text.get(2 * i + 1..2 * i + 3)?, 16).ok();
    let is_code = text.len() == 7 && text.starts_with('#');
    let code = || Some([byte(0)?, byte(1)?, byte(2)?]).filter(|_| is_code);
    match COLOURS.into_iter().find(|(name, _)| name == text) {
        Some((_, rgb)) => Ok(rgb),
        None => match code() {
            Some(rgb) => Ok(rgb),
            None => fields.unknown_word("colour", (text, &item.span), &known),
        },
    }
}
