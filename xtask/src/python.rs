//! The job `cargo xtask python`: builds the wheel of the Python package, and tests it in a clean virtual environment.

use crate::pages;
use crate::process::{self, output, run};
use crate::summary::{self, LeftOut, Outcome};
use crate::tally::{Tally, counted};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Oldest supported version of Python.
const OLDEST: [u32; 2] = [3, 11];

/// Runs only this check.
pub fn python() -> ExitCode {
    summary::ended("python", tests(tools(), &mut Tally::default()))
}

/// Virtual environments with the tools that build the package, and with the packages that its tests use.
#[derive(Debug)]
pub(crate) struct Tools {
    build: PathBuf,
    tests: PathBuf,
}

/// Makes the environments; `None` without a supported version of Python.
///
/// # Errors
///
/// The first command that fails.
pub(crate) fn tools() -> Result<Option<Tools>, String> {
    let Some(python) = interpreter() else { return Ok(None) };
    let build = environment(&python, &place().join("tools"))?;
    pip(&build, &["--requirement", "mbs-python/tools/requirements.txt"])?;
    let tests = environment(&python, &place().join("tested"))?;
    pip(&tests, &["--requirement", "mbs-python/tests/requirements.txt"])?;
    Ok(Some(Tools { build, tests }))
}

/// Builds the wheel with the features of the workspace's tests, and tests it together with packages that it works with. Counts the tests.
///
/// # Errors
///
/// The first command that fails.
pub(crate) fn tests(
    tools: Result<Option<Tools>, String>,
    tally: &mut Tally,
) -> Result<Outcome, String> {
    let Some(Tools { build, tests }) = tools? else {
        let [major, minor] = OLDEST;
        return Ok(Outcome::LeftOut(LeftOut {
            why: format!("no Python of version {major}.{minor} or later with venv is installed"),
            remedy: "On Debian, as root: `apt-get install python3 python3-venv`.".to_owned(),
        }));
    };
    // pictures need a browser; a test without one reports that
    let _ = pages::browser();
    let wheel = wheel(&build)?;
    pip(&tests, &["--no-deps", "--force-reinstall", &wheel.display().to_string()])?;
    let mut pytest = in_environment(&tests);
    pytest.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"]);
    counted(pytest.current_dir(process::root().join("mbs-python")), Tally::read_python, tally)
}

/// Runs the notebooks, whose code is that of the examples.
///
/// # Errors
///
/// The first notebook that fails.
pub(crate) fn notebooks() -> Result<Outcome, String> {
    let tests = place().join("tested");
    pip(&tests, &["nbclient", "nbformat", "ipykernel", "matplotlib"])?;
    let folder = process::root().join("mbs-python");
    run(in_environment(&tests).args(["tools/notebooks.py", "--check"]).current_dir(&folder))?;
    run(in_environment(&tests).arg("tools/run_notebooks.py").current_dir(&folder))?;
    Ok(Outcome::Passed(String::new()))
}

/// The folder of wheels and environments.
fn place() -> PathBuf {
    process::target_dir().join("python")
}

/// The command of a supported Python that can make environments.
pub(crate) fn interpreter() -> Option<String> {
    let [major, minor] = OLDEST;
    let question =
        format!("import sys, venv, ensurepip; sys.exit(sys.version_info < ({major}, {minor}))");
    let names = ["python3", "python3.13", "python3.12", "python3.11", "python"];
    let fits = |name: &&str| output(Command::new(name).args(["-c", &question])).is_some();
    names.into_iter().find(fits).map(str::to_owned)
}

/// Makes a clean virtual environment.
pub(crate) fn environment(python: &str, at: &Path) -> Result<PathBuf, String> {
    run(Command::new(python).args(["-m", "venv", "--clear"]).arg(at))?;
    Ok(at.to_owned())
}

/// The Python of an environment. Tests fail if a package that they use is missing there.
pub(crate) fn in_environment(at: &Path) -> Command {
    let bin = at.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let mut command = Command::new(bin.join("python"));
    command.env("VIRTUAL_ENV", at).env("MBS_STRICT", "1").env_remove("PYTHONPATH");
    command
}

/// Installs packages into an environment.
///
/// # Errors
///
/// The command of pip and its exit status, if it fails.
pub(crate) fn pip(at: &Path, words: &[&str]) -> Result<(), String> {
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    run(in_environment(at).args(install).args(words).current_dir(process::root()))
}

/// Builds the wheel with the features of the workspace's tests, so that no dependency is compiled again.
fn wheel(tools: &Path) -> Result<PathBuf, String> {
    let wheels = place().join("wheels");
    let _ = fs::remove_dir_all(&wheels);
    let build = [
        "-m",
        "maturin",
        "build",
        "--quiet",
        "--profile",
        "dev",
        "--features",
        "as-tested",
        "--out",
    ];
    run(in_environment(tools)
        .args(build)
        .arg(&wheels)
        .env("CARGO_TARGET_DIR", process::target_dir())
        .current_dir(process::root().join("mbs-python")))?;
    let entries = fs::read_dir(&wheels).map_err(|e| format!("{}: {e}", wheels.display()))?;
    let wheel = entries.flatten().map(|entry| entry.path()).next();
    wheel.ok_or_else(|| "maturin built no wheel".to_owned())
}

#[cfg(test)]
mod tests {
    use crate::process::built_packages as built;

    #[test]
    fn the_wheel_has_the_features_of_the_tests_so_that_nothing_is_compiled_twice() {
        let wheel =
            ["--package", "mbs-python", "--features", "as-tested", "--edges", "normal,build"];
        let tests = built(&["--workspace", "--edges", "normal,build,dev"]);
        let others: Vec<_> = built(&wheel)
            .into_iter()
            .filter(|package| !package.starts_with("mbs-python ") && !tests.contains(package))
            .collect();
        assert!(others.is_empty(), "name the features of the tests in `as-tested`: {others:?}");
    }
}
