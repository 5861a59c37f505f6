//! Diagrams on the page of a comparison: lines of points with logarithmic axes.

use super::captions;
use super::text::{per_step, reason, seconds, short};
use crate::page::{Diagram, DiagramLine, Look};
use mbs_scene::format::rounded;
use mbs_study::compare::results::{Comparison, MethodRuns, RunEntry, Status};

/// Significant digits of drawn values [-]: a screen resolves four.
const DIGITS: usize = 5;
/// Number of colours, marks and dashes in the style of the page [-].
const KINDS: usize = 6;

/// Returns the look (mark, colour and dash) of each method. Lines in single precision are hidden at first if there are lines in double
/// precision.
pub(super) fn looks(comparison: &Comparison) -> Vec<Look> {
    let has_f64 = comparison.methods.iter().any(|m| m.precision == "f64");
    let [mut integrators, mut formulations] = [const { Vec::<&str>::new() }; 2];
    for m in &comparison.methods {
        for (names, name) in
            [(&mut integrators, &m.integrator), (&mut formulations, &m.formulation)]
        {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
    }
    let place = |names: &[&str], name: &str| names.iter().position(|n| *n == name).unwrap_or(0);
    let look = |m: &MethodRuns| {
        let (is_fixed, is_single) = (m.control == "fixed", m.precision == "f32");
        Look {
            name: m.name.clone(),
            kind: place(&integrators, &m.integrator) % KINDS,
            // the last formulation, recursive, has the most lines, so its lines are solid
            dash: (formulations.len() - 1 - place(&formulations, &m.formulation)) % KINDS,
            is_filled: is_fixed,
            is_thin: is_single,
            is_shown: !is_single || !has_f64,
            groups: vec![
                if is_single { "single precision" } else { "double precision" },
                if is_fixed { "fixed steps" } else { "controlled steps" },
            ],
        }
    };
    comparison.methods.iter().map(look).collect()
}

type Value = fn(&RunEntry) -> Option<f64>;

/// Returns all diagrams of a comparison.
pub(super) fn panels(comparison: &Comparison) -> Vec<Diagram> {
    let error: Value = |run| run.error;
    let step = "mean step [s]";
    let mut panels = vec![work_precision(comparison)];
    let mut errors = against_step(comparison, error);
    for line in &mut errors.lines {
        let fit = comparison.methods[line.look].fit.clone().unwrap_or_default();
        if let Some(order) = fit.order {
            line.note = format!("order {order:.2}");
        }
        if let Some(below) = fit.rounding_below {
            line.note += &format!(" rounding below {} s", short(below));
        }
    }
    panels.push(Diagram {
        title: "Error against step".to_owned(),
        axes: axes(step, "error [-]"),
        caption: captions::orders(comparison),
        across: floor(comparison),
        ..errors
    });
    let of = |title: &str, axis, caption, value: Value| Diagram {
        title: title.to_owned(),
        axes: axes(step, axis),
        caption,
        ..against_step(comparison, value)
    };
    panels.push(of("CPU time against step", "CPU time [s]", captions::times(comparison), |run| {
        run.cpu_least
    }));
    let drift: Value = |run| run.energy.drift.map(f64::abs);
    panels.push(of("Energy drift", "|drift| [W]", captions::drift(comparison), drift));
    let scatter: Value = |run| run.energy.scatter;
    panels.push(of("Energy scatter", "scatter [J]", captions::scatter(comparison), scatter));
    let levels: [(&str, &str, Value); 3] = [
        ("Violation of positions", "[m or rad]", |run| Some(run.violation[0])),
        ("Violation of velocities", "[m/s or rad/s]", |run| Some(run.violation[1])),
        ("Violation of accelerations", "[m/s² or rad/s²]", |run| Some(run.violation[2])),
    ];
    for (i, (title, axis, value)) in levels.into_iter().enumerate() {
        panels.push(of(title, axis, captions::violation(comparison, i), value));
    }
    panels.push(histogram(comparison));
    panels
}

fn axes(across: &str, up: &str) -> [String; 2] {
    [across.to_owned(), up.to_owned()]
}

fn floor(comparison: &Comparison) -> Vec<(f64, &'static str)> {
    let floor = comparison.floor();
    if floor > 0.0 { vec![(floor, "below: not resolved by the reference")] } else { vec![] }
}

fn work_precision(comparison: &Comparison) -> Diagram {
    let lines = comparison.methods.iter().enumerate().map(|(look, m)| DiagramLine {
        look,
        points: points(m, |run| run.error, |run| run.cpu_least),
        failed: failed(m, |run| run.clocked_seconds),
        note: String::new(),
    });
    Diagram {
        title: "Work and precision".to_owned(),
        axes: axes("error [-]", "CPU time [s]"),
        caption: captions::work_precision(comparison),
        lines: lines.collect(),
        across: vec![(comparison.compared, "real time")],
        upright: floor(comparison),
        rail: "right",
        is_log: [true; 2],
        has_keys: true,
        ..Diagram::default()
    }
}

fn against_step(comparison: &Comparison, value: Value) -> Diagram {
    let lines = comparison.methods.iter().enumerate().map(|(look, m)| DiagramLine {
        look,
        points: points(m, |run| Some(run.mean_step), value),
        // a run that failed in its first step has no mean step, but a run with fixed steps has the step of its setting
        failed: failed(m, |run| if m.control == "fixed" { run.setting } else { run.mean_step }),
        note: String::new(),
    });
    Diagram { lines: lines.collect(), rail: "top", is_log: [true; 2], ..Diagram::default() }
}

fn points(m: &MethodRuns, x: Value, y: Value) -> Vec<(f64, f64, String)> {
    let point = |run: &RunEntry| {
        Some((rounded(x(run)?, DIGITS), rounded(y(run)?, DIGITS), tooltip(m, run)))
    };
    m.completed().filter_map(point).collect()
}

fn failed(m: &MethodRuns, place: impl Fn(&RunEntry) -> f64) -> Vec<(f64, String)> {
    let stopped = m.runs.iter().filter(|run| run.status == Status::Failed);
    let entry = |run: &RunEntry| {
        let (why, at) = reason(run);
        (rounded(place(run), DIGITS), format!("{}, {at}: {why}", m.name))
    };
    stopped.map(entry).collect()
}

fn setting(m: &MethodRuns, run: &RunEntry) -> String {
    match m.control.as_str() {
        "fixed" => format!("step {} s", short(run.setting)),
        _ => format!("tolerance {}", short(run.setting)),
    }
}

/// Returns the text of the tooltip of a run.
fn tooltip(m: &MethodRuns, run: &RunEntry) -> String {
    let error = run.error.map_or("no error".to_owned(), |e| format!("error {e:.2e}"));
    let below = if run.is_below_reference { " (not resolved by the reference)" } else { "" };
    let cpu = run.cpu_least.map_or("not timed".to_owned(), seconds);
    let (steps, mean) = (run.steps, short(run.mean_step));
    format!(
        "{}, {}: {error}{below}, {cpu}, {steps} steps of {mean} s on average, {:.2} iterations each",
        m.name,
        setting(m, run),
        per_step(run)
    )
}

/// Returns a histogram of the times of single steps, for the middle completed run of each method.
fn histogram(comparison: &Comparison) -> Diagram {
    let line = |(look, m): (usize, &MethodRuns)| {
        let run = captions::typical(m)?;
        let times = run.step_times.as_ref()?;
        let n: u64 = times.classes.iter().map(|(_, n)| n).sum();
        let text = |from: f64, share: f64| {
            format!(
                "{}, {}: {share:.2} % of the steps take {} or up to a quarter more",
                m.name,
                setting(m, run),
                seconds(from)
            )
        };
        #[allow(clippy::cast_precision_loss, reason = "a share for drawing")]
        let share = |k: u64| 100.0 * k as f64 / n.max(1) as f64;
        let point = |&(from, k): &(f64, u64)| {
            (rounded(from, DIGITS), rounded(share(k), DIGITS), text(from, share(k)))
        };
        let points = times.classes.iter().map(point).collect();
        Some(DiagramLine { look, points, ..DiagramLine::default() })
    };
    Diagram {
        title: "Times of single steps".to_owned(),
        axes: axes("CPU time of a step [s]", "fraction of the steps [%]"),
        caption: captions::histogram(comparison),
        lines: comparison.methods.iter().enumerate().filter_map(line).collect(),
        is_plain: true,
        is_log: [true; 2],
        ..Diagram::default()
    }
}
