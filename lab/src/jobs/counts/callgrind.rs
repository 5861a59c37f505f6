//! Runs of `counts` under callgrind. Each call of the function `measured` gives a dump, which is read function by function.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use xtask::debian;
use xtask::process::line;
use xtask::summary::LeftOut;

/// Instructions and functions that one case executed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Case {
    /// Formulation, dimension, effect, switch.
    pub(crate) name: String,
    /// Instructions of all functions, except those of libc that copy and fill memory. The counts of these depend slightly on the addresses
    /// of buffers.
    pub(crate) instructions: u64,
    /// Names of the functions.
    pub(crate) functions: BTreeSet<String>,
}

/// Returns the remedy if valgrind is missing; `None` if a job can use it.
pub(crate) fn missing(job: &str) -> Option<LeftOut> {
    let left_out = debian::find("valgrind", "valgrind").err()?;
    let remedy = format!("{}\nThen run `cargo xtask {job}`.", left_out.remedy);
    Some(LeftOut { remedy, ..left_out })
}

/// Runs the program under callgrind. Its dumps are written to `folder`, which is emptied before.
///
/// # Errors
///
/// The command that fails, or a dump that does not match the printed names.
pub(crate) fn run(program: &Path, args: &[String], folder: &Path) -> Result<Vec<Case>, String> {
    let io = |e: std::io::Error| format!("{}: {e}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(io)?;
    }
    fs::create_dir_all(folder).map_err(io)?;
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--tool=callgrind", "--compress-strings=no"]);
    // with the opposite order callgrind ignores one of the two options
    command.args(["--dump-after=*counts::measured*", "--toggle-collect=counts::measured*"]);
    command.arg(format!("--callgrind-out-file={}", folder.join("dump").display()));
    command.arg(program).args(args).stdin(Stdio::null());
    let out = command.output().map_err(|e| format!("cannot start `{}`: {e}", line(&command)))?;
    if !out.status.success() {
        let errors = String::from_utf8_lossy(&out.stderr);
        return Err(format!("`{}`: {}\n{errors}", line(&command), out.status));
    }
    let names = String::from_utf8_lossy(&out.stdout).into_owned();
    let read = |(i, name): (usize, &str)| {
        let path = folder.join(format!("dump.{}", i + 1));
        let bytes = fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(case(name, &String::from_utf8_lossy(&bytes)))
    };
    names.lines().enumerate().map(read).collect()
}

/// Reads the dump of one case.
fn case(name: &str, dump: &str) -> Case {
    let mut case = Case { name: name.to_owned(), instructions: 0, functions: BTreeSet::new() };
    let (mut function, mut is_call) = ("", false);
    for line in dump.lines() {
        if let Some(name) = line.strip_prefix("fn=") {
            function = name;
        } else if line.starts_with("calls=") {
            is_call = true;
        } else if line.starts_with(|c: char| c.is_ascii_digit() || "+-*".contains(c)) {
            // the line after `calls=` has the cost of the callee, which is counted there
            if !std::mem::take(&mut is_call) {
                if !is_copy(function) {
                    case.instructions += number(line.split(' ').nth(1));
                }
                case.functions.insert(function.to_owned());
            }
        }
    }
    case
}

/// True if the function is one of libc's that copy, fill or compare memory.
fn is_copy(function: &str) -> bool {
    let name = function.trim_start_matches('_');
    ["memcpy", "memmove", "memset", "memcmp", "bcmp"].iter().any(|f| name.starts_with(f))
}

fn number(word: Option<&str>) -> u64 {
    word.and_then(|word| word.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_callees_take_is_counted_once() {
        let dump = "events: Ir\n\nfl=a.rs\nfn=step\n10 5\n+2 7\ncfn=add\ncalls=3 0\n* 30\n\nfn=add\n4 30\n\nfn=__memcpy_avx_unaligned_erms\n0 9\n";
        let case = case("x", dump);
        assert_eq!(case.instructions, 42);
        assert_eq!(
            case.functions.into_iter().collect::<Vec<_>>(),
            ["__memcpy_avx_unaligned_erms", "add", "step"]
        );
    }
}
