//! Child processes, paths (the repository root, the target folder, cargo), progress and files.

use std::collections::BTreeSet;
use std::env;
use std::ffi::OsStr;
use std::fs;
use std::io::{IsTerminal, stderr};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};

/// The root of the repository.
pub fn root() -> PathBuf {
    // cargo sets the variable for `cargo run` and `cargo test`; a program that is started directly uses the value of its build
    let manifest = env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    manifest.parent().map_or(manifest.clone(), Path::to_path_buf)
}

/// The folder for build products: `CARGO_TARGET_DIR`, or `target` in the root.
pub fn target_dir() -> PathBuf {
    root().join(env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()))
}

/// The command of cargo by which this job was started.
pub fn cargo() -> Command {
    Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Builds a program with the profile and the features of the tests, so that no dependency is built twice. The program is fast, and has
/// every check of a debug build. `test` names a test of its package. In one process each program is built once.
///
/// # Errors
///
/// The command of cargo and its exit status, if it fails.
pub fn tested(program: &str, test: &'static str) -> Result<PathBuf, String> {
    static BUILT: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
    let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    if !built.contains(test) {
        let mut build = cargo();
        build.args(["test", "--workspace", "--no-run", "--quiet", "--test", test]);
        run(build.current_dir(root()))?;
        built.insert(test);
    }
    Ok(target_dir().join("debug").join(program))
}

/// Runs a command that shows its own output.
///
/// # Errors
///
/// One line with the command and its exit status, if it fails.
pub fn run(command: &mut Command) -> Result<(), String> {
    let status = command
        .stdin(Stdio::null())
        .status()
        .map_err(|e| format!("cannot start `{}`: {e}", line(command)))?;
    if status.success() { Ok(()) } else { Err(format!("`{}`: {status}", line(command))) }
}

/// The standard output of a command, trimmed; `None` if it cannot start or fails.
pub fn output(command: &mut Command) -> Option<String> {
    let out = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(out.stdout).ok()?;
    out.status.success().then(|| text.trim().to_owned())
}

/// CPU time of this process, of its ended child processes, and of theirs [s]; `None` if the system does not report it.
pub fn cpu_seconds() -> Option<f64> {
    // Linux reports hundredths of a second, independently of its own clock.
    const TICKS: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // fields are counted after the name, which may contain any character and ends with the last parenthesis: field 3 is the state, 14 to 17
    // times
    let (_, fields) = stat.rsplit_once(')')?;
    let times: Vec<f64> =
        fields.split_whitespace().skip(11).take(4).filter_map(|time| time.parse().ok()).collect();
    (times.len() == 4).then(|| times.iter().sum::<f64>() / TICKS)
}

/// The commit of the repository, and whether files differ from it; `None` without git.
pub fn commit() -> Option<String> {
    let git = |arguments: &[&str]| output(Command::new("git").args(arguments).current_dir(root()));
    let hash = git(&["rev-parse", "--short", "HEAD"])?;
    let is_changed = git(&["status", "--porcelain"]).is_none_or(|text| !text.is_empty());
    Some(format!("{hash}{}", if is_changed { " and changes after it" } else { "" }))
}

/// A command as a user would type it.
pub fn line(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let name = program.file_name().unwrap_or(program.as_os_str());
    let words = std::iter::once(name).chain(command.get_args());
    words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
}

/// Runs a command with the standard streams of this process. Returns its exit status.
pub fn hand_over(command: &mut Command) -> ExitCode {
    match command.status() {
        Ok(status) => exit_code(status),
        Err(e) => {
            eprintln!("cannot start `{}`: {e}", line(command));
            ExitCode::FAILURE
        }
    }
}

/// A child's exit status as one of this process: its code, or 128 + signal as in shells.
pub fn exit_code(status: ExitStatus) -> ExitCode {
    #[cfg(unix)]
    let signal = std::os::unix::process::ExitStatusExt::signal(&status);
    #[cfg(not(unix))]
    let signal: Option<i32> = None;
    let code = status.code().or(signal.map(|s| 128 + s)).unwrap_or(1);
    ExitCode::from(u8::try_from(code).unwrap_or(1))
}

/// Shows the current work on a terminal, in place of the text before.
pub fn progress(what: &str) {
    if stderr().is_terminal() {
        eprint!("\r\x1b[K{what}");
    }
}

/// Writes a file and its folder, and prints its path.
///
/// # Errors
///
/// The path, and the reason why it cannot be written.
#[allow(clippy::print_stdout, reason = "the file is what is asked for")]
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    let written = fs::create_dir_all(folder).and_then(|()| fs::write(path, bytes));
    written.map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    println!("{}", path.display());
    Ok(())
}

/// Packages with their features, as cargo builds them for a selection.
#[cfg(test)]
pub(crate) fn built_packages(selection: &[&str]) -> BTreeSet<String> {
    let mut tree = cargo();
    tree.args(["tree", "--locked", "--prefix", "none", "--format", "{p} [{f}]"]).args(selection);
    let text = output(tree.current_dir(root())).expect("cargo knows its packages");
    let lines = text.lines().filter(|line| !line.is_empty());
    lines.map(|line| line.trim_end_matches(" (*)").to_owned()).collect()
}
