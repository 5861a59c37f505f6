//! The manual of scene files, written from the tables of their keys: lists and pages for a terminal, Markdown, and a schema.

mod markdown;
mod page;
mod schema;
#[cfg(test)]
mod tests;

pub use markdown::markdown;
pub use page::{list, page};
pub use schema::schema;

use crate::keys::{TABLES, Table};

/// The tables that stand in files, apart from the files themselves, each header's together.
fn groups() -> Vec<&'static [Table]> {
    let mut groups = Vec::new();
    let mut rest = &TABLES[..];
    while let Some(first) = rest.first() {
        let n = rest.iter().take_while(|table| table.header == first.header).count();
        let (group, after) = rest.split_at(n);
        rest = after;
        if ![crate::keys::FILE, crate::keys::SWEEP_FILE].contains(&first.header) {
            groups.push(group);
        }
    }
    groups
}

/// The same tables, those of one kind together.
fn entries(group: &'static [Table]) -> Vec<&'static [Table]> {
    let mut entries: Vec<&'static [Table]> = Vec::new();
    let mut rest = group;
    while let Some(first) = rest.first() {
        let n = match first.kind {
            Some(kind) => rest.iter().take_while(|table| table.kind == Some(kind)).count(),
            None => 1,
        };
        let (entry, after) = rest.split_at(n);
        entries.push(entry);
        rest = after;
    }
    entries
}

/// The first sentence of a text.
fn first_sentence(text: &str) -> &str {
    text.find(". ").map_or(text, |end| &text[..=end])
}
