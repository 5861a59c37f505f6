//! What the page of a comparison draws: lines of points with logarithmic axes.

use super::captions;
use super::text::{per_step, reason, seconds, short};
use mbs_scene::format::rounded;
use mbs_study::compare::results::{Comparison, MethodRuns, RunEntry, Status};
use serde::Serialize;

/// Significant digits of what is drawn: a screen resolves four.
const DIGITS: usize = 5;
/// Colours and marks of the page: those of its style.
const KINDS: usize = 6;

/// How the lines of a method look: distinguished by mark and dash as well as by colour.
#[derive(Debug, Serialize)]
pub(super) struct Look {
    name: String,
    /// By formulation: colour and mark.
    kind: usize,
    /// By control and integrator.
    dash: usize,
    /// Marks are filled in double precision.
    is_filled: bool,
    is_shown: bool,
}

/// A diagram with logarithmic axes.
#[derive(Debug, Default, Serialize)]
pub(super) struct Panel {
    title: &'static str,
    /// Names of the axes with their units.
    axes: [&'static str; 2],
    caption: String,
    lines: Vec<Line>,
    /// Horizontal lines: value and name.
    across: Vec<(f64, &'static str)>,
    /// Vertical lines: value and name.
    upright: Vec<(f64, &'static str)>,
    /// What lies on the rail: at the top or at the right.
    rail: &'static str,
    /// A line through the points without marks: a histogram.
    is_plain: bool,
    is_wide: bool,
}

#[derive(Debug, Default, Serialize)]
struct Line {
    /// Index of the method.
    method: usize,
    /// Points: x, y, and what is said of them.
    points: Vec<(f64, f64, String)>,
    /// Runs that stopped: x or y along the rail, and why.
    failed: Vec<(f64, String)>,
    /// What the legend adds.
    note: String,
}

/// Looks of all methods. Single precision is hidden at first where there is double.
pub(super) fn looks(comparison: &Comparison) -> Vec<Look> {
    let has_f64 = comparison.methods.iter().any(|m| m.precision == "f64");
    let look = |m: &MethodRuns| Look {
        name: m.name.clone(),
        kind: m.look % KINDS,
        dash: match (m.integrator.as_str(), m.control.as_str()) {
            ("rk4", _) => 3,
            ("rk853" | "gbs" | "radau5", _) => 4,
            ("rk54", _) | (_, "energy") => 2,
            (_, "error") => 1,
            _ => 0,
        },
        is_filled: m.precision != "f32",
        is_shown: m.precision != "f32" || !has_f64,
    };
    comparison.methods.iter().map(look).collect()
}

type Value = fn(&RunEntry) -> Option<f64>;

/// All diagrams.
pub(super) fn panels(comparison: &Comparison) -> Vec<Panel> {
    let error: Value = |run| run.error;
    let step = "mean step [s]";
    let mut panels = vec![work_precision(comparison)];
    let mut errors = against_step(comparison, error);
    for line in &mut errors.lines {
        let fit = comparison.methods[line.method].fit.clone().unwrap_or_default();
        if let Some(order) = fit.order {
            line.note = format!("order {order:.2}");
        }
        if let Some(below) = fit.rounding_below {
            line.note += &format!(" rounding below {} s", short(below));
        }
    }
    panels.push(Panel {
        title: "Error against step",
        axes: [step, "error [-]"],
        caption: captions::orders(comparison),
        across: floor(comparison),
        ..errors
    });
    let of = |title, axis, caption, value: Value| Panel {
        title,
        axes: [step, axis],
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

fn floor(comparison: &Comparison) -> Vec<(f64, &'static str)> {
    let floor = comparison.floor();
    if floor > 0.0 { vec![(floor, "below: not resolved by the reference")] } else { vec![] }
}

fn work_precision(comparison: &Comparison) -> Panel {
    let lines = comparison.methods.iter().enumerate().map(|(method, m)| Line {
        method,
        points: points(m, |run| run.error, |run| run.cpu_least),
        failed: failed(m, |run| run.clocked_seconds),
        note: String::new(),
    });
    Panel {
        title: "Work and precision",
        axes: ["error [-]", "CPU time [s]"],
        caption: captions::work_precision(comparison),
        lines: lines.collect(),
        across: vec![(comparison.compared, "real time")],
        upright: floor(comparison),
        rail: "right",
        is_wide: true,
        ..Panel::default()
    }
}

fn against_step(comparison: &Comparison, value: Value) -> Panel {
    let lines = comparison.methods.iter().enumerate().map(|(method, m)| Line {
        method,
        points: points(m, |run| Some(run.mean_step), value),
        // a run that stopped at once has no mean step; a fixed one has the step it was asked for
        failed: failed(m, |run| if m.control == "fixed" { run.setting } else { run.mean_step }),
        note: String::new(),
    });
    Panel { lines: lines.collect(), rail: "top", ..Panel::default() }
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

/// What is said of a run under the cursor.
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

/// Times of single steps, of the run of each method whose mean step is nearest to the middle one of its runs.
fn histogram(comparison: &Comparison) -> Panel {
    let line = |(method, m): (usize, &MethodRuns)| {
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
        Some(Line { method, points, ..Line::default() })
    };
    Panel {
        title: "Times of single steps",
        axes: ["CPU time of a step [s]", "fraction of the steps [%]"],
        caption: captions::histogram(comparison),
        lines: comparison.methods.iter().enumerate().filter_map(line).collect(),
        is_plain: true,
        ..Panel::default()
    }
}
