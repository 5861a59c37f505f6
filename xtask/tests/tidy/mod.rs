//! Rules for the text of this repository, as tests. A reader relies on them, and no compiler checks them.

mod circles;
mod comments;
mod constants;
mod crates;
mod documents;
mod imports;
mod kinds;
mod language;
mod packages;
mod profiles;
mod sources;
mod tags;

use std::fs;
use std::path::{Path, PathBuf};
use xtask::process::root;
use xtask::test::{DOCUMENTS, RULES};

/// The text of a file of the repository.
fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A path as seen from the root of the repository.
fn name(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).display().to_string()
}

/// The crates' folders: those in the root folder that contain a `Cargo.toml`.
fn crate_folders() -> Vec<PathBuf> {
    let mut folders = entries(&root());
    folders.retain(|path| path.join("Cargo.toml").is_file());
    folders
}

/// The files under a folder whose names end with `.ending`, in order. Folders named `target` are skipped.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for path in entries(folder) {
        if path.is_dir() && !path.ends_with("target") {
            found.extend(files(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
    found
}

/// The files that declare a module whose name ends with `module`, as paths from the root of the repository.
fn modules_named(module: &str) -> Vec<String> {
    let sources = crate_folders().into_iter().flat_map(|folder| files(&folder, "rs"));
    let endings = [format!("{module};"), format!("{module} {{")];
    let is_one = |line: &str| {
        line.contains("mod ") && endings.iter().any(|ending| line.ends_with(ending.as_str()))
    };
    sources.filter(|path| read(path).lines().any(is_one)).map(|path| name(&path)).collect()
}

/// Entries of a folder, in order; an empty list if the folder does not exist.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<_> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// The text between `<!-- mark:begin -->` and `<!-- mark:end -->`.
fn between<'a>(text: &'a str, mark: &str) -> &'a str {
    let (begin, end) = (format!("<!-- {mark}:begin -->"), format!("<!-- {mark}:end -->"));
    let inner = text.split_once(&begin).and_then(|(_, rest)| rest.split_once(&end));
    inner.unwrap_or_else(|| panic!("`{begin}` ... `{end}` is missing")).0
}

/// Fails with all findings in one message.
#[track_caller]
fn report(rule: &str, findings: &[String]) {
    assert!(findings.is_empty(), "{rule}:\n  {}", findings.join("\n  "));
}

#[test]
fn no_other_module_has_the_name_of_one_that_is_a_check_by_itself() {
    for (filter, files) in [
        (RULES, &["xtask/tests/rules.rs"][..]),
        (DOCUMENTS, &["mbs-cli/tests/command/main.rs", "xtask/tests/tidy/mod.rs"]),
    ] {
        assert_eq!(modules_named(filter.trim_end_matches(':')), files, "{filter}");
    }
}
