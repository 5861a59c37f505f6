//! The report's grades, G1 and G2: letters by stated rules from our runs, beside the published ones.

mod code;
mod column;
mod ladder;
mod letter;
mod printed;

use crate::format::{error, ratio, seconds, step};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};
use column::{Cell, Column};
use ladder::Ladder;
use printed::{METHODS, Method};

/// Steps for a required accuracy and for difficult conditions, two per decade [s].
const STEPS: &[f64] = &[3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5];
/// Steps for difficult conditions of small mechanisms [s].
const FINE: &[f64] = &[3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];
/// Steps for difficult conditions of vehicles [s].
const COARSE: &[f64] = &[3e-2, 1e-2, 3e-3, 1e-3];
/// Steps for Andrews' mechanism, whose motion is a hundred times as fast [s].
const FAST: &[f64] = &[1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7];

/// Problems of two to eight unknowns.
const SMALL: [Ladder; 3] = [
    Ladder::new("double-pendulum", STEPS),
    Ladder::new("two-four-bars", STEPS),
    Ladder::new("andrews", FAST),
];
/// Problems of roughly ten to some hundred unknowns.
const LARGE: [Ladder; 4] = [
    Ladder::new("iltis-suspension", STEPS),
    Ladder::new("spatial-chain-20", STEPS),
    Ladder::new("tree-30", STEPS),
    Ladder::new("iltis-stairs", STEPS),
];

/// A ladder with one step, and a short duration if the step is small.
const fn at(scene: &'static str, steps: &'static [f64], duration: Option<f64>) -> Ladder {
    Ladder { duration, ..Ladder::new(scene, steps) }
}

/// Steps below 1e-5 s.
const TINY: [Ladder; 3] = [
    at("double-pendulum", &[1e-6], Some(1.0)),
    at("two-four-bars", &[1e-6], Some(1.0)),
    at("andrews", &[1e-6], None),
];
/// Steps between small and large ones.
const USUAL: [Ladder; 3] = [
    at("double-pendulum", &[1e-3], None),
    at("two-four-bars", &[1e-3], None),
    at("iltis-suspension", &[1e-3], None),
];
/// Steps above 1e-2 s.
const WIDE: [Ladder; 3] = [
    at("double-pendulum", &[2e-2], None),
    at("two-four-bars", &[2e-2], None),
    at("iltis-slalom", &[2e-2], None),
];

/// A second copy of the four-bar's last joint.
const TWICE: &str = "
[[joint]]
name = \"end-0-again\"
kind = \"revolute\"
bodies = [\"coupler-0\", \"crank-1\"]
at = [1.0, 1.0]
";

/// Difficult conditions, each with its scenes.
const CONDITIONS: [(&str, &[Ladder]); 5] = [
    ("changing topologies", &[Ladder::new("iltis-jump", COARSE)]),
    (
        "singular configurations",
        &[Ladder::new("two-four-bars", FINE), Ladder::new("n-four-bar-10", FINE)],
    ),
    (
        "inequality constraints",
        &[Ladder::new("hammer-blow", FINE), Ladder::new("iltis-suspension-stiff", COARSE)],
    ),
    (
        "numerical stiffness",
        &[Ladder::new("iltis-suspension-stiff", COARSE), Ladder::new("iltis-stairs-stiff", COARSE)],
    ),
    (
        "redundant constraints",
        &[
            Ladder::new("spatial-four-bar", FINE),
            Ladder { appended: TWICE, ..Ladder::new("four-bar", FINE) },
        ],
    ),
];

/// Table of grades for speed and accuracy.
///
/// # Errors
///
/// The reason why a case cannot be run, or why the sources cannot be counted.
pub(crate) fn g1(lab: &Lab<'_>) -> Result<Section, String> {
    let counted = METHODS.map(|method| code::count(method.package));
    let counted = counted.into_iter().collect::<Result<Vec<_>, _>>()?;
    let lines: Vec<_> = METHODS
        .iter()
        .zip(&counted)
        .map(|(_, c)| (c.lines, format!("{} lines", c.lines)))
        .collect();
    let files: Vec<_> = counted.into_iter().map(|c| c.graph).collect();
    let columns = [
        column::easiness(&lines),
        column::graphs(&files),
        column::speed(lab, "speed, small to medium", &SMALL)?,
        column::speed(lab, "speed, medium to large", &LARGE)?,
        column::accuracy(lab, "accuracy, dt < 1e-5", &TINY)?,
        column::accuracy(lab, "accuracy, 1e-5 < dt < 1e-2", &USUAL)?,
        column::accuracy(lab, "accuracy, dt > 1e-2", &WIDE)?,
    ];
    let printed = |method: &Method| method.speed_and_accuracy;
    Ok(section("G1", "Results in speed and accuracy, graded", &columns, printed))
}

/// Table of grades under difficult conditions.
///
/// # Errors
///
/// The reason why a case cannot be run.
pub(crate) fn g2(lab: &Lab<'_>) -> Result<Section, String> {
    let columns = CONDITIONS.iter().map(|(name, ladders)| column::condition(lab, name, ladders));
    let columns = columns.collect::<Result<Vec<_>, _>>()?;
    let printed = |method: &Method| method.conditions;
    Ok(section("G2", "Performance under different conditions, graded", &columns, printed))
}

/// The letters of all methods with the published ones below, the rules, and every run.
fn section(
    name: &'static str,
    title: &'static str,
    columns: &[Column],
    printed: impl Fn(&Method) -> Option<[&'static str; 2]>,
) -> Section {
    let mut section = Section::new(name, title);
    section.words(
        "A outstanding, B good, C fair, D poor, F a failure. Each letter is followed by what it rests on: how many times the best \
         method's number, or what was counted. No letter is set by hand; on the page each leads to its runs.",
    );
    let mut head = vec!["method"];
    head.extend(columns.iter().map(|column| column.name));
    let mut rows = Vec::new();
    for (m, method) in METHODS.iter().enumerate() {
        let cells = columns.iter().map(|column| cell_text(&column.cells[m]));
        rows.push([method.name.to_owned()].into_iter().chain(cells).collect());
        if let Some([report, publication]) = printed(method) {
            let letters = |source: &str, row: &str| {
                [source.to_owned()].into_iter().chain(row.chars().map(String::from)).collect()
            };
            rows.push(letters("  the report", report));
            if publication != report {
                rows.push(letters("  publication 1", publication));
            }
        }
    }
    section.table(&head, rows);
    for column in columns {
        section.words(format!("{}: {}", column.name, column.rule));
    }
    let head = ["method, column", "scene", "step [s]", "share", "CPU [s]", "what came of it"];
    section.behind("Every count and every run", &head, behind(columns));
    section.runs = columns.iter().flat_map(|c| &c.cells).flat_map(|c| c.runs.clone()).collect();
    section
}

/// Text of a letter and its basis.
fn cell_text(cell: &Cell) -> String {
    let rests = match cell.ratio {
        Some(x) if cell.counted.is_empty() => ratio(x),
        _ => cell.counted.clone(),
    };
    format!("{} {rests}", cell.letter.symbol()).trim_end().to_owned()
}

/// Rows of the runs on which the letters are based, named after their method and their column.
fn behind(columns: &[Column]) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for column in columns {
        for (method, cell) in METHODS.iter().zip(&column.cells) {
            let name = format!("{}, {}", method.name, column.name);
            if cell.runs.is_empty() {
                let none = String::new;
                rows.push(vec![name.clone(), none(), none(), none(), none(), cell.counted.clone()]);
            }
            rows.extend(cell.runs.iter().map(|run| line(&name, run)));
        }
    }
    rows
}

/// A run as a row.
fn line(name: &str, run: &Run) -> Vec<String> {
    let share = run.figures().map(|f| error(f.share())).unwrap_or_default();
    let time = run.seconds().map(seconds).unwrap_or_default();
    let reason = run.outcome.reason();
    let came = if reason.is_empty() { "ended".to_owned() } else { reason };
    let scene = if run.case.appended.is_empty() {
        run.case.scene.to_owned()
    } else {
        format!("{} with a joint twice", run.case.scene)
    };
    vec![name.to_owned(), scene, step(run.case.step), share, time, came]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::fake;

    #[test]
    fn every_cell_has_a_letter_and_leads_to_its_runs() {
        fake::with_lab(|lab| {
            for (section, columns) in [(g1(lab).unwrap(), 7), (g2(lab).unwrap(), 5)] {
                let html = section.html();
                for method in METHODS {
                    assert!(html.contains(&format!(">{}</th>", crate::page::words(method.name))));
                }
                let links = html.matches("<a href=\"#").count();
                assert_eq!(links, METHODS.len() * columns, "{}", section.name);
                for link in html.split("<a href=\"#").skip(1) {
                    let to = link.split('"').next().unwrap();
                    assert!(html.contains(&format!("<tr id=\"{to}\">")), "{to}");
                }
                assert!(section.text().contains("publication 1"));
                assert!(!section.runs.is_empty());
            }
        });
    }
}
