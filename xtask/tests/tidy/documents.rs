//! Rules for scenes and documents.

use super::{between, entries, files, name, read, report};
use std::collections::BTreeSet;
use toml::Table;
use xtask::process::root;

/// Markdown files that a reader expects in the root folder.
const DOCUMENTS: [&str; 4] = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md"];

/// Largest length of ARCHITECTURE.md, in lines: it must be short enough to be read at once.
const MAX_ARCHITECTURE: usize = 150;

/// Largest length of README.md, in lines: one screen.
const MAX_README: usize = 45;

/// The names in `scenes/`, without their ending.
fn scenes() -> BTreeSet<String> {
    let files = entries(&root().join("scenes"));
    let files = files.iter().filter(|path| path.extension().is_some_and(|e| e == "toml"));
    files.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect()
}

#[test]
fn the_gallery_lists_exactly_the_scenes_there_are() {
    let gallery = read("docs/GALLERY.md");
    let rows = between(&gallery, "scenes").lines().filter_map(|line| line.strip_prefix("| `"));
    let listed: BTreeSet<_> =
        rows.filter_map(|row| Some(row.split_once('`')?.0.to_owned())).collect();
    let scenes = scenes();
    assert!(scenes.len() >= 10, "ten scenes at least, found {}", scenes.len());
    let odd = listed.symmetric_difference(&scenes);
    let findings: Vec<_> = odd.map(|name| format!("scenes/{name}.toml")).collect();
    report("docs/GALLERY.md lists exactly the scenes there are", &findings);
    let picture = |name: &String| format!("pictures/scene-{name}.png");
    let is_drawn = |picture: &String| {
        gallery.contains(picture.as_str()) && root().join("docs").join(picture).is_file()
    };
    let findings: Vec<_> = scenes.iter().map(picture).filter(|name| !is_drawn(name)).collect();
    report("Each scene has a picture in docs/GALLERY.md: `cargo xtask pictures NAME`", &findings);
}

#[test]
fn every_scene_says_what_it_shows() {
    let mut findings = Vec::new();
    for name in scenes() {
        let text = read(format!("scenes/{name}.toml"));
        let table: Table = text.parse().unwrap_or_else(|e| panic!("scenes/{name}.toml: {e}"));
        if !text.starts_with("# ") || !table.contains_key("scene") || !table.contains_key("output")
        {
            findings.push(format!("scenes/{name}.toml"));
        }
    }
    report("A scene begins with a comment and has a [scene] and an [[output]]", &findings);
}

#[test]
fn documents_are_there() {
    let findings: Vec<_> = DOCUMENTS
        .iter()
        .chain(&["LICENSE-MIT", "LICENSE-APACHE", "docs/NOTATION.md"])
        .filter(|name| !root().join(name).is_file())
        .map(|name| (*name).to_owned())
        .collect();
    report("These documents are expected", &findings);
    assert!(read("ARCHITECTURE.md").lines().count() <= MAX_ARCHITECTURE);
    assert!(read("README.md").lines().count() <= MAX_README, "README.md is one screen");
}

#[test]
fn the_summary_lists_every_document() {
    let summary = read("docs/SUMMARY.md");
    let mut findings: Vec<_> =
        files(&root().join("docs"), "md").iter().map(|path| name(path)).collect();
    findings.retain(|path| {
        let file = path.trim_start_matches("docs/");
        file != "SUMMARY.md" && !summary.contains(&format!("]({file})"))
    });
    report("docs/SUMMARY.md, the table of contents of a book, lists every document", &findings);
}

#[test]
fn changelog_has_an_unreleased_section() {
    assert!(read("CHANGELOG.md").lines().any(|line| line == "## [Unreleased]"));
}
