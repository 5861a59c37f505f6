//! Page of a sweep: each result over each parameter, traces of some members, and the table of members.

use super::diagram::{Diagram, DiagramLine, Look};
use super::open_rows::OpenRows;
use super::pack::Pack;
use super::results::banded_frames;
use super::section::{DiagramFrame, Page, PageSection};
use crate::table::{Section, row};
use mbs::results::ResultTable;
use mbs_scene::format::{duration, few};
use mbs_study::sweep::{Columns, Report};
use serde_json::json;

/// Largest number of diagrams that are not folded [-]. They fill a screen or two.
const MAX_OPEN: usize = 12;
/// Largest number of points of all diagrams together [-]. The page is then smaller than four megabytes. Chosen, not tuned.
const MAX_POINTS: usize = 24_000;
/// Largest number of rows of the table of members, and of cells of the tables within it [-]. If there are more, the page refers to the file
/// with all members.
const MAX_ROWS: [usize; 2] = [500, 24_000];
/// Ratio of the largest to the smallest value above which a positive parameter has a logarithmic axis [-].
const MANY_TIMES: f64 = 50.0;
/// Names of the three results that each column of the outputs has.
const NUMBERS: [&str; 3] = ["at the end", "least", "largest"];

/// Writes the page of a sweep: one HTML file without references to other files. `traces` are the results of some members, with their names.
#[must_use]
pub fn sweep_page(
    (title, command): (&str, &str),
    columns: &Columns,
    report: &Report,
    traces: &[(String, ResultTable)],
) -> String {
    let diagrams = diagrams(columns, report);
    let mut frames: Vec<_> = diagrams.iter().enumerate().map(|(i, d)| d.frame(i)).collect();
    let rest: Vec<DiagramFrame> = frames.split_off(frames.len().min(MAX_OPEN));
    let mut sections = notes(report);
    let cards = [
        ("members", report.members.to_string()),
        ("completed", report.completed.to_string()),
        ("CPU time", duration(report.cpu_seconds)),
    ];
    sections.push(PageSection::Cards(cards.map(|(k, v)| [k.to_owned(), v]).into()));
    sections.push(PageSection::Keys);
    sections.push(PageSection::Diagrams(frames));
    if !rest.is_empty() {
        let title = format!("{} more diagrams", rest.len());
        sections.push(PageSection::Fold(title, vec![PageSection::Diagrams(rest)]));
    }
    let mut pack = Pack::default();
    let mut panels = None;
    if let [(_, first), ..] = traces {
        let names: Vec<String> = first.columns.iter().map(|column| column.name.clone()).collect();
        let (frames, drawn) = banded_frames(traces, &names, &mut pack);
        panels = Some(drawn);
        let title = format!("Traces of {} members", traces.len());
        sections.push(PageSection::Fold(title, vec![PageSection::Plots(frames)]));
    }
    sections.push(PageSection::Fold(
        "Members".to_owned(),
        vec![PageSection::Rows(members(columns, report))],
    ));
    let made = Section::new("How this was made", &[], vec![row("command", command.to_owned())]);
    sections.push(PageSection::of(made.folded()));
    let diagrams = json!({ "looks": looks(), "panels": diagrams, "maps": [] });
    let header = match panels {
        Some(panels) => json!({ "diagrams": diagrams, "panels": panels }),
        None => json!({ "diagrams": diagrams }),
    };
    Page { title: title.to_owned(), sections, pack: Some(pack.text(header)) }.html()
}

/// Returns notes on the failed members, by error code.
fn notes(report: &Report) -> Vec<PageSection> {
    let failures = report.failures.iter();
    let note = |(code, (count, first, message)): (&String, &(usize, usize, String))| {
        format!("{count} ended in {code}, first member {first}: {message}")
    };
    let notes: Vec<_> = failures.map(note).collect();
    if notes.is_empty() { Vec::new() } else { vec![PageSection::Notes(notes)] }
}

fn looks() -> Vec<Look> {
    let look = |(kind, name): (usize, &str)| Look {
        name: name.to_owned(),
        kind,
        is_filled: kind == 0,
        is_shown: true,
        ..Look::default()
    };
    // a disc, a triangle that points down, a triangle that points up
    [0, 4, 2].into_iter().zip(NUMBERS).map(look).collect()
}

/// Returns diagrams of each result over each parameter.
fn diagrams(columns: &Columns, report: &Report) -> Vec<Diagram> {
    let header = columns.header();
    let starts: Vec<usize> = columns.channels().collect();
    let n = (starts.len() * columns.parameters().len() * NUMBERS.len()).max(1);
    let every = report.rows.len().div_ceil((MAX_POINTS / n).max(1)).max(1);
    let number = |row: &[String], column: usize| row.get(column)?.parse::<f64>().ok();
    let mut diagrams = Vec::new();
    for start in starts {
        for parameter in columns.parameters() {
            let values = || report.rows.iter().filter_map(|row| number(row, parameter));
            let [low, high] = [f64::min, f64::max].map(|f| values().reduce(f).unwrap_or(0.0));
            let line = |look: usize| {
                let point = |row: &Vec<String>| {
                    let (x, y) = (number(row, parameter)?, number(row, start + look)?);
                    let of = columns.parameters().map(|i| format!("{} {}", header[i], row[i]));
                    let of = of.collect::<Vec<_>>().join(", ");
                    Some((x, y, format!("member {}: {of}: {} {}", row[0], NUMBERS[look], few(y))))
                };
                let points = report.rows.iter().step_by(every).filter_map(point).collect();
                DiagramLine { look, points, ..DiagramLine::default() }
            };
            let of = match every {
                1 => String::new(),
                _ => format!(" One member in {every} is drawn; table.csv has all."),
            };
            diagrams.push(Diagram {
                title: format!("{} over {}", header[start], header[parameter]),
                axes: [header[parameter].clone(), header[start].clone()],
                caption: format!("At the end of the run, and least and largest during it.{of}"),
                lines: (0..NUMBERS.len()).map(line).collect(),
                is_scatter: true,
                is_log: [low > 0.0 && high > MANY_TIMES * low, false],
                ..Diagram::default()
            });
        }
    }
    diagrams
}

/// Returns a table with a row for each member: its number, parameters, status and final outputs. An opened row shows all other data of the
/// member.
fn members(columns: &Columns, report: &Report) -> OpenRows {
    let header = columns.header();
    let mut shown = vec![0];
    shown.extend(columns.parameters());
    shown.push(columns.code());
    shown.extend(columns.channels());
    let short = |cell: &String| cell.parse::<f64>().map_or_else(|_| cell.clone(), few);
    let cell = |row: &[String], i: usize| match (i, row.get(i)) {
        (0, Some(cell)) => cell.clone(),
        (_, cell) => cell.map(short).unwrap_or_default(),
    };
    let values = |row: &[String]| {
        let channels = columns.channels().map(|start| {
            let numbers = (start..start + NUMBERS.len()).map(|i| cell(row, i));
            core::iter::once(header[start].clone()).chain(numbers).collect()
        });
        let first = columns.channels().next().unwrap_or(header.len());
        let of_run = (columns.parameters().end..first)
            .filter(|i| row.get(*i).is_some_and(|x| !x.is_empty()));
        let of_run = of_run.map(|i| vec![header[i].clone(), cell(row, i)]);
        let head = ["", NUMBERS[0], NUMBERS[1], NUMBERS[2]];
        Section::new("", &head, channels.chain(of_run).collect())
    };
    let row = |row: &Vec<String>| (shown.iter().map(|i| cell(row, *i)).collect(), values(row));
    let [rows, cells] = MAX_ROWS;
    let most = rows.min(cells / header.len().max(1)).max(1);
    let rows = report.rows.iter().take(most).map(row).collect();
    let caption = "Outputs at the end of the run; a row opens all values. table.csv has all digits";
    let caption = caption.to_owned()
        + &match report.rows.len() {
            n if n > most => format!(" and the other {} members.", n - most),
            _ => ".".to_owned(),
        };
    OpenRows { head: shown.iter().map(|i| header[*i].clone()).collect(), rows, caption }
}
