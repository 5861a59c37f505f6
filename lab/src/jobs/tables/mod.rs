//! The job `cargo xtask tables`: makes the report's tables again, and compares them with the published numbers.

mod expected;
mod history;
mod precision;
mod report;
mod rows;
mod section;

use crate::chart::picture::picture;
use crate::format::paragraph;
use crate::lab::section::Section;
use crate::lab::{self, Lab};
use crate::mbs::outcome::Outcome;
use crate::mbs::{Mbs, columns, scene};
use crate::{bench, digits, report_grades, step_experiments};
use rows::Row;
use std::path::Path;
use xtask::process;

/// Largest number of steps of a run with `--quick`.
const QUICK: f64 = 1e6;

/// Function that makes a table as a section: grades, and results of experiments on steps.
type Made = fn(&Lab<'_>) -> Result<Section, String>;
/// Tables made of sections, by their names. F6 has the report's Figures 6 and 7, and D1 answers the report's question on 32 digits.
const MADE: [(&str, Made); 4] = [
    ("G1", report_grades::g1),
    ("G2", report_grades::g2),
    (STEPS, step_experiments::figures),
    ("D1", digits::d1),
];
/// Name of the table that is also an experiment on steps.
const STEPS: &str = "F6";
/// Names of Tables IV and V of the report, on processors, which the bench measures.
const PROCESSORS: [&str; 2] = ["T6", "T7"];

/// The names of all tables.
pub(crate) fn names() -> Vec<&'static str> {
    let tables = report::TABLES.iter().map(|table| table.name);
    tables.chain(PROCESSORS).chain(MADE.map(|(name, _)| name)).collect()
}

/// The names of the tables that no other job measures. The report's pages contain each run only once.
pub(crate) fn own() -> Vec<String> {
    let is_own = |name: &&str| *name != STEPS && !PROCESSORS.contains(name);
    names().into_iter().filter(is_own).map(str::to_owned).collect()
}

/// Page of the tables, with its surprises.
#[derive(Debug)]
pub(crate) struct Tables {
    /// Page as HTML.
    pub(crate) html: String,
    /// Outcomes that differ from the list.
    pub(crate) surprises: Vec<String>,
    /// Number of entries that were run.
    pub(crate) entries: usize,
}

/// Runs every entry of the tables, or of the named ones, and writes them as text, CSV and HTML.
///
/// # Errors
///
/// The reason why something cannot be run, or outcomes that differ from the list.
pub(crate) fn tables(quick: bool, names: &[String]) -> Result<(), String> {
    listed(&run(quick, names)?.surprises)
}

/// Fails if outcomes differ from the list.
///
/// # Errors
///
/// The differences, if there are any.
pub(crate) fn listed(surprises: &[String]) -> Result<(), String> {
    if surprises.is_empty() {
        Ok(())
    } else {
        Err(format!("not what is listed:\n{}", surprises.join("\n")))
    }
}

/// Builds `mbs`, runs all entries one after the other, and writes the files under `target/tables`.
///
/// # Errors
///
/// An unknown name, or the reason why something cannot be run.
#[allow(clippy::print_stdout, reason = "the tables are what is asked for")]
pub(crate) fn run(quick: bool, wanted: &[String]) -> Result<Tables, String> {
    let known = names();
    if let Some(name) = wanted.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(format!("no table `{name}`; there are {}", known.join(", ")));
    }
    let mbs = Mbs::build()?;
    let folder = process::target_dir().join("tables");
    let is_wanted = |name: &str| wanted.is_empty() || wanted.iter().any(|n| n == name);
    let Entries { rows, mut sections, pictures } = entries(&mbs, &folder, quick, &is_wanted)?;
    sections.extend(made(&mbs, &folder, quick, &is_wanted)?);
    process::progress("");

    let mut text = lab::section::text(&sections);
    paragraph(&mut text, 0, section::REMARK);
    println!("{text}");
    let html = lab::section::page("The report's tables, run anew", section::REMARK, &sections);
    process::write(&folder.join("tables.csv"), &rows::csv(&rows)?)?;
    process::write(&folder.join("tables.html"), html.as_bytes())?;
    for (name, svg) in &pictures {
        process::write(&folder.join(format!("{name}.svg")), svg.as_bytes())?;
    }
    Ok(Tables { html, surprises: expected::surprises(&rows), entries: rows.len() })
}

/// Results of the tables on accuracy and time.
#[derive(Default)]
struct Entries {
    rows: Vec<Row>,
    sections: Vec<Section>,
    /// Drawings as separate files, by the names of their tables.
    pictures: Vec<(&'static str, String)>,
}

/// Runs the entries of the tables on accuracy and time.
fn entries(
    mbs: &Mbs,
    folder: &Path,
    quick: bool,
    is_wanted: &dyn Fn(&str) -> bool,
) -> Result<Entries, String> {
    let runs = folder.join("runs");
    let mut all = Entries::default();
    for table in report::TABLES.iter().filter(|table| is_wanted(table.name)) {
        let (mut rows, mut lines) = (Vec::new(), Vec::new());
        for (method, step) in
            table.entries().filter(|(_, step)| !quick || table.steps(*step) <= QUICK)
        {
            process::progress(&format!("{} {} dt {step:.0e}", table.name, method.name));
            let drawn = table.history.filter(|_| table.draws(method, step));
            let outcome = entry(mbs, table, method, step, drawn.map(|_| &*runs))?;
            if let Some(history) = drawn.filter(|_| outcome.has_run()) {
                let points = columns::history(&runs.join("run.csv"), history.column)?;
                // the run with the finest step is drawn below the others
                let at = if table.is_finest(method, step) { 0 } else { lines.len() };
                lines.insert(at, (format!("{}, {step:e} s", method.name), points));
            }
            rows.push(Row::new(table, method, step, outcome));
        }
        let drawn = if let Some(history) = &table.history {
            Some((history::chart(history, lines), history::CAPTION))
        } else {
            precision::chart(table, &rows).map(|chart| (chart, precision::CAPTION))
        };
        let drawing = drawn.as_ref().map(|(chart, caption)| (chart, *caption));
        all.sections.push(section::section(table, &rows, drawing));
        if let (None, Some((chart, _))) = (&table.history, drawing) {
            all.pictures.push((table.name, picture(chart)?));
        }
        all.rows.extend(rows);
    }
    Ok(all)
}

/// The tables that are made of sections.
fn made(
    mbs: &Mbs,
    folder: &Path,
    quick: bool,
    is_wanted: &dyn Fn(&str) -> bool,
) -> Result<Vec<Section>, String> {
    let mut sections = Vec::new();
    if PROCESSORS.iter().any(|name| is_wanted(name)) {
        sections.push(bench::processors(quick)?);
    }
    let runner = lab::runner(mbs, folder);
    let lab = Lab { runner: &runner, quick, folder: folder.to_path_buf() };
    for (_, made) in MADE.iter().filter(|(name, _)| is_wanted(name)) {
        sections.push(made(&lab)?);
    }
    Ok(sections)
}

/// Runs one entry of a table. With a folder, the files of the run are written to it. If the table has a reference, its channel must exist.
fn entry(
    mbs: &Mbs,
    table: &report::Table,
    method: &report::Method,
    step: f64,
    out: Option<&Path>,
) -> Result<Outcome, String> {
    let mut arguments = method.options();
    let step = format!("{step:e}");
    arguments.extend(["--step", &step]);
    let arguments: Vec<_> = arguments.into_iter().map(str::to_owned).collect();
    let outcome = mbs.run(&scene(table.scene), &arguments, out, None)?;
    if let (Some(figures), Some(reference)) = (outcome.figures(), table.reference) {
        figures.distance(reference.channel, reference.value)?;
    }
    Ok(outcome)
}
