//! Texts about a run: rows of a summary, notes, and sentences on the time, place and reason of a stop.

pub mod paced;

pub use mbs_scene::format::{duration, few, size};

use crate::choice::IntegratorKind;
use crate::methods::ROUNDINGS;
use crate::record::{Contact, ControlSummary, ErrorEstimate, MethodUsed, RunError, RunSummary};
use crate::settings::ResolvedMethod;
use mbs_core::Real;
use mbs_core::scene::{Body, BodyId, Inertia, Scene};
use mbs_scene::format::{counted, rounded, significant};

/// Rows of the summary table of an HTML page, each with label and text.
pub fn summary_rows(s: &RunSummary) -> Vec<(String, String)> {
    if s.coordinates == 0 && s.error.is_some() {
        return Vec::new();
    }
    let row = |label: &str, value: String| (label.to_owned(), value);
    let mut rows = vec![
        row("degrees of freedom", s.dof.to_string()),
        row(
            "coordinates, constraints, their rank",
            format!("{}, {}, {}", s.coordinates, s.constraints, s.constraint_rank),
        ),
        row("method", method(&s.method_used)),
        row("steps", steps(&s.method_used)),
        row("time reached", format!("{} s", significant(s.end_time))),
        row("Newton iterations", s.iterations.to_string()),
        row("factorisations", s.factorizations.to_string()),
        row("largest energy error", format!("{} J", size(s.energy.max_error))),
        row("energy drift, scatter from step to step", drift(s)),
        row("largest violation", violation(s)),
        row("CPU time of the steps", duration(s.cpu_seconds)),
        row("times real time", format!("{:.0}", s.real_time_factor)),
        row("slowest step", duration(s.worst_step_seconds)),
    ];
    rows.extend(s.control.as_ref().map(|c| row("control of the step", control(c))));
    let paced = s.realtime.iter().flat_map(paced::rows);
    rows.extend(paced.map(|(label, value)| row(label, value)));
    rows.extend(contacts(s).map(|text| row("contacts", text)));
    rows.extend(s.estimate.iter().flat_map(estimate).map(|(label, value)| row(label, value)));
    rows
}

/// Rows of a table with the error estimate.
#[must_use]
pub fn estimate(e: &ErrorEstimate) -> Vec<(&'static str, String)> {
    const LABEL: &str = "estimated error";
    if let Some(why) = &e.missing {
        return vec![(LABEL, format!("no estimate: {why}"))];
    }
    let (Some(outputs), Some(basis)) = (&e.outputs, &e.basis) else { return Vec::new() };
    let one = |(name, errors): &(String, Vec<f64>)| {
        format!("{name} {}", small(errors.iter().copied().fold(0.0, f64::max)))
    };
    let first = outputs.0.iter().take(MAX_LISTED).map(one).collect::<Vec<_>>().join(", ");
    let more = outputs.0.len().saturating_sub(MAX_LISTED);
    let more = if more > 0 { format!(", and {more} more in the JSON") } else { String::new() };
    let mut rows = vec![(LABEL, first + &more)];
    if let (Some(largest), Some(output)) = (e.largest, &e.worst_output) {
        rows.push(("", format!("at most {} of an output's range: {output}", small(largest))));
    }
    rows.push(("", format!("by {basis}; {} of CPU time", duration(e.cpu_seconds))));
    rows
}

/// Formats a number with two digits, because an error estimate has no more valid digits.
fn small(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

/// Formats the names of formulation and integrator.
fn method(m: &MethodUsed) -> String {
    [m.formulation.as_str(), &m.integrator].join(" ").trim_end().to_owned()
}

/// Describes the number of steps and the step lengths.
#[must_use]
pub fn steps(m: &MethodUsed) -> String {
    let count = counted(usize::try_from(m.steps).unwrap_or(usize::MAX), "step");
    match (m.smallest_step, m.largest_step) {
        (Some(a), Some(b)) if (b - a).abs() <= SAME_STEP * b => {
            format!("{count} of {} s", significant(b))
        }
        (Some(a), Some(b)) => format!("{count} of {} to {} s", few(a), few(b)),
        _ => format!("{count} of {} s on average", few(m.mean_step)),
    }
}

/// Relative difference up to which two step lengths count as equal [-]. The times at the ends of fixed steps have rounding errors.
const SAME_STEP: f64 = 1e-9;

/// Formats the drift and the scatter of the energy invariant for a table.
#[must_use]
pub fn drift(s: &RunSummary) -> String {
    format!("{} W, {} J", size(s.energy.drift), size(s.energy.scatter))
}

/// Formats the counts of the step control for a table.
#[must_use]
pub fn control(c: &ControlSummary) -> String {
    let rule = match c.rule {
        "energy" => "by the energy invariant",
        "energy-printed" => "by the energy invariant as printed",
        "error" => "by the estimated error of each step, not of the run",
        _ => "by the energy invariant and the estimated error of each step, not of the run",
    };
    let mut text = format!("{rule}; {} trials rejected", c.rejected);
    if c.index_1_steps > 0 {
        text += &format!("; {} steps in index-1, {} changes", c.index_1_steps, c.index_changes);
    }
    if c.events > 0 {
        text += &format!("; {} steps ended at an event", c.events);
    }
    text
}

/// Largest number of contacts and outputs that are listed in one line.
const MAX_LISTED: usize = 8;

/// Lists the first contacts of a run, and states the number of all contacts.
fn contacts(s: &RunSummary) -> Option<String> {
    if s.contacts.is_empty() {
        return None;
    }
    let one = |c: &Contact| {
        let end = c.end.map_or_else(String::new, |end| format!(" ({end})"));
        format!("`{}`{end} {} at {} s", c.effect, c.event, significant(rounded(c.time, 6)))
    };
    let mut text = s.contacts.iter().take(MAX_LISTED).map(one).collect::<Vec<_>>().join(", ");
    let more = s.contacts.len().saturating_sub(MAX_LISTED) as u64 + s.contacts_left_out;
    if more > 0 {
        text += &format!(", and {more} more");
    }
    Some(text)
}

/// Formats the largest constraint violation of positions, velocities and accelerations for a table.
#[must_use]
pub fn violation(s: &RunSummary) -> String {
    let v = &s.violation;
    let short = |x: f64| if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") };
    let [position, velocity, acceleration] = [v.position, v.velocity, v.acceleration].map(short);
    format!("{position} m, {velocity} m/s, {acceleration} m/s^2 (or rad)")
}

/// Formats the message of an early stop: when, where and why the run stopped, and what to do.
#[must_use]
pub fn stop_text(error: &RunError) -> String {
    format!("{}: {}. Hint: {}.", stopped_at(error), error.message, error.hint)
}

/// Formats when and where a run stopped.
#[must_use]
pub fn stopped_at(error: &RunError) -> String {
    let whose = match (&error.joint, &error.body) {
        (Some(joint), Some(body)) => format!(" (body `{body}`, joint `{joint}`)"),
        (Some(joint), None) => format!(" (joint `{joint}`)"),
        (None, Some(body)) => format!(" (body `{body}`)"),
        (None, None) => String::new(),
    };
    format!("at t = {} s{whose}", significant(error.time))
}

/// Returns a note if the run uses fewer threads than were requested.
#[must_use]
pub fn few_threads(asked: usize, used: usize) -> Option<String> {
    let are = if used == 1 { "thread is used" } else { "threads are used" };
    (used < asked)
        .then(|| format!("{used} {are}, not {asked}: more have no work here, or no processor"))
}

/// Collects notes on unusual properties of a scene and its run; no note is repeated.
pub fn notes<T: Real>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    s: &RunSummary,
    (change, moved): (f64, Option<&str>),
) -> Vec<String> {
    let mut notes = Vec::new();
    let redundant = s.constraints - s.constraint_rank;
    if redundant > 0 {
        let are = if redundant == 1 { "equation is" } else { "equations are" };
        notes.push(format!(
            "{redundant} constraint {are} redundant: the motion is determined, some internal forces are not"
        ));
    }
    if scene.bodies.is_empty() {
        notes.push("the scene has no body: nothing moves".to_owned());
    } else if s.dof == 0 && scene.guides.is_empty() {
        let note = "no degree of freedom is left and nothing is guided: nothing moves; if it is to move, leave a joint out, or take a kind \
                    that allows more";
        notes.push(note.to_owned());
    }
    if settings.step > settings.duration && s.control.is_none() {
        notes.push(format!(
            "the step of {} s is longer than the run: there is one step of {} s",
            significant(settings.step),
            significant(settings.duration)
        ));
    }
    for (body, is_held) in scene.bodies.iter().zip(scene.held_bodies()) {
        if !is_held {
            notes.push(format!("body `{}` has no joint: it moves freely", body.name));
        }
    }
    notes.extend(crate::tilt::notes(scene).into_iter().map(|(_, note)| note));
    notes.extend(scene.sense_notes().chain(scene.radii_notes()).map(|(_, note)| note));
    notes.extend(scene.effort_notes());
    notes.extend(scene.reaction_notes());
    notes.extend(scene.table_notes().into_iter().map(|note| note.text));
    if change > REPORTED_CHANGE {
        let most = moved.map(|body| format!(", most at body `{body}`")).unwrap_or_default();
        notes.push(format!(
            "the start differs from the reference configuration by up to {} m (or rad){most}",
            few(change)
        ));
    }
    notes.extend(spoilt(scene).map(|(body, ratio)| {
        format!(
            "places are rounded in this precision by up to {} of the size of body `{body}`: bring the origin nearer, or use f64",
            few(ratio)
        )
    }));
    notes.extend(summed::<T>(settings, s));
    notes.extend(s.realtime.as_ref().and_then(paced::note));
    for joint in &s.not_unique {
        notes.push(not_unique(joint));
    }
    notes
}

/// Returns the note on the accumulated error of the extrapolation method. Its long steps have errors close to the tolerance, and these
/// errors add up.
fn summed<T: Real>(settings: &ResolvedMethod, s: &RunSummary) -> Option<String> {
    if settings.integrator != IntegratorKind::Extrapolation || s.steps < 2 {
        return None;
    }
    let each = settings.tolerance.unwrap_or(ROUNDINGS * T::EPSILON.to_f64());
    #[allow(clippy::cast_precision_loss, reason = "for three digits")]
    let all = each * s.steps as f64;
    Some(format!(
        "the tolerance of {} holds for each of the {} steps, relative to the size of each coordinate: together they may err by {}, and more \
         where the motion amplifies errors",
        few(each),
        s.steps,
        few(all)
    ))
}

/// Smallest change of a coordinate at the start that is reported [m or rad], because numbers in files have six or more digits.
const REPORTED_CHANGE: f64 = 1e-6;
/// Smallest rounding error of positions that is reported, relative to the size of a body [-]. It is a tenth of 1e-4, the accuracy that is
/// documented for single precision.
const SPOILT: f64 = 1e-5;

/// Returns the body whose positions have the largest rounding error relative to the body's size, and this ratio; `None` if no ratio exceeds
/// `SPOILT`.
fn spoilt<T: Real>(scene: &Scene<T>) -> Option<(&str, f64)> {
    let mut places: Vec<Vec<[f64; 3]>> = scene
        .bodies
        .iter()
        .map(|body| match body.inertia {
            Inertia::Rod { from, to } => vec![from, to].into_iter().map(in_f64).collect(),
            _ => vec![in_f64(body.center)],
        })
        .collect();
    for joint in &scene.joints {
        for (body, point) in joint.bodies.into_iter().zip(joint.points) {
            if let BodyId::Body(b) = body {
                places[b].push(in_f64(point));
            }
        }
    }
    let ratio = |(body, places): (&Body<T>, &Vec<[f64; 3]>)| {
        let size = |x: [f64; 3]| x.into_iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let first = places[0];
        let far = places.iter().fold(0.0, |a: f64, &p| a.max(size(p)));
        let spread = places
            .iter()
            .fold(0.0, |a: f64, p| a.max(size(std::array::from_fn(|i| p[i] - first[i]))));
        // Points that coincide in this precision may differ in the file. In this case the radius of gyration gives the size of the body.
        let inertia = match body.inertia {
            Inertia::Planar(polar) => polar.to_f64(),
            Inertia::Spatial(six) => six[..3].iter().map(|x| x.to_f64()).fold(0.0, f64::max),
            Inertia::Rod { .. } | Inertia::Point => 0.0,
        };
        let mass = body.mass.to_f64();
        let spread = if mass > 0.0 { spread.max((inertia / mass).sqrt()) } else { spread };
        if spread > 0.0 { T::EPSILON.to_f64() * far / spread } else { 0.0 }
    };
    let bodies = scene.bodies.iter().zip(&places);
    let worst = bodies.map(|(body, places)| (body.name.as_str(), ratio((body, places))));
    worst.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, ratio)| *ratio > SPOILT)
}

fn in_f64<T: Real>(x: [T; 3]) -> [f64; 3] {
    x.map(Real::to_f64)
}

/// Returns the note on a joint whose reaction is not unique.
#[must_use]
pub fn not_unique(joint: &str) -> String {
    format!("the reaction of joint `{joint}` is not unique: the smallest one is given")
}

/// Formats a time [s] with three decimals, for the display during a run.
#[must_use]
pub fn time(t: f64) -> String {
    format!("{t:.3}")
}
