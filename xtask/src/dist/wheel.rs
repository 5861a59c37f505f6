//! The wheel of the Python package for Linux systems with the oldest glibc that is supported, and its trial in a fresh environment.

use super::build::{Build, VERSION};
use super::trial::{apart, example, quietly};
use crate::process::{root, run, target_dir};
use crate::python;
use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Newest minor version of glibc 2 that a wheel may need: that of Ubuntu 22.04, Debian 12 and RHEL 9.
const MAX_GLIBC: u32 = 34;

/// Compression level of the wheel [-]: the highest of deflate, a method that every installer reads.
const COMPRESSION: &str = "9";

/// Program that determines the platform of a wheel from its symbols, independently of maturin.
const AUDITWHEEL: &str = "auditwheel==6.8.2";

/// Builds the wheel and checks its platform tag. Returns its path.
pub(super) fn made(build: &Build<'_>, python: &str, place: &Path) -> Result<PathBuf, String> {
    let tools = python::environment(python, &target_dir().join("python").join("tools"))?;
    python::pip(&tools, &["--requirement", "mbs-python/tools/requirements.txt"])?;
    let mut maturin = python::in_environment(&tools);
    maturin.args(["-m", "maturin", "build", "--locked", "--profile", build.profile]);
    maturin.args(["--strip", "--compression-level", COMPRESSION, "--out"]).arg(place);
    maturin.env("CARGO_TARGET_DIR", target_dir()).current_dir(root().join("mbs-python"));
    run(build.strip(&mut maturin))?;
    let entries = fs::read_dir(place).map_err(|e| format!("{}: {e}", place.display()))?;
    let mut wheels = entries.flatten().map(|entry| entry.path());
    let wheel = wheels.find(|path| path.extension().is_some_and(|end| end == "whl"));
    let wheel = wheel.ok_or("maturin built no wheel")?;
    if cfg!(target_os = "linux") {
        audited(&wheel, &tools)?;
    }
    Ok(wheel)
}

/// Checks that the wheel supports an old enough glibc, and that its symbols agree with the tag in its name.
fn audited(wheel: &Path, tools: &Path) -> Result<(), String> {
    let name = wheel.file_name().unwrap_or_default().to_string_lossy();
    let minor = glibc(&name).ok_or_else(|| format!("{name} has no manylinux tag"))?;
    if minor > MAX_GLIBC {
        return Err(format!(
            "{name} needs a newer glibc than 2.{MAX_GLIBC}: `auditwheel show` names its symbols"
        ));
    }
    python::pip(tools, &[AUDITWHEEL])?;
    let mut show = python::in_environment(tools);
    let shown = quietly(show.args(["-m", "auditwheel", "show"]).arg(wheel))?;
    let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    let is_same = shown.contains(&format!("\"manylinux_2_{minor}_"));
    is_same.then_some(()).ok_or_else(|| format!("{name}: auditwheel says {shown}"))
}

/// Minor version of glibc 2 in the tag of a wheel.
fn glibc(name: &str) -> Option<u32> {
    let (_, rest) = name.split_once("manylinux_2_")?;
    rest.split_once('_')?.0.parse().ok()
}

/// Installs the wheel, and runs the README's example and the first one of docs/PYTHON.md. Returns the times of both.
pub(super) fn tried(wheel: &Path, python: &str, folder: &Path) -> Result<String, String> {
    let fresh = python::environment(python, &folder.join("fresh"))?;
    let bin = fresh.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let clock = Instant::now();
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    let mut pip = python::in_environment(&fresh);
    pip.args(install).args(["--only-binary", ":all:"]).arg(wheel).current_dir(folder);
    quietly(apart(&mut pip, &bin))?;
    let installed = clock.elapsed().as_secs_f64();
    let seconds = example(&bin.join(format!("mbs{EXE_SUFFIX}")), folder)?;
    let scenes = folder.join("scenes");
    let scene = "scenes/double-pendulum.toml";
    fs::create_dir_all(&scenes)
        .and_then(|()| fs::copy(root().join(scene), folder.join(scene)))
        .map_err(|e| format!("{}: {e}", scenes.display()))?;
    let program = format!("{}\nprint(mbs.__version__)", first_program()?);
    let clock = Instant::now();
    let mut first = python::in_environment(&fresh);
    let said = quietly(apart(first.args(["-c", &program]).current_dir(folder), &bin))?;
    if said.lines().last() != Some(VERSION) {
        return Err(format!("the installed package says {said}"));
    }
    let guide = clock.elapsed().as_secs_f64();
    Ok(format!(
        "installed in {installed:.1} s, README's example {seconds:.1} s, docs/PYTHON.md's {guide:.1} s"
    ))
}

/// The first program of docs/PYTHON.md.
fn first_program() -> Result<String, String> {
    let path = root().join("docs/PYTHON.md");
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let program = text.split_once("```python\n").and_then(|(_, rest)| rest.split_once("```"));
    program.map(|(program, _)| program.to_owned()).ok_or("docs/PYTHON.md has no program".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tag_names_the_glibc_that_is_needed() {
        for (name, minor) in [
            ("multibody-0.1.0-cp311-abi3-manylinux_2_34_x86_64.whl", Some(34)),
            ("multibody-0.1.0-cp311-abi3-manylinux_2_17_x86_64.manylinux2014_x86_64.whl", Some(17)),
            ("multibody-0.1.0-cp311-abi3-linux_x86_64.whl", None),
        ] {
            assert_eq!(glibc(name), minor, "{name}");
        }
    }

    #[test]
    fn the_guide_of_python_begins_with_a_program_that_reads_one_scene() {
        let program = first_program().expect("there is one");
        assert!(program.contains("import multibody as mbs"));
        assert_eq!(program.matches("scenes/").count(), 1, "the trial copies one scene");
    }
}
