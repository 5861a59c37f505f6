//! Typed access to the keys of one table.

use crate::keys::{self, KeyTable, KeyValue};
use crate::read::ReadFault;
pub(crate) use crate::read::error::Read;
use crate::read::names::Names;
use crate::read::point;
use crate::read::texts::Texts;
use crate::read::tree::{self, Item, Member, Node, Span};
use crate::read::values::Values;
use mbs_core::scene::{BallAngle, BodyId, Dimension, Freedom, Joint, JointId, Number, SignalId};

/// Context that the readers of all entries have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context<'a> {
    pub(crate) texts: &'a Texts,
    pub(crate) dimension: Dimension,
    pub(crate) bodies: &'a Names,
    pub(crate) joints: &'a Names,
    pub(crate) signals: &'a Names,
    pub(crate) frames: Frames<'a>,
    pub(crate) values: &'a Values<'a>,
    /// Key and unit of the numbers that are read. `None` if a number may have any unit.
    pub(crate) unit: Option<KeyUnit>,
    /// True if the coordinate of this table is a translation. `None` if the coordinate is not known.
    pub(crate) is_slide: Option<bool>,
}

/// A key, with the unit of its numbers.
pub(crate) type KeyUnit = (&'static str, &'static str);

/// The frames of a file, with their names.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frames<'a> {
    pub(crate) names: &'a Names,
    pub(crate) items: &'a [Item],
}

impl<'a> Frames<'a> {
    /// Value of a key of the frame with this name.
    fn value(&self, name: &str, key: &str) -> Option<&'a Item> {
        self.items.get(self.names.place(name)?)?.get(key)
    }
}

/// One table of the file, with the key tables that its keys are checked by.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fields<'a> {
    pub(crate) context: Context<'a>,
    pub(crate) header: &'a Span,
    pub(crate) members: &'a [Member],
    /// Key tables that may apply to this table of the file. One of them is the key table of the entry.
    pub(crate) tables: &'static [KeyTable],
}

impl<'a> Context<'a> {
    /// Context of a file whose tables do not refer to its bodies, joints or signals. `none` is an empty list of names.
    pub(crate) fn of_file(texts: &'a Texts, values: &'a Values<'a>, none: &'a Names) -> Self {
        let (bodies, joints, signals) = (none, none, none);
        let frames = Frames { names: none, items: &[] };
        let (dimension, unit, is_slide) = (Dimension::Planar, None, None);
        Self { texts, dimension, bodies, joints, signals, frames, values, unit, is_slide }
    }

    pub(crate) fn fault<R>(&self, span: &Span, fault: ReadFault) -> Read<R> {
        Err(self.texts.error(span, fault))
    }

    pub(crate) fn is_planar(&self) -> bool {
        self.dimension == Dimension::Planar
    }

    pub(crate) fn wrong_type<R>(&self, item: &Item, expected: &'static str) -> Read<R> {
        let found = item.node.description();
        self.fault(&item.span, ReadFault::WrongType { expected, found })
    }

    /// A table with this header. Keys that are in no table of the header are refused here, unless the allowed keys depend on its kind or
    /// form.
    pub(crate) fn table(
        &self,
        item: &'a Item,
        expected: &'static str,
        header: &str,
    ) -> Read<Fields<'a>> {
        let Node::Table(members) = &item.node else { return self.wrong_type(item, expected) };
        let tables = keys::of(header);
        let context = Context { unit: None, ..*self };
        let fields = Fields { context, header: &item.span, members, tables };
        if tables.len() == 1 { fields.checked() } else { Ok(fields) }
    }

    pub(crate) fn list(&self, item: &'a Item, expected: &'static str) -> Read<&'a [Item]> {
        match &item.node {
            Node::List(items) => Ok(items),
            _ => self.wrong_type(item, expected),
        }
    }

    /// A list with at least one entry.
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

    /// A vector of the scene's dimension, given by its components or as the vector from one place to another. In a planar scene, the check of
    /// the scene refuses a third component, not this function.
    pub(crate) fn vector(&self, item: &'a Item) -> Read<[Number; 3]> {
        if !matches!(item.node, Node::Table(_)) {
            let items = self.list(item, "a list of numbers")?;
            return self.components(item, items);
        }
        let form = "a list of numbers, or a table: { from = \"point\", to = \"point\" }";
        let ends = self.table(item, form, keys::DIRECTION)?;
        let [from, to] = [ends.vector("from")?, ends.vector("to")?];
        point::between(self.texts, [&from, &to], &item.span)
    }

    /// A place of the scene's dimension: numbers, the name of a point, or a place relative to a point.
    pub(crate) fn place(&self, item: &'a Item) -> Read<[Number; 3]> {
        if let Node::List(items) = &item.node {
            return self.components(item, items);
        }
        if matches!(item.node, Node::Table(_)) {
            self.table(item, "a place", keys::PLACE)?;
        }
        let place = self.values.place(item)?;
        let needed = self.dimension.count();
        if place.n == needed || place.n == 3 {
            return Ok(place.at);
        }
        self.fault(&item.span, ReadFault::WrongCount { needed, found: place.n })
    }

    /// A body by its name; the name of a frame is not accepted.
    pub(crate) fn body_alone(&self, item: &'a Item) -> Read<BodyId> {
        let frames = Frames { items: &[], ..self.frames };
        Self { frames, ..*self }.body(item)
    }

    /// A body by its name, or the body of a frame by the frame's name.
    pub(crate) fn body(&self, item: &'a Item) -> Read<BodyId> {
        let name = self.text(item)?;
        if name == "ground" {
            return Ok(BodyId::Ground);
        }
        match self.bodies.place(name) {
            Some(i) => Ok(BodyId::Body(i)),
            None => {
                if let Some(body) = self.frames.value(name, "body") {
                    return self.body_alone(body);
                }
                let mut known = vec!["ground".to_owned()];
                known.extend_from_slice(self.bodies.list());
                let has_frames = !self.frames.items.is_empty();
                known.extend(self.frames.names.list().iter().filter(|_| has_frames).cloned());
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
        debug_assert!(self.is_of_header(key), "`{key}` is in no table of `{}`", self.header_name());
        tree::find(self.members, key)
    }

    pub(crate) fn need(&self, key: &'static str) -> Read<&'a Item> {
        match self.get(key).or_else(|| self.of_frame(key)) {
            Some(item) => Ok(item),
            None => self.context.fault(self.header, ReadFault::Missing { key }),
        }
    }

    /// Returns the value of the frame's key `at`, when `body` names a frame and the entry has no key `at` itself. `None` for every other
    /// `key`.
    pub(crate) fn of_frame(&self, key: &str) -> Option<&'a Item> {
        let body = tree::find(self.members, "body").filter(|_| key == "at")?;
        let Node::Text(name) = &body.node else { return None };
        self.context.frames.value(name, key)
    }

    /// The word of the key `kind`, and the fields with the key tables of that kind. The keys are checked by those tables.
    pub(crate) fn kind(&self) -> Read<(&'a str, Self)> {
        let word = self.word("kind")?;
        let tables = keys::of_kind(self.tables, word.0);
        if !tables.is_empty() {
            return Ok((word.0, self.checked_by(tables)?));
        }
        let mut known: Vec<_> = self.tables.iter().filter_map(|table| table.kind).collect();
        known.dedup();
        self.unknown_word("kind", word, &known)
    }

    /// The fields with these key tables. The keys are checked by them.
    pub(crate) fn checked_by(&self, tables: &'static [KeyTable]) -> Read<Self> {
        Self { tables, ..*self }.checked()
    }

    /// The fields with the key tables that have the key `one`, if it is written. Otherwise the fields with the key tables that have the key
    /// `other`.
    pub(crate) fn by(&self, one: &str, other: &str) -> Read<Self> {
        let key = if self.get(one).is_some() { one } else { other };
        self.checked_by(keys::together(self.tables, |table| table.key(key).is_some()))
    }

    /// Refuses keys that are in none of the key tables. A key of another table with the same header is reported as not used here.
    pub(crate) fn checked(self) -> Read<Self> {
        let is_known = |member: &&Member| self.known().any(|known| known == member.key);
        let Some(stranger) = self.members.iter().find(|member| !is_known(member)) else {
            return Ok(self);
        };
        let key = stranger.key.clone();
        let mut known = Vec::new();
        for key in self.known() {
            if !known.contains(&key) {
                known.push(key);
            }
        }
        let fault = if self.is_of_header(&key) {
            ReadFault::UnusedKey { key, known }
        } else {
            ReadFault::UnknownKey { key, known }
        };
        self.context.fault(&stranger.key_span, fault)
    }

    /// True if a key table of this header has the key, for any kind.
    fn is_of_header(&self, key: &str) -> bool {
        keys::of(self.header_name()).iter().any(|table| table.key(key).is_some())
    }

    fn header_name(&self) -> &'static str {
        self.tables.first().map_or("", |table| table.header)
    }

    /// Names of the keys of all its key tables, in a scene of this dimension.
    fn known(&self) -> impl Iterator<Item = &'static str> {
        let dimension = self.context.dimension;
        self.tables.iter().flat_map(move |table| table.keys_of(dimension).map(|key| key.name))
    }

    /// Refuses keys that have no meaning together with the other keys of the table.
    pub(crate) fn unused(&self, keys: &[&str]) -> Read<()> {
        let unused = self.members.iter().find(|member| keys.contains(&member.key.as_str()));
        let Some(member) = unused else { return Ok(()) };
        let mut known: Vec<_> = self.known().filter(|known| !keys.contains(known)).collect();
        known.dedup();
        let fault = ReadFault::UnusedKey { key: member.key.clone(), known };
        self.context.fault(&member.key_span, fault)
    }

    /// Refuses a table that has both of two keys.
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

    /// The value of `name`, or `KIND-N`, counted from 1, when no name is written.
    pub(crate) fn name_or(&self, kind: &str, index: usize) -> Read<String> {
        match self.get("name") {
            Some(_) => self.name(),
            None => Ok(format!("{kind}-{}", index + 1)),
        }
    }

    pub(crate) fn number(&self, key: &'static str) -> Read<Number> {
        self.at(key).number(self.need(key)?)
    }

    pub(crate) fn optional(&self, key: &str) -> Read<Option<Number>> {
        self.get(key).map(|item| self.at(key).number(item)).transpose()
    }

    pub(crate) fn number_or_zero(&self, key: &str) -> Read<Number> {
        Ok(self.optional(key)?.unwrap_or(Number::ZERO))
    }

    /// The number of a key. When the key is not written, it is the number of the decimal text `default`.
    pub(crate) fn number_or(&self, key: &str, default: &str) -> Read<Number> {
        Ok(self.optional(key)?.or_else(|| Number::from_decimal(default)).unwrap_or(Number::ZERO))
    }

    /// A whole number from 1 to `most`; a fraction of zero is allowed.
    pub(crate) fn count(&self, key: &'static str, most: u32) -> Read<u32> {
        let item = self.need(key)?;
        let Node::Number(text) = &item.node else {
            return self.context.wrong_type(item, "a whole number");
        };
        match counted(text, most) {
            Some(count) => Ok(count),
            None => {
                let fault = ReadFault::NotACount { text: text.clone(), most };
                self.context.fault(&item.span, fault)
            }
        }
    }

    /// A vector, or a place if the key tables have a place at that key.
    pub(crate) fn vector(&self, key: &'static str) -> Read<[Number; 3]> {
        self.vector_or_place(key, self.need(key)?)
    }

    pub(crate) fn optional_vector(&self, key: &str) -> Read<Option<[Number; 3]>> {
        self.get(key).map(|item| self.vector_or_place(key, item)).transpose()
    }

    fn vector_or_place(&self, key: &str, item: &'a Item) -> Read<[Number; 3]> {
        let value = self.tables.iter().find_map(|table| table.key(key)).map(|key| &key.value);
        match value {
            Some(KeyValue::Place | KeyValue::Places(_) | KeyValue::PlacesOrTables(_)) => {
                self.at(key).place(item)
            }
            _ => self.at(key).vector(item),
        }
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

    /// The two bodies of the key `bodies = ["first", "second"]`.
    pub(crate) fn pair(&self) -> Read<[BodyId; 2]> {
        let [first, second] =
            self.context.exactly(self.need("bodies")?, "a list of two body names")?;
        Ok([self.context.body(first)?, self.context.body(second)?])
    }

    /// Two vectors or places, one for each of two bodies.
    pub(crate) fn two_vectors(&self, key: &'static str) -> Read<[[Number; 3]; 2]> {
        let [first, second] = self.context.exactly(self.need(key)?, "a list of two vectors")?;
        Ok([self.vector_or_place(key, first)?, self.vector_or_place(key, second)?])
    }

    /// A coordinate of a joint, by its name or by its number from 0.
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

/// A whole number from 1 to `most`, as `10` or `10.0`. Numbers from code have the second form.
pub(crate) fn counted(text: &str, most: u32) -> Option<u32> {
    let whole = text.strip_suffix(".0").unwrap_or(text);
    whole.parse().ok().filter(|n| (1..=most).contains(n))
}
