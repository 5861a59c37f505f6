//! Trials of the files of a release: commands run without a compiler, and must write certain files.

use crate::process;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Makes the folder empty.
pub(super) fn emptied(folder: &Path) -> Result<PathBuf, String> {
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(folder.to_owned())
}

/// Lets a command find no other program: the search path has one folder, and no variable names a compiler.
pub(super) fn apart<'a>(command: &'a mut Command, path: &Path) -> &'a mut Command {
    for (name, _) in env::vars_os() {
        let is_of_compiler = |name: &str| name.starts_with("CARGO") || name.starts_with("RUST");
        if name.to_str().is_some_and(is_of_compiler) {
            command.env_remove(name);
        }
    }
    command.env("PATH", path)
}

/// The standard output of a command.
///
/// # Errors
///
/// The command with its outputs, if it fails.
pub(super) fn quietly(command: &mut Command) -> Result<String, String> {
    let line = process::line(command);
    let ended = command.stdin(Stdio::null()).output();
    let ended = ended.map_err(|e| format!("cannot start `{line}`: {e}"))?;
    let said = String::from_utf8_lossy(&ended.stdout).into_owned();
    let error = String::from_utf8_lossy(&ended.stderr);
    if ended.status.success() { Ok(said) } else { Err(format!("`{line}`: {said}{error}")) }
}

/// Runs the README's example with a command. Returns the seconds that it takes.
pub(super) fn example(mbs: &Path, folder: &Path) -> Result<f64, String> {
    let clock = Instant::now();
    for words in [
        &["new", "crank-rocker"][..],
        &["run", "crank-rocker.toml", "--out", "out"],
        &["diff", "out", "crank-rocker.toml", "--within", "1e-9"],
        &["run", "crank-rocker.toml", "--precision", "dd", "--step", "1e-2", "--no-estimate"],
    ] {
        let path = mbs.parent().unwrap_or(mbs);
        quietly(apart(Command::new(mbs).args(words).current_dir(folder), path))?;
    }
    for file in ["out/run.html", "out/run.csv"] {
        is_filled(&folder.join(file))?;
    }
    Ok(clock.elapsed().as_secs_f64())
}

/// Checks that the file exists and is not empty.
pub(super) fn is_filled(file: &Path) -> Result<(), String> {
    let is_filled = fs::metadata(file).is_ok_and(|file| file.len() > 0);
    is_filled.then_some(()).ok_or_else(|| format!("{} is missing or empty", file.display()))
}
