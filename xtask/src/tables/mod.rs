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
    let mut rows = Vec::new();
    let mut drawings = Vec::new();
    let is_wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    for table in report::TABLES.iter().filter(|table| is_wanted(table.name)) {
        for (method, step) in
            table.entries().filter(|(_, step)| !quick || table.steps(*step) <= QUICK)
        {
            let note = format!("{} {} dt {step:.0e}", table.name, method.name);
            if stderr().is_terminal() {
                eprint!("\r\x1b[K{note}");
            }
            rows.push(Row::new(table, method, step, entry(&mbs, table, method, step)?));
        }
        if let Some(history) = &table.history {
            let lines = histories(&mbs, table, history, &folder.join("runs"))?;
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

/// The command of one entry, with the release build of `mbs`.
fn command(mbs: &Path, table: &report::Table, method: &report::Method, step: f64) -> Command {
    let mut command = Command::new(mbs);
    command.args(["run", "--json", "--formulation", method.formulation]);
    command.args(["--step", &format!("{step:e}")]).args(method.arguments);
    command.arg(process::root().join("scenes").join(format!("{}.toml", table.scene)));
    command
}

/// Runs one entry.
fn entry(
    mbs: &Path,
    table: &report::Table,
    method: &report::Method,
    step: f64,
) -> Result<outcome::Outcome, String> {
    let mut command = command(mbs, table, method, step);
    let output =
        command.output().map_err(|e| format!("cannot start `{}`: {e}", process::line(&command)))?;
    outcome::read(output.status.code(), &output.stdout, &output.stderr, table.reference)
        .map_err(|why| format!("`{}`: {why}", process::line(&command)))
}

/// The histories of a table: the first method at its smallest step, then every method of the report at its first step. What
/// stopped is drawn as far as it came.
fn histories(
    mbs: &Path,
    table: &report::Table,
    history: &report::History,
    folder: &Path,
) -> Result<Vec<history::Line>, String> {
    let entries: Vec<_> = table.entries().collect();
    let first = entries.first().map(|(method, _)| method.name);
    let finest = entries.iter().rev().find(|(method, _)| Some(method.name) == first);
    let printed = entries.iter().filter(|(method, step)| {
        method.dt.first() == Some(step) && !method.printed.is_empty() && method.arguments.is_empty()
    });
    finest
        .into_iter()
        .chain(printed)
        .map(|&(method, step)| {
            let mut command = command(mbs, table, method, step);
            let output = command.arg("--out").arg(folder).output();
            output.map_err(|e| format!("cannot start `{}`: {e}", process::line(&command)))?;
            let points = history::read(&folder.join("run.csv"), history)?;
            Ok(history::Line { name: format!("{}, {step:e} s", method.name), points })
        })
        .collect()
}
