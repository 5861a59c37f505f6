//! The job `cargo xtask profile`: counts the instructions of a step by parts, and compares its time with the least time for its operations
//! (docs/PROFILES.md).
//!
//! The program `runner` is built for any x86-64 with the names of functions. Callgrind counts two runs of different length, whose
//! difference does not contain the start-up. `addr2line` lists the functions that are inlined at an instruction. Time, operations and rates
//! are measured without callgrind.

mod callgrind;
mod parts;
mod table;

use crate::bench::{Machine, RUNNER};
use crate::counts::missing_valgrind;
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use table::Profile;
use xtask::child::printed;
use xtask::process::{self, cargo, line, output};

/// The five scenes of `scenes/` with the longest index-3 steps. The vehicle on steering ramps takes as long as the last scene, and is left
/// out since that one has no effects.
const SCENES: [&str; 5] = ["iltis-links", "iltis-slalom", "iltis-jump", "iltis-stairs", "tree-30"];
/// First and last step of the scene's run that are profiled.
const WINDOW: [u32; 2] = [20, 320];
/// Setting of glibc that copies and fills memory by loops. Callgrind would count the processor's repeating instructions once per byte.
const LOOPS: &str =
    "glibc.cpu.x86_rep_movsb_threshold=1073741824:glibc.cpu.x86_rep_stosb_threshold=1073741824";
/// Largest time of a run of the program.
const RUN_TIME: Duration = Duration::from_secs(900);

/// Profiles the scenes, or the named ones, and writes text and Markdown. With `keep` it writes the tables into docs/PROFILES.md.
///
/// # Errors
///
/// The reason why nothing can be measured.
#[allow(clippy::print_stdout, reason = "the tables are what is asked for")]
pub(crate) fn profile(keep: bool, names: &[String]) -> Result<(), String> {
    if let Some(left_out) = missing_valgrind("profile") {
        return Err(format!("{}\n{}", left_out.why, left_out.remedy));
    }
    if output(Command::new("addr2line").arg("--version")).is_none() {
        return Err("`addr2line` is not installed\nGet it on Debian, as root, with `apt-get install binutils`.".to_owned());
    }
    let mut machine = Machine::now();
    let program = build()?;
    process::progress("rates");
    let rates = read_line(&program, &["rates"])?;
    let names: Vec<&str> = match names {
        [] => SCENES.to_vec(),
        names => names.iter().map(String::as_str).collect(),
    };
    let mut profiles = Vec::new();
    for name in names {
        let profile = scene(&program, name)?;
        let path = folder().join(format!("{name}.txt"));
        process::write(&path, table::text(&profile, &rates).as_bytes())?;
        profiles.push(profile);
    }
    machine.end();
    process::progress("");
    let markdown = table::markdown(&profiles, &rates, &remark(&machine));
    println!("{markdown}");
    process::write(&folder().join("profile.md"), markdown.as_bytes())?;
    if keep { put(&process::root().join("docs/PROFILES.md"), &markdown) } else { Ok(()) }
}

fn folder() -> PathBuf {
    process::target_dir().join("profile")
}

/// Builds the program with the optimisation of a release, and with the lines and names of inlined functions.
fn build() -> Result<PathBuf, String> {
    let mut command = cargo();
    command.args(["build", "--quiet", "--profile", "bench"]).args(RUNNER);
    process::run(command.arg("--target-dir").arg(folder()).current_dir(process::root()))?;
    Ok(folder().join("release").join("runner"))
}

/// Runs the measuring program. Returns its only line.
fn read_line(program: &Path, words: &[&str]) -> Result<Value, String> {
    let mut command = Command::new(program);
    command.args(["bench", "profile"]).args(words).current_dir(process::root());
    let line = printed(&mut command, RUN_TIME)?;
    serde_json::from_str(&line).map_err(|e| format!("`{line}`: {e}"))
}

/// Measures a scene, and counts the instructions of its steps.
fn scene(program: &Path, name: &str) -> Result<Profile, String> {
    process::progress(name);
    let [from, to] = WINDOW.map(|n| n.to_string());
    let line = read_line(program, &["step", name, &from, &to])?;
    let [from, to] = ["from", "to"].map(|key| line[key].to_string());
    process::progress(&format!("{name} under callgrind"));
    let costs = callgrind::more(&counted(program, name, &to)?, &counted(program, name, &from)?);
    let own = program.display().to_string();
    let addresses: Vec<&str> = costs
        .keys()
        .filter(|place| place.object == own)
        .map(|place| place.address.as_str())
        .collect();
    let shares = parts::shares(&costs, &own, &functions(program, addresses)?);
    Ok(Profile { line, shares })
}

/// Counts the instructions of a run with a number of steps.
fn counted(program: &Path, name: &str, steps: &str) -> Result<callgrind::Costs, String> {
    let path = folder().join("callgrind.out");
    let mut command = Command::new("valgrind");
    command.env("GLIBC_TUNABLES", LOOPS);
    command.args(["--quiet", "--tool=callgrind", "--dump-instr=yes"]);
    command.args(["--compress-strings=no", "--compress-pos=no"]);
    command.arg(format!("--callgrind-out-file={}", path.display()));
    command
        .arg(program)
        .args(["bench", "profile", "bare", name, steps])
        .current_dir(process::root());
    printed(&mut command, RUN_TIME)?;
    let bytes = fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    callgrind::costs(&String::from_utf8_lossy(&bytes))
}

/// Output of `addr2line` for a list of addresses.
fn functions(program: &Path, addresses: Vec<&str>) -> Result<String, String> {
    let mut command = Command::new("addr2line");
    command.args(["-a", "-f", "-i", "-C", "-e"]).arg(program);
    let words = line(&command);
    let failed = |e: std::io::Error| format!("`{words}`: {e}");
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().map_err(failed)?;
    let (stdin, text) = (child.stdin.take(), addresses.join("\n"));
    // addresses are written by another thread, since `addr2line` answers while it reads
    let asking = std::thread::spawn(move || stdin.map(|mut to| to.write_all(text.as_bytes())));
    let out = child.wait_with_output().map_err(failed)?;
    match asking.join() {
        Ok(Some(Ok(()))) => Ok(String::from_utf8_lossy(&out.stdout).into_owned()),
        _ => Err(format!("`{words}` did not take its addresses")),
    }
}

/// Returns the remark on the origin of the numbers.
fn remark(machine: &Machine) -> String {
    let version = |program: &str| output(Command::new(program).arg("--version"));
    let or_unknown = |what: Option<String>| what.unwrap_or_else(|| "?".to_owned());
    let rustc = or_unknown(version("rustc"));
    let rustc = rustc.split(" (").next().unwrap_or_default();
    format!(
        "Steps {} to {} of each run, by `cargo xtask profile`. mbs {}, built for any x86-64, {rustc}, {}. {} cores ({}), {}.",
        WINDOW[0],
        WINDOW[1],
        or_unknown(process::commit()),
        or_unknown(version("valgrind")),
        machine.cores,
        machine.processor,
        machine.load_text()
    )
}

/// Writes the tables between the marks of a document.
fn put(path: &Path, markdown: &str) -> Result<(), String> {
    let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let text = between(&text, markdown)
        .ok_or_else(|| format!("{}: no marks `{}` and `{}`", path.display(), MARKS[0], MARKS[1]))?;
    process::write(path, text.as_bytes())
}

/// Marks before and after the tables.
const MARKS: [&str; 2] = ["<!-- profile:begin -->", "<!-- profile:end -->"];

/// A text with other lines between its marks; `None` if it has no marks.
fn between(text: &str, lines: &str) -> Option<String> {
    let (head, rest) = text.split_once(MARKS[0])?;
    let (_, tail) = rest.split_once(MARKS[1])?;
    Some(format!("{head}{}\n{}\n{}{tail}", MARKS[0], lines.trim_end(), MARKS[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_between_the_marks_is_replaced() {
        let text = format!("before\n{}\nold\n{}\nafter\n", MARKS[0], MARKS[1]);
        let new = format!("before\n{}\nnew\n{}\nafter\n", MARKS[0], MARKS[1]);
        assert_eq!(between(&text, "new\n"), Some(new));
        assert_eq!(between("no marks", "new"), None);
        let document = fs::read_to_string(process::root().join("docs/PROFILES.md")).unwrap();
        assert!(between(&document, "new").is_some());
    }
}
