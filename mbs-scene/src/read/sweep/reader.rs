//! Reading of a sweep file: `[sweep]` and `[[vary]]`.

use super::SweepFault;
use super::fault::MOST_MEMBERS;
use super::parameter::{Combine, Parameter};
use super::path::{self, Address};
use super::values::ValueRange;
use crate::keys::{self, SWEEP_FILE};
use crate::read::fields::{Context, Fields, Read};
use crate::read::names::Names;
use crate::read::tree::{Item, Node, Span};
use crate::read::values::Values;
use crate::read::{ReadFault, SceneFile};

const COMBINE: [&str; 3] = ["grid", "zip", "latin-hypercube"];
const SCALES: [&str; 2] = ["linear", "log"];

/// Reads the combination of values, and the parameters in the order of the file. `has_more` is true if code gives further parameters.
pub(super) fn read(
    sweep: &SceneFile,
    scene: &SceneFile,
    has_more: bool,
) -> Read<(Combine, Vec<Parameter>)> {
    let none = Names::default();
    let values = Values::new(&sweep.texts, sweep.root())?;
    let context = Context::of_file(&sweep.texts, &values, &none);
    let (members, tables) = (sweep.root(), keys::of(SWEEP_FILE));
    Fields { context, header: &(0..0), members, tables }.checked()?;
    let header = sweep.root().iter().find(|member| member.key == "sweep");
    let (combine, seed) = match header {
        Some(member) => read_header(&context.table(&member.item, "a table: [sweep]", "sweep")?)?,
        None => (Combine::Grid, 0),
    };
    let parameters: Vec<Parameter> = sweep
        .entries(&context, "vary", |i, fields| read_parameter(fields, scene, (combine, seed, i)))?;
    if parameters.is_empty() && !has_more {
        return fault(&context, &(0..0), SweepFault::NoValues);
    }
    Ok((combine, parameters))
}

pub(super) fn fault<R>(context: &Context<'_>, span: &Span, fault: SweepFault) -> Read<R> {
    context.fault(span, ReadFault::Sweep(fault))
}

fn read_header(header: &Fields<'_>) -> Read<(Combine, u64)> {
    if header.get("name").is_some() {
        header.name()?;
    }
    let word = match header.get("combine") {
        None => "grid",
        Some(_) => header.word("combine")?.0,
    };
    let is_known = COMBINE.contains(&word);
    if !is_known {
        return header.unknown_word("combine", header.word("combine")?, &COMBINE);
    }
    if word == "latin-hypercube" {
        let n = header.count("samples", MOST_MEMBERS)?;
        return Ok((Combine::Latin(n), read_seed(header)?));
    }
    header.unused(&["samples", "seed"])?;
    Ok((if word == "zip" { Combine::Zip } else { Combine::Grid }, 0))
}

fn read_seed(header: &Fields<'_>) -> Read<u64> {
    let item = header.need("seed")?;
    let Node::Number(text) = &item.node else {
        return header.context.number(item).map(|_| 0);
    };
    match text.parse() {
        Ok(seed) => Ok(seed),
        Err(_) => fault(&header.context, &item.span, SweepFault::NotASeed(text.clone())),
    }
}

fn read_parameter(
    fields: &Fields<'_>,
    scene: &SceneFile,
    (combine, seed, index): (Combine, u64, usize),
) -> Read<Parameter> {
    let context = fields.context;
    let item = fields.need("path")?;
    let path = context.text(item)?;
    let place = address(&context, item, scene)?;
    let mut parameter = Parameter {
        name: path.to_owned(),
        span: item.span.clone(),
        sets: vec![(place, item.span.clone())],
        shifts: addresses(fields, "shift", scene)?,
        texts: Vec::new(),
        value_spans: Vec::new(),
        ends: Vec::new(),
        is_in_code: false,
    };
    parameter.sets.extend(addresses(fields, "also", scene)?);
    if let Some(item) = fields.get("name") {
        parameter.name = fields.name()?;
        parameter.span = item.span.clone();
    }
    if fields.get("values").is_some() {
        read_values(fields, combine, &mut parameter)?;
    } else {
        read_range(fields, (combine, seed, index), &mut parameter)?;
    }
    Ok(parameter)
}

/// The addresses that a path or a list of paths names.
fn addresses(fields: &Fields<'_>, key: &str, scene: &SceneFile) -> Read<Vec<(Address, Span)>> {
    let context = fields.context;
    let place = |item: &Item| Ok((address(&context, item, scene)?, item.span.clone()));
    match fields.get(key) {
        None => Ok(Vec::new()),
        Some(item) if matches!(item.node, Node::Text(_)) => Ok(vec![place(item)?]),
        Some(item) => context.list(item, "a path, or a list of paths")?.iter().map(place).collect(),
    }
}

fn address(context: &Context<'_>, item: &Item, scene: &SceneFile) -> Read<Address> {
    let Node::Text(path) = &item.node else {
        let found = item.node.description();
        let expected = "a path in quotes, such as \"body.crank.mass\"";
        return context.fault(&item.span, ReadFault::WrongType { expected, found });
    };
    path::address(scene, path).or_else(|found| fault(context, &item.span, found))
}

/// Reads `values = [..]` of a parameter; the numbers keep their decimal text.
fn read_values(fields: &Fields<'_>, combine: Combine, parameter: &mut Parameter) -> Read<()> {
    let context = fields.context;
    fields.unused(&["from", "to", "count", "step", "scale"])?;
    let item = fields.need("values")?;
    if let Combine::Latin(_) = combine {
        let known = vec!["path", "also", "shift", "name", "from", "to", "scale"];
        return context.fault(&item.span, ReadFault::UnusedKey { key: "values".to_owned(), known });
    }
    for item in context.list(item, "a list of numbers")? {
        parameter.texts.push(decimal(&context, item)?);
        parameter.value_spans.push(item.span.clone());
    }
    match parameter.texts.is_empty() {
        true => fault(&context, &item.span, SweepFault::NoValues),
        false => Ok(()),
    }
}

/// The decimal text of a number: the text in the file, or that of the value of an expression.
fn decimal(context: &Context<'_>, item: &Item) -> Read<String> {
    let number = context.number(item)?;
    Ok(if let Node::Number(text) = &item.node { text.clone() } else { number.text() })
}

/// Reads the ends of a range, and the number of values or the step.
fn read_range(
    fields: &Fields<'_>,
    (combine, seed, index): (Combine, u64, usize),
    parameter: &mut Parameter,
) -> Read<()> {
    let context = fields.context;
    if fields.get("from").is_none() && fields.get("to").is_none() {
        return fault(&context, fields.header, SweepFault::NoValues);
    }
    let (from, to) = (fields.number("from")?.to_f64(), fields.number("to")?.to_f64());
    let ends = [fields.need("from")?, fields.need("to")?];
    let is_log = match fields.get("scale") {
        None => false,
        Some(_) => match fields.word("scale")? {
            ("linear", _) => false,
            ("log", _) => true,
            word => return fields.unknown_word("scale", word, &SCALES),
        },
    };
    let range = ValueRange { from, to, is_log };
    if !(from < to || to < from) {
        return fault(&context, &ends[1].span, SweepFault::NoRange);
    }
    if is_log && from.min(to) <= 0.0 {
        let low = if from < to { ends[0] } else { ends[1] };
        return fault(&context, &low.span, SweepFault::NotLogarithmic);
    }
    let numbers = match combine {
        Combine::Latin(n) => {
            fields.unused(&["count", "step"])?;
            range.strata(n, seed, index)
        }
        _ => range_values(fields, &range)?,
    };
    parameter.texts = numbers.into_iter().map(|x| x.to_string()).collect();
    for item in ends {
        parameter.ends.push((decimal(&context, item)?, item.span.clone()));
    }
    // An error of a value between the ends is shown at the end of the range.
    parameter.value_spans = vec![ends[1].span.clone()];
    Ok(())
}

fn range_values(fields: &Fields<'_>, range: &ValueRange) -> Read<Vec<f64>> {
    let context = fields.context;
    fields.exclusive("count", "step")?;
    let Some(item) = fields.get("step") else {
        if fields.get("count").is_none() {
            let fault = ReadFault::Missing { key: "count or step" };
            return context.fault(fields.header, fault);
        }
        let count = fields.count("count", MOST_MEMBERS)?;
        if count == 1 {
            return fault(&context, &fields.need("count")?.span, SweepFault::NoRange);
        }
        return Ok(range.spread(count));
    };
    if range.is_log {
        let known = vec!["count"];
        return context.fault(&item.span, ReadFault::UnusedKey { key: "step".to_owned(), known });
    }
    let step = context.number(item)?;
    let (from, to) = (range.from, range.to);
    match range.steps(step.to_f64()) {
        None => fault(&context, &item.span, SweepFault::Step { from, to }),
        Some(n) if n > f64::from(MOST_MEMBERS) => {
            fault(&context, &item.span, SweepFault::TooMany(n))
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
        Some(n) => Ok(range.stepped(step.to_f64(), n as u32)),
    }
}
