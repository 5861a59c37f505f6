//! `cargo xtask bundle`: the part of three.js that pages contain, as one text. No build needs node: the text is in the repository.

use crate::process::{root, run, target_dir};
use std::fs;
use std::process::{Command, ExitCode};

/// Files that the bundle is made of, and the two that it leaves.
const SOURCES: [&str; 7] = [
    ".npmrc",
    "bundle.mjs",
    "entry.js",
    "package.json",
    "package-lock.json",
    "three.txt",
    "LICENSE",
];
/// Files that are written back.
const RESULTS: [&str; 2] = ["three.txt", "LICENSE"];

/// Bundles it anew with the versions of its lock file. The text stays as it is where the script in it does.
pub fn bundle() -> ExitCode {
    match bundled() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!(
                "{message}\nThe bundle needs node 20 with npm, and a registry of its packages."
            );
            ExitCode::FAILURE
        }
    }
}

/// In a copy of the folder, so that no package of node comes into ours.
fn bundled() -> Result<(), String> {
    let here = root().join("mbs-report/src/page/web/three");
    let copy = target_dir().join("bundle");
    let copied = |from: &std::path::Path, to: &std::path::Path| {
        fs::copy(from, to).map(drop).map_err(|e| format!("{}: {e}", from.display()))
    };
    fs::create_dir_all(&copy).map_err(|e| format!("{}: {e}", copy.display()))?;
    for name in SOURCES {
        copied(&here.join(name), &copy.join(name))?;
    }
    run(Command::new("npm").args(["ci", "--no-audit", "--no-fund"]).current_dir(&copy))?;
    run(Command::new("node").arg("bundle.mjs").current_dir(&copy))?;
    RESULTS.iter().try_for_each(|name| copied(&copy.join(name), &here.join(name)))
}
