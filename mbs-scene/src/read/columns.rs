//! Tables in a scene that are columns of a CSV file: `table = { file = "force.csv", columns = ["time", "force"] }`.
//!
//! The first row of the file has the names of the columns, each with an optional unit in brackets: `time [ms]`. Every other row has a cell
//! for each column, and becomes a row of the table. Each number keeps its place in the file, so that error messages refer to it.

use super::ReadFault;
use super::error::{ExpressionFault, Read};
use super::expression::evaluate;
use super::fields::Context;
use super::include::plain;
use super::names::Names;
use super::nearest::nearest_name;
use super::texts::{Text, Texts};
use super::tree::{Item, Member, Node, Span};
use super::values::Values;
use crate::keys::TABLE_FILE;
use core::ops::Range;
use mbs_core::scene::Number;

/// The keys whose value may be a table in a file.
const TABLES: [&str; 2] = ["table", "points"];
/// Largest total length of the CSV files of a scene [bytes]. The texts of a scene have the same limit. Chosen, not tuned.
const MAX_BYTES: usize = 64 << 20;
const FORM: &str = "a list of rows, or { file = \"force.csv\", columns = [\"time\", \"force\"] }";

/// Replaces the tables that name a file by the rows of that file.
pub(super) fn resolve(texts: &mut Texts, members: &mut [Member]) -> Read<()> {
    members.iter_mut().try_for_each(|member| {
        let is_table = TABLES.contains(&member.key.as_str());
        if is_table && member.item.get("file").is_some() {
            return replace(texts, &mut member.item);
        }
        inner(texts, &mut member.item)
    })
}

fn inner(texts: &mut Texts, item: &mut Item) -> Read<()> {
    match &mut item.node {
        Node::Table(members) => resolve(texts, members),
        Node::List(items) => items.iter_mut().try_for_each(|item| inner(texts, item)),
        _ => Ok(()),
    }
}

/// Table in a file, with the keys that the scene has for it.
struct TableFile {
    file: (String, Span),
    columns: Vec<(String, Span)>,
    units: Option<Vec<(String, Span)>>,
}

fn refused<R>(texts: &Texts, span: &Span, message: String, hint: impl Into<String>) -> Read<R> {
    Err(texts.error(span, ReadFault::Include(ExpressionFault { message, hint: hint.into() })))
}

fn replace(texts: &mut Texts, item: &mut Item) -> Read<()> {
    let table = written(texts, item)?;
    let start = load(texts, &table.file, &item.span)?;
    item.node = Node::List(rows(texts, &table, start)?);
    Ok(())
}

/// Reads the keys of a table in a file.
fn written(texts: &Texts, item: &Item) -> Read<TableFile> {
    let values = Values::none(texts);
    let names = Names::default();
    let context = Context::of_file(texts, &values, &names);
    let fields = context.table(item, FORM, TABLE_FILE)?;
    let text = |item: &Item| Ok((context.text(item)?.to_owned(), item.span.clone()));
    let list = |item, form| -> Read<Vec<_>> {
        context.filled_list(item, form)?.iter().map(text).collect()
    };
    let columns = list(fields.need("columns")?, "a list of names of columns")?;
    let units = fields.get("units").map(|item| list(item, "a list of units")).transpose()?;
    if let Some(units) = &units
        && units.len() != columns.len()
    {
        let (needed, found) = (columns.len(), units.len());
        let span = &fields.need("units")?.span;
        return context.fault(span, ReadFault::WrongCount { needed, found });
    }
    Ok(TableFile { file: text(fields.need("file")?)?, columns, units })
}

/// Adds the text of a file, once for each file, and returns the byte at which it begins.
fn load(texts: &mut Texts, (file, span): &(String, Span), by: &Span) -> Read<usize> {
    let of = texts.of(span);
    let Some(folder) = &of.folder else {
        let message = "a text that is no file lies in no folder, and has no tables in files";
        let hint = "write the rows themselves, or read the scene from its file";
        return refused(texts, span, message.to_owned(), hint);
    };
    let path = folder.join(file);
    let name = path.display().to_string();
    if let Some(text) = texts.list().iter().find(|text| text.is_table && text.name == name) {
        return Ok(text.start);
    }
    let unreadable = |problem: String| {
        let message = format!("cannot read the table `{name}`: {problem}");
        refused(texts, span, message, "give the path from the folder of the scene")
    };
    let left = MAX_BYTES.saturating_sub(texts.len()) as u64;
    let bytes = match std::fs::metadata(&path) {
        Ok(about) if !about.is_file() => return unreadable("it is no file".to_owned()),
        Ok(about) if about.len() > left => {
            return unreadable(format!("more than {} MiB in all texts", MAX_BYTES >> 20));
        }
        Ok(_) => std::fs::read(&path),
        Err(error) => Err(error),
    };
    let text = match bytes.map(String::from_utf8) {
        Ok(Ok(text)) => text,
        Ok(Err(_)) => return unreadable("it is not UTF-8 text".to_owned()),
        Err(error) => return unreadable(plain(&error)),
    };
    let (prefix, folder) = (of.prefix.clone(), None);
    let by = Some(by.clone());
    Ok(texts.add(Text { name, text, prefix, by, is_file: true, is_table: true, folder, start: 0 }))
}

/// A column of the table: index of its cell in a row, and its unit, which is empty when there is none.
struct Column {
    place: usize,
    unit: String,
}

/// The rows of the file whose text begins at byte `start`.
fn rows(texts: &Texts, table: &TableFile, start: usize) -> Read<Vec<Item>> {
    let text = &texts.of(&(start..start)).text;
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut next = start + text.len() - body.len();
    let mut head: Option<(Vec<Column>, char, usize)> = None;
    let mut rows = Vec::new();
    for line in body.split_inclusive('\n') {
        let here = next;
        next += line.len();
        let line = line.trim_end_matches(['\n', '\r']);
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let Some((columns, separator, n_cells)) = &head else {
            let separator = separator(line);
            let cells = cells(line, separator);
            head = Some((head_of(texts, table, (line, here), &cells)?, separator, cells.len()));
            continue;
        };
        let cells = cells(line, *separator);
        if cells.len() != *n_cells {
            let message =
                format!("the row has {} cells, but the first row has {n_cells}", cells.len());
            let span = here..here + line.len();
            return refused(texts, &span, message, "write one cell for each column");
        }
        let cell = |column: &Column| cell(texts, (line, here), &cells[column.place], &column.unit);
        let node = Node::List(columns.iter().map(cell).collect::<Read<_>>()?);
        rows.push(Item { span: here..here + line.len(), node });
    }
    if rows.is_empty() {
        let message = format!("`{}` has no rows", table.file.0);
        let hint = "write names of columns in its first row, and numbers in the others";
        return refused(texts, &table.file.1, message, hint);
    }
    Ok(rows)
}

/// Character that separates the cells of a file with this first row.
fn separator(head: &str) -> char {
    [';', '\t'].into_iter().find(|&c| head.contains(c)).unwrap_or(',')
}

/// The byte ranges of the cells of a line, without blanks and quotes around them.
fn cells(line: &str, separator: char) -> Vec<Range<usize>> {
    let (mut cells, mut start, mut is_quoted) = (Vec::new(), 0, false);
    for (i, c) in line.char_indices() {
        if c == '"' {
            is_quoted = !is_quoted;
        } else if c == separator && !is_quoted {
            cells.push(start..i);
            start = i + c.len_utf8();
        }
    }
    cells.push(start..line.len());
    let bare = |cell: Range<usize>| {
        let blank = |c: char| c.is_whitespace() || c == '"';
        let text = &line[cell.clone()];
        let start = cell.start + text.len() - text.trim_start_matches(blank).len();
        start..(cell.start + text.trim_end_matches(blank).len()).max(start)
    };
    cells.into_iter().map(bare).collect()
}

/// Finds the columns of a table in the first row of a file, which begins at byte `at`.
fn head_of(
    texts: &Texts,
    table: &TableFile,
    (line, at): (&str, usize),
    cells: &[Range<usize>],
) -> Read<Vec<Column>> {
    let named: Vec<(&str, &str)> =
        cells.iter().map(|cell| name_and_unit(&line[cell.clone()])).collect();
    let mut columns = Vec::new();
    for (i, (name, span)) in table.columns.iter().enumerate() {
        let is_named = |k: &usize| named[*k].0 == name || line[cells[*k].clone()] == *name;
        let mut places = (0..named.len()).filter(is_named);
        let (Some(place), other) = (places.next(), places.next()) else {
            let known: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
            let message = format!("`{}` has no column `{name}`", table.file.0);
            return refused(texts, span, message, nearest_name(name, &known, "columns"));
        };
        if let Some(other) = other {
            let span = at + cells[other].start..at + cells[other].end;
            let message = format!("there is another column `{name}`");
            return refused(texts, &span, message, "give each column its own name");
        }
        let of_head = (named[place].1, at + cells[place].start..at + cells[place].end);
        let of_scene = table.units.as_ref().map(|units| &units[i]);
        let unit = unit(texts, of_head, of_scene)?;
        columns.push(Column { place, unit });
    }
    Ok(columns)
}

/// The name of a column, and its unit in brackets; the unit is empty when none is written.
fn name_and_unit(cell: &str) -> (&str, &str) {
    let unit = cell.strip_suffix(']').and_then(|cell| cell.rsplit_once('['));
    unit.map_or((cell, ""), |(name, unit)| (name.trim_end(), unit.trim()))
}

/// The unit of a column as expressions write it, from the first row of the file or from the scene.
fn unit(
    texts: &Texts,
    (of_head, span): (&str, Span),
    of_scene: Option<&(String, Span)>,
) -> Read<String> {
    let plain = |unit: &str| match unit {
        "-" | "1" => String::new(),
        unit => unit.replace('\u{b0}', "deg").replace(' ', "*"),
    };
    let (written, span) = match of_scene {
        Some((unit, span)) if of_head.is_empty() || plain(unit) == plain(of_head) => {
            (unit.as_str(), span)
        }
        Some((unit, span)) => {
            let message = format!("the unit is `{unit}`, but the file has `{of_head}`");
            return refused(texts, span, message, "leave `units` out, or write that of the file");
        }
        None => (of_head, &span),
    };
    let unit = plain(written);
    let mut none = |_: &str| Err([String::new(), String::new()]);
    if !unit.is_empty() && evaluate(&format!("1 {unit}"), &mut none).is_err() {
        let message = format!("`{written}` is no unit");
        let hint = "write a unit as in expressions: `mm`, `kN`, `deg/s`, `N*m`; `-` is none";
        return refused(texts, span, message, hint);
    }
    Ok(unit)
}

/// The number in a cell of a line that begins at byte `at`.
fn cell(texts: &Texts, (line, at): (&str, usize), cell: &Range<usize>, unit: &str) -> Read<Item> {
    let (text, span) = (&line[cell.clone()], at + cell.start..at + cell.end.max(cell.start + 1));
    if Number::from_decimal(text).is_none_or(|number| !number.to_f64().is_finite()) {
        let message = match text {
            "" => "the cell is empty".to_owned(),
            text => format!("`{text}` is no number"),
        };
        return refused(texts, &span, message, "write a number with a decimal point: 12.5 or 1e-3");
    }
    let node = match unit {
        "" => Node::Number(text.to_owned()),
        unit => Node::Text(format!("{text} {unit}")),
    };
    Ok(Item { span, node })
}
