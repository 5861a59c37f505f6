//! The job `cargo xtask bundle`: makes the part of three.js that pages contain, as one text. The text is in the repository, so that no
//! build needs node.

use crate::process::{root, run, target_dir};
use std::fs;
use std::process::{Command, ExitCode};

/// Files from which the bundle is made, and the two that it writes.
const SOURCES: [&str; 7] = [
    ".npmrc",
    "bundle.mjs",
    "entry.js",
    "package.json",
    "package-lock.json",
    "three.txt",
    "LICENSE",
];
/// Files that are copied back to the repository.
const RESULTS: [&str; 2] = ["three.txt", "LICENSE"];

/// Makes the bundle again with the versions of its lock file. The result changes only if a source changes.
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

/// Makes the bundle in a copy of the folder, so that no package of node is written into the repository.
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
