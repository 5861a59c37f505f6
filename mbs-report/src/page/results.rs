//! Pages of results from files: channels of several runs, and the difference of two runs.

use super::decimate::MAX_POINTS;
use super::pack::Pack;
use super::panels::{Curve, Panels};
use super::section::{Page, PageSection, PlotFrame};
use crate::table::Section;
use mbs::results::{Difference, ResultTable, difference_over_time, envelope};
use mbs_scene::format::{few, rounded, significant};
use serde_json::{Value, json};

/// Number of digits in the table of peaks.
const DIGITS: usize = 6;
/// Largest number of panels with full lines [-]. On a page with more panels, lines have fewer points, so that the page is smaller than four
/// megabytes.
const MANY_PANELS: usize = 200;

/// Returns the number of points of a line on a page with `n_panels` panels [-].
fn points(n_panels: usize) -> usize {
    (MAX_POINTS * MANY_PANELS / n_panels.max(MANY_PANELS)).max(16)
}

/// Writes a page of plots. Each column is drawn over time, or the second column over the first. A plot has a line for each run with that
/// column.
#[must_use]
pub fn plots_page(
    runs: &[(String, ResultTable)],
    names: &[String],
    is_over: bool,
    is_log: bool,
) -> String {
    let mut pack = Pack::default();
    let (frames, panels) = plot_frames(runs, names, (is_over, is_log), &mut pack);
    let labels: Vec<&str> = runs.iter().map(|(label, _)| label.as_str()).collect();
    Page {
        title: labels.join(", "),
        sections: vec![PageSection::Plots(frames)],
        pack: Some(pack.text(json!({ "panels": panels }))),
    }
    .html()
}

/// Returns plots of columns of several runs over time, each with the band between the smallest and largest value of all runs. Also returns
/// their panels for the pack.
pub(super) fn banded_frames(
    runs: &[(String, ResultTable)],
    names: &[String],
    pack: &mut Pack,
) -> (Vec<PlotFrame>, Value) {
    let mut panels = Panels::new(points(names.len()));
    let tables: Vec<&ResultTable> = runs.iter().map(|(_, run)| run).collect();
    let frame = |name: &String| {
        let mut frame = over_time(runs, name, false, (&mut panels, pack));
        if let Some(band) = envelope(&tables, name).filter(|_| tables.len() > 1) {
            let n = tables.len();
            frame.caption += &format!(" The band is the least and the largest of these {n}.");
            panels.add_band(&frame, &band, pack);
        }
        frame
    };
    let frames = names.iter().map(frame).collect();
    (frames, panels.json())
}

/// Returns a plot of a column of several runs over time.
fn over_time(
    runs: &[(String, ResultTable)],
    name: &str,
    is_log: bool,
    (panels, pack): (&mut Panels, &mut Pack),
) -> PlotFrame {
    let with_column = runs.iter().filter_map(|run| Some((run, run.1.column(name)?)));
    let curves = with_column.map(|((label, run), column)| Curve {
        name: label,
        times: &run.times,
        across: None,
        values: &column.values,
    });
    let size = if is_log { "Magnitude of " } else { "" };
    let caption = format!("{size}{name} over time.");
    let text = (name, unit(runs, name), caption);
    panels.add_curves(text, &curves.collect::<Vec<_>>(), (is_log, ""), pack)
}

/// Returns plots of columns of several runs, and their panels for the pack.
fn plot_frames(
    runs: &[(String, ResultTable)],
    names: &[String],
    (is_over, is_log): (bool, bool),
    pack: &mut Pack,
) -> (Vec<PlotFrame>, Value) {
    let mut panels = Panels::new(points(names.len()));
    let frames: Vec<PlotFrame> = match (is_over, names) {
        (true, [across, up]) => {
            let has_both = |run: &&(String, ResultTable)| {
                run.1.column(across).is_some() && run.1.column(up).is_some()
            };
            let both = runs.iter().filter(has_both);
            let curves = both.map(|(label, run)| Curve {
                name: label,
                times: &run.times,
                across: run.column(across).map(|column| column.values.as_slice()),
                values: run.column(up).map_or(&[], |column| &column.values),
            });
            let unit = unit(runs, up);
            let caption = format!("{up} over {across}; the dot is at the time of the cursor.");
            let axis = match self::unit(runs, across) {
                "" | "-" => across.clone(),
                unit => format!("{across} [{unit}]"),
            };
            let title = format!("{up} over {across}");
            let text = (title.as_str(), unit, caption);
            vec![panels.add_curves(text, &curves.collect::<Vec<_>>(), (is_log, &axis), pack)]
        }
        _ => {
            let of_name = |name: &String| over_time(runs, name, is_log, (&mut panels, pack));
            names.iter().map(of_name).collect()
        }
    };
    (frames, panels.json())
}

/// Returns the unit of a column in the first run that has the column.
fn unit<'a>(runs: &'a [(String, ResultTable)], name: &str) -> &'a str {
    runs.iter().find_map(|(_, run)| run.column(name)).map_or("", |column| &column.unit)
}

/// Writes a page of the difference of two runs: the largest difference, plots of each column with its difference, and the table of peaks.
#[must_use]
pub fn difference_page(
    runs: &[(String, ResultTable); 2],
    found: &Difference,
    within: Option<f64>,
) -> String {
    let [(a, _), (b, _)] = runs;
    let mut worst: Vec<_> = found.columns.iter().collect();
    worst.sort_by(|x, y| y.relative.total_cmp(&x.relative));
    let mut sections = Vec::new();
    if let Some(within) = within.filter(|within| !found.is_within(*within)) {
        let most = few(within);
        sections.push(PageSection::Error(format!(
            "The runs differ by more than {most} of the range of a column."
        )));
    }
    let notes = notes(runs, found);
    if !notes.is_empty() {
        sections.push(PageSection::Notes(notes));
    }
    if let Some(first) = worst.first() {
        let largest = format!("{} of the range", few(first.relative));
        let cards = [
            ("largest difference", largest),
            ("of", first.name.clone()),
            ("at", format!("{} s", significant(rounded(first.at, DIGITS)))),
        ];
        sections.push(PageSection::Cards(cards.map(|(k, v)| [k.to_owned(), v]).into()));
    }
    let (mut pack, mut panels) = (Pack::default(), Panels::new(points(2 * worst.len())));
    let mut frames = Vec::new();
    for column in &worst {
        let name = column.name.as_str();
        let both = runs.iter().filter_map(|(label, run)| {
            let values = &run.column(name)?.values;
            Some(Curve { name: label, times: &run.times, across: None, values })
        });
        let both: Vec<_> = both.collect();
        let text = (name, column.unit.as_str(), format!("{name} in both runs."));
        frames.push(panels.add_curves(text, &both, (false, ""), &mut pack));
        let Some([times, values]) = difference_over_time(&runs[0].1, &runs[1].1, name) else {
            continue;
        };
        let title = format!("{name}: difference");
        let caption = format!(
            "{a} minus {b}, linear between rows: at most {}, {} of the range, at {} s.",
            significant(rounded(column.difference, DIGITS)),
            few(column.relative),
            significant(rounded(column.at, DIGITS))
        );
        let curve = Curve { name: "difference", times: &times, across: None, values: &values };
        let text = (title.as_str(), column.unit.as_str(), caption);
        frames.push(panels.add_curves(text, &[curve], (false, ""), &mut pack));
    }
    sections.push(PageSection::Plots(frames));
    sections.push(PageSection::Table(peaks([a, b], found)));
    Page {
        title: format!("{a} and {b}: difference"),
        sections,
        pack: Some(pack.text(json!({ "panels": panels.json() }))),
    }
    .html()
}

/// Returns notes on the columns and times that are not compared.
fn notes(runs: &[(String, ResultTable); 2], found: &Difference) -> Vec<String> {
    let [(a, _), (b, _)] = runs;
    let mut notes = Vec::new();
    for (names, run) in [(&found.only_a, a), (&found.only_b, b)] {
        if !names.is_empty() {
            notes.push(format!("In {run} alone: {}.", names.join(", ")));
        }
    }
    if !found.ends_together() {
        let [a, b] = found.ends.map(significant);
        notes
            .push(format!("The runs end at {a} and {b} s: they are compared up to the first end."));
    }
    notes
}

fn peaks([a, b]: [&String; 2], found: &Difference) -> Section {
    let number = |x: f64| significant(rounded(x, DIGITS));
    let row = |column: &mbs::results::ColumnDifference| {
        let numbers = [
            column.peaks[0],
            column.peaks[1],
            column.rms[0],
            column.rms[1],
            column.difference,
            column.at,
        ];
        let mut row = vec![column.name.clone(), column.unit.clone()];
        row.extend(numbers.map(number));
        row.push(few(column.relative));
        row
    };
    let head = [
        "column",
        "unit",
        &format!("peak {a}"),
        &format!("peak {b}"),
        &format!("RMS {a}"),
        &format!("RMS {b}"),
        "largest difference",
        "at [s]",
        "of the range",
    ];
    let mut table = Section::new("Peaks", &head, found.columns.iter().map(row).collect());
    table.caption =
        "Peak: largest magnitude. Peaks and RMS are those of every step where the run has them, else of the rows."
            .to_owned();
    table
}
