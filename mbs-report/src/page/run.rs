//! Page of a run: its error, key numbers, the motion, plots, statistics, and provenance.

use super::decimate::MAX_POINTS;
use super::meshes::PageMeshes;
use super::motion;
use super::paced;
use super::pack::Pack;
use super::panels::Panels;
use super::section::{Page, PageSection};
use super::statistics;
use crate::table::{Section, row};
use mbs::record::{RealtimeSummary, RunRecord};
use serde_json::json;

/// Largest size of the data of a page, as text [bytes]. With its scripts the page is then smaller than four megabytes.
const MAX_PACK: usize = 3_600_000;
/// Largest number of pictures of the motion [-]. A run records as many.
const MAX_PICTURES: usize = 600;
/// Largest number of halvings of pictures and points [-]. After them the data are accepted at any size.
const HALVINGS: u32 = 5;
/// Labels of the summary that are shown at the top of the page.
const FIGURES: [&str; 5] = [
    "degrees of freedom",
    "time reached",
    "steps",
    "CPU time of the steps",
    "largest energy error",
];

/// Packed data for the script, and the sections that refer to them.
struct Drawn {
    pack: String,
    view: Option<PageSection>,
    plots: Vec<PageSection>,
    health: Vec<PageSection>,
}

/// Writes the page of a run: one HTML file without references to other files.
///
/// Series are thinned to at most 1500 points per line. The smallest and largest value of every interval remain, so that peaks are visible.
/// Numbers that are not finite appear as gaps. Lines have a resolution of 1/65000 of their range.
///
/// # Examples
/// ```
/// let record = mbs::record::RunRecord { scene: "pendulum".into(), ..Default::default() };
/// let html = mbs_report::page(&record);
/// assert!(html.starts_with("<!doctype html>") && html.contains("<title>pendulum</title>"));
/// ```
#[must_use]
pub fn page(record: &RunRecord) -> String {
    html(record, Vec::new())
}

/// Writes the page of a real-time run: margins and the ladder are shown before the motion.
#[must_use]
pub fn paced_page(record: &RunRecord, paced: &RealtimeSummary) -> String {
    html(record, paced::sections(paced))
}

fn html(record: &RunRecord, head: Vec<PageSection>) -> String {
    let meshes = record.motion.as_ref().map(PageMeshes::of).unwrap_or_default();
    let (drawn, halvings) = fitting(record, &meshes);
    let mut sections = Vec::new();
    let stop =
        record.error.as_ref().map(|error| PageSection::Error(format!("The run stopped {error}")));
    sections.extend(stop);
    let mut notes = record.notes.clone();
    notes.extend(meshes.notes);
    if halvings > 0 {
        notes.push(format!(
            "The page has one in {} of the pictures and points that a page may have; run.csv has all rows.",
            1 << halvings
        ));
    }
    if !notes.is_empty() {
        sections.push(PageSection::Notes(notes));
    }
    let figures = record.summary.iter().filter(|(label, _)| FIGURES.contains(&label.as_str()));
    let figures: Vec<_> = figures.map(|(label, value)| [label.clone(), value.clone()]).collect();
    if !figures.is_empty() {
        sections.push(PageSection::Cards(figures));
    }
    sections.extend(head);
    sections.extend(drawn.view);
    sections.extend(drawn.plots);
    sections.extend(statistics::section(&record.channels));
    if let [head, rows @ ..] = record.choice.as_slice() {
        sections.push(PageSection::Table(Section {
            title: "What was chosen, and what the others would have cost".to_owned(),
            caption: "CPU time of the whole run and error of its outputs as the pilot predicts them. All trials are in choice.json and \
                      choice.csv."
                .to_owned(),
            head: head.clone(),
            rows: rows.to_vec(),
            ..Section::default()
        }));
    }
    let rows = record.summary.iter().map(|(label, value)| row(label, value.clone())).collect();
    let mut health = vec![PageSection::Table(Section::new("Summary", &[], rows))];
    health.extend(drawn.health);
    sections.push(PageSection::Fold("Solver health".to_owned(), health));
    sections.push(PageSection::Table(Section::made(record.provenance.rows())));
    Page { title: record.scene.clone(), sections, pack: Some(drawn.pack) }.html()
}

/// Returns the drawn data and the number of halvings. Pictures and points are halved until the pack is small enough.
fn fitting(record: &RunRecord, meshes: &PageMeshes) -> (Drawn, u32) {
    let mut halvings = 0;
    loop {
        let drawn = drawn(record, meshes, [MAX_PICTURES, MAX_POINTS].map(|n| n >> halvings));
        if drawn.pack.len() <= MAX_PACK || halvings == HALVINGS {
            return (drawn, halvings);
        }
        halvings += 1;
    }
}

fn drawn(record: &RunRecord, meshes: &PageMeshes, [pictures, points]: [usize; 2]) -> Drawn {
    let mut pack = Pack::default();
    let recorded = record.motion.as_ref();
    let mut motion =
        recorded.and_then(|m| motion::packed((m, meshes), (pictures, false), &mut pack));
    let mut panels = Panels::new(points);
    let (frames, still) = panels.add_channels(&record.channels, &mut pack);
    if let (Some(motion), Some(recorded)) = (&mut motion, recorded) {
        motion["forces"] = panels.forces(&recorded.forces).into();
    }
    let health = panels.add_health(record, &mut pack);
    let pack = pack.text(json!({ "motion": motion, "panels": panels.json() }));
    let view = motion.is_some().then(|| PageSection::View(caption(record)));
    let mut plots = Vec::new();
    if !frames.is_empty() {
        plots.push(PageSection::Plots(frames));
    }
    if !still.is_empty() {
        let table = Section::new("", &[], still);
        plots.push(PageSection::Fold(
            "Outputs that stand still".to_owned(),
            vec![PageSection::Table(table)],
        ));
    }
    Drawn { pack, view, plots, health: vec![PageSection::Plots(health)] }
}

/// Returns sentences that explain parts of the view that are not obvious.
fn caption(record: &RunRecord) -> String {
    let motion = record.motion.as_ref();
    let has_traces = motion.is_some_and(|motion| !motion.traces.is_empty());
    let is_spatial = motion.is_some_and(|motion| motion.dimension == 3);
    let first = if is_spatial {
        "Boxes that the scene does not write have the inertia of their bodies. Left button turns, right button or two fingers move, wheel or pinch zooms."
    } else {
        "Left or right button moves, wheel or pinch zooms."
    };
    let paths = if has_traces { " Lines are the paths of outputs." } else { "" };
    let has_arrows = motion.is_some_and(|motion| !motion.forces.is_empty());
    let arrows = match (has_arrows, is_spatial) {
        (true, true) => " Arrows are forces, those with two heads moments.",
        (true, false) => " Arrows are forces.",
        (false, _) => "",
    };
    format!(
        "{first}{paths}{arrows} Keys: space, arrows, Home, End, f (fit), l (labels), 1 to 4 (sides)."
    )
}
