//! Command `mbs plot RUN... --out FILE`: channels of one or several runs over each other, as a page, as a picture or as a table.

mod dashes;
mod figure;
mod pdf;
mod picture;

use crate::diff::{label, results, unknown};
use crate::files;
use crate::refusal::Refusal;
use crate::say::say;
use clap::Args;
pub(crate) use figure::work_precision;
use mbs::results::ResultTable;
use mbs::scene_file::format::shortest;
pub(crate) use picture::is_picture;
use picture::{Line, Panel, drawn};
use std::path::PathBuf;
use std::process::ExitCode;

/// Largest number of panels of a picture. For more, the user must name channels. Chosen, not tuned.
const MAX_PANELS: usize = 60;

/// Arguments of `mbs plot`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Runs: directories that `mbs run --out` has written, or scene files, which are run.
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// Another value at a path of the scenes among them, as sweeps write it: body.rod.mass=2. May be repeated. Default: none.
    #[arg(long, value_name = "PATH=VALUE", display_order = 800)]
    set: Vec<String>,
    /// Page (.html), picture (.svg, .pdf) or table (.csv) that is written.
    #[arg(long, value_name = "FILE", default_value = "plot.html")]
    out: PathBuf,
    /// Name of a channel, or of one of its columns; may be repeated. Default: all.
    #[arg(long, value_name = "NAME", conflicts_with = "xy")]
    channel: Vec<String>,
    /// Names of two columns: the second over the first. Default: columns over time.
    #[arg(long, num_args = 2, value_names = ["A", "B"])]
    xy: Option<Vec<String>>,
    /// Magnitudes over a logarithmic axis.
    #[arg(long)]
    log: bool,
}

/// Runs the command `mbs plot`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match plotted(arguments) {
        Ok(text) => say(&text, ExitCode::SUCCESS),
        Err(refusal) => refusal.report(),
    }
}

fn plotted(arguments: &Arguments) -> Result<String, Refusal> {
    let path = arguments.out.as_path();
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if !matches!(ending, "html" | "csv") && !is_picture(ending) {
        let message = format!("`{}` is no page, no picture and no table", path.display());
        let hint = "give a file that ends with .html, .svg, .pdf or .csv";
        return Err(Refusal::new("usage", message, hint));
    }
    let runs: Result<Vec<_>, _> =
        arguments.runs.iter().map(|run| results(run, &arguments.set)).collect();
    let mut runs: Vec<(String, ResultTable)> =
        arguments.runs.iter().map(|run| label(run)).zip(runs?).collect();
    if let Some(((_, first), others)) = runs.split_first_mut() {
        others.iter_mut().for_each(|(_, run)| run.in_units_of(first));
    }
    let mut names = names(&runs, arguments.xy.as_ref().unwrap_or(&arguments.channel))?;
    if let Some(xy) = &arguments.xy {
        columns(&runs, xy)?;
        names.clone_from(xy);
    }
    let bytes = match (ending, &arguments.xy) {
        ("csv", _) => table(&runs, &names).into_bytes(),
        ("html", xy) => {
            mbs_report::plots_page(&runs, &names, xy.is_some(), arguments.log).into_bytes()
        }
        (_, Some(xy)) => drawn(&[over(&runs, xy, arguments.log)][..], ending)?,
        _ if names.len() > MAX_PANELS => {
            let message = format!("a picture of {} columns has no use", names.len());
            return Err(Refusal::new("too-many-columns", message, "name some with --channel"));
        }
        _ => drawn(&panels(&runs, &names, arguments.log)[..], ending)?,
    };
    files::write(path, &bytes, None)?;
    Ok(format!("wrote {}\n", path.display()))
}

/// The requested columns, in the order of the runs; without names, all columns. Otherwise the refusal of a name that no run has.
fn names(runs: &[(String, ResultTable)], asked: &[String]) -> Result<Vec<String>, Refusal> {
    let all = || runs.iter().flat_map(|(_, run)| &run.columns);
    let is_of = |name: &str| all().any(|column| column.name == name || column.channel == name);
    if let Some(name) = asked.iter().find(|name| !is_of(name)) {
        return Err(unknown(name, all().map(|column| column.channel.as_str()).collect()));
    }
    let mut names: Vec<String> = Vec::new();
    for column in all() {
        let is_asked =
            asked.is_empty() || asked.iter().any(|x| *x == column.name || *x == column.channel);
        if is_asked && !names.contains(&column.name) {
            names.push(column.name.clone());
        }
    }
    Ok(names)
}

/// Refuses two names if no run has both as columns. The name of a vector is not a column.
fn columns(runs: &[(String, ResultTable)], xy: &[String]) -> Result<(), Refusal> {
    let has = |run: &ResultTable, name: &String| run.column(name).is_some();
    if let Some(name) = xy.iter().find(|name| !runs.iter().any(|(_, run)| has(run, name))) {
        let all = runs.iter().flat_map(|(_, run)| &run.columns);
        return Err(unknown(name, all.map(|column| column.name.as_str()).collect()));
    }
    if !runs.iter().any(|(_, run)| xy.iter().all(|name| has(run, name))) {
        let message = format!("no run has both `{}` and `{}`", xy[0], xy[1]);
        return Err(Refusal::new("unknown-channel", message, "name two columns of one run"));
    }
    Ok(())
}

/// A panel for each column, with a line for each run that has it.
fn panels(runs: &[(String, ResultTable)], names: &[String], is_log: bool) -> Vec<Panel> {
    let panel = |name: &String| {
        let of_run = |(i, (label, run)): (usize, &(String, ResultTable))| {
            let column = run.column(name)?;
            let points = run.times.iter().copied().zip(column.values.iter().copied());
            Some((
                column.unit.clone(),
                Line { label: label.clone(), run: i, points: points.collect() },
            ))
        };
        let (units, lines): (Vec<_>, Vec<_>) = runs.iter().enumerate().filter_map(of_run).unzip();
        let unit = units.first().cloned().unwrap_or_default();
        Panel { titles: ["t [s]".to_owned(), titled(name, &unit)], lines, is_log }
    };
    names.iter().map(panel).collect()
}

/// A panel of the second column over the first.
fn over(runs: &[(String, ResultTable)], xy: &[String], is_log: bool) -> Panel {
    let pair = |run: &ResultTable| Some([run.column(&xy[0])?.clone(), run.column(&xy[1])?.clone()]);
    let mut titles = [xy[0].clone(), xy[1].clone()];
    let mut lines = Vec::new();
    for (i, (label, run)) in runs.iter().enumerate() {
        let Some([x, y]) = pair(run) else { continue };
        titles = [titled(&x.name, &x.unit), titled(&y.name, &y.unit)];
        let points = x.values.into_iter().zip(y.values).collect();
        lines.push(Line { label: label.clone(), run: i, points });
    }
    Panel { titles, lines, is_log }
}

fn titled(name: &str, unit: &str) -> String {
    if unit.is_empty() || unit == "-" { name.to_owned() } else { format!("{name} [{unit}]") }
}

/// The rows of all runs, one run after the other. A column that a run lacks is empty.
fn table(runs: &[(String, ResultTable)], names: &[String]) -> String {
    let quoted = |text: &str| match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    };
    let header = ["run", "t"].into_iter().chain(names.iter().map(String::as_str));
    let mut text = header.map(quoted).collect::<Vec<_>>().join(",") + "\n";
    for (label, run) in runs {
        let columns: Vec<_> = names.iter().map(|name| run.column(name)).collect();
        for (i, t) in run.times.iter().enumerate() {
            text += &format!("{},{}", quoted(label), shortest(*t));
            for column in &columns {
                text += &column
                    .map_or_else(|| ",".to_owned(), |x| format!(",{}", shortest(x.values[i])));
            }
            text.push('\n');
        }
    }
    text
}
