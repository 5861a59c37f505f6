//! The parameters of a file, and the values of its expressions.

use super::document::SceneFile;
use super::error::ExpressionFault;
use super::expression::unit::{self, Dimensions};
use super::expression::{self, Fault, evaluate};
use super::nearest::nearest_name;
use super::tree::{Item, Member, Node, Span};
use super::{ReadError, ReadFault};
use mbs_core::Real;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::Number;
use std::collections::HashMap;

/// Most parameters that need one another in a row [-]. Chosen, not tuned.
const MAX_CHAIN: usize = 64;
/// Words that keys take in place of a number.
const WORDS: [&str; 1] = ["reference"];
/// Digits of a value's text after the first: 32 in all, those of a pair of doubles.
const DIGITS: usize = 31;

/// The parameters of a file, with their values.
#[derive(Debug)]
pub(crate) struct Values<'a> {
    document: &'a SceneFile,
    known: HashMap<String, DoubleDouble>,
}

/// Parameters whose values are being found.
struct Parameters<'a> {
    document: &'a SceneFile,
    members: &'a [Member],
    known: HashMap<String, DoubleDouble>,
    /// Those that need the one at hand.
    chain: Vec<&'a str>,
}

impl<'a> Values<'a> {
    /// The parameters of a file, each evaluated once.
    pub(crate) fn new(document: &'a SceneFile) -> Result<Self, ReadError> {
        let members = match document.top("parameters") {
            None => &[],
            Some(Item { node: Node::Table(members), .. }) => &members[..],
            Some(item) => {
                let found = item.node.description();
                let expected =
                    "a table: [parameters], with a number or an expression for each name";
                return Err(document.error(&item.span, ReadFault::WrongType { expected, found }));
            }
        };
        for member in members {
            check_name(document, member)?;
        }
        let (known, chain) = (HashMap::new(), Vec::new());
        let mut parameters = Parameters { document, members, known, chain };
        for member in members {
            parameters.value(member)?;
        }
        Ok(Self { document, known: parameters.known })
    }

    /// The number of an expression, and of a number with a unit alone its dimensions.
    pub(crate) fn number(
        &self,
        text: &str,
        span: &Span,
    ) -> Result<(Number, Option<Dimensions>), ReadError> {
        let mut named = |name: &str| match self.known.get(name) {
            Some(value) => Ok(*value),
            None => Err(unknown(name, self.known.keys().map(String::as_str).collect())),
        };
        let found = evaluate(text, &mut named)
            .map_err(|fault| refused(self.document, (text, span), fault))?;
        let decimal = format!("{:.DIGITS$e}", found.value);
        let (digits, exponent) = decimal.split_once('e').unwrap_or((&decimal, "0"));
        let decimal = format!("{}0e{exponent}", digits.trim_end_matches('0'));
        let number = Number::from_decimal(&decimal).filter(|number| number.to_f64().is_finite());
        match number {
            Some(number) => Ok((number, found.dimensions)),
            None => Err(self.document.error(span, ReadFault::NotFinite { text: text.to_owned() })),
        }
    }
}

impl<'a> Parameters<'a> {
    /// The value of a parameter, and with it of those that it needs.
    fn value(&mut self, member: &'a Member) -> Result<DoubleDouble, ReadError> {
        let name = member.key.as_str();
        if let Some(value) = self.known.get(name) {
            return Ok(*value);
        }
        let (document, span) = (self.document, &member.item.span);
        let deep = |message: String| {
            let hint = "give one of them a number".to_owned();
            Err(document.error(span, ReadFault::Expression(ExpressionFault { message, hint })))
        };
        if let Some(i) = self.chain.iter().position(|other| *other == name) {
            let ring = [&self.chain[i..], &[name]].concat().join(" -> ");
            return deep(format!("parameters that need one another: {ring}"));
        }
        if self.chain.len() == MAX_CHAIN {
            return deep(format!(
                "more than {MAX_CHAIN} parameters that need one another in a row"
            ));
        }
        self.chain.push(name);
        let value = match &member.item.node {
            Node::Number(text) => {
                let fault = || ReadFault::NotFinite { text: text.clone() };
                let value = Number::from_decimal(text).map(|x| x.value::<DoubleDouble>());
                value.filter(|x| x.is_finite()).ok_or_else(|| document.error(span, fault()))?
            }
            Node::Text(text) => self.expression(text, span)?,
            other => {
                let expected = "a number, or an expression in quotes";
                let fault = ReadFault::WrongType { expected, found: other.description() };
                return Err(document.error(span, fault));
            }
        };
        self.chain.pop();
        self.known.insert(name.to_owned(), value);
        Ok(value)
    }

    fn expression(&mut self, text: &str, span: &Span) -> Result<DoubleDouble, ReadError> {
        // the fault of another parameter stands at its own place
        let mut other = None;
        let members = self.members;
        let mut named = |name: &str| {
            let Some(member) = members.iter().find(|member| member.key == name) else {
                return Err(unknown(name, members.iter().map(|m| m.key.as_str()).collect()));
            };
            self.value(member).map_err(|error| {
                other = Some(error);
                [String::new(), String::new()]
            })
        };
        let found = evaluate(text, &mut named);
        match (found, other) {
            (Ok(found), _) => Ok(found.value),
            (Err(_), Some(error)) => Err(error),
            (Err(fault), None) => Err(refused(self.document, (text, span), fault)),
        }
    }
}

/// Refuses a name that expressions have for themselves, or cannot write.
fn check_name(document: &SceneFile, member: &Member) -> Result<(), ReadError> {
    let name = member.key.as_str();
    let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let (message, hint) = if !is_name {
        (format!("`{name}` is no name of a parameter"), "letters, digits and `_` make a name")
    } else if unit::of_name(name).is_some() {
        (format!("`{name}` is a unit"), "give the parameter another name")
    } else if expression::is_reserved(name) || WORDS.contains(&name) {
        (format!("`{name}` has a meaning of its own"), "give the parameter another name")
    } else {
        return Ok(());
    };
    let fault = ReadFault::Expression(ExpressionFault { message, hint: hint.to_owned() });
    Err(document.error(&member.key_span, fault))
}

/// What to say of a name without a value.
fn unknown(name: &str, mut names: Vec<&str>) -> [String; 2] {
    names.sort_unstable();
    let hint = match names.is_empty() {
        true => "write a number, or give the name a value in [parameters]".to_owned(),
        false => nearest_name(name, &names, "parameters"),
    };
    [format!("`{name}` is no parameter"), hint]
}

/// A fault of an expression, at its place within the text where that stands in the file as it is.
fn refused(document: &SceneFile, (text, span): (&str, &Span), fault: Fault) -> ReadError {
    let inside = document.text().get(span.clone()).and_then(|written| {
        let inner = written.get(1..written.len().checked_sub(1)?)?;
        (inner == text).then_some(span.start + 1)
    });
    let end = fault.span.end.max(fault.span.start + 1);
    let place = inside.map_or_else(|| span.clone(), |start| start + fault.span.start..start + end);
    let Fault { message, hint, .. } = fault;
    document.error(&place, ReadFault::Expression(ExpressionFault { message, hint }))
}
