//! Rules for the language (docs/NOTATION.md, second part): words that are not used, short sentences, paths and names that exist.
//!
//! The rule of words is for every line of the Rust files in the `src` folder of each crate, with identifiers split at underscores and
//! capitals. It is also for README.md, ARCHITECTURE.md, CONTRIBUTING.md, CHANGELOG.md, the documents in `docs/`, the crates' README.md
//! files, and the help of the command. This file is left out. The rule of sentences is for README.md, the documents in `docs/` and the
//! crates' README.md files.

use super::{crate_folders, files, name, read, report};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use xtask::process::root;

/// Words that no text may contain.
const BANNED: [&str; 14] = [
    "told",
    "tell",
    "tells",
    "telling",
    "foretold",
    "felt",
    "nobody",
    "so many times",
    "as far as",
    "by turns",
    "go on",
    "goes on",
    "going on",
    "gone on",
];

/// Largest number of words in a sentence. A code span is one word.
const MAX_WORDS: usize = 25;

/// Exceptions: `rule | file | what | reason`. An unnecessary exception fails too, so that the list only gets shorter.
const ALLOWED: &str = include_str!("allow.txt");

/// The exceptions of a rule: the file or name of each, and what is allowed there.
pub(super) fn allowed(rule: &str) -> BTreeMap<String, String> {
    let lines = ALLOWED.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let mut found = BTreeMap::new();
    for line in lines {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        let [kind, place, what, reason] = cells[..] else {
            panic!("allow.txt: `{line}` is not `rule | place | what | reason`")
        };
        assert!(!reason.is_empty(), "allow.txt: `{line}` has no reason");
        if kind == rule {
            found.insert(place.to_owned(), what.to_owned());
        }
    }
    found
}

/// Fails if there are more findings than the exceptions allow, or fewer.
#[track_caller]
pub(super) fn report_beyond(rule: &str, kind: &str, found: &BTreeMap<String, Vec<String>>) {
    let allowed = allowed(kind);
    let mut findings = Vec::new();
    for (place, list) in found {
        let most = allowed.get(place).map_or(0, |n| n.parse().expect("a count"));
        if list.len() > most {
            findings.extend(list.iter().cloned());
        }
    }
    for (place, most) in &allowed {
        let n = found.get(place).map_or(0, Vec::len);
        if most.parse::<usize>().expect("a count") > n {
            findings.push(format!("allow.txt: {place} has {n} only: write that number"));
        }
    }
    report(rule, &findings);
}

/// The packages that are published: those without `publish = false`.
fn published() -> Vec<PathBuf> {
    let mut folders = crate_folders();
    folders.retain(|folder| !read(folder.join("Cargo.toml")).contains("publish = false"));
    folders
}

/// The documents in scope and the help.
fn documents() -> Vec<PathBuf> {
    let mut paths = vec![root().join("README.md"), root().join("mbs-cli/tests/command/help.txt")];
    paths.extend(files(&root().join("docs"), "md"));
    paths.extend(crate_folders().iter().map(|folder| folder.join("README.md")));
    paths.retain(|path| path.is_file());
    paths
}

/// A line in lower case, with spaces between the words of its identifiers.
fn plain(line: &str) -> String {
    let (mut text, mut is_lower) = (String::new(), false);
    for c in line.chars() {
        if is_lower && c.is_uppercase() {
            text.push(' ');
        }
        is_lower = c.is_lowercase();
        text.extend(if c == '_' { ' ' } else { c }.to_lowercase());
    }
    text
}

/// True if a plain line contains the word or words, with no letter or digit directly before or after.
fn has_word(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        !line[..at].ends_with(char::is_alphanumeric)
            && !line[at + word.len()..].starts_with(char::is_alphanumeric)
    })
}

#[test]
fn text_in_scope_has_no_banned_word() {
    let mut paths = documents();
    paths.extend(
        ["ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|file| root().join(file)),
    );
    paths.extend(crate_folders().iter().flat_map(|folder| files(&folder.join("src"), "rs")));
    paths.retain(|path| !path.ends_with("tidy/language.rs"));
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for path in paths {
        for (number, line) in read(&path).lines().enumerate() {
            let line = plain(line);
            for word in BANNED.iter().filter(|word| has_word(&line, word)) {
                let place = format!("{}:{}: `{word}`", name(&path), number + 1);
                found.entry(name(&path)).or_default().push(place);
            }
        }
    }
    report_beyond("Words that are banned (docs/NOTATION.md, second part)", "word", &found);
}

/// The sentences of a Markdown text, each with the line number of its paragraph. Code blocks and headings are left out. Code spans count as
/// one word, and each cell of a table is a paragraph.
fn sentences(text: &str) -> Vec<(usize, String)> {
    let (mut found, mut paragraph, mut first, mut is_code) = (Vec::new(), String::new(), 0, false);
    let mut end = |paragraph: &mut String, first: usize| {
        found.extend(split(paragraph).into_iter().map(|sentence| (first, sentence)));
        paragraph.clear();
    };
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        let is_fence = line.starts_with("```");
        let begins =
            is_fence || is_code || line.is_empty() || line.starts_with(['#', '|', '!', '<']);
        let item = ["- ", "* "].iter().find_map(|mark| line.strip_prefix(mark)).or_else(|| {
            let rest = line.trim_start_matches(|c: char| c.is_ascii_digit());
            rest.strip_prefix(". ").filter(|_| rest.len() < line.len())
        });
        if begins || item.is_some() {
            end(&mut paragraph, first);
        }
        is_code ^= is_fence;
        if line.starts_with('|') && !is_code {
            line.split('|').for_each(|cell| end(&mut cell.replace("; ", ". "), number + 1));
        }
        if begins {
            continue;
        }
        if paragraph.is_empty() {
            first = number + 1;
        }
        paragraph += item.unwrap_or(line);
        paragraph.push(' ');
    }
    end(&mut paragraph, first);
    found
}

/// The sentences of a paragraph. A sentence ends with a full stop, a question mark or an exclamation mark, followed by a space.
fn split(paragraph: &str) -> Vec<String> {
    let spans = paragraph.split('`').enumerate();
    let plain: String = spans.map(|(i, part)| if i % 2 == 0 { part } else { "Code" }).collect();
    let mut found = vec![String::new()];
    for word in plain.split_whitespace() {
        let last = found.last_mut().expect("there is one");
        last.push_str(word);
        last.push(' ');
        if word.trim_end_matches([')', '*', '"']).ends_with(['.', '!', '?']) {
            found.push(String::new());
        }
    }
    found
}

#[test]
fn sentences_of_documents_are_short() {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for path in documents().iter().filter(|path| path.extension().is_some_and(|e| e == "md")) {
        for (number, sentence) in sentences(&read(path)) {
            let is_word = |word: &&str| word.contains(char::is_alphanumeric);
            let words = sentence.split_whitespace().filter(is_word).count();
            if words > MAX_WORDS {
                let start: String = sentence.chars().take(60).collect();
                let line = format!("{}:{number}: {words} words: {start}...", name(path));
                found.entry(name(path)).or_default().push(line);
            }
        }
    }
    report_beyond("A sentence has at most 25 words", "sentence", &found);
}

#[test]
fn paths_in_documents_exist() {
    let mut findings = Vec::new();
    let tops: BTreeSet<String> = super::entries(&root()).iter().map(|path| name(path)).collect();
    let mut paths = documents();
    paths.extend(["ARCHITECTURE.md", "CONTRIBUTING.md"].map(|file| root().join(file)));
    for path in paths {
        for (number, line) in read(&path).lines().enumerate() {
            for span in line.split('`').skip(1).step_by(2) {
                let top = span.split('/').next().unwrap_or_default();
                let is_path = span.contains('/')
                    && tops.contains(top)
                    && top != "target"
                    && span.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
                if is_path
                    && !root().join(span).exists()
                    && !root().join(span).with_extension("rs").exists()
                {
                    findings.push(format!("{}:{}: `{span}`", name(&path), number + 1));
                }
            }
        }
    }
    report("A path in backticks exists", &findings);
}

/// Names of public types that may occur once in each crate: readers see them together with the crate's name.
const OF_A_CRATE: [&str; 3] = ["Options", "Workspace", "History"];

#[test]
fn public_type_names_occur_once() {
    let mut owners: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    // types of mbs-steps are public if mbs exports them, by name or in a module
    let door = read("mbs/src/lib.rs") + &read("mbs/src/front/mod.rs");
    let uses: Vec<&str> =
        door.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next()).collect();
    let words = |text: &str| -> BTreeSet<String> {
        text.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned).collect()
    };
    let types = words(&uses.join(" "));
    let modules = uses.iter().find_map(|names| names.strip_prefix("mbs_steps::{")).map(words);
    let is_shown = |path: &Path, word: &str| {
        let path = name(path);
        let module = path.trim_start_matches("mbs-steps/src/").split(['/', '.']).next();
        let is_module = |word| modules.as_ref().is_some_and(|modules| modules.contains(word));
        types.contains(word) || module.is_some_and(is_module)
    };
    for folder in published() {
        let is_hidden = folder.ends_with("mbs-steps");
        for path in files(&folder.join("src"), "rs") {
            let text = read(&path);
            let indent = if text.contains("named! {\n") { "    " } else { "" };
            for line in text.lines().map(|line| line.strip_prefix(indent).unwrap_or(line)) {
                let rest = ["pub struct ", "pub enum ", "pub trait ", "pub type "]
                    .iter()
                    .find_map(|kind| line.strip_prefix(kind));
                let is_part = |c: char| c.is_alphanumeric() || c == '_';
                let Some(rest) = rest else { continue };
                let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
                if !is_hidden || is_shown(&path, &rest[..end]) {
                    owners.entry(rest[..end].to_owned()).or_default().insert(name(&path));
                }
            }
        }
    }
    owners.retain(|name, paths| paths.len() > 1 && !OF_A_CRATE.contains(&name.as_str()));
    let found = owners.into_iter().map(|(name, paths)| {
        let places = paths.into_iter().map(|path| format!("{name}: {path}")).collect();
        (name, places)
    });
    report_beyond("A public type's name occurs once", "type", &found.collect());
}

#[test]
fn text_is_read_as_intended() {
    let text = "# Title\n\nOne `a b. c` here. Two\nlines; more? Yes.\n\n```sh\ncode. code\n```\n- item one.\n| cell one | cell; two |\n";
    let found: Vec<_> = sentences(text).into_iter().filter(|(_, s)| !s.is_empty()).collect();
    let words: Vec<_> = found.iter().map(|(line, s)| (*line, s.trim_end())).collect();
    let expected = [
        (3, "One Code here."),
        (3, "Two lines; more?"),
        (3, "Yes."),
        (9, "item one."),
        (10, "cell one"),
        (10, "cell."),
        (10, "two"),
    ];
    assert_eq!(words, expected);
    let has_told = |line: &str| has_word(&plain(line), "told");
    assert!(["as it is told, so", "fn is_told()", "struct AsTold;"].into_iter().all(has_told));
    assert!(!has_told("untold") && has_word(&plain("CannotGoOn"), "go on"));
}
