//! Test of the commands in documents. Each command runs, in the order of its document, in a folder with the files that the document writes.
//! Outputs that are shown must have the numbers of the command. CONTRIBUTING.md describes the marks.

mod compare;
mod steps;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use steps::Step;

/// Root folder of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The documents that contain commands for readers.
fn documents() -> Vec<PathBuf> {
    let mut found = vec![root().join("README.md")];
    for folder in [root().join("docs"), root()] {
        let entries = fs::read_dir(folder).expect("the repository is there").flatten();
        found.extend(entries.filter_map(|entry| match entry.path() {
            path if path.extension().is_some_and(|end| end == "md") => Some(path),
            path => Some(path.join("README.md")).filter(|readme| readme.is_file()),
        }));
    }
    found.retain(|path| !path.ends_with("CHANGELOG.md"));
    found.sort();
    found.dedup();
    found
}

/// Makes the folder in which a document's commands run. It is new, and contains the scenes of the repository.
fn folder(document: &Path) -> PathBuf {
    let name: String =
        document.strip_prefix(root()).expect("of the repository").display().to_string();
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join("documents").join(name.replace('/', "-"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the directory is ours");
    let scenes = root().join("scenes").canonicalize().expect("scenes are there");
    std::os::unix::fs::symlink(scenes, folder.join("scenes")).expect("the directory is ours");
    folder
}

/// Runs a line in a shell that finds the `mbs` of the test. Returns its output, or a message if its status is wrong.
fn ran(line: &str, status: i32, folder: &Path) -> Result<String, String> {
    let ours = Path::new(env!("CARGO_BIN_EXE_mbs")).parent().expect("a directory");
    let others = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new("sh");
    command.args(["-c", line]).current_dir(folder);
    // without a display no browser opens
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command.env("PATH", format!("{}:{others}", ours.display()));
    let output = command.output().expect("there is a shell");
    let said = format!("{}{}", super::text(&output.stdout), super::text(&output.stderr));
    // status 3: this build lacks a precision, which a complete build has
    let is_lean = cfg!(not(all(feature = "f32", feature = "dd"))) && super::status(&output) == 3;
    if super::status(&output) == status || is_lean {
        Ok(said)
    } else {
        Err(format!("status {} is not {status}:\n{said}", super::status(&output)))
    }
}

/// Follows the steps of a document. Returns faults with their lines, and the number of commands.
fn followed(document: &Path) -> (Vec<String>, usize) {
    let text = fs::read_to_string(document).expect("it is there");
    let place = folder(document);
    let (mut faults, mut count, mut said) = (Vec::new(), 0, String::new());
    for (line, step) in steps::of(&text) {
        let result = match step {
            Step::Command { text, status } => {
                count += 1;
                ran(&text, status, &place)
                    .map(|text| said = text)
                    .map_err(|e| format!("`{text}`: {e}"))
            }
            Step::File { name, text } => {
                fs::write(place.join(name), text).map_err(|e| e.to_string())
            }
            Step::Change { name, lines } => steps::change(&place.join(name), &lines),
            Step::Shown(shown) => compare::shown(&shown, &said),
            Step::Fault(fault) => Err(fault),
        };
        if let Err(fault) = result {
            faults.push(format!("{}:{line}: {fault}", document.display()));
        }
    }
    (faults, count)
}

#[test]
fn commands_of_the_documents_run_and_give_what_is_shown() {
    let all = documents();
    let results: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = all.iter().map(|path| scope.spawn(|| followed(path))).collect();
        threads.into_iter().map(|thread| thread.join().expect("it ends")).collect()
    });
    let faults: Vec<String> = results.iter().flat_map(|(faults, _)| faults.clone()).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
    let commands: usize = results.iter().map(|(_, count)| count).sum();
    assert!(commands >= 15, "{commands} commands were found");
}
