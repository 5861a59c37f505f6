//! Runs of the table D1: scenes, choices of the penalty, and forms with their digits; and the rows of all runs.

use super::outcome::{Figures, Run};
use crate::format::{self, error, step};

/// A scene of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Scene {
    pub(super) file: &'static str,
    pub(super) what: &'static str,
}

pub(super) const SCENES: [Scene; 2] = [
    Scene { file: "double-pendulum", what: "Double pendulum: smooth motion" },
    Scene { file: "two-four-bars", what: "Two four-bars: through a singular position" },
];

/// Choice of the penalty factor alpha for a step of 10^-k s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ladder {
    pub(super) name: &'static str,
    /// Exponent of alpha for a step with exponent k.
    pub(super) exponent: fn(i32) -> i32,
}

/// Choices of alpha by the step. The first is the report's fixed value. The report increases it where it does not converge, to 1e9 at 1e-4
/// s and 1e11 at 1e-5 s, as the second choice does. The last one increases so fast that multipliers from zero converge at the singular
/// position.
pub(super) const LADDERS: [Ladder; 3] = [
    Ladder { name: "1e7", exponent: |_| 7 },
    Ladder { name: "10/dt², 1e7 at least", exponent: |k| (2 * k + 1).max(7) },
    Ladder { name: "10/dt⁴", exponent: |k| 4 * k + 1 },
];

/// Form and digits of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Way {
    pub(super) name: &'static str,
    pub(super) form: &'static str,
    pub(super) digits: &'static str,
}

/// Forms and digits: the published form with 16 digits, with 32 digits, and with a factor of 16 digits and residuals of 32; then our forms.
pub(super) const WAYS: [Way; 6] = [
    Way { name: "printed, f64", form: "printed", digits: "f64" },
    Way { name: "printed, once", form: "printed", digits: "once" },
    Way { name: "printed, refined", form: "printed", digits: "refined" },
    Way { name: "printed, dd", form: "printed", digits: "dd" },
    Way { name: "correction, f64", form: "correction", digits: "f64" },
    DEFAULT,
];
/// Index of the published form in doubles [-].
pub(super) const PRINTED: usize = 0;
/// Index of the published form with refined solutions [-].
pub(super) const REFINED: usize = 2;
/// Index of the published form in pairs of doubles [-].
pub(super) const PAIRS: usize = 3;
/// Index of our projections in doubles [-].
pub(super) const CORRECTION: usize = 4;
/// Our default form, which has no alpha. It is run once for each step.
pub(super) const DEFAULT: Way = Way { name: "default, f64", form: "default", digits: "f64" };
/// Index of our default form in doubles [-].
pub(super) const OURS: usize = 5;

/// Runs with one step and one penalty, in all forms in the order of [`WAYS`].
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub(super) scene: Scene,
    /// Exponent of the step, 10^-k s; alpha is 10^exponent.
    pub(super) k: i32,
    pub(super) exponent: i32,
    pub(super) runs: Vec<Run>,
}

impl Cell {
    pub(super) fn step(&self) -> f64 {
        10_f64.powi(-self.k)
    }

    /// True if this choice of the penalty gives the cell's alpha for its step.
    pub(super) fn is_on(&self, ladder: &Ladder) -> bool {
        (ladder.exponent)(self.k) == self.exponent
    }
}

/// The runs of a cell, each with its form.
fn each(cell: &Cell) -> impl Iterator<Item = (&Cell, &Run, Way)> {
    cell.runs.iter().zip(WAYS).map(move |(run, way)| (cell, run, way))
}

/// Headings of the table of all runs.
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

/// A row for every run of some cells.
pub(super) fn rows<'a>(cells: impl Iterator<Item = &'a Cell>) -> Vec<Vec<String>> {
    cells
        .flat_map(each)
        .map(|(cell, run, way)| {
            let name = format!("{}, 1e{}, {}", step(cell.step()), cell.exponent, way.name);
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

/// A record for every run, as CSV.
///
/// # Errors
///
/// The message of the writer.
pub(super) fn csv(cells: &[Cell]) -> Result<Vec<u8>, String> {
    let head = "scene,step_s,alpha,way,energy_error_j,turned_over_j,\
        phi,phi_d,phi_dd,steps,iterations_per_step,corrections_per_solution,seconds_per_step,stopped_at_s,reason";
    let record = |(cell, run, way): (&Cell, &Run, Way)| {
        let f = match run {
            Run::Made(figures) => figures.clone(),
            Run::None(_) => Figures::default(),
        };
        let exact = |x: f64| format!("{x:e}");
        vec![
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
        ]
    };
    format::csv(head, cells.iter().flat_map(each).map(record))
}
