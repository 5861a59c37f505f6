//! Joints are data: code that asks for a kind by its name forgets the next kind.

use super::{crate_folders, files, name, read, report};

/// The text between the bracket that `text` begins with and its partner.
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

/// The patterns of the arms of a match, from its body: those on the last line of a pattern that goes over several.
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

/// Questions of a source text about the kinds of joint that a new kind would pass by; equality too, if it is no test.
fn findings(text: &str, is_test: bool) -> Vec<&'static str> {
    let mut found = Vec::new();
    let after = |word: &'static str| text.match_indices(word).map(move |(at, _)| &text[at..]);
    if after("matches!(").any(|rest| enclosed(&rest[8..], ['(', ')']).contains("JointKind::")) {
        found.push("`matches!` on JointKind");
    }
    let has_hole = |rest: &str| {
        let Some(start) = rest.find('{') else { return false };
        let arms = patterns(enclosed(&rest[start..], ['{', '}']));
        let is_rest = |pattern: &&str| *pattern == "_" || pattern.starts_with("_ if");
        arms.iter().any(|arm| arm.contains("JointKind::")) && arms.iter().any(is_rest)
    };
    if after("match ").any(has_hole) {
        found.push("`_ =>` in a match on JointKind");
    }
    if text.contains("JointKind as ") {
        found.push("another name for JointKind");
    }
    if !is_test && ["== JointKind::", "!= JointKind::"].iter().any(|word| text.contains(word)) {
        found.push("a comparison with one JointKind");
    }
    found
}

#[test]
fn no_code_asks_for_a_kind_of_joint_in_a_way_that_forgets_the_next() {
    let mut all = Vec::new();
    for path in crate_folders().iter().flat_map(|folder| files(folder, "rs")) {
        let (text, name) = (read(&path), name(&path));
        let is_test = name.contains("/tests") || name.starts_with("xtask/");
        if !name.ends_with("tidy/kinds.rs") {
            all.extend(findings(&text, is_test).iter().map(|finding| format!("{name}: {finding}")));
        }
    }
    report("Ask the table of joints (`mbs-core/src/joint/table.rs`), or match every kind", &all);
}

#[test]
fn what_forgets_a_kind_is_found() {
    let of = |text| findings(text, false).len();
    assert_eq!(of("if matches!(joint.kind, JointKind::Weld | JointKind::Free) {}"), 1);
    assert_eq!(of("match (kind, d) {\n(JointKind::Weld, _) => f(),\n_ => g(),\n}"), 1);
    assert_eq!(of("match kind {\nJointKind::Weld => {\n_ => 1\n}\n_ if x => 2,\n}"), 1);
    assert_eq!(of("let is_weld = kind == JointKind::Weld;"), 1);
    assert_eq!(findings("kind == JointKind::Weld", true).len(), 0);
    assert_eq!(of("match kind {\nJointKind::Weld => match x {\n_ => 1\n},\n}"), 0);
    assert_eq!(of("match n {\n0 => JointKind::Weld,\n_ => JointKind::Free,\n}"), 0);
    assert_eq!(of("matches!(freedom, Freedom::Turn(_))"), 0);
}
