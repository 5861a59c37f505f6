//! What a run came to, as the program tells it.

use super::{Cell, WAYS};
use crate::tell::{error, step};
use serde_json::Value;

/// A run: its figures, or why there are none.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Run {
    /// It reached its end, or stopped on the way, and has figures of the steps it made.
    Made(Figures),
    /// It could not be run, or took too long.
    None(String),
}

/// Figures of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Figures {
    /// Largest energy error, and largest kinetic energy [J].
    pub(super) energy_error: f64,
    pub(super) turned_over: f64,
    /// Largest violation of positions, velocities and accelerations.
    pub(super) violation: [f64; 3],
    pub(super) steps: f64,
    /// Iterations of a step, and its time by the wall clock [s].
    pub(super) iterations: f64,
    pub(super) seconds: f64,
    /// Corrections of a refined solution.
    pub(super) corrections: Option<f64>,
    /// When [s] and why it stopped.
    pub(super) stopped: Option<(f64, String)>,
}

impl Run {
    /// From the lines of the program.
    pub(super) fn read(lines: Result<Vec<Value>, String>) -> Self {
        let line = match lines.as_deref() {
            Ok([line]) => line,
            Ok(lines) => return Self::None(format!("{} lines came back", lines.len())),
            Err(why) => return Self::None(why.clone()),
        };
        // What is not a number came from one that is none.
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let stopped =
            line["reason"].as_str().map(|why| (number(&line["stopped_at"]), why.to_owned()));
        Self::Made(Figures {
            energy_error: number(&line["energy_error"]),
            turned_over: number(&line["turned_over"]),
            violation: [0, 1, 2].map(|level| number(&line["violation"][level])),
            steps: number(&line["steps"]),
            iterations: number(&line["iterations"]),
            seconds: number(&line["seconds"]),
            corrections: line["corrections"].as_f64(),
            stopped,
        })
    }

    /// Its figures, where it reached its end.
    pub(super) fn completed(&self) -> Option<&Figures> {
        match self {
            Self::Made(figures) if figures.stopped.is_none() => Some(figures),
            _ => None,
        }
    }

    /// Its error [J], or when it stopped.
    pub(super) fn told(&self) -> String {
        match self {
            Self::Made(Figures { steps, .. }) if self.completed().is_none() && *steps < 1.0 => {
                "no step".to_owned()
            }
            Self::Made(Figures { stopped: Some((t, _)), .. }) if *t < 0.01 => {
                format!("stops at {t:.0e} s")
            }
            Self::Made(Figures { stopped: Some((t, _)), .. }) => format!("stops at {t:.2} s"),
            Self::Made(figures) => error(figures.energy_error),
            Self::None(_) => "not run".to_owned(),
        }
    }

    /// Why it has no error.
    pub(super) fn reason(&self) -> String {
        match self {
            Self::Made(figures) => {
                figures.stopped.as_ref().map(|s| s.1.clone()).unwrap_or_default()
            }
            Self::None(why) => why.clone(),
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_line_is_read_with_its_failure_and_what_is_no_number_stays_none() {
        let line = json!({
            "energy_error": null, "turned_over": 19.0, "violation": [1e-9, 1e-8, 1e-7], "steps": 594, "iterations": 19.9,
            "seconds": 3e-5, "stopped_at": 0.594, "reason": "no convergence",
        });
        let run = Run::read(Ok(vec![line.clone()]));
        assert_eq!((run.told(), run.reason()), ("stops at 0.59 s".into(), "no convergence".into()));
        let Run::Made(figures) = run else { panic!("it has figures") };
        assert!(figures.energy_error.is_nan() && figures.corrections.is_none());
        assert_eq!(Run::read(Err("took too long".into())).told(), "not run");
        assert_eq!(Run::read(Ok(vec![line.clone(), line])).reason(), "2 lines came back");
    }
}
