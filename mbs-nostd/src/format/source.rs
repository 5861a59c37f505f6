//! Writer of Rust expressions: structs, tuples and the entries of laws.

use super::Record;
use alloc::string::String;
use mbs_core::Real;
use mbs_core::laws::entry::EntryWriter;

/// Begins an expression of a struct.
pub(crate) fn open(name: &str, to: &mut String) {
    to.push_str(name);
    to.push('\u{1}');
}

/// Begins a field: a named field, or a position of a tuple.
pub(crate) fn name(field: &str, to: &mut String) {
    let is_tuple = field.starts_with(|c: char| c.is_ascii_digit());
    let opens = to.ends_with('\u{1}');
    if opens {
        to.pop();
    }
    match (opens, is_tuple) {
        (true, true) => to.push_str("(\u{2}"),
        (true, false) => to.push_str(" { \u{3}"),
        (false, _) => to.push_str(", "),
    }
    if !is_tuple {
        to.push_str(field);
        to.push_str(": ");
    }
}

/// Ends an expression of a struct.
pub(crate) fn close(to: &mut String) {
    if to.ends_with('\u{1}') {
        to.pop();
        return;
    }
    // The mark of the innermost open expression determines how it is closed.
    let tuple = to.rfind('\u{2}');
    let named = to.rfind('\u{3}');
    let (at, end) = if tuple > named { (tuple, ")") } else { (named, " }") };
    if let Some(at) = at {
        to.remove(at);
        to.push_str(end);
    }
}

/// Rust expression that is being written.
#[derive(Debug)]
pub(crate) struct Source<'a>(pub(crate) &'a mut String);

impl<T: Real + Record> EntryWriter<T> for Source<'_> {
    fn real(&mut self, x: T) {
        x.source(self.0);
    }
    fn word(&mut self, x: u32) {
        x.source(self.0);
    }
    fn flag(&mut self, x: bool) {
        x.source(self.0);
    }
    fn tag(&mut self, _: u32) {}
    fn none(&mut self) {
        self.0.push_str("None");
    }
    fn some(&mut self) {
        self.0.push_str("Some(");
    }
    fn open(&mut self, of: &'static str) {
        open(of, self.0);
    }
    fn field(&mut self, of: &'static str) {
        name(of, self.0);
    }
    fn close(&mut self) {
        close(self.0);
    }
    fn text(&mut self, text: &'static str) {
        self.0.push_str(text);
    }
}
