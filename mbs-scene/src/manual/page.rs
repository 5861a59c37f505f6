//! Pages of the command `mbs kinds`: the list of tables and kinds, and the page of one.

use super::groups::{entries, first_sentence, groups};
use crate::keys::{Key, KeyTable};
use crate::read::nearest_name;
use mbs_core::scene::Dimension;
use std::fmt::Write;

/// Width of a terminal [characters].
const WIDTH: usize = 100;
/// Width of the column with the names of keys [characters]; the longest name has 19.
const NAMES: usize = 20;

/// A list of all tables and kinds, one line each.
#[must_use]
pub fn list() -> String {
    let mut text = String::new();
    for group in groups() {
        let first = &group[0];
        if group.iter().all(|table| table.kind.is_none()) {
            line(&mut text, &first.title(), first);
            continue;
        }
        let _ = writeln!(text, "{}", first.title());
        kinds(&mut text, group);
    }
    text
}

/// The pages of a table or of a kind. Its name is `joint`, `[[joint]]`, `revolute`, or `effect torque`.
///
/// # Errors
/// A message with the nearest name, when no table or kind has this name.
pub fn page(name: &str) -> Result<String, String> {
    let asked = name.trim().trim_matches(['[', ']']).trim();
    let mut text = String::new();
    let mut names: Vec<String> = Vec::new();
    for group in groups() {
        let header = group[0].header;
        let is_whole = asked == header;
        if is_whole && group.iter().any(|table| table.kind.is_some()) && group.len() > 1 {
            return Ok(overview(group));
        }
        names.push(header.to_owned());
        for entry in entries(group) {
            let kind = entry[0].kind.unwrap_or(header);
            names.push(kind.to_owned());
            let is_meant = kind == asked || asked == format!("{header} {kind}");
            if is_whole || is_meant {
                entry.iter().for_each(|table| of_table(&mut text, table));
            }
        }
    }
    match text.is_empty() {
        true => Err(nearest_name(asked, &names, "tables and kinds")),
        false => Ok(text),
    }
}

/// Adds a line for each kind of a group.
fn kinds(text: &mut String, group: &'static [KeyTable]) {
    for entry in entries(group) {
        line(text, &format!("  {}", entry[0].kind.unwrap_or("several features")), &entry[0]);
    }
}

/// Adds a line with a name and the first sentence of its meaning.
fn line(text: &mut String, name: &str, table: &KeyTable) {
    let column = NAMES + 2;
    let what = if table.law.is_empty() { first_sentence(&table.meaning) } else { table.law };
    wrapped(text, (&format!("{name:<column$}"), column), what);
}

/// A list of the kinds of a table.
fn overview(group: &'static [KeyTable]) -> String {
    let mut text = format!("{}: its kinds\n\n", group[0].title());
    kinds(&mut text, group);
    text + "\n`mbs kinds KIND` has the keys of each.\n"
}

fn of_table(text: &mut String, table: &KeyTable) {
    if !text.is_empty() {
        text.push('\n');
    }
    let kind = table.kind.map(|kind| format!(" kind = \"{kind}\"")).unwrap_or_default();
    let _ = writeln!(text, "{}{kind}", table.title());
    wrapped(text, ("  ", 2), &table.meaning);
    if !table.law.is_empty() {
        wrapped(text, ("  Law:", 2), table.law);
    }
    text.push('\n');
    for key in &table.keys {
        of_key(text, key);
    }
    if let Some(example) = &table.example {
        text.push('\n');
        for line in example.text.lines() {
            let _ = writeln!(text, "    {line}");
        }
    }
}

fn of_key(text: &mut String, key: &Key) {
    let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
    let scenes = match key.dimension {
        None => "",
        Some(Dimension::Planar) => ", in the plane",
        Some(Dimension::Spatial) => ", in space",
    };
    let default = match key.is_needed {
        true => "needed".to_owned(),
        false if key.default.starts_with("needed") => key.default.clone(),
        false => format!("default: {}", key.default),
    };
    let form = key.value.form().replace('`', "");
    let default = default.replace('`', "");
    let name = format!("  {:<NAMES$}", key.name);
    wrapped(text, (&name, NAMES + 2), &format!("{form}{unit}{scenes}; {default}"));
    wrapped(text, (&" ".repeat(NAMES + 2), NAMES + 2), &key.meaning.replace('`', ""));
}

/// Adds a text, broken into lines that fit a terminal.
fn wrapped(text: &mut String, (first, others): (&str, usize), words: &str) {
    let mut line = first.to_owned();
    for word in words.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(text, "{}", line.trim_end());
            line = " ".repeat(others);
        }
        if !line.ends_with(' ') {
            line.push(' ');
        }
        line.push_str(word);
    }
    let _ = writeln!(text, "{}", line.trim_end());
}
