//! Elements of a file, which know what was read of them.
//!
//! A reader asks for attributes and children by name; what it never asked for is what the model is not given. So nothing is lost unsaid: a walk
//! at the end finds all that (`unread.rs`).

use crate::source::{Fault, Origin, Read};
use std::cell::Cell;

/// An element of a file.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    /// Name of the element, with the prefix that the file gives it.
    pub(crate) name: String,
    pub(crate) at: Origin,
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) children: Vec<Self>,
    /// The text between its children.
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

    /// A refusal of its value.
    pub(crate) fn fault(&self, message: impl Into<String>, hint: impl Into<String>) -> Fault {
        Fault::new(self.at, message, hint)
    }

    /// Numbers of the value, as many as there are.
    pub(crate) fn list(&self) -> Read<Vec<f64>> {
        self.value.split_ascii_whitespace().map(|word| self.word(word)).collect()
    }

    /// Takes over as many numbers as are written, at most `all` of them.
    pub(crate) fn merge(&self, all: &mut [f64]) -> Read<()> {
        let list = self.list()?;
        if list.len() > all.len() {
            let message = format!("`{}` has {} numbers", self.name, list.len());
            return Err(self.fault(message, format!("write {} numbers at most", all.len())));
        }
        all.iter_mut().zip(list).for_each(|(own, written)| *own = written);
        Ok(())
    }

    /// Exactly `N` numbers of the value.
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

    /// The one number of the value.
    pub(crate) fn number(&self) -> Read<f64> {
        self.numbers::<1>().map(|[x]| x)
    }

    /// Is the value true?
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

    /// Marks the element and all below it as read: something else said what becomes of it.
    pub(crate) fn read_whole(&self) {
        let mut rest = vec![self];
        while let Some(element) = rest.pop() {
            element.is_read.set(true);
            element.attributes.iter().for_each(|attribute| attribute.is_read.set(true));
            rest.extend(&element.children);
        }
    }

    /// An attribute that is there, which is read from here on.
    pub(crate) fn attribute(&self, name: &str) -> Option<&Attribute> {
        let found = self.attributes.iter().find(|attribute| attribute.name == name)?;
        found.is_read.set(true);
        Some(found)
    }

    /// The value of an attribute, without blanks around it.
    pub(crate) fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|attribute| attribute.value.trim())
    }

    /// An attribute that must be there.
    pub(crate) fn need(&self, name: &str) -> Read<&Attribute> {
        self.attribute(name).ok_or_else(|| {
            self.fault(format!("`{}` has no `{name}`", self.name), format!("write {name}=\"...\""))
        })
    }

    /// A number, or what stands for it.
    pub(crate) fn number_or(&self, name: &str, default: f64) -> Read<f64> {
        self.attribute(name).map_or(Ok(default), Attribute::number)
    }

    /// Some numbers, or what stands for them.
    pub(crate) fn numbers_or<const N: usize>(
        &self,
        name: &str,
        default: [f64; N],
    ) -> Read<[f64; N]> {
        self.attribute(name).map_or(Ok(default), Attribute::numbers)
    }

    /// The first child of a name; it is read from here on.
    pub(crate) fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name).map(Self::read)
    }

    /// The children of a name; each is read from when it is reached.
    pub(crate) fn each<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.name == name).map(Self::read)
    }

    /// A refusal of it.
    pub(crate) fn fault(&self, message: impl Into<String>, hint: impl Into<String>) -> Fault {
        Fault::new(self.at, message, hint)
    }

    /// The text in it, as if it were an attribute.
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
