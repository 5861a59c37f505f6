//! Numbers of a key. The dimensions of a number with a unit are compared with those of the key's unit.

use crate::read::ReadFault;
use crate::read::fields::{Context, Fields, Read};
use crate::read::number::check_unit;
use crate::read::tree::{Item, Node};
use mbs_core::scene::{JointKind, Number};

impl<'a> Fields<'a> {
    /// The context for the numbers of this key.
    pub(crate) fn at(&self, key: &str) -> Context<'a> {
        let known = self.tables.iter().find_map(|table| table.key(key));
        Context { unit: known.map(|key| (key.name, key.unit)), ..self.context }
    }

    /// Reads exactly `N` numbers of this key.
    pub(crate) fn numbers_of<const N: usize>(
        &self,
        key: &'static str,
        expected: &'static str,
    ) -> Read<[Number; N]> {
        self.at(key).numbers_of(self.need(key)?, expected)
    }

    /// The fields of an entry that refers to a coordinate of a joint.
    pub(crate) fn about(&self, kind: JointKind, number: usize) -> Self {
        Self { context: self.context.about(kind, number), ..*self }
    }
}

impl<'a> Context<'a> {
    /// Context for a coordinate of a kind of joint. A unit `rad or m` then means the unit of that coordinate.
    pub(crate) fn about(&self, kind: JointKind, number: usize) -> Self {
        let freedoms = kind.freedoms(self.dimension);
        let mut units =
            freedoms.iter().flat_map(|x| core::iter::repeat_n(x.unit(), x.n_coordinates()));
        Self { is_slide: units.nth(number).map(|unit| unit == "m"), ..*self }
    }

    /// Context for numbers of another key, with its unit.
    pub(crate) fn of_unit(&self, key: &'static str, unit: &'static str) -> Self {
        Self { unit: Some((key, unit)), ..*self }
    }

    /// Context for entry `i` of `n`, when the unit of a list names the units of its parts: `N/m and N m/rad`.
    pub(crate) fn entry(&self, i: usize, n: usize) -> Self {
        let Some((key, unit)) = self.unit else { return *self };
        let parts: Vec<_> = unit.split(", ").flat_map(|part| part.split(" and ")).collect();
        self.of_unit(key, parts.get(i * parts.len() / n.max(1)).copied().unwrap_or(unit))
    }

    /// The number of an expression. A unit `rad or m` is that of a rotation or of a translation, in this order.
    fn in_unit(&self, text: &str, item: &Item) -> Read<Number> {
        let (number, dimensions) = self.values.number(text, &item.span)?;
        if let Some((key, unit)) = self.unit {
            let unit = match (self.is_slide, unit.split_once(" or ")) {
                (Some(true), Some((_, slide))) => slide,
                (Some(false), Some((turn, _))) => turn,
                _ => unit,
            };
            check_unit(self.texts, (text, &item.span), dimensions, (key, unit))?;
        }
        Ok(number)
    }

    /// The nearest number to a decimal text or expression, which must be finite.
    pub(crate) fn number(&self, item: &Item) -> Read<Number> {
        let text = match &item.node {
            Node::Number(text) => text,
            Node::Text(text) => return self.in_unit(text, item),
            _ => return self.wrong_type(item, "a number"),
        };
        match Number::from_decimal(text) {
            Some(number) if number.to_f64().is_finite() => Ok(number),
            _ => self.fault(&item.span, ReadFault::NotFinite { text: text.clone() }),
        }
    }

    /// Reads one number or a list of numbers.
    pub(crate) fn numbers(&self, item: &'a Item) -> Read<Vec<Number>> {
        match &item.node {
            Node::Number(_) | Node::Text(_) => Ok(vec![self.number(item)?]),
            Node::List(items) => items.iter().map(|entry| self.number(entry)).collect(),
            _ => self.wrong_type(item, "a number or a list of numbers"),
        }
    }

    /// Reads one number or a list of numbers, for the coordinates of a joint.
    pub(crate) fn coordinates(&self, item: &'a Item, kind: JointKind) -> Read<Vec<Number>> {
        let Node::List(items) = &item.node else { return self.about(kind, 0).numbers(item) };
        let entries = items.iter().enumerate();
        entries.map(|(i, entry)| self.about(kind, i).number(entry)).collect()
    }

    /// Reads exactly `N` numbers.
    pub(crate) fn numbers_of<const N: usize>(
        &self,
        item: &'a Item,
        expected: &'static str,
    ) -> Read<[Number; N]> {
        let mut numbers = [const { Number::ZERO }; N];
        for (i, item) in self.exactly::<N>(item, expected)?.iter().enumerate() {
            numbers[i] = self.entry(i, N).number(item)?;
        }
        Ok(numbers)
    }

    /// The components of a vector from the list `items`; `whole` is the value to which an error refers.
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
}
