//! Rules for packages, checked on `cargo metadata`: allowed licences, allowed sources, no package in two versions without a reason, and the
//! required keys of a published crate.

use super::{read, report};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use xtask::process::{cargo, root};

/// Allowed licences of linked packages and of those used in builds; each can be combined with the licences of this repository.
const LICENCES: [&str; 9] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "Zlib",
    "Unicode-3.0",
    "Unlicense",
];

/// Packages in more than one version, each with the reason why this is accepted.
const TWICE: [(&str, &str); 1] =
    [("glam", "optional conversions of nalgebra, never built; they are in the lock file alone")];

/// Metadata by cargo of a manifest of the repository with its lock file. Missing packages are downloaded.
fn metadata(manifest: &str) -> Value {
    let ask = |more: &[&str]| {
        let mut command = cargo();
        command.args([
            "metadata",
            "--format-version",
            "1",
            "--locked",
            "--manifest-path",
            manifest,
        ]);
        command.args(more).current_dir(root()).output().expect("cargo is here")
    };
    let mut out = ask(&["--offline"]);
    if !out.status.success() {
        out = ask(&[]);
    }
    assert!(out.status.success(), "{manifest}: {}", String::from_utf8_lossy(&out.stderr));
    serde_json::from_slice(&out.stdout).expect("cargo metadata is JSON")
}

fn packages(metadata: &Value) -> &[Value] {
    metadata["packages"].as_array().expect("packages are a list")
}

fn text<'a>(package: &'a Value, key: &str) -> &'a str {
    package[key].as_str().unwrap_or_default()
}

/// True if an SPDX expression allows a choice from the list. `AND` requires all its parts, `OR` (formerly `/`) one of them. An expression
/// in parentheses is a part of `AND`.
fn is_allowed(expression: &str) -> bool {
    let one_of = |choices: &str| {
        choices.split(" OR ").any(|all| all.split(" AND ").all(|name| LICENCES.contains(&name)))
    };
    let plain = expression.replace('/', " OR ");
    if !plain.contains('(') {
        return one_of(&plain);
    }
    let joined =
        |part: &'_ str| part.trim_start_matches(" AND").trim_end_matches("AND ").trim().to_owned();
    plain.split(['(', ')']).map(joined).filter(|part| !part.is_empty()).all(|part| one_of(&part))
}

#[test]
fn licences_are_read_as_expressions() {
    for good in [
        "MIT OR Apache-2.0",
        "MIT/Apache-2.0",
        "(MIT OR Apache-2.0) AND Unicode-3.0",
        "(MIT OR Apache-2.0) AND (ISC)",
        "GPL-3.0 OR MIT",
    ] {
        assert!(is_allowed(good), "{good}");
    }
    for bad in ["", "GPL-3.0", "MIT AND GPL-3.0", "(MIT OR Apache-2.0) AND GPL-3.0"] {
        assert!(!is_allowed(bad), "{bad}");
    }
}

#[test]
fn every_dependency_has_a_licence_and_a_source_of_the_lists() {
    let metadata = metadata("Cargo.toml");
    let mut findings = Vec::new();
    for package in packages(&metadata) {
        let (name, licence) = (text(package, "name"), text(package, "license"));
        if !is_allowed(licence) {
            findings.push(format!("{name}: licence `{licence}`"));
        }
        let source = &package["source"];
        let is_of_registry =
            |source: &str| source.starts_with("registry+") && source.ends_with("/crates.io-index");
        if !source.is_null() && !source.as_str().is_some_and(is_of_registry) {
            findings.push(format!("{name}: source {source}"));
        }
    }
    report("Dependencies have a licence of the list and come from the registry", &findings);
}

/// Lock files of the other peers are used by the checks that build them.
#[test]
fn our_side_of_the_peers_has_the_versions_of_its_lock_file() {
    let metadata = metadata("lab/peers/ours/Cargo.toml");
    assert!(packages(&metadata).iter().any(|package| text(package, "name") == "mbs"));
}

#[test]
fn no_package_comes_twice_without_a_reason() {
    let metadata = metadata("Cargo.toml");
    let mut versions: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for package in packages(&metadata) {
        versions.entry(text(package, "name")).or_default().insert(text(package, "version"));
    }
    let is_listed = |name: &str| TWICE.iter().any(|(twice, _)| *twice == name);
    let twice = versions.iter().filter(|(_, versions)| versions.len() > 1);
    let found: BTreeSet<&str> = twice.map(|(name, _)| *name).collect();
    let mut findings: Vec<String> = found
        .iter()
        .filter(|name| !is_listed(name))
        .map(|name| format!("{name}: {:?}", versions[name]))
        .collect();
    let once = TWICE.iter().filter(|(name, _)| !found.contains(name));
    findings.extend(once.map(|(name, _)| format!("{name} is in the list and comes once")));
    report("Packages come in one version, but for a list with reasons", &findings);
}

#[test]
fn crates_that_are_published_say_what_they_are() {
    let metadata = metadata("Cargo.toml");
    let members = packages(&metadata).iter().filter(|package| package["source"].is_null());
    let is_published = |package: &&Value| package["publish"].is_null();
    let mut findings = Vec::new();
    for package in members.filter(is_published) {
        let name = text(package, "name");
        for key in ["description", "license", "readme", "rust_version"] {
            if text(package, key).is_empty() {
                findings.push(format!("{name}: no {key}"));
            }
        }
        for key in ["keywords", "categories"] {
            if package[key].as_array().is_none_or(Vec::is_empty) {
                findings.push(format!("{name}: no {key}"));
            }
        }
        for file in ["LICENSE-MIT", "LICENSE-APACHE"] {
            if read(root().join(name).join(file)) != read(file) {
                findings.push(format!("{name}: {file} is not that of the repository"));
            }
        }
        let dependencies = package["dependencies"].as_array().into_iter().flatten();
        for dependency in dependencies.filter(|dependency| dependency["path"].is_string()) {
            let (is_dev, has_version) =
                (text(dependency, "kind") == "dev", text(dependency, "req") != "*");
            if is_dev == has_version {
                let rule = if is_dev { "no version, as it is for tests" } else { "a version" };
                findings.push(format!("{name}: {} needs {rule}", text(dependency, "name")));
            }
        }
    }
    report("Published crates say what they are, and depend on each other by version", &findings);
}
