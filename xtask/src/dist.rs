//! The job `cargo xtask dist`: makes the files of a release in `target/dist`, and tries each without a compiler.

mod archive;
mod build;
mod trial;
mod wheel;

use crate::process;
use crate::python;
use crate::summary::{self, Outcome};
use build::Build;
use clap::{Args, ValueEnum};
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};
use trial::{emptied, quietly};

/// Name of the file with the checksums, in the form that `sha256sum --check` reads.
const SUMS: &str = "SHA256SUMS";

/// Program that prints the checksums of the named files, in the form of `sha256sum`.
const SUM: &str = "import hashlib, pathlib, sys
for name in sys.argv[1:]:
    print(hashlib.sha256(pathlib.Path(name).read_bytes()).hexdigest(), name, sep='  ')";

/// Options of the job.
#[derive(Debug, Args)]
pub struct Options {
    /// Make this file alone
    #[arg(long)]
    only: Option<Part>,
    /// Target of the command; it must run on this machine. Default: the target of the compiler. The wheel is for the compiler's
    #[arg(long, value_name = "TRIPLE", requires = "only")]
    target: Option<String>,
    /// Another profile of cargo, for a trial of the job itself
    #[arg(long, default_value = "dist", hide = true)]
    profile: String,
}

/// A file of a release.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The command, with licences, manual pages and completions
    Archive,
    /// The Python package
    Wheel,
}

/// Makes the files and tries them.
pub fn dist(options: &Options) -> ExitCode {
    summary::ended("dist", made(options).map(Outcome::Passed))
}

/// Makes and tries the files. Returns a remark on each.
fn made(options: &Options) -> Result<String, String> {
    let python =
        python::interpreter().ok_or("there is no Python of version 3.11 or later with venv")?;
    let place = process::target_dir().join("dist");
    let tries = process::target_dir().join("dist-tries");
    fs::create_dir_all(&place).map_err(|e| format!("{}: {e}", place.display()))?;
    for file in released(&place)? {
        fs::remove_file(place.join(&file)).map_err(|e| format!("{file}: {e}"))?;
    }
    let build = Build { profile: &options.profile, target: options.target.as_deref() };
    let is_made = |part| options.only.is_none_or(|only| only == part);
    let mut remarks = Vec::new();
    if is_made(Part::Archive) {
        let archive = archive::made(&build, &place)?;
        let seconds = archive::tried(&archive, &emptied(&tries.join("archive"))?)?;
        remarks.push(remark(&archive, &format!("tried in {seconds:.1} s"))?);
    }
    if is_made(Part::Wheel) {
        let wheel = wheel::made(&build, &python, &place)?;
        let tried = wheel::tried(&wheel, &python, &emptied(&tries.join("wheel"))?)?;
        remarks.push(remark(&wheel, &tried)?);
    }
    let files = released(&place)?;
    let mut sum = Command::new(&python);
    let sums = quietly(sum.args(["-c", SUM]).args(&files).current_dir(&place))?;
    process::write(&place.join(SUMS), sums.as_bytes())?;
    Ok(format!("\n  {}", remarks.join("\n  ")))
}

/// The names of released files in the folder, in order. Cargo's own files in the folder are left out.
fn released(place: &Path) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(place).map_err(|e| format!("{}: {e}", place.display()))?;
    let mut names: Vec<String> =
        entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.retain(|name| name.ends_with(".whl") || name.ends_with(".tar.gz") || name == SUMS);
    names.sort_unstable();
    Ok(names)
}

/// A file's name and size, and the result of its trial.
fn remark(file: &Path, tried: &str) -> Result<String, String> {
    /// Bytes of a megabyte.
    const MEGABYTE: f64 = 1e6;
    let size = fs::metadata(file).map_err(|e| format!("{}: {e}", file.display()))?.len();
    let name = file.file_name().unwrap_or_default().display();
    Ok(format!("{name}: {:.2} MB; {tried}", size as f64 / MEGABYTE))
}
