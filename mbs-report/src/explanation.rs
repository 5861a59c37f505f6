//! Explanation of a scene as tables.

use crate::report::{Report, Section, row};
use mbs::record::{PilotReport, Provenance};
use mbs::words::stop_text;
use mbs_scene::format::{duration, few, significant};
use mbs_study::explain::{
    ControllerStep, EffectCost, EffectCosts, Explanation, LargestStep, Relative, SearchEnd, Sizes,
};

/// Returns the tables of an explanation.
#[must_use]
pub fn report(explanation: &Explanation, provenance: Provenance) -> Report {
    let mut sections = vec![simulated(explanation)];
    sections.extend(effects(explanation).map(Section::folded));
    sections.push(absent(explanation).folded());
    sections.extend(explanation.choice.as_ref().map(candidates).map(Section::folded));
    if let Some(prices) = &explanation.prices {
        sections.push(whole(prices));
        sections.extend(price_list("Cost of each effect", &prices.effects, prices));
        sections.extend(price_list("Cost of effects of a kind together", &prices.kinds, prices));
        sections.extend(changes(prices).map(Section::folded));
    }
    Report {
        title: format!("{}: what is simulated", explanation.scene),
        error: explanation.error.as_ref().map(|error| format!("stopped {}", stop_text(error))),
        sections,
        motion: None,
        provenance,
    }
}

fn simulated(e: &Explanation) -> Section {
    let s = &e.simulated;
    let kinds = s.joints.iter().map(|group| format!("{} {}", group.names.len(), group.kind));
    let guides = s.guides.iter().map(|guide| format!("{} ({})", guide.joint, guide.law));
    let mut rows = vec![
        row("dimension", if e.dimension == 2 { "plane" } else { "space" }.to_owned()),
        row("bodies", counted(&s.bodies)),
        row("joints", or_none(kinds.collect())),
    ];
    if !s.guides.is_empty() {
        rows.push(row("guided joints", guides.collect::<Vec<_>>().join(", ")));
    }
    if !s.couplings.is_empty() {
        rows.push(row("couplings", counted(&s.couplings)));
    }
    if !s.rollings.is_empty() {
        rows.push(row("rolling", counted(&s.rollings)));
    }
    if let Some(gravity) = &s.gravity {
        let g: Vec<String> = gravity.iter().map(|x| significant(*x)).collect();
        rows.push(row("gravity", format!("[{}] m/s^2", g.join(", "))));
    }
    rows.push(row("degrees of freedom", s.dof.map_or("unknown".to_owned(), |n| n.to_string())));
    rows.push(row("natural coordinates", s.natural.map_or("no model".to_owned(), |n| sizes(&n))));
    let relative = match (&s.relative, &s.relative_error) {
        (Some(relative), _) => loops(relative),
        (None, Some(error)) => format!("no model: {}", error.message),
        (None, None) => "no model".to_owned(),
    };
    rows.push(row("relative coordinates", relative));
    if let Some(bound) = s.relative.as_ref().and_then(|relative| relative.controller.as_ref()) {
        rows.push(row("a step on a controller", on_controller(bound)));
    }
    for rod in &s.rods {
        let says = if rod.idle_spin_carried {
            "its idle spin is a coordinate"
        } else {
            "no idle spin in natural coordinates; relative ones carry it as a freedom at rest"
        };
        rows.push(row(&format!("thin rod `{}`", rod.body), says.to_owned()));
    }
    let chosen = e.chosen.as_ref();
    let formulation = chosen
        .map_or(e.formulation.clone(), |c| format!("{} ({})", c.formulation, c.reasons.join("; ")));
    rows.push(row("formulation", formulation));
    rows.push(row("integrator", format!("{}, {}", e.integrator, e.precision)));
    let run = format!("{} s, step {} s", significant(e.duration), significant(e.step));
    rows.push(row("run", run));
    Section::new("What is simulated", &[], rows)
}

/// Returns the table of methods that can run the scene, with the measurements of a pilot.
fn candidates(choice: &PilotReport) -> Section {
    let mut table = choice.table();
    let head = table.remove(0);
    let is_measured = choice.error.is_some();
    let mut caption = choice.structure.join("; ");
    caption += &match is_measured {
        true => format!(". {}.", choice.reasons().join(". ")),
        false => ". With --error E or --deadline S a pilot measures them and chooses; without them auto means index-3.".to_owned(),
    };
    Section { head, caption, ..Section::new("Choice of formulation", &[], table) }
}

fn sizes(n: &Sizes) -> String {
    let redundant = match n.redundant {
        0 => String::new(),
        n => format!(" ({n} redundant)"),
    };
    format!(
        "{}, {} constraints of rank {}{redundant}",
        n.coordinates, n.constraints, n.constraint_rank
    )
}

fn loops(relative: &Relative) -> String {
    if relative.loops == 0 {
        return format!("{}, no closed loop", relative.sizes.coordinates);
    }
    let are = if relative.loops == 1 { "loop, cut at" } else { "loops, cut at" };
    let joints = relative.cut_joints.join(", ");
    let Sizes { coordinates, constraints, constraint_rank, redundant, .. } = relative.sizes;
    let redundant =
        if redundant == 0 { String::new() } else { format!(" ({redundant} redundant)") };
    format!(
        "{coordinates}; {} {are} {joints}; {constraints} equations of rank {constraint_rank}{redundant}",
        relative.loops
    )
}

fn on_controller(bound: &ControllerStep) -> String {
    let ControllerStep { products, sums, quotients, roots, turns, instructions: [single, double] } =
        *bound;
    format!(
        "at most {products} products, {sums} sums, {quotients} quotients, {roots} roots, {turns} sines or arc tangents: \
         {single} instructions in f32, {double} in f64"
    )
}

fn effects(e: &Explanation) -> Option<Section> {
    let mut kinds: Vec<&str> = Vec::new();
    for effect in &e.effects {
        if !kinds.contains(&effect.kind.as_str()) {
            kinds.push(&effect.kind);
        }
    }
    let row = |kind: &&str| {
        let of = |enabled| {
            let of = e.effects.iter().filter(|x| x.kind == *kind && x.enabled == enabled);
            or_none(of.map(|x| x.name.clone()).collect())
        };
        vec![(*kind).to_owned(), of(true), of(false)]
    };
    let rows: Vec<_> = kinds.iter().map(row).collect();
    let head = ["kind", "on", "switched off: costs nothing"];
    (!rows.is_empty()).then(|| Section::new("Effects", &head, rows))
}

fn absent(e: &Explanation) -> Section {
    let rows = e.absent.iter().map(|a| row(&a.text, "costs nothing".to_owned()));
    Section::new("What is not simulated", &[], rows.collect())
}

fn whole(prices: &EffectCosts) -> Section {
    let completes = if prices.completed { "completes" } else { "stops early" };
    let run = format!("{completes} (over the first {} s)", significant(prices.compared_duration));
    let time = prices.seconds_per_step.map_or("not measured".into(), duration);
    let rows = vec![
        row("CPU time per step", time),
        row("of it to watch the energy invariant", monitor(prices)),
        row("run", run),
        row("largest step", largest_step(&prices.largest_step)),
    ];
    Section {
        caption: format!(
            "Measured: {} steps from the start, least of {} repeats, in turn with those below; the largest step by doubling the \
             given one, up to 64 times or a tenth of the run.",
            prices.timed_steps, prices.repeats
        ),
        ..Section::new("The run with all effects", &[], rows)
    }
}

/// Returns a text with the time for monitoring the invariant, and the fraction of a step that it takes.
fn monitor(prices: &EffectCosts) -> String {
    let Some(seconds) = prices.monitor_seconds_per_step else {
        return "not measured".to_owned();
    };
    let share = prices.seconds_per_step.filter(|&step| step > 0.0).map(|step| seconds / step);
    format!(
        "{:.0} ns{}",
        seconds * 1e9,
        share.map_or(String::new(), |share| format!(" ({})", percent(share)))
    )
}

fn price_list(title: &str, list: &[EffectCost], prices: &EffectCosts) -> Option<Section> {
    let rows = list.iter().map(|price| {
        vec![
            name(price),
            price.kind.clone(),
            share(price),
            format!("{:.2} ({:.2})", price.iterations_per_step, prices.iterations_per_step),
            largest_step(&price.largest_step),
            price.error.as_ref().map_or("completes".to_owned(), |error| {
                format!("stops at {} s: {}", few(error.time), error.code)
            }),
            largest_change(price),
        ]
    });
    let head = ["left out", "kind", "fraction of a step", "iterations", "largest step", "the run"];
    let head = [&head[..], &["changes most"]].concat();
    let lengths = list.iter().map(|p| {
        let is_resolved = p.below_noise == Some(false);
        p.share.filter(|_| is_resolved).unwrap_or(0.0)
    });
    (!list.is_empty()).then(|| Section {
        caption: format!(
            "Fraction of a step = 1 - CPU time per step without it / with all effects: what leaving it out saves, a changed number of \
             iterations per step (in brackets: with all effects) included. Below noise: not larger than the distance of the two best repeats. Changes: the first {} s, with \
             the given step, in percent of the output's own range.",
            significant(prices.compared_duration)
        ),
        bars: Some((2, lengths.collect())),
        ..Section::new(title, &head, rows.collect())
    })
}

/// Returns the table of outputs that change without an effect, effect by effect.
fn changes(prices: &EffectCosts) -> Option<Section> {
    let of_price = |price: &EffectCost| {
        let changed = price.changes.iter().filter(|change| !change.is_rounding);
        let row = |change: &mbs::record::OutputChange| {
            vec![
                name(price),
                change.output.clone(),
                format!("{} {}", few(change.largest), change.unit),
                format!("{} {}", few(change.range), change.unit),
                change.relative.map_or("-".to_owned(), percent),
            ]
        };
        changed.map(row).collect::<Vec<_>>()
    };
    let rows: Vec<_> = prices.effects.iter().chain(&prices.kinds).flat_map(of_price).collect();
    let head = ["left out", "output", "largest difference", "range of the output", "of the range"];
    let title = "What leaving an effect out changes";
    (!rows.is_empty()).then(|| Section { is_detail: true, ..Section::new(title, &head, rows) })
}

fn name(price: &EffectCost) -> String {
    match price.names.as_slice() {
        [one] => one.clone(),
        several => format!("all {} {}", several.len(), price.kind),
    }
}

fn share(price: &EffectCost) -> String {
    match (price.share, price.below_noise) {
        (None, _) => "not measured".to_owned(),
        (_, Some(true)) => "below noise".to_owned(),
        (Some(share), _) => percent(share),
    }
}

fn largest_change(price: &EffectCost) -> String {
    let Some(change) = price.largest_change() else {
        return "nothing".to_owned();
    };
    let relative = change.relative.map_or(String::new(), |x| format!(" ({})", percent(x)));
    format!("{}: {} {}{relative}", change.output, few(change.largest), change.unit)
}

fn largest_step(found: &LargestStep) -> String {
    let Some(step) = found.step else { return "stops as given".to_owned() };
    match found.end {
        SearchEnd::Stops => format!("{} s", significant(step)),
        SearchEnd::Limit => format!("{} s or more", significant(step)),
        SearchEnd::NotMeasured => "not measured".to_owned(),
    }
}

/// Formats a percentage with two significant digits. A percentage of 100 or more is rounded to a whole number.
fn percent(x: f64) -> String {
    let p = 100.0 * x;
    match p.abs() {
        size if size >= 10.0 => format!("{p:.0} %"),
        size if size >= 0.1 => format!("{p:.1} %"),
        _ => format!("{} %", few(p)),
    }
}

fn counted(names: &[String]) -> String {
    /// Largest number of names in a list [-]. Of a longer list only the number of names is shown.
    const MAX_NAMES: usize = 12;
    match names.len() {
        0 => "none".to_owned(),
        n if n > MAX_NAMES => n.to_string(),
        n => format!("{n}: {}", names.join(", ")),
    }
}

fn or_none(parts: Vec<String>) -> String {
    if parts.is_empty() { "none".to_owned() } else { parts.join(", ") }
}
