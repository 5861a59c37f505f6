//! Places: numbers, the name of a point, or a place relative to another point.

use super::ReadFault;
use super::error::Read;
use super::number::{decimal, rounded};
use super::texts::Texts;
use super::tree::{Item, Node, Span};
use mbs_core::real::DoubleDouble;
use mbs_core::scene::Number;

/// A place, with the number of its coordinates in the file: two in the plane, three in space.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) at: [Number; 3],
    pub(super) n: usize,
}

/// Source of the values of names and expressions.
pub(super) trait Given {
    fn texts(&self) -> &Texts;
    /// The length [m] of an expression at a span.
    fn length(&self, text: &str, span: &Span) -> Read<Number>;
    /// The point whose full name is at a span.
    fn point(&self, name: &str, span: &Span) -> Read<Point>;
}

const FORM: &str =
    "a place: a list of numbers, the name of a point, or { of = \"point\", plus = [..] }";

/// Reads a place: `[x, y, z]`, `"NAME"`, or `{ of = "NAME", mirror = "y", plus = [x, y, z] }`.
pub(super) fn read(given: &dyn Given, item: &Item) -> Read<Point> {
    match &item.node {
        Node::List(items) => numbers(given, item, items),
        Node::Text(name) => given.point(name, &item.span),
        Node::Table(_) => from(given, item),
        other => wrong_type(given, item, FORM, other.description()),
    }
}

fn wrong_type<R>(
    given: &dyn Given,
    item: &Item,
    expected: &'static str,
    found: &'static str,
) -> Read<R> {
    Err(given.texts().error(&item.span, ReadFault::WrongType { expected, found }))
}

/// Reads a place from two or three numbers.
fn numbers(given: &dyn Given, whole: &Item, items: &[Item]) -> Read<Point> {
    if !matches!(items.len(), 2 | 3) {
        let fault = ReadFault::NoPlace { found: items.len() };
        return Err(given.texts().error(&whole.span, fault));
    }
    let mut at = [const { Number::ZERO }; 3];
    for (x, item) in at.iter_mut().zip(items) {
        *x = match &item.node {
            Node::Number(text) => decimal(given.texts(), text, &item.span)?,
            Node::Text(text) => given.length(text, &item.span)?,
            other => return wrong_type(given, item, "a number", other.description()),
        };
    }
    Ok(Point { at, n: items.len() })
}

/// A place relative to a point, mirrored and moved: `{ of = "NAME", mirror = "y", plus = [x, y, z] }`.
fn from(given: &dyn Given, item: &Item) -> Read<Point> {
    const AXES: [&str; 3] = ["x", "y", "z"];
    let Some(of) = item.get("of") else {
        return Err(given.texts().error(&item.span, ReadFault::Missing { key: "of" }));
    };
    let mut point = match &of.node {
        Node::Text(name) => given.point(name, &of.span)?,
        other => return wrong_type(given, of, "the name of a point", other.description()),
    };
    if let Some(mirror) = item.get("mirror") {
        let Node::Text(word) = &mirror.node else {
            return wrong_type(given, mirror, "a text in quotes", mirror.node.description());
        };
        let Some(axis) = AXES[..point.n].iter().position(|axis| axis == word) else {
            let (found, known) = (word.clone(), AXES[..point.n].to_vec());
            let fault = ReadFault::UnknownWord { key: "mirror", found, known };
            return Err(given.texts().error(&mirror.span, fault));
        };
        point.at[axis] = negative(&point.at[axis]);
    }
    let Some(plus) = item.get("plus") else { return Ok(point) };
    let Node::List(items) = &plus.node else {
        return wrong_type(given, plus, "a list of numbers", plus.node.description());
    };
    let moved = numbers(given, plus, items)?;
    if moved.n != point.n {
        let fault = ReadFault::WrongCount { needed: point.n, found: moved.n };
        return Err(given.texts().error(&plus.span, fault));
    }
    for (x, by) in point.at.iter_mut().zip(&moved.at) {
        *x = sum(given.texts(), x.value(), by.value(), &plus.span)?;
    }
    Ok(point)
}

/// The vector from one place to another.
pub(super) fn between(
    texts: &Texts,
    [from, to]: [&[Number; 3]; 2],
    span: &Span,
) -> Read<[Number; 3]> {
    let mut vector = [const { Number::ZERO }; 3];
    for ((x, from), to) in vector.iter_mut().zip(from).zip(to) {
        *x = sum(texts, to.value(), -from.value::<DoubleDouble>(), span)?;
    }
    Ok(vector)
}

/// A sum in double-double arithmetic, with all its digits.
fn sum(texts: &Texts, a: DoubleDouble, b: DoubleDouble, span: &Span) -> Read<Number> {
    rounded(texts, a + b, ("the sum", span))
}

/// The number with the same digits and the opposite sign; zero stays zero.
fn negative(number: &Number) -> Number {
    if number.is_zero() {
        return number.clone();
    }
    let text = number.text();
    let negative = match text.strip_prefix('-') {
        Some(positive) => positive.to_owned(),
        None => format!("-{}", text.trim_start_matches('+')),
    };
    Number::from_decimal(&negative).unwrap_or_else(|| Number::from(-number.to_f64()))
}

/// The fault of a reference to a point that the file does not have.
pub(super) fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> ReadFault {
    let mut known: Vec<String> = known.map(str::to_owned).collect();
    known.sort_unstable();
    ReadFault::UnknownPart { list: "points", name: name.to_owned(), known }
}
