//! Rules for numeric constants: each has a doc sentence, and a name that says what it is.

use super::{crate_folders, files, name, read, report};

/// Words that are too vague as the complete name of a constant.
const VAGUE: [&str; 10] =
    ["MOST", "LIMIT", "SHARE", "SAME", "NEAR", "FAR", "SLOW", "FEW", "FIRST", "CUT"];

/// Words of a type that consists of numbers alone.
const NUMERIC: [&str; 17] = [
    "f32", "f64", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "i128",
    "isize", "Duration", "Option", "static",
];

/// Name and type of the constant whose definition begins in a line.
fn constant(line: &str) -> Option<(&str, &str)> {
    let line = line.trim_start();
    let line = match line.strip_prefix("pub(") {
        Some(rest) => rest.split_once(") ")?.1,
        None => line.strip_prefix("pub ").unwrap_or(line),
    };
    let (name, rest) = line.strip_prefix("const ")?.split_once(": ")?;
    let is_name = name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
    // a parameter of a type or a function ends with a comma
    let rest = Some(rest).filter(|rest| !rest.ends_with(','))?;
    let kind = rest.split_once(" =").map(|(kind, _)| kind).or(rest.strip_suffix(';'))?;
    is_name.then_some((name, kind))
}

/// True if a type consists of numbers alone, or of arrays and tuples of numbers. The length of an array may be any expression.
fn is_numeric(kind: &str) -> bool {
    let mut parts = kind.split(']').map(|part| part.split("; ").next().unwrap_or_default());
    let mut words = Vec::new();
    parts.by_ref().for_each(|part| words.extend(part.split(|c: char| !c.is_alphanumeric())));
    words.retain(|word| !word.is_empty());
    !words.is_empty() && words.iter().all(|word| NUMERIC.contains(word))
}

/// The first line of the block around a line, such as that of an item or a function.
fn enclosing<'a>(lines: &[&'a str], at: usize) -> &'a str {
    let indent = |line: &str| line.len() - line.trim_start().len();
    let depth = indent(lines[at]);
    let opens = |line: &&&str| {
        !line.is_empty()
            && indent(line) < depth
            && line.trim_start().starts_with(char::is_alphabetic)
    };
    let mut above = lines[..at].iter().rev().filter(opens);
    above.find(|line| line.trim() != "where").copied().unwrap_or_default().trim_start()
}

/// The comment directly above a line: its first and its last line, without slashes. Attributes may be between them.
fn comment<'a>(lines: &[&'a str], at: usize, marks: &[&str]) -> Option<[&'a str; 2]> {
    let text = |line: &&'a str| {
        marks.iter().find_map(|mark| line.trim_start().strip_prefix(mark).map(str::trim))
    };
    let above = lines[..at].iter().rev().skip_while(|line| line.trim_start().starts_with("#["));
    let found: Vec<_> = above.map_while(text).collect();
    Some([*found.last()?, *found.first()?])
}

/// Faults of the constants of a source text: line, name and reason.
fn findings(text: &str) -> Vec<String> {
    let lines: Vec<_> = text.lines().collect();
    let (mut found, mut has_table) = (Vec::new(), false);
    for (at, line) in lines.iter().enumerate() {
        let Some((name, kind)) = constant(line) else { continue };
        let mut add = |reason: &str| found.push(format!("{}: {name}: {reason}", at + 1));
        if VAGUE.contains(&name) {
            add("say what it limits");
        }
        let around = enclosing(&lines, at);
        // constants of a trait's implementation are documented in the trait
        let is_given = around.starts_with("impl") && around.contains(" for ");
        if !is_numeric(kind) || is_given {
            continue;
        }
        let is_item = ["impl", "trait", "mod", "pub"].iter().any(|word| around.starts_with(word))
            && !around.contains("fn ");
        let is_local = !line.starts_with(char::is_alphabetic) && !is_item;
        let marks: &[&str] = if is_local { &["///", "//"] } else { &["///"] };
        // one sentence may document all arrays of a published table, whose names are single letters
        let is_table =
            kind.starts_with(['[', '&']) && name.trim_end_matches(char::is_numeric).len() == 1;
        match comment(&lines, at, marks) {
            None if is_table && has_table => {}
            None => add("no sentence of its own"),
            Some([first, last]) => {
                has_table |= is_table;
                let begins = first.starts_with(|c: char| c.is_uppercase() || c == '`');
                if !begins || !last.ends_with(['.', ':']) {
                    add("no sentence: a capital first, a full stop last");
                }
            }
        }
    }
    found
}

#[test]
fn each_numeric_constant_has_a_sentence_of_its_own() {
    let mut all = Vec::new();
    for path in crate_folders().iter().flat_map(|folder| files(&folder.join("src"), "rs")) {
        let place = name(&path);
        all.extend(findings(&read(&path)).iter().map(|finding| format!("{place}:{finding}")));
    }
    report("A numeric constant has one sentence: meaning, unit, why this value", &all);
}

#[test]
fn constants_without_a_sentence_are_found() {
    let of = |text| findings(text).len();
    assert_eq!(of("/// Most steps.\nconst MAX_STEPS: u32 = 3;\n"), 0);
    assert_eq!(of("/// Most steps.\n#[cfg(test)]\npub(super) const MAX_STEPS: u32 = 3;\n"), 0);
    assert_eq!(of("// Most steps.\nconst MAX_STEPS: u32 = 3;\n"), 1);
    assert_eq!(of("/// Most steps\nconst MAX_STEPS: u32 = 3;\n"), 1);
    assert_eq!(of("/// most steps.\nconst MAX_STEPS: u32 = 3;\n"), 1);
    assert_eq!(of("/// Both.\nconst A_STEP: f64 = 3.0;\nconst B_STEP: [f64; 2] = [3.0; 2];\n"), 1);
    assert_eq!(of("fn f() {\n    // Most steps.\n    const MAX_STEPS: u32 = 3;\n}\n"), 0);
    assert_eq!(of("impl A {\n    // Most steps.\n    const MAX_STEPS: u32 = 3;\n}\n"), 1);
    assert_eq!(of("impl<T> A for B<T>\nwhere\n    T: C,\n{\n    const STEPS: u32 = 3;\n}\n"), 0);
    assert_eq!(
        of("/// Nodes and weights.\nconst B: [f64; 2] = [0.5; 2];\nconst C: [f64; N + 1] = X;\n"),
        0
    );
    assert_eq!(of("/// Longest wait.\nconst LIMIT: Duration = Duration::from_secs(1);\n"), 1);
    assert_eq!(
        of("const TEXT: &str = \"\";\nconst ROW: Row = Row::new();\nconst fn f() -> f64 {\n"),
        0
    );
}
