//! The page of a sweep: each result over each parameter, traces of some members, and the table of members.

use super::diagram::{Diagram, DiagramLine, Look};
use super::pack::Pack;
use super::results::plot_frames;
use super::section::{DiagramFrame, Page, PageSection};
use crate::table::{Section, row};
use mbs::results::ResultTable;
use mbs_scene::format::{duration, few};
use mbs_study::sweep::{Columns, Report};
use serde_json::json;

/// Diagrams that stand open on the page [-]: a screen or two.
const MAX_OPEN: usize = 12;
/// Points of all diagrams [-]: the page then stays below four megabytes. Chosen, not tuned.
const MAX_POINTS: usize = 24_000;
/// Rows of the table of members [-]: of more, the page says where the others are.
const MAX_ROWS: usize = 500;
/// Ratio of the largest to the least value beyond which a positive parameter has a logarithmic axis [-].
const MANY_TIMES: f64 = 50.0;
/// The three numbers of each column of the outputs.
const NUMBERS: [&str; 3] = ["at the end", "least", "largest"];

/// Writes the page of a sweep: one HTML file without references to anything outside. Traces are rows of some members, by their names.
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
        let (frames, drawn) = plot_frames(traces, &names, (false, false), &mut pack);
        panels = Some(drawn);
        let title = format!("Traces of {} members", traces.len());
        sections.push(PageSection::Fold(title, vec![PageSection::Plots(frames)]));
    }
    sections.push(PageSection::of(members(columns, report).folded()));
    let made = Section::new("How this was made", &[], vec![row("command", command.to_owned())]);
    sections.push(PageSection::of(made.folded()));
    let diagrams = json!({ "looks": looks(), "panels": diagrams, "maps": [] });
    let header = match panels {
        Some(panels) => json!({ "diagrams": diagrams, "panels": panels }),
        None => json!({ "diagrams": diagrams }),
    };
    Page { title: title.to_owned(), sections, pack: Some(pack.text(header)) }.html()
}

/// The members that failed, by code.
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
    // a disc, a triangle that points down, one that points up
    [0, 4, 2].into_iter().zip(NUMBERS).map(look).collect()
}

/// Each result over each parameter.
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

/// A row for each member: its numbers, what became of it, and the outputs at the end.
fn members(columns: &Columns, report: &Report) -> Section {
    let mut shown = vec![0];
    shown.extend(columns.parameters());
    shown.push(columns.code());
    shown.extend(columns.channels());
    let short = |cell: &String| cell.parse::<f64>().map_or_else(|_| cell.clone(), few);
    let row = |row: &Vec<String>| {
        let cells = shown.iter().map(|i| match (*i, row.get(*i)) {
            (0, Some(cell)) => cell.clone(),
            (_, cell) => cell.map(short).unwrap_or_default(),
        });
        cells.collect()
    };
    let head: Vec<&str> = shown.iter().map(|i| columns.header()[*i].as_str()).collect();
    let rows = report.rows.iter().take(MAX_ROWS).map(row).collect();
    let mut table = Section::new("Members", &head, rows);
    table.caption = "Outputs at the end of the run; table.csv has all columns".to_owned();
    table.caption += &match report.rows.len() {
        n if n > MAX_ROWS => format!(" and the other {} members.", n - MAX_ROWS),
        _ => ".".to_owned(),
    };
    table
}
