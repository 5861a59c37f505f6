//! Proof that a function of an image can reach no panic and no allocation.

use super::image::reachable;
use crate::debian;
use crate::process::{self, output};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Checks that a function of an image can reach no function that panics or allocates.
pub(super) fn no_panics(
    elf: &Path,
    (cpu, function): (&str, &str),
    place: &str,
) -> Result<(), String> {
    let disassembler = match disassembler() {
        Some(found) => found,
        None => {
            debian::install(&["llvm"]).map_err(|why| format!("there is no llvm-objdump: {why}"))?;
            disassembler().ok_or("Debian's llvm has no llvm-objdump")?
        }
    };
    let mut command = Command::new(disassembler);
    // without the name of the processor, the disassembler does not know instructions of the floating-point unit, and misreads those after
    // them
    command.args(["-d", "--no-show-raw-insn", &format!("--mcpu={cpu}")]);
    let text = output(command.arg(elf));
    let text = text.ok_or_else(|| format!("`{}` failed", process::line(&command)))?;
    let reached = reachable(&text, function).map_err(|why| format!("{place}: {why}"))?;
    let bad = |name: &&String| {
        name.contains("9panicking") || name.contains("5alloc") || name.contains("__rust_alloc")
    };
    match reached.iter().find(bad) {
        Some(name) => Err(format!("{place}: `{name}` can be reached from `{function}`")),
        None => Ok(()),
    }
}

/// A program `llvm-objdump` in the path, of the newest version.
fn disassembler() -> Option<PathBuf> {
    let is_one = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        name == "llvm-objdump" || name.starts_with("llvm-objdump-")
    };
    let paths = std::env::var_os("PATH")?;
    let mut found: Vec<_> = std::env::split_paths(&paths)
        .filter_map(|folder| std::fs::read_dir(folder).ok())
        .flat_map(|entries| entries.flatten().map(|entry| entry.path()))
        .filter(is_one)
        .collect();
    // the newest version knows most instructions
    found.sort_by_key(|path| {
        let name = path.to_string_lossy().into_owned();
        name.rsplit('-').next().and_then(|n| n.parse::<u32>().ok()).unwrap_or(0)
    });
    found.pop()
}
