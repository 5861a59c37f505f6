//! `cargo xtask tables`: the report's tables on accuracy, run anew and set beside the printed numbers.

mod history;
mod html;
mod report;
mod rows;
mod text;

use crate::mbs::outcome::Outcome;
use crate::mbs::{Mbs, columns, scene};
use crate::page;
use crate::process;
use rows::Row;
use std::path::Path;
use std::process::ExitCode;

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
    let mbs = Mbs::build()?;

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
            process::progress(&format!("{} {} dt {step:.0e}", table.name, method.name));
            let drawn = table.history.filter(|_| table.draws(method, step));
            let outcome = entry(&mbs, table, method, step, drawn.map(|_| &*runs))?;
            if let Some(history) = drawn.filter(|_| outcome.has_run()) {
                let points = columns::history(&runs.join("run.csv"), history.column)?;
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
            let chart = history::chart(history, lines);
            drawings.push((table.name, page::figure(&chart, history::CAPTION)?));
        }
    }
    process::progress("");

    println!("{}", text::text(&rows));
    process::write(&folder.join("tables.csv"), &rows::csv(&rows)?)?;
    process::write(&folder.join("tables.html"), html::page(&rows, &drawings).as_bytes())
}

/// Runs one entry; with a folder, its files are left there. A reference that its table has must be there.
fn entry(
    mbs: &Mbs,
    table: &report::Table,
    method: &report::Method,
    step: f64,
    out: Option<&Path>,
) -> Result<Outcome, String> {
    let step = format!("{step:e}");
    let arguments = ["--formulation", method.formulation, "--step", &step];
    let arguments: Vec<_> =
        arguments.iter().chain(method.arguments).map(|&word| word.to_owned()).collect();
    let outcome = mbs.run(&scene(table.scene), &arguments, out, None)?;
    if let (Some(figures), Some(reference)) = (outcome.figures(), table.reference) {
        figures.distance(reference.channel, reference.value)?;
    }
    Ok(outcome)
}
