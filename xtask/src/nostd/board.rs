//! Builds of the firmware example, and its runs on emulated boards and on the host.

use super::image::Image;
use super::toolchain::Toolchain;
use crate::child::watched;
use crate::process::{self, cargo, output, run};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// The target of both boards.
pub(super) const TARGET: &str = "thumbv7em-none-eabihf";

/// Largest wall-clock time of an emulator's run.
const PATIENCE: Duration = Duration::from_secs(600);

/// Features of mbs-nostd for machine elements; the last one enables all of them.
pub(super) const ELEMENTS: [&str; 8] =
    ["couplings", "curves", "lines", "rolling", "rotors", "signals", "sums", "elements"];

pub(super) const M7: Board = Board { machine: "mps2-an500", cpu: "cortex-m7" };

pub(super) const M4: Board = Board { machine: "mps2-an386", cpu: "cortex-m4" };

/// A toolchain, and a linker if the toolchain has none.
pub(super) type Tools<'a> = (Toolchain, Option<&'a Path>);

/// An emulated board, with the names that the emulator uses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Board {
    machine: &'static str,
    pub(super) cpu: &'static str,
}

/// Exports a scene as a table of Rust, and returns its path. `scene` is the file's path relative to `scenes/`, without its ending.
pub(super) fn export(scene: &str, precision: &str, models: &Path) -> Result<PathBuf, String> {
    let file = models.join(format!("{}-{precision}.rs", name(scene)));
    let mut command = Command::new(process::tested("mbs", "command")?);
    command.arg("export").arg(format!("scenes/{scene}.toml")).args([
        "--precision",
        precision,
        "--rust",
    ]);
    command.arg(&file).arg("--binary").arg(file.with_extension("mbs"));
    run(command.current_dir(process::root()))?;
    Ok(file)
}

/// The name of a scene, from its path.
pub(super) fn name(scene: &str) -> &str {
    scene.rsplit('/').next().unwrap_or(scene)
}

/// Builds the firmware with a model. Returns the path of the image, and its sizes.
pub(super) fn build(
    tools: Tools<'_>,
    board: &Board,
    features: &str,
    model: &Path,
) -> Result<(PathBuf, Image), String> {
    build_program(tools, board, ("mbs-firmware", features), &[("MBS_MODEL", model)])
}

/// Builds a program of the firmware. The environment variables of `models` name its models. Returns the path of the image, and its sizes.
pub(super) fn build_program(
    tools: Tools<'_>,
    board: &Board,
    (program, features): (&str, &str),
    models: &[(&str, &Path)],
) -> Result<(PathBuf, Image), String> {
    let (mut command, folder) = cross_build(tools, board);
    command.args(["--bin", program, "--features", &qualified(features)]);
    command.envs(models.iter().copied());
    run(command.current_dir(process::root().join("mbs-nostd/firmware")))?;
    let elf = folder.join(program);
    let image = Image::read(&elf)?;
    Ok((elf, image))
}

/// The command of a build for a board, and the folder of the built programs. All builds have the same flags, so that libraries are compiled
/// once.
pub(super) fn cross_build((toolchain, lld): Tools<'_>, board: &Board) -> (Command, PathBuf) {
    let folder = process::target_dir().join("firmware").join(board.cpu);
    let mut command = toolchain.cargo(false);
    command.args(["build", "--release", "--quiet", "--locked", "--target", TARGET]);
    command.arg("--target-dir").arg(&folder);
    let mut flags = format!("-C target-cpu={} -C link-arg=-Tlink.x", board.cpu);
    if let Some(lld) = lld {
        flags.push_str(&format!(" -C linker={}", lld.display()));
    }
    command.env("RUSTFLAGS", flags);
    (command, folder.join(TARGET).join("release"))
}

/// Runs an image on its board. Returns the text that it prints.
pub(super) fn emulate(board: &Board, elf: &Path) -> Result<String, String> {
    let mut command = Command::new("qemu-system-arm");
    command.args(["-machine", board.machine, "-cpu", board.cpu, "-nographic"]);
    command.args(["-semihosting-config", "enable=on,target=native", "-icount", "shift=0"]);
    let name = elf.display();
    let out = watched(command.arg("-kernel").arg(elf), Some(PATIENCE))?;
    let out = out.ok_or_else(|| format!("{name} does not come to its end"))?;
    let text = String::from_utf8_lossy(&out.stdout).into_owned();
    if out.status.success() { Ok(text) } else { Err(format!("{name}: {}\n{text}", out.status)) }
}

/// Runs a model on the host, in a program without the standard library. A second request for the same run returns the stored text.
pub(super) fn on_host(model: &Path, features: &str) -> Result<String, String> {
    static RUNS: Mutex<BTreeMap<(PathBuf, String), String>> = Mutex::new(BTreeMap::new());
    let mut runs = RUNS.lock().unwrap_or_else(PoisonError::into_inner);
    let asked = (model.to_owned(), features.to_owned());
    if let Some(text) = runs.get(&asked) {
        return Ok(text.clone());
    }
    let folder = process::target_dir().join("firmware/host");
    let mut command = cargo();
    command.args(["build", "--release", "--quiet", "--locked"]);
    command.args(["--features", &qualified(features)]);
    command.arg("--target-dir").arg(&folder).env("MBS_MODEL", model);
    run(command.current_dir(process::root().join("mbs-nostd/firmware/host")))?;
    let program = folder.join("release/mbs-firmware-host");
    let text = output(&mut Command::new(&program));
    let text = text.ok_or_else(|| format!("{} failed", program.display()))?;
    runs.insert(asked, text.clone());
    Ok(text)
}

/// Features with the names of their crates: machine elements belong to mbs-nostd, effects to mbs-core.
fn qualified(features: &str) -> String {
    let named = features.split(',').filter(|feature| !feature.is_empty());
    let of = |feature| if ELEMENTS.contains(&feature) { "mbs-nostd" } else { "mbs-core" };
    named.map(|feature| format!("{}/{feature}", of(feature))).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::qualified;

    #[test]
    fn elements_are_features_of_the_solver_and_effects_of_the_laws() {
        assert_eq!(qualified(""), "");
        assert_eq!(qualified("signals,tire"), "mbs-nostd/signals,mbs-core/tire");
    }
}
