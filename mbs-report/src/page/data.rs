//! The data of the page as compact JSON.

use crate::page::captions;
use crate::page::decimate::{envelope, kept, spread};
use mbs::record::{Animation, ChannelSeries, RunRecord};
use mbs_scene::format::rounded;
use serde::Serialize;

/// Significant digits of what is drawn; a screen resolves four.
const DIGITS: usize = 6;
/// Significant digits of times: steps of long runs stay apart.
const TIME_DIGITS: usize = 9;
/// Most lines of one panel: more have no colours of their own.
const MOST_LINES: usize = 6;

#[derive(Serialize)]
struct Page<'a> {
    scene: &'a str,
    provenance: Vec<[&'a str; 2]>,
    summary: &'a [(String, String)],
    notes: &'a [String],
    choice: &'a [Vec<String>],
    error: Option<&'a str>,
    motion: Option<Motion<'a>>,
    panels: Vec<Panel>,
}

#[derive(Serialize)]
struct Motion<'a> {
    dimension: usize,
    up: [f64; 3],
    t: Vec<f64>,
    frames: Vec<Vec<f64>>,
    bodies: Vec<(&'a str, &'a [Vec<usize>])>,
    ground: &'a [[f64; 3]],
    rails: &'a [[[f64; 3]; 2]],
    traces: Vec<(&'a str, usize)>,
}

#[derive(Serialize)]
struct Panel {
    title: String,
    unit: String,
    caption: String,
    log: bool,
    steps: bool,
    lines: Vec<Line>,
}

#[derive(Serialize)]
struct Line {
    name: String,
    t: Vec<f64>,
    y: Vec<f64>,
}

/// Serialises what the script draws.
pub(super) fn json(record: &RunRecord) -> String {
    let mut panels = channel_panels(&record.channels);
    panels.extend(health_panels(record));
    let page = Page {
        scene: &record.scene,
        provenance: record.provenance.rows().collect(),
        summary: &record.summary,
        notes: &record.notes,
        choice: &record.choice,
        error: record.error.as_deref(),
        motion: record.animation.as_ref().map(motion),
        panels,
    };
    // all keys are texts and the sink is memory: serialisation has nothing to fail on
    serde_json::to_string(&page).unwrap_or_default()
}

fn motion(animation: &Animation) -> Motion<'_> {
    let indices = spread(animation.times.len().min(animation.frames.len()));
    let frame = |i: &usize| animation.frames[*i].iter().map(|x| rounded(*x, DIGITS)).collect();
    Motion {
        dimension: animation.dimension,
        up: animation.up,
        t: indices.iter().map(|i| rounded(animation.times[*i], TIME_DIGITS)).collect(),
        frames: indices.iter().map(frame).collect(),
        bodies: animation.bodies.iter().map(|b| (b.name.as_str(), b.chains.as_slice())).collect(),
        ground: &animation.ground,
        rails: &animation.rails,
        traces: animation.traces.iter().map(|trace| (trace.name.as_str(), trace.point)).collect(),
    }
}

fn line(name: &str, times: &[f64], values: &[f64]) -> Line {
    let n = times.len().min(values.len());
    thinned(name, (times, values), &kept(&values[..n]))
}

/// The upper edge only: what a residual falls to between its peaks says nothing.
fn upper_edge(name: &str, times: &[f64], values: &[f64]) -> Line {
    let n = times.len().min(values.len());
    thinned(name, (times, values), &envelope(&values[..n]))
}

fn thinned(name: &str, (times, values): (&[f64], &[f64]), indices: &[usize]) -> Line {
    Line {
        name: name.to_owned(),
        t: indices.iter().map(|i| rounded(times[*i], TIME_DIGITS)).collect(),
        y: indices.iter().map(|i| rounded(values[*i], DIGITS)).collect(),
    }
}

/// Vectors have a panel per unit; channels of one number share a panel with others of their unit.
fn channel_panels(channels: &[ChannelSeries]) -> Vec<Panel> {
    let mut panels: Vec<(Option<&str>, Panel)> = Vec::new();
    for series in channels {
        let channel = &series.channel;
        let is_number = channel.components.len() == 1;
        let owner = if is_number { None } else { Some(channel.name.as_str()) };
        for ((component, column), values) in
            channel.components.iter().zip(channel.columns()).zip(&series.values)
        {
            let line = line(&column, &series.times, values);
            let open = panels.iter_mut().find(|(of, panel)| {
                *of == owner && panel.unit == component.unit && panel.lines.len() < MOST_LINES
            });
            match open {
                Some((_, panel)) => panel.lines.push(line),
                None => panels.push((owner, panel_of(&component.unit, line))),
            }
        }
    }
    panels
        .into_iter()
        .map(|(owner, mut panel)| {
            let names: Vec<&str> = panel.lines.iter().map(|line| line.name.as_str()).collect();
            panel.caption = captions::channel(&names, &panel.unit);
            panel.title = owner.map_or_else(|| names.join(", "), str::to_owned);
            panel
        })
        .collect()
}

fn panel_of(unit: &str, line: Line) -> Panel {
    let (title, caption) = (String::new(), String::new());
    Panel { title, unit: unit.to_owned(), caption, log: false, steps: false, lines: vec![line] }
}

/// Energy, violation, iterations.
fn health_panels(record: &RunRecord) -> Vec<Panel> {
    let mut panels = Vec::new();
    let mut add = |title: &str, unit: &str, caption, lines: Vec<Line>| {
        let (title, unit) = (title.to_owned(), unit.to_owned());
        panels.push(Panel { title, unit, caption, log: false, steps: false, lines });
    };
    if let Some(energy) = &record.energy {
        let lines = vec![line("Pi(t) - Pi(0)", &energy.times, &energy.invariant_error)];
        add("energy error", "J", captions::energy_error(energy), lines);
        let lines = vec![
            line("T", &energy.times, &energy.kinetic),
            line("V", &energy.times, &energy.potential),
        ];
        add("energies", "J", captions::energies(), lines);
    }
    if let Some(violation) = &record.violation {
        let lines = vec![
            upper_edge("position", &violation.times, &violation.position),
            upper_edge("velocity", &violation.times, &violation.velocity),
            upper_edge("acceleration", &violation.times, &violation.acceleration),
        ];
        let caption = captions::violation(violation);
        add("constraint violation", "m, m/s, m/s^2 (rad, ...)", caption, lines);
    }
    if let Some(iterations) = &record.iterations {
        let counts: Vec<f64> = iterations.counts.iter().map(|count| f64::from(*count)).collect();
        let lines = vec![upper_edge("iterations", &iterations.times, &counts)];
        add("Newton iterations", "per step", captions::iterations(iterations), lines);
    }
    if let Some(steps) = &record.steps {
        let lengths: Vec<f64> = steps.rows.iter().map(|row| row.length).collect();
        let lines = vec![line("step", &steps.times, &lengths)];
        add("step size", "s", captions::steps(steps), lines);
    }
    for panel in &mut panels {
        panel.log = ["constraint violation", "step size"].contains(&panel.title.as_str());
        panel.steps = ["Newton iterations", "step size"].contains(&panel.title.as_str());
    }
    panels
}
