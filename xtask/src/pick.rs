//! The job `cargo xtask pick`: builds and runs each package of `examples/pick`, which uses mbs-core and one formulation alone.

use crate::process::{self, cargo, output, run};
use crate::summary::{self, Outcome};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Crates that must not depend on external linear algebra or threads.
const LEAN: [&str; 3] = ["mbs-core", "mbs-recursive", "mbs-nostd"];
/// Crates on which those of [`LEAN`] must not depend.
const HEAVY: [&str; 2] = ["faer", "rayon"];

/// Runs only this check.
pub fn pick() -> ExitCode {
    summary::ended("pick", check())
}

/// Runs every package, and checks the dependencies of the packages and of the lean crates.
///
/// # Errors
///
/// The first package that fails, or a dependency that is not allowed.
pub(crate) fn check() -> Result<Outcome, String> {
    let mut names = Vec::new();
    for folder in packages(&process::root().join("examples/pick")) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let manifest = folder.join("Cargo.toml");
        run(on("run", &manifest).arg("--quiet"))?;
        let tree = tree(&mut on("tree", &manifest))?;
        let ours: BTreeSet<_> = tree.iter().filter(|name| name.starts_with("mbs-")).collect();
        // all depend on mbs-math; packages with threads need mbs-parallel and a solver, controllers need the recursive formulation
        let most = if tree.contains("mbs-parallel") {
            5
        } else {
            3 + usize::from(tree.contains("mbs-nostd"))
        };
        if ours.len() > most || !tree.contains("mbs-core") {
            return Err(format!("`{name}` is for mbs-core and one formulation, and has {ours:?}"));
        }
        names.push(name);
    }
    if names.is_empty() {
        return Err("examples/pick holds no package".to_owned());
    }
    for name in LEAN.iter().filter(|name| process::root().join(name).is_dir()) {
        let mut command = cargo();
        let tree = tree(command.args(["tree", "--package", name]).current_dir(process::root()))?;
        if let Some(heavy) = HEAVY.iter().find(|heavy| is_within(heavy, &tree)) {
            return Err(format!("{name} pulls in {heavy}"));
        }
    }
    Ok(Outcome::Passed(names.join(", ")))
}

/// The folders under `folder` that contain a package, in order.
fn packages(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut folders: Vec<_> = entries.map(|entry| entry.path()).collect();
    folders.retain(|path| path.join("Cargo.toml").is_file());
    folders.sort();
    folders
}

/// A cargo command on one package of the workspace `examples/pick`, with the committed lock file. It works offline if all packages are
/// here. Features are those of this package alone.
fn on(subcommand: &str, manifest: &Path) -> Command {
    let mut probe = cargo();
    probe.args(["metadata", "--format-version", "1", "--locked", "--offline", "--manifest-path"]);
    let is_here = output(probe.arg(manifest)).is_some();
    let mut command = cargo();
    command.args([subcommand, "--locked", "--manifest-path"]).arg(manifest);
    if is_here {
        command.arg("--offline");
    }
    command.env("CARGO_TARGET_DIR", process::target_dir().join("pick"));
    command
}

/// The names in a dependency tree.
///
/// # Errors
///
/// The command, if it fails.
fn tree(command: &mut Command) -> Result<BTreeSet<String>, String> {
    command.args(["--edges", "normal", "--prefix", "none"]);
    let text = output(command).ok_or_else(|| format!("`{}` failed", process::line(command)))?;
    Ok(names(&text))
}

/// The first word of each line of a tree, the name of a package.
fn names(tree: &str) -> BTreeSet<String> {
    tree.lines().filter_map(|line| Some(line.split_whitespace().next()?.to_owned())).collect()
}

/// True if a tree contains a crate, or a part of its family such as `faer-traits`.
fn is_within(name: &str, tree: &BTreeSet<String>) -> bool {
    tree.iter().any(|other| {
        other.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_tree_are_its_first_words() {
        let tree = names("mbs-core v0.1.0 (/here)\nlibm v0.2.16\nlibm v0.2.16 (*)\n\n");
        assert_eq!(tree.into_iter().collect::<Vec<_>>(), ["libm", "mbs-core"]);
    }

    #[test]
    fn families_are_recognised() {
        let tree = names("mbs-sparse v0.1.0\nfaer-traits v0.24.0\nrayonet v1.0.0");
        assert!(is_within("faer", &tree));
        assert!(!is_within("rayon", &tree));
    }

    #[test]
    fn every_package_of_the_repository_is_found() {
        let folders = packages(&process::root().join("examples/pick"));
        assert!(folders.iter().any(|folder| folder.ends_with("augmented")), "{folders:?}");
    }
}
