//! The job `cargo xtask package`: packages every crate, and builds the contents of the packages.

use crate::process::{self, cargo, output, run};
use crate::summary::{self, Outcome};
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

/// Runs only this check.
pub fn package() -> ExitCode {
    summary::ended("package", check())
}

/// Packages all crates, unpacks them, and builds the command from the unpacked files alone.
///
/// # Errors
///
/// The first crate or command that cannot be packaged, unpacked or built.
pub(crate) fn check() -> Result<Outcome, String> {
    let packed = process::target_dir().join("package");
    let unpacked = packed.join("unpacked");
    let io = |e: std::io::Error| format!("{}: {e}", packed.display());
    if packed.exists() {
        fs::remove_dir_all(&packed).map_err(io)?;
    }
    // without cargo's own verification: it would use unpacked packages of an earlier run with the same version
    run(cargo()
        .args(["package", "--workspace", "--no-verify", "--allow-dirty", "--quiet"])
        .current_dir(process::root()))?;
    fs::create_dir_all(&unpacked).map_err(io)?;
    let mut names = Vec::new();
    for entry in fs::read_dir(&packed).map_err(io)?.flatten() {
        let path = entry.path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if path.extension().is_some_and(|end| end == "crate") {
            run(Command::new("tar").arg("-xzf").arg(&path).arg("-C").arg(&unpacked))?;
            names.push(stem);
        }
    }
    names.sort_unstable();
    build(&unpacked, &names)?;
    Ok(Outcome::Passed(names.join(", ")))
}

/// Builds the unpacked command with the unpacked crates in place of those of the registry.
fn build(unpacked: &Path, names: &[String]) -> Result<(), String> {
    let (crates, members): (Vec<_>, Vec<_>) = names
        .iter()
        .filter_map(|full| Some((full.rsplit_once('-')?.0, full)))
        .map(|(name, full)| (format!("{name} = {{ path = \"{full}\" }}\n"), format!("\"{full}\"")))
        .unzip();
    let manifest = format!(
        "[workspace]\nresolver = \"3\"\nmembers = [{}]\n[patch.crates-io]\n{}",
        members.join(", "),
        crates.concat()
    );
    let path = unpacked.join("Cargo.toml");
    fs::write(&path, manifest).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut command = cargo();
    command.args(["check", "--quiet", "--workspace", "--target-dir"]).arg(unpacked.join("target"));
    run(command.current_dir(unpacked))?;
    let help = ["run", "--quiet", "--package", "mbs-cli", "--target-dir"];
    let mut command = cargo();
    command.args(help).arg(unpacked.join("target")).args(["--", "--version"]);
    let version =
        output(command.current_dir(unpacked)).ok_or("the packaged command does not run")?;
    version.starts_with("mbs ").then_some(()).ok_or(format!("the packaged command says {version}"))
}
