//! Values of parameters and points. Each is evaluated once, after the names that it uses.

use super::error::{ExpressionFault, Read};
use super::expression::{EvaluationFault, evaluate, unit::Dimensions};
use super::nearest::nearest_name;
use super::number::{check_unit, decimal, rounded};
use super::point::{self, Given, Point};
use super::texts::Texts;
use super::tree::{Item, Member, Node, Span};
use super::{ReadError, ReadFault};
use mbs_core::real::DoubleDouble;
use mbs_core::scene::Number;
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};

/// Largest number of parameters and points that use one another in a row [-]. Chosen, not tuned.
const MAX_CHAIN: usize = 64;

/// Parameters and points by their full names, and the values found so far.
pub(super) struct Named<'a> {
    pub(super) texts: &'a Texts,
    /// Parameters as they are written in the files.
    parameters: HashMap<&'a str, &'a Member>,
    /// Places of points as they are written in the files.
    places: HashMap<&'a str, &'a Item>,
    numbers: RefCell<HashMap<String, DoubleDouble>>,
    points: RefCell<HashMap<String, Point>>,
    /// Names whose evaluation needs the present name, from the outside inwards.
    chain: RefCell<Vec<String>>,
    /// Parameters that some expression has used.
    used: RefCell<HashSet<String>>,
}

/// Reason why a name has no value.
pub(super) enum Missing {
    /// The name has no value of this kind: message and hint.
    Unknown([String; 2]),
    /// The value of the name has an error at its own place in the file.
    Refused(ReadError),
}

impl<'a> Named<'a> {
    pub(super) fn new(texts: &'a Texts, parameters: &'a [Member], points: &'a [Item]) -> Self {
        let place = |item: &'a Item| match (item.text_at("name"), item.get("at")) {
            (Some(name), Some(at)) => Some((name, at)),
            // The reader of the entry reports the missing key.
            _ => None,
        };
        Self {
            texts,
            parameters: parameters.iter().map(|member| (member.key.as_str(), member)).collect(),
            places: points.iter().filter_map(place).collect(),
            numbers: RefCell::default(),
            points: RefCell::default(),
            chain: RefCell::default(),
            used: RefCell::default(),
        }
    }

    /// Evaluates all parameters and points.
    pub(super) fn all(self, parameters: &'a [Member], points: &'a [Item]) -> Read<Self> {
        for member in parameters {
            self.parameter(member)?;
        }
        for item in points {
            if let (Some(name), Some(at)) = (item.text_at("name"), item.get("at")) {
                self.place(name, at)?;
            }
        }
        Ok(self)
    }

    /// The value of a parameter; parameters that it uses are evaluated first.
    fn parameter(&self, member: &'a Member) -> Read<DoubleDouble> {
        let (name, span) = (member.key.as_str(), &member.item.span);
        if let Some(value) = self.numbers.borrow().get(name) {
            return Ok(*value);
        }
        self.begin(name, span)?;
        let value = match &member.item.node {
            Node::Number(text) => decimal(self.texts, text, span)?.value(),
            Node::Text(text) => self.expression(text, span)?.0,
            other => {
                let expected = "a number, or an expression in quotes";
                let fault = ReadFault::WrongType { expected, found: other.description() };
                return Err(self.texts.error(span, fault));
            }
        };
        self.chain.borrow_mut().pop();
        self.numbers.borrow_mut().insert(name.to_owned(), value);
        Ok(value)
    }

    /// The place of a point; names that it uses are evaluated first.
    fn place(&self, name: &str, at: &'a Item) -> Read<Point> {
        if let Some(point) = self.points.borrow().get(name) {
            return Ok(point.clone());
        }
        self.begin(name, &at.span)?;
        let point = point::read(self, at)?;
        self.chain.borrow_mut().pop();
        self.points.borrow_mut().insert(name.to_owned(), point.clone());
        Ok(point)
    }

    /// Begins the evaluation of a name. Refuses cycles, and chains that are too long.
    fn begin(&self, name: &str, span: &Span) -> Read<()> {
        let refused = |message: String| {
            let hint = "give one of them a number".to_owned();
            Err(self.texts.error(span, ReadFault::Expression(ExpressionFault { message, hint })))
        };
        let mut chain = self.chain.borrow_mut();
        if let Some(i) = chain.iter().position(|other| *other == name) {
            let ring: Vec<&str> = chain[i..].iter().map(String::as_str).chain([name]).collect();
            let ring = ring.join(" -> ");
            return refused(format!("parameters and points that need one another: {ring}"));
        }
        if chain.len() == MAX_CHAIN {
            return refused(format!(
                "more than {MAX_CHAIN} parameters and points that need one another in a row"
            ));
        }
        chain.push(name.to_owned());
        Ok(())
    }

    /// The value of an expression at a place in the file. A text that is only a number with a unit also has its dimensions.
    pub(super) fn expression(
        &self,
        text: &str,
        span: &Span,
    ) -> Read<(DoubleDouble, Option<Dimensions>)> {
        // An error of another parameter has its own place.
        let mut other = None;
        let texts = self.texts;
        let mut named = |name: &str| {
            self.value(name, span).map_err(|missing| match missing {
                Missing::Unknown(message) => message,
                Missing::Refused(error) => {
                    other = Some(error);
                    [String::new(), String::new()]
                }
            })
        };
        match (evaluate(text, &mut named), other) {
            (Ok(found), _) => Ok((found.value, found.dimensions)),
            (Err(_), Some(error)) => Err(error),
            (Err(fault), None) => Err(refused(texts, (text, span), fault)),
        }
    }

    /// The value of a name, `PARAMETER` or `POINT.x`, in a text at a span. The name is looked up in the file of that text first, then in
    /// the files that include it.
    fn value(&self, name: &str, span: &Span) -> Result<DoubleDouble, Missing> {
        let (base, axis) = match name.split_once('.') {
            Some((base, axis)) => (base, "xyz".find(axis)),
            None => (name, None),
        };
        let full: Vec<String> =
            self.texts.outwards(span).map(|text| format!("{}{base}", text.prefix)).collect();
        let Some(axis) = axis else {
            let member = full.iter().find_map(|name| self.parameters.get(name.as_str()).copied());
            return match member {
                Some(member) => {
                    self.used.borrow_mut().insert(member.key.clone());
                    self.parameter(member).map_err(Missing::Refused)
                }
                None => Err(Missing::Unknown(self.unknown(base, &full, span))),
            };
        };
        let found = full.iter().find_map(|full| Some((full, *self.places.get(full.as_str())?)));
        let Some((full_name, at)) = found else {
            return Err(Missing::Unknown(unknown_point(base, self.places.keys().copied())));
        };
        let point = self.place(full_name, at).map_err(Missing::Refused)?;
        if axis >= point.n {
            let message = format!("`{base}` has two coordinates");
            return Err(Missing::Unknown([message, "write its `.x` or `.y`".to_owned()]));
        }
        Ok(point.at[axis].value())
    }

    /// The parameters of the scene's file itself that no expression has used so far. Unused parameters of included files are not reported.
    pub(super) fn unused(&self) -> Vec<String> {
        let used = self.used.borrow();
        let is_own = |member: &&&Member| self.texts.of(&member.key_span).by.is_none();
        let mut spare: Vec<&Member> = self
            .parameters
            .values()
            .filter(is_own)
            .filter(|member| !used.contains(&member.key))
            .copied()
            .collect();
        spare.sort_by_key(|member| member.key_span.start);
        spare.into_iter().map(|member| member.key.clone()).collect()
    }

    /// Message and hint for a name that has no value.
    fn unknown(&self, name: &str, full: &[String], span: &Span) -> [String; 2] {
        if full.iter().any(|full| self.places.contains_key(full.as_str())) {
            return [format!("`{name}` is a point"), format!("write `{name}.x`, or another axis")];
        }
        let prefixes: Vec<&str> =
            self.texts.outwards(span).map(|text| text.prefix.as_str()).collect();
        let own = |name: &&'a str| prefixes.iter().find_map(|prefix| name.strip_prefix(prefix));
        let mut names: Vec<&str> = self.parameters.keys().filter_map(own).collect();
        names.sort_unstable();
        let hint = match names.is_empty() {
            true => "write a number, or give the name a value in [parameters]".to_owned(),
            false => nearest_name(name, &names, "parameters"),
        };
        [format!("`{name}` is no parameter"), hint]
    }
}

impl Given for Named<'_> {
    fn texts(&self) -> &Texts {
        self.texts
    }

    fn length(&self, text: &str, span: &Span) -> Read<Number> {
        let (value, dimensions) = self.expression(text, span)?;
        check_unit(self.texts, (text, span), dimensions, ("place", "m"))?;
        rounded(self.texts, value, (text, span))
    }

    fn point(&self, name: &str, span: &Span) -> Read<Point> {
        match self.places.get(name).copied() {
            Some(at) => self.place(name, at),
            None => Err(self.texts.error(span, point::unknown(name, self.places.keys().copied()))),
        }
    }
}

fn unknown_point<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> [String; 2] {
    let known: Vec<&str> = known.collect();
    let hint = match known.is_empty() {
        true => "add [[point]] with this name, and `at`".to_owned(),
        false => nearest_name(name, &known, "points"),
    };
    [format!("`{name}` is no point"), hint]
}

/// The error of an expression. When the file has the text exactly as evaluated, the place is within the text.
fn refused(texts: &Texts, (text, span): (&str, &Span), fault: EvaluationFault) -> ReadError {
    let inside = texts.written(span).and_then(|written| {
        // The text of a command line has no quotes.
        if written == text {
            return Some(span.start);
        }
        let inner = written.get(1..written.len().checked_sub(1)?)?;
        (inner == text).then_some(span.start + 1)
    });
    let end = fault.span.end.max(fault.span.start + 1);
    let place = inside.map_or_else(|| span.clone(), |start| start + fault.span.start..start + end);
    let EvaluationFault { message, hint, .. } = fault;
    texts.error(&place, ReadFault::Expression(ExpressionFault { message, hint }))
}
