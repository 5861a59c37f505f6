//! The short table at the end of a run.

use mbs::Outcome;
use std::fmt::Write;
use std::path::Path;

/// Summary, outputs and notes as text.
pub(crate) fn text(outcome: &Outcome, out: Option<&Path>) -> String {
    let s = &outcome.summary;
    let formulation = s.chosen.as_ref().map_or(s.formulation.as_str(), |c| c.formulation.as_str());
    let mut text = format!(
        "{}: {formulation}, {}, step {} s, {} steps to t = {} s{}\n",
        s.scene,
        s.precision,
        s.step,
        s.steps,
        s.end_time,
        if s.completed { "" } else { " (stopped)" }
    );
    let mut row = |label: &str, value: String| {
        // Writing into a String has nothing to fail on.
        let _ = writeln!(text, "  {label:<24} {value}");
    };
    row(
        "degrees of freedom",
        format!(
            "{} ({} coordinates, {} constraints of rank {})",
            s.dof, s.coordinates, s.constraints, s.constraint_rank
        ),
    );
    row("largest energy error", format!("{:.3e} J", s.energy.max_error));
    row(
        "largest violation",
        format!(
            "{:.1e} m, {:.1e} m/s, {:.1e} m/s^2",
            s.violation.position, s.violation.velocity, s.violation.acceleration
        ),
    );
    row("iterations", format!("{} ({} factorisations)", s.iterations, s.factorizations));
    row(
        "CPU time of the steps",
        format!(
            "{:.4} s, {:.0} times real time, slowest step {:.1} us",
            s.cpu_seconds,
            s.real_time_factor,
            s.worst_step_seconds * 1e6
        ),
    );
    for (name, values) in &s.outputs.0 {
        let values: Vec<String> = values.iter().map(|v| format!("{v:.9}")).collect();
        row(name, values.join("  "));
    }
    for note in outcome.notes() {
        let _ = writeln!(text, "note: {note}");
    }
    if let Some(out) = out {
        let _ = writeln!(text, "wrote run.csv, run.json and run.html to {}", out.display());
    }
    text
}
