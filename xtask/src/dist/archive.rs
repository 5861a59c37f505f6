//! The archive of the command: the binary, licences, manual pages, completions.

use super::build::{Build, VERSION};
use super::trial::{apart, emptied, example, is_filled, quietly};
use crate::process::{self, cargo, root, run, target_dir};
use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Shells with completions in the archive.
const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

/// Files of the repository that the archive contains.
const FILES: [&str; 4] = ["LICENSE-APACHE", "LICENSE-MIT", "README.md", "CHANGELOG.md"];

/// Largest size of the command with all precisions, in bytes: it had 29.6 million on 29 November 2026. The bound is raised by hand, when a
/// larger command is worth it.
const MOST_BYTES: u64 = 31_000_000;

/// Packages and features with which cargo builds the command. The package of the wheel is selected too: so features of dependencies are the
/// same in both builds, and nothing is compiled twice.
pub(super) const SELECTION: [&str; 7] = [
    "--package",
    "mbs-cli",
    "--package",
    "mbs-python",
    "--no-default-features",
    "--features",
    "mbs-cli/f32,mbs-cli/dd",
];

/// Builds the command and packs it. Returns the path of the archive.
pub(super) fn made(build: &Build<'_>, place: &Path) -> Result<PathBuf, String> {
    let mut command = cargo();
    command.args(["build", "--locked", "--bin", "mbs", "--profile", build.profile]).args(SELECTION);
    command.arg("--target-dir").arg(target_dir()).current_dir(root());
    if let Some(target) = build.target {
        command.args(["--target", target]);
    }
    run(build.strip(&mut command))?;
    let name = format!("mbs-{VERSION}-{}", build.target()?);
    let staged = emptied(&place.join(&name))?;
    if build.profile == "dist" {
        within(&build.folder().join(format!("mbs{EXE_SUFFIX}")), MOST_BYTES)?;
    }
    packed(&build.folder().join(format!("mbs{EXE_SUFFIX}")), &staged)?;
    let archive = format!("{name}.tar.gz");
    run(Command::new("tar").args(["-czf", &archive, &name]).current_dir(place))?;
    fs::remove_dir_all(&staged).map_err(|e| format!("{}: {e}", staged.display()))?;
    Ok(place.join(archive))
}

/// Fails if a program is larger than `most` bytes.
fn within(built: &Path, most: u64) -> Result<(), String> {
    let name = built.display();
    let bytes = fs::metadata(built).map_err(|e| format!("{name}: {e}"))?.len();
    if bytes > most {
        return Err(format!(
            "{name} has {bytes} bytes, and may have {most}: what grew? Raise the bound by hand where it is worth its size"
        ));
    }
    Ok(())
}

/// Copies the command and the other files of the archive into a folder.
fn packed(built: &Path, folder: &Path) -> Result<(), String> {
    let copy = |from: &Path| {
        let to = folder.join(from.file_name().unwrap_or_default());
        fs::copy(from, to).map(drop).map_err(|e| format!("{}: {e}", from.display()))
    };
    copy(built)?;
    for file in FILES {
        copy(&root().join(file))?;
    }
    quietly(Command::new(built).arg("man").arg(folder.join("man")))?;
    let completions = folder.join("completions");
    fs::create_dir(&completions).map_err(|e| format!("{}: {e}", completions.display()))?;
    for shell in SHELLS {
        let text = quietly(Command::new(built).args(["completions", shell]))?;
        let file = completions.join(format!("mbs.{shell}"));
        fs::write(&file, text).map_err(|e| format!("{}: {e}", file.display()))?;
    }
    Ok(())
}

/// Unpacks the archive into a folder and runs the README's example with it. Returns the seconds that the example takes.
pub(super) fn tried(archive: &Path, folder: &Path) -> Result<f64, String> {
    // tar gets the name without a folder: it reads text before a colon as the name of a machine
    let name = archive.file_name().unwrap_or_default().to_string_lossy();
    fs::copy(archive, folder.join(&*name)).map_err(|e| format!("{name}: {e}"))?;
    run(Command::new("tar").args(["-xzf", &name]).current_dir(folder))?;
    let unpacked = folder.join(name.trim_end_matches(".tar.gz"));
    for file in FILES.iter().chain(&["man/mbs.1", "completions/mbs.bash"]) {
        is_filled(&unpacked.join(file))?;
    }
    let mbs = unpacked.join(format!("mbs{EXE_SUFFIX}"));
    let version = quietly(apart(Command::new(&mbs).arg("--version"), folder))?;
    if version.trim() != format!("mbs {VERSION}") {
        return Err(format!("{} says {version}", process::line(&Command::new(&mbs))));
    }
    example(&mbs, folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::process::built_packages;

    #[test]
    fn a_command_beyond_its_bound_fails() {
        let file = root().join(FILES[2]);
        let bytes = fs::metadata(&file).expect("a README").len();
        assert!(within(&file, bytes).is_ok());
        assert!(within(&file, bytes - 1).expect_err("it is larger").contains("Raise the bound"));
    }

    #[test]
    fn the_command_of_a_release_stands_on_what_the_wheel_stands_on() {
        let edges = ["--edges", "normal,build"];
        let command = built_packages(&[&SELECTION[..], &edges].concat());
        let wheel = built_packages(&[&["--package", "mbs-python"][..], &edges].concat());
        let others: Vec<&String> = command
            .difference(&wheel)
            .filter(|package| !package.starts_with("mbs-python "))
            .collect();
        assert!(others.is_empty(), "these are compiled twice: {others:?}");
    }
}
