//! Command `mbs diff A B`: comparison of the results of two runs.

use crate::channels::{number, time};
use crate::files;
use crate::refusal::Refusal;
use crate::say::say;
use crate::scene::SceneArgument;
use crate::signals;
use crate::status::STOPPED;
use clap::Args;
use mbs::results::{ColumnDifference, Difference, ResultTable, difference};
use mbs::{Method, Run};
use mbs_report::difference_page;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Largest number of characters of a column's name in the table. With it the table fits into a hundred columns.
const NAME_WIDTH: usize = 26;

/// Arguments of `mbs diff`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// First run: a directory that `mbs run --out` has written, or a scene file, which is run.
    a: PathBuf,
    /// Second run.
    b: PathBuf,
    /// Largest difference, relative to the range of each channel; beyond it the exit status is 2. Default: none.
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    within: Option<f64>,
    /// Name of a channel, or of one of its columns; may be repeated. Default: all.
    #[arg(long, value_name = "NAME")]
    channel: Vec<String>,
    /// Page (.html) with both lines of each column, their difference, and a table of peaks. Default: none.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
}

fn ratio(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| *x >= 0.0 && x.is_finite());
    number.ok_or_else(|| "write a number of at least zero, such as 1e-6".to_owned())
}

/// Runs the command `mbs diff`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match compared(arguments) {
        Ok(found) => report(arguments, &found),
        Err(refusal) => refusal.report(),
    }
}

fn compared(arguments: &Arguments) -> Result<Difference, Refusal> {
    let is_page = |path: &Path| path.extension().is_some_and(|ending| ending == "html");
    if let Some(path) = arguments.out.as_deref().filter(|path| !is_page(path)) {
        let message = format!("`{}` is no name of a page", path.display());
        return Err(Refusal::new("usage", message, "give a file that ends with .html"));
    }
    let (a, mut b) = (results(&arguments.a, &[])?, results(&arguments.b, &[])?);
    b.in_units_of(&a);
    let found = difference(&a, &b, &arguments.channel);
    let missing = |name: &&String| {
        let has = |table: &ResultTable| {
            table.columns.iter().any(|x| x.channel == **name || x.name == **name)
        };
        !has(&a) && !has(&b)
    };
    if let Some(name) = arguments.channel.iter().find(missing) {
        let known: Vec<_> = a.columns.iter().map(|column| column.channel.as_str()).collect();
        return Err(unknown(name, known));
    }
    if found.columns.is_empty() {
        let hint = "compare runs that have an output of the same name";
        return Err(Refusal::new("no-common-channel", "both runs have no channel in common", hint));
    }
    if let Some(path) = &arguments.out {
        let mut labels = [&arguments.a, &arguments.b].map(|path| label(path));
        if labels[0] == labels[1] {
            labels = [&arguments.a, &arguments.b].map(|path| path.display().to_string());
        }
        let [of_a, of_b] = labels;
        let page = difference_page(&[(of_a, a), (of_b, b)], &found, arguments.within);
        files::write(path, page.as_bytes(), None)?;
    }
    Ok(found)
}

/// Returns the name of a run in a legend: the last part of its path.
pub(crate) fn label(run: &Path) -> String {
    run.file_stem().unwrap_or(run.as_os_str()).to_string_lossy().into_owned()
}

/// The refusal of a channel that no run has.
pub(crate) fn unknown(name: &str, mut known: Vec<&str>) -> Refusal {
    known.dedup();
    let hint = format!("name one of: {}", known.join(", "));
    Refusal::new("unknown-channel", format!("there is no channel `{name}`"), hint)
}

/// The results in a directory, or those of a scene file, which is run with the values of `set`. Otherwise the refusal.
pub(crate) fn results(path: &Path, set: &[String]) -> Result<ResultTable, Refusal> {
    let unreadable = |error: &dyn core::fmt::Display| {
        let hint = "give a directory that `mbs run SCENE --out DIR` has written, or a scene";
        Refusal::new("results-unreadable", error, hint)
    };
    if path.is_dir() {
        if !set.is_empty() {
            let message = format!("--set changes scenes, and `{}` has results", path.display());
            return Err(Refusal::new("set-refused", message, "give a scene, or leave --set out"));
        }
        files::warn_of_mixed(path);
        return ResultTable::open(path).map_err(|error| unreadable(&error));
    }
    let overrides = Method { interrupt: signals::heeded(), ..Method::default() };
    let begun = files::begin(&SceneArgument::new(path, set), &overrides, (None, &[]))?;
    let result = mbs::run(&begun.mechanism, &Run::new().method(overrides));
    let result = result.map_err(|error| files::refused(&error, &begun.document))?;
    ResultTable::of_outcome(result.outcome()).map_err(|error| unreadable(&error))
}

fn report(arguments: &Arguments, found: &Difference) -> ExitCode {
    let is_within = arguments.within.map(|within| found.is_within(within));
    let status = match is_within {
        Some(false) => ExitCode::from(STOPPED),
        _ => ExitCode::SUCCESS,
    };
    let text = if arguments.json {
        let [a, b] = [&arguments.a, &arguments.b].map(|path| path.display().to_string());
        let object = json!({
            "runs": [a, b],
            "within": arguments.within,
            "is_within": is_within,
            "ends": found.ends,
            "columns": found.columns,
            "only_a": found.only_a,
            "only_b": found.only_b,
        });
        format!("{object:#}\n")
    } else {
        let wrote = arguments.out.as_ref().map(|path| format!("wrote {}\n", path.display()));
        lines(found, arguments.within).join("\n") + "\n" + &wrote.unwrap_or_default()
    };
    say(&text, status)
}

fn lines(found: &Difference, within: Option<f64>) -> Vec<String> {
    let head = ["peak A", "peak B", "RMS A", "RMS B", "largest"];
    let head = head.map(|x| format!("{x:>11}")).concat();
    let mut lines = vec![format!("  {:<NAME_WIDTH$} {:<6}{head}{:>9}", "", "unit", "at [s]")];
    lines.extend(found.columns.iter().map(line));
    for (names, which) in [(&found.only_a, "first"), (&found.only_b, "second")] {
        if !names.is_empty() {
            lines.push(format!("  in the {which} run alone: {}", names.join(", ")));
        }
    }
    if !found.ends_together() {
        let [a, b] = found.ends.map(time);
        lines.push(format!("  the runs end at {a} and {b} s: compared up to the first end"));
    }
    let worst = found.columns.iter().max_by(|a, b| a.relative.total_cmp(&b.relative));
    if let Some(ColumnDifference { name, relative, .. }) = worst {
        let verdict = match within {
            Some(most) if found.is_within(most) => format!(", within {most:e}"),
            Some(most) if *relative > most => format!(", beyond {most:e}"),
            _ => String::new(),
        };
        let share = number(*relative);
        lines.push(if *relative > 0.0 {
            format!("  largest difference: {share} of the range, of {name}{verdict}")
        } else {
            "  no difference beyond rounding".to_owned()
        });
    }
    lines
}

fn line(column: &ColumnDifference) -> String {
    let ([a, b], [c, d]) = (column.peaks, column.rms);
    let numbers = [a, b, c, d, column.difference].map(|x| format!("{:>11}", number(x))).concat();
    let n = column.name.chars().count().saturating_sub(NAME_WIDTH);
    // a shortened name keeps its end, which names the component
    let name = match n {
        0 => column.name.clone(),
        _ => ['…'].into_iter().chain(column.name.chars().skip(n + 1)).collect(),
    };
    let at = time(column.at);
    format!("  {name:<NAME_WIDTH$} {:<6}{numbers}{at:>9}", column.unit)
}
