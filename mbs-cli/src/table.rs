//! The short table at the end of a run.

use mbs::record::RunSummary;
use mbs::scene_file::format::{counted, significant};
use mbs::{Outcome, words};
use std::fmt::Write;
use std::path::Path;

/// Summary, outputs and notes as text.
pub(crate) fn text(outcome: &Outcome, out: Option<&Path>) -> String {
    let s = &outcome.summary;
    let mut text = String::new();
    let mut line = |line: String| {
        // Writing into a String has nothing to fail on.
        let _ = writeln!(text, "{line}");
    };
    if s.coordinates > 0 || s.completed {
        line(headline(s));
        for (label, value) in rows(s) {
            line(format!("  {label:<24} {value}"));
        }
    }
    for reason in s.chosen.iter().filter(|c| c.evidence.is_some()).flat_map(|c| &c.reasons) {
        line(format!("chosen: {reason}"));
    }
    for note in outcome.notes() {
        line(format!("note: {note}"));
    }
    if let Some(out) = out {
        let is_measured = s.chosen.as_ref().is_some_and(|c| c.evidence.is_some());
        let paced = if s.realtime.is_some() { "realtime.csv, " } else { "" };
        let chosen = if is_measured { "choice.json, choice.csv, " } else { "" };
        let out = out.display();
        line(format!("wrote run.csv, steps.csv, {paced}{chosen}run.json and run.html to {out}"));
    }
    text
}

fn headline(s: &RunSummary) -> String {
    let formulation = s.chosen.as_ref().map_or(s.formulation.as_str(), |c| c.formulation.as_str());
    let is_of_its_own = matches!(s.integrator.as_str(), "rk54" | "rk853" | "gbs" | "radau5");
    #[allow(clippy::cast_precision_loss, reason = "for three digits")]
    let mean = s.end_time / s.steps.max(1) as f64;
    let lengths = match &s.control {
        Some(c) => format!("{} to {} s", words::few(c.smallest_step), words::few(c.largest_step)),
        None if is_of_its_own => format!("{} s on average", words::few(mean)),
        None => format!("{} s", significant(s.step)),
    };
    let integrator = match s.integrator.as_str() {
        "" | "trapezoidal" => String::new(),
        other => format!(" {other}"),
    };
    format!(
        "{}: {formulation}{integrator}, {}, {} of {lengths} to t = {} s{}",
        s.scene,
        s.precision,
        counted(usize::try_from(s.steps).unwrap_or(usize::MAX), "step"),
        significant(s.end_time),
        if s.completed { "" } else { " (stopped)" }
    )
}

fn rows(s: &RunSummary) -> Vec<(&str, String)> {
    let mut rows = vec![
        (
            "degrees of freedom",
            format!(
                "{} ({}, {} of rank {})",
                s.dof,
                counted(s.coordinates, "coordinate"),
                counted(s.constraints, "constraint"),
                s.constraint_rank
            ),
        ),
        ("largest energy error", format!("{} J", words::size(s.energy.max_error))),
        ("energy drift, scatter", words::drift(s)),
        ("largest violation", words::violation(s)),
        ("iterations", format!("{} ({} factorisations)", s.iterations, s.factorizations)),
        (
            "CPU time of the steps",
            format!(
                "{}, {:.0} times real time, slowest step {}",
                words::duration(s.cpu_seconds),
                s.real_time_factor,
                words::duration(s.worst_step_seconds)
            ),
        ),
    ];
    rows.extend(s.control.as_ref().map(|control| ("control of the step", words::control(control))));
    let paced = s.realtime.iter().flat_map(mbs::realtime::rows);
    rows.extend(paced.map(|(label, value): (&str, String)| (label, value)));
    for (name, values) in &s.outputs.0 {
        let values: Vec<String> = values.iter().map(|v| fixed(*v)).collect();
        rows.push((name, values.join("  ")));
    }
    rows.extend(s.estimate.iter().flat_map(|e| words::estimate(e)));
    rows
}

/// Nine decimals, without a minus before a zero.
pub(crate) fn fixed(x: f64) -> String {
    let text = format!("{x:.9}");
    if text.trim_start_matches('-').chars().all(|c| matches!(c, '0' | '.')) {
        return "0.000000000".to_owned();
    }
    text
}
