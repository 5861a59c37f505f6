//! Runs of a comparison as a table in CSV.

use super::data::{Comparison, RunEntry, Status};
use mbs_scene::format::shortest;
use std::io;

const HEADER: [&str; 26] = [
    "method",
    "formulation",
    "integrator",
    "control",
    "precision",
    "setting",
    "status",
    "code",
    "message",
    "time_reached",
    "steps",
    "mean_step",
    "iterations",
    "error",
    "error_rms",
    "below_reference",
    "cpu_seconds",
    "repeats",
    "energy_max_error",
    "energy_drift",
    "energy_scatter",
    "violation_position",
    "violation_velocity",
    "violation_acceleration",
    "step_seconds_p99",
    "step_seconds_max",
];

/// Writes a row for each run with its status, its error and its CPU time. Cells without a measurement are empty.
///
/// # Errors
/// Errors of the writer `sink`.
pub fn write_comparison(sink: impl io::Write, comparison: &Comparison) -> io::Result<()> {
    let mut out = csv::Writer::from_writer(sink);
    out.write_record(HEADER)?;
    for method in &comparison.methods {
        for run in &method.runs {
            let of = [&method.name, &method.formulation, &method.integrator, &method.control];
            let mut row: Vec<String> = of.into_iter().cloned().collect();
            row.push(method.precision.clone());
            row.extend(cells(run, comparison.compared));
            out.write_record(&row)?;
        }
    }
    out.flush()
}

fn cells(run: &RunEntry, end: f64) -> Vec<String> {
    let number = |x: Option<f64>| x.map(shortest).unwrap_or_default();
    let made = run.status != Status::NotRun;
    let of_run = |x: f64| number(made.then_some(x));
    let (status, code, message, reached) = match (run.status, &run.failure) {
        (Status::Completed, _) => ("completed", "", String::new(), Some(end)),
        (Status::Failed, Some(e)) => ("failed", e.code.as_str(), e.message.clone(), Some(e.time)),
        (Status::Failed, None) => ("failed", "", String::new(), None),
        (Status::NotRun, _) => ("not-run", "", run.not_run.clone().unwrap_or_default(), None),
    };
    let times = run.step_times.as_ref();
    let mut cells = vec![shortest(run.setting), status.to_owned(), code.to_owned(), message];
    cells.extend([
        number(reached),
        run.steps.to_string(),
        of_run(run.mean_step),
        run.iterations.to_string(),
        number(run.error),
        number(run.error_rms),
        run.is_below_reference.to_string(),
        number(run.cpu_least),
        run.cpu_seconds.len().to_string(),
        number(run.energy.max_error),
        number(run.energy.drift),
        number(run.energy.scatter),
    ]);
    cells.extend(run.violation.map(of_run));
    cells.extend([number(times.map(|t| t.p99)), number(times.map(|t| t.max))]);
    cells
}
