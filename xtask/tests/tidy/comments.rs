//! Rules for doc comments: the first sentence of each must be understandable alone, since a hover or a search shows nothing else.

use super::language::report_beyond;
use super::{crate_folders, files, name, read};
use std::collections::BTreeMap;

/// Words with which no first sentence begins: they refer to a text elsewhere.
const BEGINNINGS: [&str; 20] = [
    "What", "It", "Its", "That", "Those", "The same", "Where", "As", "They", "How", "Of", "Why",
    "Which", "Whose", "Their", "These", "Both", "By", "Another", "Without",
];

/// Least number of words in a first sentence [-]: a shorter one names its subject without a statement about it.
const FEWEST_WORDS: usize = 4;

/// The doc comments of a file, each joined to one line, with the number of its first line.
fn doc_comments(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut continues = false;
    for (number, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let doc = ["///", "//!"].iter().find_map(|mark| line.strip_prefix(mark));
        let doc = doc.filter(|doc| !doc.starts_with('/')).map(str::trim);
        match (doc, found.last_mut()) {
            (Some(doc), Some((_, comment))) if continues => {
                comment.push(' ');
                comment.push_str(doc);
            }
            (Some(doc), _) => found.push((number + 1, doc.to_owned())),
            (None, _) => {}
        }
        continues = doc.is_some();
    }
    found
}

/// The first sentence of a comment.
fn first_sentence(comment: &str) -> &str {
    let end = [". ", "? "].iter().filter_map(|end| comment.find(end)).min();
    comment.split_at(end.map_or(comment.len(), |end| end + 1)).0
}

/// The first sentences that satisfy a claim, by crate.
fn sentences_that(holds: impl Fn(&str) -> bool) -> BTreeMap<String, Vec<String>> {
    let mut found = BTreeMap::new();
    for folder in crate_folders() {
        let list: &mut Vec<String> = found.entry(name(&folder)).or_default();
        for path in files(&folder, "rs") {
            for (number, comment) in doc_comments(&read(&path)) {
                let sentence = first_sentence(&comment);
                if holds(sentence) {
                    list.push(format!("{}:{number}: {sentence}", name(&path)));
                }
            }
        }
    }
    found
}

#[test]
fn first_sentences_of_doc_comments_begin_with_their_subject() {
    let refers = |sentence: &str| {
        BEGINNINGS.iter().any(|word| {
            let rest = sentence.strip_prefix(word);
            rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
        })
    };
    report_beyond("Doc comments without their subject", "subject", &sentences_that(refers));
}

#[test]
fn first_sentences_of_doc_comments_are_no_labels() {
    let is_label = |sentence: &str| sentence.split_whitespace().count() < FEWEST_WORDS;
    report_beyond("Doc comments of three words or fewer", "label", &sentences_that(is_label));
}

#[test]
fn a_comment_is_read_as_its_first_sentence() {
    let text = "/// Number of rows [-]. It is even.\n///\n/// # Errors\n/// None.\nfn a() {}\n//// no doc\n//! Its name.\n";
    let found = doc_comments(text);
    assert_eq!(found.iter().map(|(line, _)| *line).collect::<Vec<_>>(), [1, 7]);
    let sentences: Vec<_> = found.iter().map(|(_, text)| first_sentence(text)).collect();
    assert_eq!(sentences, ["Number of rows [-].", "Its name."]);
}
