//! Summary at the end of a run.

use crate::channels;
use mbs::record::RunSummary;
use mbs::scene_file::format::{counted, significant};
use mbs::{Outcome, words};
use std::fmt::Write;
use std::path::Path;

/// Summary, statistics and notes as text. The statistics have all rows with `is_all`, otherwise the first ones.
pub(crate) fn text(outcome: &Outcome, out: Option<&Path>, is_all: bool) -> String {
    let s = &outcome.summary;
    let mut text = String::new();
    let mut line = |line: String| {
        // writing into a String cannot fail
        let _ = writeln!(text, "{line}");
    };
    if s.coordinates > 0 || s.completed {
        line(headline(s));
        for (label, value) in rows(s) {
            line(format!("  {label:<24} {value}"));
        }
        channels::lines(&s.channels, is_all).into_iter().for_each(&mut line);
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
    let integrator = match s.method_used.integrator.as_str() {
        "" | "trapezoidal" => String::new(),
        other => format!(" {other}"),
    };
    format!(
        "{}: {}{integrator}, {}, {} to t = {} s{}",
        s.scene,
        s.method_used.formulation,
        s.precision,
        words::steps(&s.method_used),
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
    rows.extend(s.estimate.iter().flat_map(|e| words::estimate(e)));
    rows
}

/// A number with nine decimals. A negative zero has no minus sign.
pub(crate) fn fixed(x: f64) -> String {
    let text = format!("{x:.9}");
    if text.trim_start_matches('-').chars().all(|c| matches!(c, '0' | '.')) {
        return "0.000000000".to_owned();
    }
    text
}
