//! Reads tables, laws over time and terms of sums.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::scene::{Carrier, Curve, Joint, Kind, Law, Measure, Signal, Source, Spline, Term};
use crate::vector::{Vector, unit};

/// Reads rows of two numbers.
pub(crate) fn rows(node: &Node) -> Read<Vec<[f64; 2]>> {
    node.list()?
        .iter()
        .map(|row| match row.numbers()?.as_slice() {
            &[t, x] => Ok([t, x]),
            other => fault(format!("not a row: {other:?}")),
        })
        .collect()
}

pub(crate) fn word(table: &mut Table, key: &str, default: &str) -> Read<String> {
    if table.has(key) { table.text(key) } else { Ok(default.to_owned()) }
}

fn flag(table: &mut Table, key: &str) -> bool {
    matches!(table.take(key), Some(Node::Flag(true)))
}

/// Reads the curve through the given rows, with the keys `interpolation`, `ends` and `periodic`.
fn tabled(table: &mut Table, rows: &[[f64; 2]]) -> Read<Curve> {
    let (how, ends) = (word(table, "interpolation", "spline")?, word(table, "ends", "natural")?);
    let repeats = flag(table, "periodic");
    Ok(match (how.as_str(), ends.as_str(), repeats) {
        ("spline", "natural", true) => Curve::Periodic(Spline::periodic(rows)),
        ("spline", "natural", false) => Curve::Spline(Spline::natural(rows)),
        ("spline", "level", false) => Curve::Spline(Spline::level(rows)),
        ("linear", ..) => Curve::Linear(rows.to_vec(), repeats),
        ("hold", ..) => Curve::Hold(rows.to_vec(), repeats),
        ("monotone", "natural", true) => {
            Curve::Periodic(Spline::monotone(&Spline::periodic(rows), true))
        }
        ("monotone", "natural", false) => {
            Curve::Spline(Spline::monotone(&Spline::natural(rows), false))
        }
        ("monotone", "level", false) => {
            Curve::Spline(Spline::monotone(&Spline::level(rows), false))
        }
        (other, ends, _) => return fault(format!("interpolation {other}, ends {ends}")),
    })
}

/// Reads a curve from the key `table` or `coefficients`; `None` without these keys.
pub(crate) fn curve(table: &mut Table) -> Read<Option<Curve>> {
    if let Some(node) = table.take("coefficients") {
        return Ok(Some(Curve::Polynomial(node.numbers()?)));
    }
    match table.take("table") {
        Some(node) => tabled(table, &rows(&node)?).map(Some),
        None => Ok(None),
    }
}

/// A law over time, if the table has the keys of a law.
pub(crate) fn law(table: &mut Table, signals: &[Signal]) -> Read<Option<Law>> {
    if let Some(source) = signal(table, signals)? {
        return Ok(Some(Law::Signal(Box::new(source))));
    }
    if let Some(mut sine) = table.table("sine")? {
        let numbers = ["amplitude", "frequency"].map(|key| sine.number(key));
        let [amplitude, frequency] = numbers;
        return Ok(Some(Law::Sine([amplitude?, frequency?, sine.number_or("phase", 0.0)?])));
    }
    if let Some(mut ramp) = table.table("ramp")? {
        return Ok(Some(Law::Ramp(ramp.number("rate")?)));
    }
    Ok(curve(table)?.map(Law::Curve))
}

/// The names of a joint's coordinates; components of a rotation vector have none.
fn coordinate_names(kind: Kind, planar: bool) -> &'static [&'static str] {
    match kind {
        Kind::Revolute => &["turn"],
        Kind::Prismatic => &["slide"],
        Kind::Cylindrical => &["slide", "turn"],
        Kind::Universal => &["first", "second"],
        Kind::Planar => &["x", "y", "turn"],
        Kind::PinInSlot if planar => &["slide", "turn"],
        Kind::PinInSlot => &["slide"],
        Kind::Free if planar => &["x", "y", "turn"],
        Kind::FreePoint if planar => &["x", "y"],
        Kind::Free | Kind::FreePoint => &["x", "y", "z"],
        Kind::Spherical | Kind::Weld | Kind::Distance => &[],
    }
}

/// Reads the number of the coordinate that the key `coordinate` names; `None` without the key.
pub(crate) fn coordinate(table: &mut Table, kind: Kind) -> Read<Option<usize>> {
    let names = coordinate_names(kind, table.planar);
    let Some(node) = table.take("coordinate") else { return Ok(None) };
    let known = match &node {
        Node::Text(name) => names.iter().position(|n| n == name),
        other => {
            let number = other.number()?;
            (0..names.len().max(6)).find(|i| (*i as f64 - number).abs() < 0.5)
        }
    };
    known.map_or_else(|| fault(format!("no coordinate {node:?}")), |i| Ok(Some(i)))
}

/// The number of the only coordinate of a joint, or of its only rotation.
pub(crate) fn only(joint: &Joint, planar: bool) -> Read<usize> {
    match joint.kind.coordinates(planar) {
        [1, 0] => Ok(0),
        [slides, 1] => Ok(slides),
        _ => fault(format!("which coordinate of `{}`", joint.name)),
    }
}

/// Reads `points` of a line.
pub(crate) fn points(table: &mut Table, names: &Names) -> Read<Vec<(Carrier, Vector)>> {
    let one = |mut point: Table| Ok((names.carrier(&point.text("body")?)?, point.vector("at")?));
    table.tables("points")?.into_iter().map(one).collect()
}

/// Reads a measure: a coordinate of a joint (keys `joint`, `coordinate`, `axis`), or the length of a line (key `points`).
pub(crate) fn measure(table: &mut Table, names: &Names, joints: &[Joint]) -> Read<Measure> {
    if table.has("points") {
        return Ok(Measure::Length(points(table, names)?));
    }
    let joint = names.joint(&table.text("joint")?)?;
    if let Some(axis) = table.vector_or_none("axis")? {
        let angle = table.text("coordinate")?;
        return Ok(Measure::Ball(joint, unit(axis), angle == "twist"));
    }
    let data = &joints[joint];
    let number = match coordinate(table, data.kind)? {
        Some(number) => number,
        None => only(data, table.planar)?,
    };
    Ok(Measure::Coordinate(joint, number))
}

/// The terms of a sum.
pub(crate) fn terms(table: &mut Table, names: &Names, joints: &[Joint]) -> Read<Vec<Term>> {
    let one = |mut term: Table| {
        let measure = measure(&mut term, names, joints)?;
        let (factor, curve) = (term.number_or("factor", 1.0)?, curve(&mut term)?);
        term.done("term")?;
        Ok(Term { measure, factor, curve })
    };
    table.tables("terms")?.into_iter().map(one).collect()
}

/// The sum of an effect: `terms`, or one coordinate of `joint`.
pub(crate) fn effect_sum(table: &mut Table, names: &Names, joints: &[Joint]) -> Read<Vec<Term>> {
    if table.has("terms") {
        return terms(table, names, joints);
    }
    Ok(vec![Term { measure: measure(table, names, joints)?, factor: 1.0, curve: None }])
}

/// The signal that `signal` names, if the key exists.
fn signal(table: &mut Table, signals: &[Signal]) -> Read<Option<Source>> {
    let Some(node) = table.take("signal") else { return Ok(None) };
    by_name(&node, signals).map(Some)
}

/// A signal by its name.
pub(crate) fn by_name(node: &Node, signals: &[Signal]) -> Read<Source> {
    let Node::Text(name) = node else { return fault("not the name of a signal") };
    let found = signals.iter().find(|signal| signal.name == *name);
    found.map_or_else(|| fault(format!("no signal `{name}`")), |one| Ok(one.source.clone()))
}
