//! Numbers that are probably in another unit. They are reported only with strong evidence, because frequent warnings are not read.

use super::finding::{Finding, Severity, Topic, body_names};
use mbs_core::cluster::{mass_properties, scene_length};
use mbs_core::effects::UnitHint;
use mbs_core::scene::{BodyId, Effect, Entry, Freedom, InitialTarget, JointId, Motion, Scene};
use mbs_scene::format::few;

/// Bounds of the mass divided by the cube of the size [kg/m^3]. A slender rod of 1 m and 1 kg has 1, a block of steel 8000.
const DENSITIES: [f64; 2] = [1e-6, 1e8];
/// Ratio of radius of gyration to size from which an inertia is probably in another unit [-]: a rod has 0.29.
const GYRATION: f64 = 30.0;
/// Ratio of a spring's free length to its present length from which it is probably in another unit [-]. Chosen, not tuned.
const LENGTHS: f64 = 100.0;
/// Angular frequency from which a unit is doubtful [rad/s]: that of the longitudinal vibration of a steel rod of 1.6 mm.
const FASTEST: f64 = 1e7;

pub(super) fn findings(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    gravity(scene, findings);
    bodies(scene, findings);
    angles(scene, findings);
    for (i, effect) in scene.effects.iter().enumerate().filter(|(_, e)| e.enabled) {
        let mut hints = effect.kind.unit_hints(&scene.joints).into_iter();
        findings.extend(hints.find_map(|hint| spring(scene, (i, effect), hint)));
    }
}

fn doubt(code: &'static str, message: String, remedy: &str) -> Finding {
    Finding::new(Severity::Doubt, (Topic::Units, code), message, remedy)
}

fn gravity(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    let Some(g) = scene.gravity else { return };
    let size = g.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit = match size {
        x if (9_000.0..11_000.0).contains(&x) => "mm/s^2",
        x if (900.0..1_100.0).contains(&x) => "cm/s^2",
        x if (31.0..33.5).contains(&x) => "ft/s^2",
        _ => return,
    };
    let message = format!("gravity of {} looks like {unit}, not m/s^2", few(size));
    let remedy = "write lengths in m, masses in kg, gravity in m/s^2: tolerances are in SI units";
    findings.push(doubt("gravity-unit", message, remedy).at(Entry::Scene, "gravity"));
}

/// Size of a body [m]: the largest distance of a joint's point or a rod's end from the centre of mass.
fn size(scene: &Scene<f64>, body: usize) -> f64 {
    let (_, center, _) = mass_properties(scene, body);
    let me = BodyId::Body(body);
    let mut size = 0.0_f64;
    for joint in &scene.joints {
        for (of, point) in joint.bodies.iter().zip(joint.points) {
            if *of == me {
                size = size.max((mbs_core::algebra::Vector::from(point) - center).norm());
            }
        }
    }
    if let mbs_core::scene::Inertia::Rod { from, .. } = scene.bodies[body].inertia {
        size = size.max((mbs_core::algebra::Vector::from(from) - center).norm());
    }
    size
}

fn bodies(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    let length = scene_length(scene);
    let mut densities = Vec::new();
    let mut large = Vec::new();
    for b in 0..scene.bodies.len() {
        let (mass, _, inertia) = mass_properties(scene, b);
        if !(mass > 0.0) {
            continue;
        }
        let size = size(scene, b);
        if size > 0.0 {
            densities.push(mass / size.powi(3));
        }
        let gyration = (inertia.trace() / mass).sqrt();
        if gyration > GYRATION * if size > 0.0 { size } else { length } && gyration > 3.0 * length {
            large.push(b);
        }
    }
    if !large.is_empty() {
        let message = format!(
            "the inertia of {} belongs to a body much larger than the places of its joints",
            body_names(scene, &large)
        );
        let remedy = "write inertias in kg m^2: 1 kg mm^2 is 1e-6 kg m^2, 1 g mm^2 is 1e-9";
        findings.push(doubt("inertia-unit", message, remedy).bodies(large));
    }
    densities.sort_by(f64::total_cmp);
    let Some(&median) = densities.get(densities.len() / 2) else { return };
    let guess = match median {
        x if x < DENSITIES[0] => "lengths look like millimetres, or masses like tonnes",
        x if x > DENSITIES[1] => "lengths look like kilometres, or masses like grams",
        _ => return,
    };
    let message = format!(
        "half of the bodies have less or more than {} kg per cubic metre: {guess}",
        few(median)
    );
    let remedy = "write lengths in m and masses in kg";
    findings.push(doubt("size-or-mass-unit", message, remedy).at(Entry::Scene, "name"));
}

/// True if a number looks like an angle in degrees. Such a number exceeds 2 π, is at most 720, and is a multiple of five.
fn like_degrees(x: f64) -> bool {
    /// Rounding of a quotient of two decimal numbers [-]. Chosen, not tuned.
    const ROUNDING: f64 = 1e-9;
    let steps = x / 5.0;
    x.abs() > core::f64::consts::TAU && x.abs() <= 720.0 && (steps - steps.round()).abs() < ROUNDING
}

fn is_turn(freedom: Freedom) -> bool {
    matches!(freedom, Freedom::Turn(_))
}

fn angles(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    let kind = |joint: JointId| scene.joints[joint].kind;
    let turns = |joint: JointId| kind(joint).single(scene.dimension).is_some_and(is_turn);
    let mut report = |x: f64, entry: Entry, key: &'static str| {
        let message = format!("{} rad is more than a turn and looks like degrees", few(x));
        let remedy = format!("write {} for {} degrees", few(x.to_radians()), few(x));
        findings.push(doubt("angle-unit", message, &remedy).at(entry, key));
    };
    for (i, initial) in scene.initials.iter().enumerate() {
        if let InitialTarget::Joint { joint, value: Some(value), .. } = &initial.target {
            let numbers = kind(*joint).numbered(scene.dimension).filter(|(_, f)| is_turn(*f));
            let values = numbers.filter_map(|(number, _)| value.get(number).copied());
            values.filter(|x| like_degrees(*x)).for_each(|x| report(x, Entry::Initial(i), "value"));
        }
    }
    for (i, guide) in scene.guides.iter().enumerate() {
        let freedom = kind(guide.joint).freedom(scene.dimension, guide.number);
        if let Motion::Sine { amplitude, .. } = guide.law
            && !matches!(freedom, Some(Freedom::Slide(_)))
            && like_degrees(amplitude)
        {
            report(amplitude, Entry::Guide(i), "amplitude");
        }
    }
    for (i, effect) in scene.effects.iter().enumerate().filter(|(_, e)| e.enabled) {
        for hint in effect.kind.unit_hints(&scene.joints) {
            if let UnitHint::Angle { key, value, of } = hint
                && of.is_none_or(turns)
                && like_degrees(value)
            {
                report(value, Entry::Effect(i), key);
            }
        }
    }
}

/// Reports a spring whose free length is far from its present length, or whose frequency is higher than that of any machine.
fn spring(
    scene: &Scene<f64>,
    (index, effect): (usize, &Effect<f64>),
    hint: UnitHint<f64>,
) -> Option<Finding> {
    match hint {
        UnitHint::Angle { .. } => None,
        UnitHint::FreeLength { key, value, in_place } => {
            (in_place > 0.0 && value > LENGTHS * in_place).then(|| {
                let message = format!(
                    "spring `{}` is {} m long without tension and {} m in place: looks like millimetres",
                    effect.name,
                    few(value),
                    few(in_place)
                );
                let remedy = format!("write {key} in m");
                doubt("spring-length-unit", message, &remedy).at(Entry::Effect(index), key)
            })
        }
        UnitHint::Stiffness { key, value, bodies } => {
            let mass = bodies.iter().filter_map(|body| match body {
                BodyId::Body(b) => Some(mass_properties(scene, *b).0),
                BodyId::Ground => None,
            });
            let lightest = mass.filter(|m| *m > 0.0).fold(f64::INFINITY, f64::min);
            let frequency = (value / lightest).sqrt();
            (frequency > FASTEST).then(|| {
                let message = format!(
                    "spring `{}` on {} kg swings with {} rad/s: no part of a machine is that stiff",
                    effect.name,
                    few(lightest),
                    few(frequency)
                );
                let remedy = format!(
                    "write {key} in N/m (1 N/mm is 1000 N/m); use a joint for what does not give"
                );
                doubt("stiffness-unit", message, &remedy).at(Entry::Effect(index), key)
            })
        }
    }
}
