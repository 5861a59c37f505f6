//! Reads the value of a field, according to its form.

use crate::read::ReadFault;
use crate::read::coupling::{ball_term, read_points, read_terms};
use crate::read::fields::{Context, Fields, Read};
use crate::read::signal::components;
use crate::read::tree::{Item, Node};
use mbs_core::effects::{Field, Form, SignalForm, Value};
use mbs_core::scene::{
    AxisFrame, BodyId, CalspanCoefficients, Joint, LongitudinalSlip, Number, PolynomialPiece,
    Signal,
};

/// The value of a field of an effect of the kind `name`; `None` when its key is not written.
pub(super) fn read(
    fields: &Fields<'_>,
    field: &'static Field,
    (name, joints): (&str, &[Joint<Number>]),
) -> Read<Option<Value<Number>>> {
    let (key, context) = (field.key, fields.context.of_unit(field.key, field.unit));
    match field.form {
        Form::Signal(form) => return Ok(signal(fields, (form, context))?.map(Value::Signal)),
        Form::Side => return side(fields).map(Value::Side).map(Some),
        Form::Name(own) => return Ok(Some(Value::Name(own == name))),
        Form::ForceLaw | Form::BodyLaw => return Ok(None),
        _ => {}
    }
    if field.form == Form::Terms && fields.get(key).is_none() {
        let term = ball_term(fields, joints, Number::from(1.0))?;
        return Ok(term.map(|term| Value::Terms(vec![term])));
    }
    let Some(item) = fields.get(key).or_else(|| fields.of_frame(key)) else { return Ok(None) };
    Ok(Some(match field.form {
        Form::Bodies => Value::Bodies(fields.pair()?),
        Form::Body => Value::Body(context.moving_body(item)?),
        Form::Joint(_) => Value::Joint(context.joint(item)?),
        Form::Coordinate => {
            let joint = &joints[context.joint(fields.need("joint")?)?.index()];
            Value::Coordinate(Some(fields.coordinate(item, joint)?))
        }
        Form::Terms => Value::Terms(read_terms(fields, item, joints)?),
        Form::Point => Value::Point(context.place(item)?),
        Form::Points(_) => Value::Points(fields.two_vectors(key)?),
        Form::Line => Value::Line(line(fields, item)?),
        Form::Length => Value::Length(match &item.node {
            Node::Text(word) if word == "reference" => None,
            _ => Some(context.number(item)?),
        }),
        Form::Axis => Value::Axis(context.vector(item)?),
        Form::MaybeAxis => Value::MaybeAxis(Some(context.vector(item)?)),
        Form::Spin => Value::Spin(Some(context.joint(item)?)),
        Form::Slip => Value::Slip(Some(slip(fields, item)?)),
        Form::Number(_) => Value::Number(context.number(item)?),
        Form::Flag => Value::Flag(fields.flag(key, false)?),
        Form::Six => Value::Six(six(&context, item)?),
        Form::Pieces => {
            let pieces = context.list(item, "a list of pieces [lower, upper, c0, c1, ...]")?;
            Value::Pieces(pieces.iter().map(|item| piece(fields, item)).collect::<Read<_>>()?)
        }
        Form::Frame => Value::Frame(match fields.word(key)? {
            ("global", _) => AxisFrame::Global,
            ("body", _) => AxisFrame::Body,
            word => return fields.unknown_word(key, word, &["global", "body"]),
        }),
        _ => return Ok(None),
    }))
}

/// Reads a signal from one of three keys. The key `value` has a constant, or with `input = true` an input that is set between steps. The
/// key `signal` has a name or a list of names. The key `table` has rows `[time, value]`, for a vector also `[time, x, y, z]`.
fn signal<'a>(
    fields: &Fields<'a>,
    (form, context): (SignalForm, Context<'a>),
) -> Read<Option<Signal<Number>>> {
    for [one, other] in [
        ["value", "table"],
        ["table", "input"],
        ["value", "signal"],
        ["table", "signal"],
        ["input", "signal"],
    ] {
        fields.exclusive(one, other)?;
    }
    let time_of = |item| context.of_unit("table", "s").number(item);
    if let Some(item) = fields.get("signal") {
        return components(&context, item).map(|signals| Some(Signal::Named(signals)));
    }
    let is_scalar = form.n_components(context.dimension) == 1;
    let value = |item| {
        if is_scalar {
            return Ok([context.number(item)?, Number::ZERO, Number::ZERO]);
        }
        context.vector(item)
    };
    let Some(table) = fields.get("table") else {
        let is_input = fields.flag("input", false)?;
        let signal = if is_input { Signal::Input } else { Signal::Constant };
        return fields.get("value").map(|item| Ok(signal(value(item)?))).transpose();
    };
    let rows = context.list(table, "a list of rows [time, value]")?;
    let read_row = |row| match context.list(row, "a row [time, value]")? {
        [time, flat @ ..]
            if !is_scalar
                && matches!(flat, [Item { node: Node::Number(_) | Node::Text(_), .. }, ..]) =>
        {
            Ok((time_of(time)?, context.components(row, flat)?))
        }
        _ => {
            let [time, item] = context.exactly(row, "a row [time, value]")?;
            Ok((time_of(time)?, value(item)?))
        }
    };
    rows.iter().map(read_row).collect::<Read<Vec<_>>>().map(|rows| Some(Signal::Table(rows)))
}

/// Reads a piece of a polynomial, `[lower, upper, c0, c1, ...]`.
fn piece(fields: &Fields<'_>, item: &Item) -> Read<PolynomialPiece<Number>> {
    let context = fields.context;
    let numbers = context.list(item, "a piece [lower, upper, c0, c1, ...]")?;
    let [lower, upper, rest @ ..] = numbers else {
        let fault = ReadFault::WrongCount { needed: 3, found: numbers.len() };
        return context.fault(&item.span, fault);
    };
    Ok(PolynomialPiece {
        lower: context.number(lower)?,
        upper: context.number(upper)?,
        coefficients: rest.iter().map(|item| context.number(item)).collect::<Read<_>>()?,
    })
}

/// Reads six numbers: along and about x, y, z. In the plane there are three: along x, along y and about z.
fn six(context: &Context<'_>, item: &Item) -> Read<[Number; 6]> {
    if context.is_planar() {
        let [x, y, about] = context.numbers_of(item, "a list of three numbers: [x, y, theta]")?;
        const ZERO: Number = Number::ZERO;
        return Ok([x, y, ZERO, ZERO, ZERO, about]);
    }
    context.numbers_of(item, "a list of six numbers: along x, y, z, then about x, y, z")
}

/// Reads points with their bodies, or `bodies` with a place on each.
fn line(fields: &Fields<'_>, item: &Item) -> Read<Vec<(BodyId, [Number; 3])>> {
    if fields.get("bodies").is_none() {
        return read_points(fields, item);
    }
    let (bodies, points) = (fields.pair()?, fields.two_vectors("points")?);
    Ok(bodies.into_iter().zip(points).collect())
}

/// Reads longitudinal slip, `{ stiffness = .., friction = .. }`.
fn slip(fields: &Fields<'_>, item: &Item) -> Read<LongitudinalSlip<Number>> {
    let table = fields.context.table(item, "a table: { stiffness = .., friction = .. }", "slip")?;
    let [stiffness, friction] = ["stiffness", "friction"].map(|key| table.number(key));
    Ok(LongitudinalSlip { stiffness: stiffness?, friction: friction? })
}

/// Reads the side force, `side = "calspan"` with `coefficients`. Default: the coefficients of the Iltis.
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
    let table = fields.context.table(item, form, "calspan")?;
    Ok(Some(CalspanCoefficients {
        a: table.numbers_of("a", "five numbers: [A0, A1, A2, A3, A4]")?,
        omega: table.number("omega")?,
        b: table.numbers_of("b", "three numbers: [B1, B3, B4]")?,
        skid: table.number("skid")?,
        trail: table.numbers_of("trail", "two numbers: [AF1, AF2]")?,
    }))
}
