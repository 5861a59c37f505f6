//! Rules for dependencies: ARCHITECTURE.md lists the edges between crates and names every external one.

use super::{between, crate_folders, read, report};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use toml::{Table, Value};

/// The tables of a manifest that contain dependencies.
const BUILD_TABLES: [&str; 2] = ["dependencies", "build-dependencies"];
const ALL_TABLES: [&str; 3] = ["dependencies", "build-dependencies", "dev-dependencies"];

/// Names in one kind of table of a manifest, also under `[target.'...']`.
fn names(manifest: &Table, kinds: &[&str]) -> BTreeSet<String> {
    let targets = manifest.get("target").and_then(Value::as_table);
    let places = targets.into_iter().flat_map(Table::values).filter_map(Value::as_table);
    let tables = places.chain([manifest]);
    let mut names = BTreeSet::new();
    for table in tables {
        for dependencies in kinds.iter().filter_map(|kind| table.get(*kind)?.as_table()) {
            names.extend(dependencies.keys().cloned());
        }
    }
    names
}

/// Crate name and manifest of every crate.
fn manifests() -> BTreeMap<String, Table> {
    let manifest = |folder: &Path| -> (String, Table) {
        let table: Table = read(folder.join("Cargo.toml")).parse().expect("a manifest is TOML");
        let name = table["package"]["name"].as_str().expect("a crate has a name").to_owned();
        (name, table)
    };
    crate_folders().iter().map(|folder| manifest(folder)).collect()
}

/// The edges written in ARCHITECTURE.md: lines `crate -> crate, crate` or `crate -> nothing`.
fn written_edges(architecture: &str) -> BTreeMap<String, BTreeSet<String>> {
    let lines = between(architecture, "edges").lines().filter_map(|line| line.split_once("->"));
    let words = |text: &str| -> BTreeSet<String> {
        let words = text.split(',').map(str::trim).filter(|word| *word != "nothing");
        words.map(str::to_owned).collect()
    };
    lines.map(|(from, to)| (from.trim().to_owned(), words(to))).collect()
}

#[test]
fn crate_edges_are_those_of_the_architecture() {
    let manifests = manifests();
    let written = written_edges(&read("ARCHITECTURE.md"));
    let mut findings = Vec::new();
    for (name, manifest) in &manifests {
        let mut built = names(manifest, &BUILD_TABLES);
        built.retain(|dependency| manifests.contains_key(dependency));
        if written.get(name) != Some(&built) {
            let built: Vec<_> = built.into_iter().collect();
            findings.push(format!("`{name} -> {}` is not in the list", built.join(", ")));
        }
    }
    for name in written.keys().filter(|name| !manifests.contains_key(*name)) {
        findings.push(format!("`{name}` is in the list and is no crate"));
    }
    report("The list of edges in ARCHITECTURE.md equals the Cargo.toml files", &findings);
}

#[test]
fn every_external_dependency_has_its_reason_in_the_architecture() {
    let manifests = manifests();
    let architecture = read("ARCHITECTURE.md");
    let reasons = between(&architecture, "dependencies");
    let mut findings = Vec::new();
    for (name, manifest) in &manifests {
        for dependency in names(manifest, &ALL_TABLES) {
            let is_named = reasons.contains(&format!("`{dependency}`"));
            if !manifests.contains_key(&dependency) && !is_named {
                findings.push(format!("`{dependency}`, used by {name}"));
            }
        }
    }
    report("ARCHITECTURE.md says why for every external dependency", &findings);
}
