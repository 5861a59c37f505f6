//! Rules for source files.

use super::{crate_folders, files, name, read, report};

/// Largest length of a file, in lines.
const MAX_LINES: usize = 500;

#[test]
fn every_source_file_begins_with_what_it_is() {
    let mut findings = Vec::new();
    for path in crate_folders().iter().flat_map(|folder| files(&folder.join("src"), "rs")) {
        let text = read(&path);
        let first = text.lines().next().unwrap_or_default();
        // the doc comment of a crate may be its README
        let begins = first.starts_with("//! ") || first.starts_with("#![doc = include_str!(");
        if !begins {
            findings.push(format!("{}:1: `{first}`", name(&path)));
        }
    }
    report("The first line says what the file is, as `//! ...`", &findings);
}

#[test]
fn no_source_file_is_too_long() {
    let mut findings = Vec::new();
    for path in crate_folders().iter().flat_map(|folder| files(folder, "rs")) {
        let lines = read(&path).lines().count();
        if lines > MAX_LINES {
            findings.push(format!("{}: {lines} lines", name(&path)));
        }
    }
    report("A file of more than 500 lines has a seam: split it there", &findings);
}
