//! Typed access to the keys of one table.

use crate::read::names::Names;
use crate::read::tree::{Item, Member, Node, Span};
use crate::read::{ReadError, ReadFault, SceneFile};
use mbs_core::scene::{BallAngle, BodyId, Dimension, Freedom, Joint, JointId, Number, SignalId};

/// What the readers of all entries share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context<'a> {
    pub(crate) document: &'a SceneFile,
    pub(crate) dimension: Dimension,
    pub(crate) bodies: &'a Names,
    pub(crate) joints: &'a Names,
    pub(crate) signals: &'a Names,
}

/// One table of the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fields<'a> {
    pub(crate) context: Context<'a>,
    pub(crate) header: &'a Span,
    pub(crate) members: &'a [Member],
}

pub(crate) type Read<T> = Result<T, ReadError>;

impl<'a> Context<'a> {
    pub(crate) fn fault<R>(&self, span: &Span, fault: ReadFault) -> Read<R> {
        Err(self.document.error(span, fault))
    }

    pub(crate) fn is_planar(&self) -> bool {
        self.dimension == Dimension::Planar
    }

    fn wrong_type<R>(&self, item: &Item, expected: &'static str) -> Read<R> {
        let found = item.node.description();
        self.fault(&item.span, ReadFault::WrongType { expected, found })
    }

    pub(crate) fn table(&self, item: &'a Item, expected: &'static str) -> Read<Fields<'a>> {
        match &item.node {
            Node::Table(members) => Ok(Fields { context: *self, header: &item.span, members }),
            _ => self.wrong_type(item, expected),
        }
    }

    pub(crate) fn list(&self, item: &'a Item, expected: &'static str) -> Read<&'a [Item]> {
        match &item.node {
            Node::List(items) => Ok(items),
            _ => self.wrong_type(item, expected),
        }
    }

    /// A list that is not empty.
    pub(crate) fn filled_list(&self, item: &'a Item, expected: &'static str) -> Read<&'a [Item]> {
        let items = self.list(item, expected)?;
        if items.is_empty() {
            let found = "an empty one";
            return self.fault(&item.span, ReadFault::WrongType { expected, found });
        }
        Ok(items)
    }

    /// A list of exactly `N` entries.
    pub(crate) fn exactly<const N: usize>(
        &self,
        item: &'a Item,
        expected: &'static str,
    ) -> Read<&'a [Item; N]> {
        let items = self.list(item, expected)?;
        match items.try_into() {
            Ok(items) => Ok(items),
            Err(_) => {
                self.fault(&item.span, ReadFault::WrongCount { needed: N, found: items.len() })
            }
        }
    }

    pub(crate) fn text(&self, item: &'a Item) -> Read<&'a str> {
        match &item.node {
            Node::Text(text) => Ok(text),
            _ => self.wrong_type(item, "a text in quotes"),
        }
    }

    /// The nearest number to the decimal text; finite.
    pub(crate) fn number(&self, item: &Item) -> Read<Number> {
        let text = match &item.node {
            Node::Number(text) => text,
            Node::Text(text) => {
                return self.fault(&item.span, ReadFault::NumberInText { text: text.clone() });
            }
            _ => return self.wrong_type(item, "a number"),
        };
        match Number::from_decimal(text) {
            Some(number) if number.to_f64().is_finite() => Ok(number),
            _ => self.fault(&item.span, ReadFault::NotFinite { text: text.clone() }),
        }
    }

    /// One number or a list of numbers.
    pub(crate) fn numbers(&self, item: &'a Item) -> Read<Vec<Number>> {
        match &item.node {
            Node::Number(_) | Node::Text(_) => Ok(vec![self.number(item)?]),
            Node::List(items) => items.iter().map(|entry| self.number(entry)).collect(),
            _ => self.wrong_type(item, "a number or a list of numbers"),
        }
    }

    /// Exactly `N` numbers.
    pub(crate) fn numbers_of<const N: usize>(
        &self,
        item: &'a Item,
        expected: &'static str,
    ) -> Read<[Number; N]> {
        let mut numbers = [const { Number::ZERO }; N];
        for (number, item) in numbers.iter_mut().zip(self.exactly::<N>(item, expected)?) {
            *number = self.number(item)?;
        }
        Ok(numbers)
    }

    /// A vector of the scene's dimension; a third component in a planar scene is left to the check.
    pub(crate) fn vector(&self, item: &'a Item) -> Read<[Number; 3]> {
        let items = self.list(item, "a list of numbers")?;
        self.components(item, items)
    }

    /// The components of a vector that stand in `items`, a part of `whole`.
    pub(crate) fn components(&self, whole: &Item, items: &[Item]) -> Read<[Number; 3]> {
        let needed = self.dimension.count();
        if items.len() != needed && items.len() != 3 {
            return self.fault(&whole.span, ReadFault::WrongCount { needed, found: items.len() });
        }
        let mut vector = [const { Number::ZERO }; 3];
        for (component, item) in vector.iter_mut().zip(items) {
            *component = self.number(item)?;
        }
        Ok(vector)
    }

    pub(crate) fn body(&self, item: &'a Item) -> Read<BodyId> {
        let name = self.text(item)?;
        if name == "ground" {
            return Ok(BodyId::Ground);
        }
        match self.bodies.place(name) {
            Some(i) => Ok(BodyId::Body(i)),
            None => {
                let mut known = vec!["ground".to_owned()];
                known.extend_from_slice(self.bodies.list());
                self.fault(&item.span, ReadFault::UnknownBody { name: name.to_owned(), known })
            }
        }
    }

    pub(crate) fn moving_body(&self, item: &'a Item) -> Read<BodyId> {
        match self.body(item)? {
            body @ BodyId::Body(_) => Ok(body),
            BodyId::Ground => self.fault(&item.span, ReadFault::GroundDoesNotMove),
        }
    }

    pub(crate) fn joint(&self, item: &'a Item) -> Read<JointId> {
        let name = self.text(item)?;
        match self.joints.place(name) {
            Some(i) => Ok(JointId::new(i)),
            None => {
                let (name, known) = (name.to_owned(), self.joints.list().to_vec());
                self.fault(&item.span, ReadFault::UnknownJoint { name, known })
            }
        }
    }

    pub(crate) fn signal(&self, item: &'a Item) -> Read<SignalId> {
        let name = self.text(item)?;
        match self.signals.place(name) {
            Some(i) => Ok(SignalId::new(i)),
            None => {
                let (name, known) = (name.to_owned(), self.signals.list().to_vec());
                self.fault(&item.span, ReadFault::UnknownSignal { name, known })
            }
        }
    }
}

impl<'a> Fields<'a> {
    pub(crate) fn get(&self, key: &str) -> Option<&'a Item> {
        self.members.iter().find(|member| member.key == key).map(|member| &member.item)
    }

    pub(crate) fn need(&self, key: &'static str) -> Read<&'a Item> {
        match self.get(key) {
            Some(item) => Ok(item),
            None => self.context.fault(self.header, ReadFault::Missing { key }),
        }
    }

    /// Refuses keys outside `known`; those in `elsewhere` are reported as known but not used here.
    pub(crate) fn allow(&self, known: &[&'static str], elsewhere: &[&'static str]) -> Read<()> {
        let Some(stranger) = self.members.iter().find(|m| !known.contains(&m.key.as_str())) else {
            return Ok(());
        };
        let (key, known) = (stranger.key.clone(), known.to_vec());
        let fault = if elsewhere.contains(&stranger.key.as_str()) {
            ReadFault::UnusedKey { key, known }
        } else {
            ReadFault::UnknownKey { key, known }
        };
        self.context.fault(&stranger.key_span, fault)
    }

    /// At most one of two keys.
    pub(crate) fn exclusive(&self, one: &'static str, other: &'static str) -> Read<()> {
        match (self.get(one), self.get(other)) {
            (Some(_), Some(item)) => {
                self.context.fault(&item.span, ReadFault::Both { keys: [one, other] })
            }
            _ => Ok(()),
        }
    }

    pub(crate) fn name(&self) -> Read<String> {
        Ok(self.context.text(self.need("name")?)?.to_owned())
    }

    /// The name, or `KIND-N`, counted from 1, where none is written.
    pub(crate) fn name_or(&self, kind: &str, index: usize) -> Read<String> {
        match self.get("name") {
            Some(_) => self.name(),
            None => Ok(format!("{kind}-{}", index + 1)),
        }
    }

    pub(crate) fn number(&self, key: &'static str) -> Read<Number> {
        self.context.number(self.need(key)?)
    }

    pub(crate) fn optional(&self, key: &str) -> Read<Option<Number>> {
        self.get(key).map(|item| self.context.number(item)).transpose()
    }

    pub(crate) fn number_or_zero(&self, key: &str) -> Read<Number> {
        Ok(self.optional(key)?.unwrap_or(Number::ZERO))
    }

    /// The number of a key, or the nearest one to a decimal text.
    pub(crate) fn number_or(&self, key: &str, default: &str) -> Read<Number> {
        Ok(self.optional(key)?.or_else(|| Number::from_decimal(default)).unwrap_or(Number::ZERO))
    }

    /// A whole number from 1 to `most`.
    pub(crate) fn count(&self, key: &'static str, most: u32) -> Read<u32> {
        let item = self.need(key)?;
        let Node::Number(text) = &item.node else {
            return self.context.wrong_type(item, "a whole number");
        };
        match text.parse() {
            Ok(count) if (1..=most).contains(&count) => Ok(count),
            _ => {
                let fault = ReadFault::NotACount { text: text.clone(), most };
                self.context.fault(&item.span, fault)
            }
        }
    }

    pub(crate) fn vector(&self, key: &'static str) -> Read<[Number; 3]> {
        self.context.vector(self.need(key)?)
    }

    pub(crate) fn word(&self, key: &'static str) -> Read<(&'a str, &'a Span)> {
        let item = self.need(key)?;
        Ok((self.context.text(item)?, &item.span))
    }

    pub(crate) fn flag(&self, key: &str, default: bool) -> Read<bool> {
        match self.get(key) {
            None => Ok(default),
            Some(Item { node: Node::Bool(flag), .. }) => Ok(*flag),
            Some(item) => self.context.wrong_type(item, "true or false"),
        }
    }

    /// `bodies = ["first", "second"]`.
    pub(crate) fn pair(&self) -> Read<[BodyId; 2]> {
        let [first, second] =
            self.context.exactly(self.need("bodies")?, "a list of two body names")?;
        Ok([self.context.body(first)?, self.context.body(second)?])
    }

    /// Two vectors, one per body.
    pub(crate) fn two_vectors(&self, key: &'static str) -> Read<[[Number; 3]; 2]> {
        let [first, second] = self.context.exactly(self.need(key)?, "a list of two vectors")?;
        Ok([self.context.vector(first)?, self.context.vector(second)?])
    }

    /// A coordinate of a joint, by its name or its number from 0.
    pub(crate) fn coordinate(&self, item: &Item, joint: &Joint<Number>) -> Read<usize> {
        let names = || joint.kind.coordinate_names(self.context.dimension);
        let number = match &item.node {
            Node::Number(text) => text.parse().ok(),
            Node::Text(name) => match names().find(|(_, known)| known == name) {
                Some((number, _)) => Some(number),
                None => {
                    let has_ball =
                        joint.kind.freedoms(self.context.dimension).contains(&Freedom::Ball);
                    let angles = BallAngle::ALL.map(BallAngle::name).into_iter();
                    let angles = angles.filter(|angle| has_ball && angle != name);
                    let known: Vec<_> = names().map(|(_, name)| name).chain(angles).collect();
                    return self.unknown_word("coordinate", (name, &item.span), &known);
                }
            },
            _ => None,
        };
        match number {
            Some(number) => Ok(number),
            None => self.context.wrong_type(item, "a coordinate's name, or its number from 0"),
        }
    }

    pub(crate) fn unknown_word<R>(
        &self,
        key: &'static str,
        (found, span): (&str, &Span),
        known: &[&'static str],
    ) -> Read<R> {
        let fault = ReadFault::UnknownWord { key, found: found.to_owned(), known: known.to_vec() };
        self.context.fault(span, fault)
    }
}
