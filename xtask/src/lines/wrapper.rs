//! A compiler that counts: in place of machine code each library gives lines of LLVM's code before any optimisation.
//!
//! Cargo starts this program in place of rustc where `RUSTC_WRAPPER` names it. What cargo only checks then also makes code, whose lines
//! are counted and which is taken away again: no machine code is made, so that a count takes a small share of a build.

use crate::process;
use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The folder of counts, a file for each crate; where it is set, this program is the compiler.
pub(super) const FOLDER: &str = "MBS_IR_LINES";
/// Set to keep the code as text, beside the counts.
const KEEP: &str = "MBS_IR_KEEP";
/// How code is made: none of LLVM's passes, one file a crate, names that can be read.
const FLAGS: [&str; 8] = [
    "-C",
    "no-prepopulate-passes",
    "-C",
    "passes=name-anon-globals",
    "-C",
    "codegen-units=1",
    "-C",
    "symbol-mangling-version=v0",
];

/// Compiles and counts, where cargo has started this program as its compiler.
pub fn as_compiler() -> Option<ExitCode> {
    let folder = PathBuf::from(env::var_os(FOLDER)?);
    let mut args = env::args_os().skip(1);
    let rustc = args.next()?;
    let args: Vec<OsString> = args.collect();
    let mut command = Command::new(rustc);
    let Some(crate_name) = counted(&args) else {
        return Some(process::hand_over(command.args(&args)));
    };
    let emits = |arg: &OsString| arg.to_str().is_some_and(|arg| arg.starts_with("--emit="));
    command.args(args.iter().map(|arg| {
        let mut arg = arg.clone();
        if emits(&arg) {
            arg.push(",llvm-ir");
        }
        arg
    }));
    let end = process::hand_over(command.args(FLAGS));
    if end == ExitCode::SUCCESS {
        if let Err(why) = count(&args, &crate_name, &folder) {
            eprintln!("lines of {crate_name}: {why}");
            return Some(ExitCode::FAILURE);
        }
    }
    Some(end)
}

/// The name of the library that is checked; `None` for a procedural macro, a build script, or a question of cargo's.
fn counted(args: &[OsString]) -> Option<String> {
    let is_checked = args.iter().any(|arg| {
        arg.to_str().is_some_and(|arg| arg.starts_with("--emit=") && !arg.contains("link"))
    });
    let name = after(args, "--crate-name")?;
    let kind = after(args, "--crate-type")?;
    (is_checked && kind != "proc-macro" && kind != "bin").then(|| name.to_owned())
}

/// The word behind an option.
fn after<'a>(args: &'a [OsString], option: &str) -> Option<&'a str> {
    let at = args.iter().position(|arg| arg == option)?;
    args.get(at + 1).and_then(|word| word.to_str())
}

/// Counts the lines of the file that the compiler has written, and removes it.
fn count(args: &[OsString], crate_name: &str, folder: &Path) -> Result<(), String> {
    let out = after(args, "--out-dir").ok_or("no --out-dir")?;
    let extra = args
        .iter()
        .filter_map(|arg| arg.to_str())
        .find_map(|arg| {
            arg.strip_prefix("extra-filename=").or(arg.strip_prefix("-Cextra-filename="))
        })
        .unwrap_or_default();
    let code = Path::new(out).join(format!("{crate_name}{extra}.ll"));
    let failed = |e: std::io::Error| format!("{}: {e}", code.display());
    let n = lines(&code).map_err(failed)?;
    fs::create_dir_all(folder).map_err(failed)?;
    fs::write(folder.join(crate_name), n.to_string()).map_err(failed)?;
    if env::var_os(KEEP).is_some() {
        fs::rename(&code, folder.join(format!("{crate_name}.ll"))).map_err(failed)
    } else {
        fs::remove_file(&code).map_err(failed)
    }
}

/// The number of lines of a file.
fn lines(path: &Path) -> std::io::Result<u64> {
    let mut file = BufReader::with_capacity(1 << 20, fs::File::open(path)?);
    let mut n = 0;
    loop {
        let bytes = file.fill_buf()?;
        if bytes.is_empty() {
            return Ok(n);
        }
        n += bytes.iter().filter(|byte| **byte == b'\n').count() as u64;
        let used = bytes.len();
        file.consume(used);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<OsString> {
        text.split_whitespace().map(|word| OsString::from(word)).collect()
    }

    #[test]
    fn libraries_that_are_checked_are_counted_and_nothing_else() {
        let call = |kind: &str, emit: &str| {
            counted(&words(&format!("--crate-name x --crate-type {kind} --emit={emit}")))
        };
        assert_eq!(call("lib", "dep-info,metadata"), Some("x".to_owned()));
        assert_eq!(call("lib", "dep-info,metadata,link"), None);
        assert_eq!(call("proc-macro", "dep-info,metadata"), None);
        assert_eq!(call("bin", "dep-info,metadata"), None);
        assert_eq!(counted(&words("-vV")), None);
    }
}
