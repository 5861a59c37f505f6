//! `cargo xtask tables`: the report's tables on accuracy, run anew and set beside the printed numbers.

mod history;
mod html;
mod outcome;
mod report;
mod rows;
mod text;

use crate::process;
use rows::Row;
use std::fs;
use std::io::{IsTerminal, stderr};
use std::path::Path;
use std::process::{Command, ExitCode};

/// Runs with more steps than this are left out by `--quick`.
const QUICK: f64 = 1e6;

/// Runs every entry of the tables, or of those named, and writes them as text, CSV and HTML; exit status 1 where something
/// cannot be run.
pub(crate) fn tables(quick: bool, names: &[String]) -> ExitCode {
    match run(quick, names) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("cargo xtask tables: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Builds `mbs`, runs all entries one after the other, and writes the files under `target/tables`.
#[allow(clippy::print_stdout, reason = "the tables are what is asked for")]
fn run(quick: bool, names: &[String]) -> Result<(), String> {
    let known = report::TABLES.map(|table| table.name);
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(format!("no table `{name}`; there are {}", known.join(", ")));
    }
    let mut build = process::cargo();
    build.args(["build", "--quiet", "--release", "--package", "mbs", "--bin", "mbs"]);
    process::run(build.current_dir(process::root()))?;
    let mbs = process::target_dir().join("release").join("mbs");

    let folder = process::target_dir().join("tables");
    let runs = folder.join("runs");
    let mut rows = Vec::new();
    let mut drawings = Vec::new();
    let is_wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    for table in report::TABLES.iter().filter(|table| is_wanted(table.name)) {
        let mut lines = Vec::new();
        for (method, step) in
            table.entries().filter(|(_, step)| !quick || table.steps(*step) <= QUICK)
        {
            let note = format!("{} {} dt {step:.0e}", table.name, method.name);
            if stderr().is_terminal() {
                eprint!("\r\x1b[K{note}");
            }
            let drawn = table.history.filter(|_| table.draws(method, step));
            let outcome = entry(&mbs, table, method, step, drawn.map(|_| &*runs))?;
            if let Some(history) = drawn.filter(|_| outcome.has_run()) {
                let points = history::read(&runs.join("run.csv"), &history)?;
                // The finest run lies below the others.
                let at = if table.is_finest(method, step) { 0 } else { lines.len() };
                lines.insert(
                    at,
                    history::Line { name: format!("{}, {step:e} s", method.name), points },
                );
            }
            rows.push(Row::new(table, method, step, outcome));
        }
        if let Some(history) = &table.history {
            drawings.push((table.name, history::svg(history, &lines)?));
        }
    }
    if stderr().is_terminal() {
        eprint!("\r\x1b[K");
    }

    println!("{}", text::text(&rows));
    let write = |name: &str, bytes: &[u8]| -> Result<(), String> {
        let path = folder.join(name);
        let written = fs::create_dir_all(&folder).and_then(|()| fs::write(&path, bytes));
        written.map_err(|e| format!("cannot write {}: {e}", path.display()))?;
        println!("{}", path.display());
        Ok(())
    };
    write("tables.csv", &rows::csv(&rows)?)?;
    write("tables.html", html::page(&rows, &drawings).as_bytes())
}

/// Runs one entry with the release build of `mbs`; with a folder, its files are left there.
fn entry(
    mbs: &Path,
    table: &report::Table,
    method: &report::Method,
    step: f64,
    out: Option<&Path>,
) -> Result<outcome::Outcome, String> {
    let mut command = Command::new(mbs);
    command.args(["run", "--json", "--formulation", method.formulation]);
    command.args(["--step", &format!("{step:e}")]).args(method.arguments);
    command.arg(process::root().join("scenes").join(format!("{}.toml", table.scene)));
    if let Some(out) = out {
        command.arg("--out").arg(out);
    }
    let output =
        command.output().map_err(|e| format!("cannot start `{}`: {e}", process::line(&command)))?;
    outcome::read(output.status.code(), &output.stdout, &output.stderr, table.reference)
        .map_err(|why| format!("`{}`: {why}", process::line(&command)))
}
