//! The syntax tree as TOML text.

use crate::read::tree::{Item, Member, Node};
use core::fmt::Write;

/// Largest number of rows of a list of lists on one line [-]. A longer list gets a line for each row.
const ROWS_ON_A_LINE: usize = 3;

/// The text of a whole file, with each table and each entry of a list of tables under its header.
pub(crate) fn text(root: &[Member]) -> String {
    let mut out = String::new();
    for Member { key, item, .. } in root {
        match &item.node {
            Node::Table(members) => table(&mut out, &format!("[{}]", bare(key)), members),
            Node::List(items) => {
                for item in items {
                    let Node::Table(members) = &item.node else { continue };
                    table(&mut out, &format!("[[{}]]", bare(key)), members);
                }
            }
            _ => {}
        }
    }
    out
}

/// Writes a header and its keys, after an empty line when the text is not empty.
pub(crate) fn table(out: &mut String, header: &str, members: &[Member]) {
    if !out.is_empty() {
        out.push('\n');
    }
    out.push_str(header);
    out.push('\n');
    for Member { key, item, .. } in members {
        // Writing into a String does not fail.
        let _ = writeln!(out, "{} = {}", bare(key), value(item));
    }
}

/// The text of a value: on one line, or with a line for each row of a long list.
pub(crate) fn value(item: &Item) -> String {
    match &item.node {
        Node::Text(text) => quoted(text),
        Node::Number(text) => text.clone(),
        Node::Bool(flag) => flag.to_string(),
        // No key of a scene is a date, so the text is not used.
        Node::Date => quoted(""),
        Node::List(items) => {
            let is_long = items.len() > ROWS_ON_A_LINE
                && items.iter().all(|item| matches!(item.node, Node::List(_) | Node::Table(_)));
            let rows: Vec<String> = items.iter().map(value).collect();
            if is_long { format!("[\n    {},\n]", rows.join(",\n    ")) } else { list(&rows) }
        }
        Node::Table(members) => {
            let members = members.iter().map(|m| format!("{} = {}", bare(&m.key), value(&m.item)));
            format!("{{ {} }}", members.collect::<Vec<_>>().join(", "))
        }
    }
}

/// The text of a list of values, in brackets.
pub(crate) fn list(values: &[String]) -> String {
    format!("[{}]", values.join(", "))
}

/// A key, in quotes when it has characters that TOML does not allow without quotes.
fn bare(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    if !key.is_empty() && key.chars().all(is_bare) { key.to_owned() } else { quoted(key) }
}

/// A text in quotes, with the escapes of TOML.
#[must_use]
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out + "\""
}
