//! The runs of cells, in full.

use super::cells::{Cell, WAYS};
use super::run::{Figures, Run};
use crate::tell::{error, step};

/// The head of all runs.
pub(super) const HEAD: [&str; 10] = [
    "step [s], alpha, way",
    "energy error [J]",
    "phi [m]",
    "phi' [m/s]",
    "phi'' [m/s²]",
    "steps",
    "iterations",
    "corrections",
    "time of a step [µs]",
    "reason",
];

/// Every run of some cells, in full.
pub(super) fn rows<'a>(cells: impl Iterator<Item = &'a Cell>) -> Vec<Vec<String>> {
    let each =
        |cell: &'a Cell| cell.runs.iter().zip(WAYS).map(move |(run, way)| (cell, run, way.name));
    cells
        .flat_map(each)
        .map(|(cell, run, way)| {
            let name = format!("{}, 1e{}, {way}", step(cell.step()), cell.exponent);
            let Run::Made(f) = run else { return vec![name, run.reason()] };
            let [q, v, a] = f.violation.map(error);
            let corrections = f.corrections.map(|n| format!("{n:.1}")).unwrap_or_default();
            let counts = [format!("{:.0}", f.steps), format!("{:.1}", f.iterations), corrections];
            let time = format!("{:.2}", f.seconds * 1e6);
            let [steps, iterations, corrections] = counts;
            vec![
                name,
                error(f.energy_error),
                q,
                v,
                a,
                steps,
                iterations,
                corrections,
                time,
                run.reason(),
            ]
        })
        .collect()
}

/// Every run as CSV.
///
/// # Errors
///
/// What the writer says.
pub(super) fn csv(cells: &[Cell]) -> Result<Vec<u8>, String> {
    let mut out = csv::Writer::from_writer(Vec::new());
    let head = [
        "scene",
        "step_s",
        "alpha",
        "way",
        "energy_error_j",
        "turned_over_j",
        "phi",
        "phi_d",
        "phi_dd",
        "steps",
        "iterations_per_step",
        "corrections_per_solution",
        "seconds_per_step",
        "stopped_at_s",
        "reason",
    ];
    out.write_record(head).map_err(|e| e.to_string())?;
    for cell in cells {
        for (run, way) in cell.runs.iter().zip(WAYS) {
            let f = match run {
                Run::Made(figures) => figures.clone(),
                Run::None(_) => Figures::default(),
            };
            let exact = |x: f64| format!("{x:e}");
            let record = [
                cell.scene.file.to_owned(),
                step(cell.step()),
                format!("1e{}", cell.exponent),
                way.name.to_owned(),
                exact(f.energy_error),
                exact(f.turned_over),
                exact(f.violation[0]),
                exact(f.violation[1]),
                exact(f.violation[2]),
                exact(f.steps),
                exact(f.iterations),
                f.corrections.map(exact).unwrap_or_default(),
                exact(f.seconds),
                f.stopped.as_ref().map(|s| exact(s.0)).unwrap_or_default(),
                run.reason(),
            ];
            out.write_record(record).map_err(|e| e.to_string())?;
        }
    }
    out.into_inner().map_err(|e| e.to_string())
}
