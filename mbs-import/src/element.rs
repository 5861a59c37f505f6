//! Elements of a file, which record whether they were read.
//!
//! A reader asks for attributes and children by name. An element or attribute that no reader asked for has no counterpart in the scene. A
//! walk at the end reports all of them (`unread.rs`), so that nothing is dropped silently.

use crate::source::{Fault, Origin, Read};
use std::cell::Cell;

/// An element of a file.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    /// Name of the element, with its namespace prefix in the file.
    pub(crate) name: String,
    pub(crate) at: Origin,
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) children: Vec<Self>,
    /// Text between the child elements.
    pub(crate) text: String,
    is_read: Cell<bool>,
}

/// An attribute of an element.
#[derive(Debug, Clone)]
pub(crate) struct Attribute {
    pub(crate) name: String,
    pub(crate) value: String,
    pub(crate) at: Origin,
    is_read: Cell<bool>,
}

impl Attribute {
    pub(crate) const fn new(name: String, value: String, at: Origin) -> Self {
        Self { name, value, at, is_read: Cell::new(false) }
    }

    pub(crate) fn is_read(&self) -> bool {
        self.is_read.get()
    }

    /// The error of an attribute's value, at its place.
    pub(crate) fn fault(&self, message: impl Into<String>, hint: impl Into<String>) -> Fault {
        Fault::new(self.at, message, hint)
    }

    /// All numbers of the value, in order.
    pub(crate) fn list(&self) -> Read<Vec<f64>> {
        self.value.split_ascii_whitespace().map(|word| self.word(word)).collect()
    }

    /// Overwrites the first numbers of `all` with those of the value, which has at most as many.
    pub(crate) fn merge(&self, all: &mut [f64]) -> Read<()> {
        let list = self.list()?;
        if list.len() > all.len() {
            let message = format!("`{}` has {} numbers", self.name, list.len());
            return Err(self.fault(message, format!("write {} numbers at most", all.len())));
        }
        all.iter_mut().zip(list).for_each(|(own, written)| *own = written);
        Ok(())
    }

    /// The value as exactly `N` numbers.
    pub(crate) fn numbers<const N: usize>(&self) -> Read<[f64; N]> {
        let list = self.list()?;
        let n = list.len();
        list.try_into().map_err(|_| {
            let wanted = if N == 1 { "one number".to_owned() } else { format!("{N} numbers") };
            self.fault(
                format!("`{}` has {n} numbers", self.name),
                format!("write {wanted}, with blanks between them"),
            )
        })
    }

    /// The value as a single number.
    pub(crate) fn number(&self) -> Read<f64> {
        self.numbers::<1>().map(|[x]| x)
    }

    /// The value as a Boolean: `true`, `1`, `false` or `0`.
    pub(crate) fn flag(&self) -> Read<bool> {
        match self.value.trim().to_ascii_lowercase().as_str() {
            "true" | "1" => Ok(true),
            "false" | "0" => Ok(false),
            other => {
                Err(self.fault(format!("`{}` is `{other}`", self.name), "write `true` or `false`"))
            }
        }
    }

    fn word(&self, word: &str) -> Read<f64> {
        let is_plain = word.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        match word.parse::<f64>() {
            Ok(x) if x.is_finite() && is_plain => Ok(x),
            _ => Err(self.fault(
                format!("`{word}` in `{}` is not a finite number", self.name),
                "write decimal numbers with a point, as 0.25 or 1e-3, with blanks between them",
            )),
        }
    }
}

impl Element {
    pub(crate) const fn new(name: String, at: Origin, attributes: Vec<Attribute>) -> Self {
        Self {
            name,
            at,
            attributes,
            children: Vec::new(),
            text: String::new(),
            is_read: Cell::new(false),
        }
    }

    pub(crate) fn is_read(&self) -> bool {
        self.is_read.get()
    }

    /// Marks the element as read, and returns it.
    pub(crate) fn read(&self) -> &Self {
        self.is_read.set(true);
        self
    }

    /// Marks the element and everything in it as read, because another finding reports them.
    pub(crate) fn read_whole(&self) {
        let mut rest = vec![self];
        while let Some(element) = rest.pop() {
            element.is_read.set(true);
            element.attributes.iter().for_each(|attribute| attribute.is_read.set(true));
            rest.extend(&element.children);
        }
    }

    /// An attribute of the element, if it exists; it then counts as read.
    pub(crate) fn attribute(&self, name: &str) -> Option<&Attribute> {
        let found = self.attributes.iter().find(|attribute| attribute.name == name)?;
        found.is_read.set(true);
        Some(found)
    }

    /// The value of an attribute without surrounding blanks, if it exists.
    pub(crate) fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|attribute| attribute.value.trim())
    }

    /// An attribute that must exist; otherwise an error.
    pub(crate) fn need(&self, name: &str) -> Read<&Attribute> {
        self.attribute(name).ok_or_else(|| {
            self.fault(format!("`{}` has no `{name}`", self.name), format!("write {name}=\"...\""))
        })
    }

    /// The number of an attribute, or `default` when the attribute does not exist.
    pub(crate) fn number_or(&self, name: &str, default: f64) -> Read<f64> {
        self.attribute(name).map_or(Ok(default), Attribute::number)
    }

    /// The numbers of an attribute, or `default` when the attribute does not exist.
    pub(crate) fn numbers_or<const N: usize>(
        &self,
        name: &str,
        default: [f64; N],
    ) -> Read<[f64; N]> {
        self.attribute(name).map_or(Ok(default), Attribute::numbers)
    }

    /// The first child of this name, if it exists; it then counts as read.
    pub(crate) fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name).map(Self::read)
    }

    /// All children of this name. Each counts as read when the iteration reaches it.
    pub(crate) fn each<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.name == name).map(Self::read)
    }

    /// The error of an element, at its place.
    pub(crate) fn fault(&self, message: impl Into<String>, hint: impl Into<String>) -> Fault {
        Fault::new(self.at, message, hint)
    }

    /// The text in the element, in the form of an attribute.
    pub(crate) fn content(&self) -> Attribute {
        Attribute::new(self.name.clone(), self.text.trim().to_owned(), self.at)
    }

    /// Name of the element in findings: `joint[elbow]`.
    pub(crate) fn label(&self) -> String {
        let name = self.attributes.iter().find(|attribute| attribute.name == "name");
        match name {
            Some(name) => format!("{}[{}]", self.name, name.value),
            None => self.name.clone(),
        }
    }
}
