//! The values of the names in a file, parameters and points, for expressions and places.

use super::ReadFault;
use super::error::{ExpressionFault, Read};
use super::expression;
use super::expression::unit::{self, Dimensions};
use super::named::Named;
use super::number::rounded;
use super::point::{self, Point};
use super::texts::Texts;
use super::tree::{self, Item, Member, Node, Span};
use mbs_core::scene::Number;

/// Words that some keys allow in place of a number.
const WORDS: [&str; 1] = ["reference"];

/// The parameters and points of a scene, with their values.
pub(crate) struct Values<'a>(Named<'a>);

impl core::fmt::Debug for Values<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("Values")
    }
}

impl<'a> Values<'a> {
    /// Returns an empty set of names.
    pub(crate) fn none(texts: &'a Texts) -> Self {
        Self(Named::new(texts, &[], &[]))
    }

    /// Returns the values of the names in a tree; each is evaluated once.
    pub(crate) fn new(texts: &'a Texts, root: &'a [Member]) -> Read<Self> {
        let parameters = match tree::find(root, "parameters") {
            None => &[],
            Some(Item { node: Node::Table(members), .. }) => &members[..],
            Some(item) => {
                let found = item.node.description();
                let expected =
                    "a table: [parameters], with a number or an expression for each name";
                return Err(texts.error(&item.span, ReadFault::WrongType { expected, found }));
            }
        };
        for member in parameters {
            check_name(texts, member)?;
        }
        let points = match tree::find(root, "point") {
            Some(Item { node: Node::List(items), .. }) => &items[..],
            _ => &[],
        };
        let named = Named::new(texts, parameters, points);
        Ok(Self(named.all(parameters, points)?))
    }

    /// The number of an expression. A text that is only a number with a unit also has its dimensions.
    pub(crate) fn number(&self, text: &str, span: &Span) -> Read<(Number, Option<Dimensions>)> {
        let (value, dimensions) = self.0.expression(text, span)?;
        Ok((rounded(self.0.texts, value, (text, span))?, dimensions))
    }

    /// The parameters of the scene's file itself that no expression has used so far.
    pub(crate) fn unused(&self) -> Vec<String> {
        self.0.unused()
    }

    /// The place that an item describes.
    pub(super) fn place(&self, item: &Item) -> Read<Point> {
        point::read(&self.0, item)
    }
}

/// Refuses the name of a parameter that expressions reserve, or that they cannot contain.
fn check_name(texts: &Texts, member: &Member) -> Read<()> {
    let full = member.key.as_str();
    let name = full.strip_prefix(&texts.of(&member.key_span).prefix).unwrap_or(full);
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
    Err(texts.error(&member.key_span, fault))
}
