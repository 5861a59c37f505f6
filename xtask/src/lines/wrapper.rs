//! A compiler that counts: for each library it counts the lines of LLVM's code before any optimisation, and makes no machine code.
//!
//! Cargo starts this program instead of rustc if `RUSTC_WRAPPER` names it. Then crates that cargo would only check produce LLVM's code too.
//! Its lines are counted, and the file is removed. A count is much faster than a build, since no machine code is made.

use super::counts::{Counts, OWNED};
use crate::process;
use std::array;
use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The environment variable with the folder of counts, which gets a file for each crate. If it is set, this program acts as the compiler.
pub(super) const FOLDER: &str = "MBS_IR_LINES";
/// The environment variable that, if it is set, keeps LLVM's code as text beside the counts.
const KEEP: &str = "MBS_IR_KEEP";
/// Flags of rustc: no passes of LLVM, one file per crate, readable names.
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

/// Compiles and counts, if cargo has started this program as its compiler.
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
    if end == ExitCode::SUCCESS
        && let Err(why) = count(&args, &crate_name, &folder)
    {
        eprintln!("lines of {crate_name}: {why}");
        return Some(ExitCode::FAILURE);
    }
    Some(end)
}

/// The name of the library that is checked; `None` for a procedural macro, a build script, or a query of cargo.
fn counted(args: &[OsString]) -> Option<String> {
    let is_checked = args.iter().any(|arg| {
        arg.to_str().is_some_and(|arg| arg.starts_with("--emit=") && !arg.contains("link"))
    });
    let name = after(args, "--crate-name")?;
    let kind = after(args, "--crate-type")?;
    (is_checked && kind != "proc-macro" && kind != "bin").then(|| name.to_owned())
}

/// The argument after an option.
fn after<'a>(args: &'a [OsString], option: &str) -> Option<&'a str> {
    let at = args.iter().position(|arg| arg == option)?;
    args.get(at + 1).and_then(|word| word.to_str())
}

/// Counts the lines of the file that the compiler has written, and removes the file.
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
    let counts = counts(&code).map_err(failed)?;
    fs::create_dir_all(folder).map_err(failed)?;
    let numbers = [counts.lines].into_iter().chain(counts.owned);
    let text: Vec<String> = numbers.map(|n| n.to_string()).collect();
    fs::write(folder.join(crate_name), text.join(" ")).map_err(failed)?;
    if env::var_os(KEEP).is_some() {
        fs::rename(&code, folder.join(format!("{crate_name}.ll"))).map_err(failed)
    } else {
        fs::remove_file(&code).map_err(failed)
    }
}

/// The counts that were written for a crate.
pub(super) fn read(path: &Path) -> Result<Counts, String> {
    let failed = |why: &str| format!("{}: {why}", path.display());
    let text = fs::read_to_string(path).map_err(|e| failed(&e.to_string()))?;
    let numbers: Option<Vec<u64>> = text.split_whitespace().map(|n| n.parse().ok()).collect();
    match numbers.as_deref().and_then(<[u64]>::split_first) {
        Some((&lines, owned)) if owned.len() == OWNED.len() => {
            Ok(Counts { lines, owned: array::from_fn(|i| owned[i]) })
        }
        _ => Err(failed("no counts")),
    }
}

/// The lines of the functions in a file of LLVM's code.
fn counts(path: &Path) -> std::io::Result<Counts> {
    let mut file = BufReader::with_capacity(1 << 20, fs::File::open(path)?);
    let (mut counts, mut line, mut within) = (Counts::default(), Vec::new(), None);
    while {
        line.clear();
        file.read_until(b'\n', &mut line)? > 0
    } {
        if line.starts_with(b"define ") {
            within = Some(owned(&line));
        }
        let Some(of) = within else { continue };
        counts.lines += 1;
        if let Some(of) = of {
            counts.owned[of] += 1;
        }
        if line.starts_with(b"}") {
            within = None;
        }
    }
    Ok(counts)
}

/// Index in [`OWNED`] of the module that a function belongs to, by the mangled name in its definition. The module follows the first crate
/// in the name. The crate is written as `Cs`, a hash and its name.
fn owned(definition: &[u8]) -> Option<usize> {
    let name = String::from_utf8_lossy(definition);
    let (_, name) = name.split_once("@")?;
    let (_, path) = name.split_once("Cs")?.1.split_once('_')?;
    OWNED.iter().position(|(owner, module)| {
        let words = [*owner].into_iter().chain(module.split("::"));
        path.starts_with(&words.map(|word| format!("{}{word}", word.len())).collect::<String>())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<OsString> {
        text.split_whitespace().map(OsString::from).collect()
    }

    #[test]
    fn a_function_belongs_to_the_first_path_of_its_name() {
        let of = |name: &str| owned(format!("define internal void @{name}(ptr %x) {{").as_bytes());
        let natural = "_RNvMs_NtNtCs6fU_8mbs_core7natural10from_sceneINtNtB4_5model12NaturalModeldKj2_E5build";
        assert_eq!(of(natural), Some(0));
        let tree =
            "_RNvMNtNtCs6fU_13mbs_recursive5build4treeINtB2_9TreeModeldNtNtB6_5space6PlanarE5build";
        assert_eq!(of(tree), Some(3));
        let dropped = "_RINvNtCs9aB_4core3ptr13drop_in_placeNtNtCs6fU_8mbs_core7natural5modelE";
        assert_eq!(of(dropped), None);
        assert_eq!(of("main"), None);
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
