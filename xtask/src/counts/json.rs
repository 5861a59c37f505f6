//! Everything counted as JSON. It is written here: a library for it would be compiled before any job of this repository can begin.

use super::callgrind::{Case, STEPS};
use super::claims::{Claim, Runs};

/// The runs and the claims.
pub(crate) fn text(runs: &Runs, claims: &[Claim]) -> String {
    let cases = |cases: &[Case]| {
        list(cases, 1, |case| {
            let name = string(&case.name);
            format!("{{ \"case\": {name}, \"instructions\": {} }}", case.instructions)
        })
    };
    let claims = list(claims, 1, |claim| {
        let against = list(&claim.against, 2, |why| string(why));
        format!(
            "{{ \"claim\": {}, \"holds\": {}, \"comparisons\": {}, \"against\": {against} }}",
            string(claim.text),
            claim.holds(),
            claim.n_checked
        )
    });
    format!(
        "{{\n  \"all_effects\": {},\n  \"claims\": {claims},\n  \"no_effects\": {},\n  \"steps\": {STEPS}\n}}\n",
        cases(&runs.full),
        cases(&runs.lean)
    )
}

/// A list with a line for each, that stands so deep in others.
fn list<T>(items: &[T], depth: usize, line: impl Fn(&T) -> String) -> String {
    if items.is_empty() {
        return "[]".to_owned();
    }
    let (outer, inner) = ("  ".repeat(depth), "  ".repeat(depth + 1));
    let lines: Vec<_> = items.iter().map(|item| format!("{inner}{}", line(item))).collect();
    format!("[\n{}\n{outer}]", lines.join(",\n"))
}

/// A text in quotes.
fn string(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_texts_are_written_as_json_asks() {
        let full =
            vec![Case { name: "a \"b\"\\\n".to_owned(), instructions: 7, functions: [].into() }];
        let runs = Runs { full, lean: vec![], refusals: vec![], plain: vec![] };
        let written = text(&runs, &[]);
        let case = r#"{ "case": "a \"b\"\\\u000a", "instructions": 7 }"#;
        let lists = "  \"claims\": [],\n  \"no_effects\": [],\n  \"steps\": 10\n";
        let expected = format!("{{\n  \"all_effects\": [\n    {case}\n  ],\n{lists}}}\n");
        assert_eq!(written, expected);
    }
}
