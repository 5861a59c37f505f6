//! Rules for equation tags: each `[P3 (10)]` in the code has a row in docs/NOTATION.md.

use super::{between, crate_folders, files, name, read, report};
use std::collections::BTreeSet;

/// A publication of the report and an equation in it.
type Tag = (char, u32);

/// The tags in a text such as `P1 (32), (36)` or `P3 (3)–(5)`, where a dash stands for a range.
///
/// Text before the first publication and sections such as `P3 §2.1` contain no tags.
fn tags(text: &str) -> Vec<Tag> {
    let mut found: Vec<Tag> = Vec::new();
    let mut publication = None;
    let mut is_range = false;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (taken, number) = equation(rest);
        if let Some(p) = ["P1", "P2", "P3"].iter().position(|p| rest.starts_with(p)) {
            publication = char::from_digit(p as u32 + 1, 10);
        } else if let (Some(p), Some(number)) = (publication, number) {
            let from = match found.last() {
                Some(&(_, last)) if is_range => last + 1,
                _ => number,
            };
            found.extend((from..=number).map(|n| (p, n)));
            is_range = false;
        } else if matches!(first, '-' | '–') {
            is_range = true;
        } else if matches!(first, ',' | ';') {
            is_range = false;
        }
        rest = &rest[taken.max(first.len_utf8())..];
    }
    found
}

/// The number in parentheses at the start of a text, and its length.
fn equation(text: &str) -> (usize, Option<u32>) {
    let inner = text.strip_prefix('(').and_then(|rest| rest.split_once(')'));
    match inner.and_then(|(digits, _)| Some((digits.len() + 2, digits.parse().ok()?))) {
        Some((length, number)) => (length, Some(number)),
        None => (0, None),
    }
}

/// The tags in brackets in one line: `... [P3 (9)] ...`.
fn bracketed(line: &str) -> Vec<Tag> {
    let pieces = line.split('[').skip(1).filter_map(|piece| Some(piece.split_once(']')?.0));
    pieces.filter(|piece| piece.starts_with('P')).flat_map(tags).collect()
}

/// The tags in the index of docs/NOTATION.md: its first cells.
fn index() -> BTreeSet<Tag> {
    let notation = read("docs/NOTATION.md");
    let rows = between(&notation, "index").lines().filter_map(|line| line.strip_prefix("| P"));
    let cells = rows.filter_map(|row| Some(format!("P{}", row.split_once('|')?.0)));
    cells.flat_map(|cell| tags(&cell)).collect()
}

#[test]
fn every_equation_tag_is_in_the_index() {
    let index = index();
    let mut findings = Vec::new();
    let folders = crate_folders();
    let sources = folders.iter().filter(|folder| !folder.ends_with("xtask"));
    for path in sources.flat_map(|f| [files(f, "rs"), files(f, "md")].concat()) {
        for (number, line) in read(&path).lines().enumerate() {
            for tag in bracketed(line).iter().filter(|tag| !index.contains(*tag)) {
                let place = format!("{}:{}", name(&path), number + 1);
                findings.push(format!("{place}: [P{} ({})]", tag.0, tag.1));
            }
        }
    }
    report("Every equation tag has a row in the index of docs/NOTATION.md", &findings);
}

#[test]
fn tags_are_read_with_lists_and_ranges() {
    assert_eq!(bracketed("/// T x = b   [P3 (10)]"), [('3', 10)]);
    assert_eq!(bracketed("[P3 (8), (4), (5)]"), [('3', 8), ('3', 4), ('3', 5)]);
    assert_eq!(
        bracketed("[P3 (3)–(5)] and [P1 (32), P2 (21)]")[..4],
        [('3', 3), ('3', 4), ('3', 5), ('1', 32)]
    );
    assert_eq!(bracketed("x[0] + (3) [P3 §2.1] as corrected"), []);
}

#[test]
fn index_covers_both_augmented_lagrangian_methods() {
    let index = index();
    assert!((4..=19).all(|n| index.contains(&('1', n))));
    assert!((1..=12).all(|n| index.contains(&('3', n))));
}
