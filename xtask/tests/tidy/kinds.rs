//! Rule that joints, effects and quantities are data: code that names single kinds would ignore a new kind.
//!
//! A kind of effect is named in its own file, and in the files by which scenes are built in Rust. These have a constructor for each kind. A
//! missing constructor is noticed by its caller, and gives no wrong result.

use super::language::report_beyond;
use super::{crate_folders, files, name, read, report};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The list of the kinds of effect.
const EFFECTS: &str = include_str!("../../../mbs-core/src/effects/list.rs");

/// Folders of tables of kinds, with the enum that each declares.
const TABLES: [(&str, &str); 2] =
    [("EffectKind", "mbs-core/src/effects/"), ("Quantity", "mbs-core/src/outputs/quantity/")];

/// Files of mbs-core with constructors of effects, for scenes that are built in Rust.
const DOORS: [&str; 3] = [
    "mbs-core/src/mechanism/build.rs",
    "mbs-core/src/mechanism/on_terms.rs",
    "mbs-core/src/mechanism/joint_limits.rs",
];

/// Crates that are not part of the product: they test or measure the others, or simulate independently.
const TRIALS: [&str; 4] = ["judge/", "lab/", "mbs-testkit/", "xtask/"];

/// The sources of the product with their names, without tests, benches and examples.
fn product() -> impl Iterator<Item = (PathBuf, String)> {
    let all = crate_folders().into_iter().flat_map(|folder| files(&folder, "rs"));
    let is_other = |name: &str| {
        TRIALS.iter().any(|of| name.starts_with(of))
            || ["/tests", "/benches/", "/examples/"].iter().any(|part| name.contains(part))
    };
    all.map(|path| (path.clone(), name(&path))).filter(move |(_, name)| !is_other(name))
}

/// The text without its comments.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect()
}

/// The text between the bracket at the beginning of `text` and its closing bracket.
fn enclosed(text: &str, [open, close]: [char; 2]) -> &str {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        depth += usize::from(c == open);
        if c == close {
            depth -= 1;
            if depth == 0 {
                return &text[open.len_utf8()..at];
            }
        }
    }
    text
}

/// The patterns of the arms of a match, from its body. Of a pattern with several lines, only the last line is returned.
fn patterns(body: &str) -> Vec<&str> {
    let (mut depth, mut found) = (0_usize, Vec::new());
    for line in body.lines() {
        if depth == 0
            && let Some((pattern, _)) = line.split_once("=>")
        {
            found.push(pattern.trim());
        }
        let count = |brackets: &[char]| line.matches(brackets).count();
        depth = (depth + count(&['{', '('])).saturating_sub(count(&['}', ')']));
    }
    found
}

/// Places of a source text that treat single kinds of an enum, so that a new kind would be ignored. Tests may use equality and `let`.
fn findings(text: &str, of: &str, is_test: bool) -> Vec<String> {
    let mut found = Vec::new();
    let kind = format!("{of}::");
    let names = |text: &str| {
        let is_start = |at: usize| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        text.match_indices(&kind).any(|(at, _)| is_start(at))
    };
    let after = |word: &'static str| text.match_indices(word).map(move |(at, _)| &text[at..]);
    if after("matches!(").any(|rest| names(enclosed(&rest[8..], ['(', ')']))) {
        found.push(format!("`matches!` on {of}"));
    }
    let has_hole = |rest: &str| {
        let Some(start) = rest.find('{') else { return false };
        let arms = patterns(enclosed(&rest[start..], ['{', '}']));
        let is_rest = |pattern: &&str| *pattern == "_" || pattern.starts_with("_ if");
        arms.iter().any(|arm| names(arm)) && arms.iter().any(is_rest)
    };
    if after("match ").any(has_hole) {
        found.push(format!("`_ =>` in a match on {of}"));
    }
    if text.contains(&format!("{of} as ")) {
        found.push(format!("another name for {of}"));
    }
    let has = |word: &str| text.contains(&format!("{word} {kind}"));
    if !is_test && ["==", "!="].into_iter().any(has) {
        found.push(format!("a comparison with one {of}"));
    }
    if !is_test && ["let", "let &", "let Some("].into_iter().any(has) {
        found.push(format!("a `let` of one {of}"));
    }
    found
}

/// The kinds of effect that a source text names: as variants, or as imported types.
fn effects_named(text: &str) -> Vec<&'static str> {
    let text = code(text);
    let of_list = EFFECTS.lines().filter_map(|line| line.trim().split_once(" in "));
    let kinds = of_list.filter(|(_, rest)| rest.contains('(')).map(|(kind, _)| kind);
    let is_in_word = |c: char| c.is_alphanumeric() || c == '_';
    let imports: Vec<&str> = text
        .match_indices("use ")
        .filter_map(|(at, _)| text[at..].split(';').next())
        .filter(|import| ["scene", "effects", "kinds"].iter().any(|part| import.contains(part)))
        .collect();
    let is_named = |kind: &&str| {
        let paths = ["EffectKind", "scene", "effects", "kinds"].map(|of| format!("{of}::{kind}"));
        let is_path = |path: &String| {
            let ends = text.match_indices(path.as_str()).map(|(at, _)| &text[at + path.len()..]);
            ends.into_iter().any(|rest| !rest.starts_with(is_in_word))
        };
        let has = |import: &&str| import.split(|c| !is_in_word(c)).any(|word| word == *kind);
        paths.iter().any(is_path) || imports.iter().any(has)
    };
    kinds.filter(is_named).collect()
}

#[test]
fn no_code_asks_for_a_kind_of_joint_in_a_way_that_forgets_the_next() {
    let mut all = Vec::new();
    for path in crate_folders().iter().flat_map(|folder| files(folder, "rs")) {
        let (text, name) = (read(&path), name(&path));
        let is_test = name.contains("/tests") || name.starts_with("xtask/");
        if !name.ends_with("tidy/kinds.rs") {
            let found = findings(&text, "JointKind", is_test);
            all.extend(found.iter().map(|finding| format!("{name}: {finding}")));
        }
    }
    report("Ask the table of joints (`mbs-core/src/joint/table.rs`), or match every kind", &all);
}

#[test]
fn no_product_asks_for_an_effect_or_a_quantity_in_a_way_that_forgets_the_next() {
    let mut all = Vec::new();
    for (path, name) in product() {
        let text = code(&read(&path));
        for (of, _) in TABLES.iter().filter(|(_, folder)| !name.starts_with(folder)) {
            let found = findings(&text, of, false);
            all.extend(found.iter().map(|finding| format!("{name}: {finding}")));
        }
    }
    report("Ask a method of the effects or the row of the quantity, or match every kind", &all);
}

#[test]
fn product_files_outside_the_effects_name_no_kind_of_effect() {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (path, name) in product() {
        let is_own = name.starts_with(TABLES[0].1);
        let is_door = DOORS.contains(&name.as_str());
        let named = effects_named(&read(&path));
        if !is_own && !is_door && !named.is_empty() {
            found.insert(name.clone(), vec![format!("{name}: {}", named.join(", "))]);
        }
    }
    let rule = "Ask a method of the effects (`mbs-core/src/effects/kind.rs`) that the kind's own file answers";
    report_beyond(rule, "kind", &found);
}

#[test]
fn what_forgets_a_kind_is_found() {
    let of = |text| findings(text, "JointKind", false).len();
    assert_eq!(of("if matches!(joint.kind, JointKind::Weld | JointKind::Free) {}"), 1);
    assert_eq!(of("match (kind, d) {\n(JointKind::Weld, _) => f(),\n_ => g(),\n}"), 1);
    assert_eq!(of("match kind {\nJointKind::Weld => {\n_ => 1\n}\n_ if x => 2,\n}"), 1);
    assert_eq!(of("let is_weld = kind == JointKind::Weld;"), 1);
    assert_eq!(findings("kind == JointKind::Weld", "JointKind", true).len(), 0);
    assert_eq!(of("match kind {\nJointKind::Weld => match x {\n_ => 1\n},\n}"), 0);
    assert_eq!(of("match n {\n0 => JointKind::Weld,\n_ => JointKind::Free,\n}"), 0);
    assert_eq!(of("matches!(freedom, Freedom::Turn(_))"), 0);
    let of = |text| findings(text, "Quantity", false).len();
    assert_eq!(of("let Quantity::Position { body, at } = quantity else { return };"), 1);
    assert_eq!(of("match quantity {\nQuantity::Position { body, at } => f(),\n_ => g(),\n}"), 1);
    assert_eq!(of("let value = |joint| Quantity::JointValue { joint };"), 0);
    assert_eq!(of("match kind {\nOtherQuantity::Energy => f(),\n_ => g(),\n}"), 0);
}

#[test]
fn the_effects_that_a_text_names_are_found() {
    assert_eq!(effects_named("if let EffectKind::Tire(tire) = kind {}"), ["Tire"]);
    assert_eq!(effects_named("use mbs_core::scene::{\n    BodyId, Limit,\n};"), ["Limit"]);
    assert_eq!(effects_named("let tire = mbs_core::effects::Tire { body };"), ["Tire"]);
    assert!(effects_named("// an EffectKind::Tire\nuse mbs_core::control::Limit;").is_empty());
    assert!(effects_named("EffectKind::TireOfOldTimes; LineStyle::Bumper").is_empty());
}
