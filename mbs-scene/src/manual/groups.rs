//! Key tables, in the order of the manual.

use crate::keys::{KeyTable, tables};

/// The key tables of the entries of a scene or a sweep, in groups. Tables with one header form a group. Tables of a whole file are left out.
pub fn groups() -> Vec<&'static [KeyTable]> {
    let mut groups = Vec::new();
    let mut rest = tables();
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

/// Returns the tables of a group, with the tables of one kind together.
pub fn entries(group: &'static [KeyTable]) -> Vec<&'static [KeyTable]> {
    let mut entries: Vec<&'static [KeyTable]> = Vec::new();
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

/// The first sentence of a text, with its full stop.
pub(super) fn first_sentence(text: &str) -> &str {
    text.find(". ").map_or(text, |end| &text[..=end])
}
