//! Masses and inertias that are unusual.

use super::finding::{Finding, Severity, Topic, body_names};
use crate::redundancy::Massless;
use mbs_core::cluster::{Cluster, Clusters};
use mbs_core::scene::{Dimension, Entry, Scene, SceneFault};
use mbs_linear::{Matrix, singular_values};
use mbs_scene::format::few;

/// Excess of the sum of two principal moments over the third, relative to the third, below which a body is flat like a plate [-]. Chosen, not
/// tuned.
const FLAT: f64 = 1e-3;
/// Ratio of masses from which rounding errors of the heavy body are considerable forces on the light one [-]. Chosen, not tuned.
const RATIO: f64 = 1e6;

pub(super) fn findings(
    scene: &Scene<f64>,
    massless: Option<&[Massless]>,
    findings: &mut Vec<Finding>,
) {
    match massless {
        Some(all) => all.iter().for_each(|m| findings.push(direction(scene, m))),
        None => {
            let code = (Topic::Masses, "masses-not-looked-at");
            let message = "too many bodies to look for massless motions".to_owned();
            findings.push(Finding::new(Severity::Note, code, message, ""));
        }
    }
    odd_parts(scene, findings);
    // bodies that are welded together count as one body; bodies welded to the ground do not count
    let lumps = Clusters::new(scene).clusters;
    let without = lumps.iter().filter(|lump| !(lump.mass > 0.0));
    let empty: Vec<usize> = without.flat_map(|lump| lump.bodies.iter().copied()).collect();
    if !empty.is_empty() {
        let names = body_names(scene, &empty);
        let message = format!("without mass: {names}; the other bodies determine how they move");
        let code = (Topic::Masses, "no-mass");
        findings.push(Finding::new(Severity::Note, code, message, "").bodies(empty));
    }
    let with = || lumps.iter().filter(|lump| lump.mass > 0.0);
    let heavy = with().max_by(|a, b| a.mass.total_cmp(&b.mass));
    let light = with().min_by(|a, b| a.mass.total_cmp(&b.mass));
    if let (Some(heavy), Some(light)) = (heavy, light)
        && heavy.mass > RATIO * light.mass
    {
        let ratio = few(heavy.mass / light.mass);
        let [heavy, light] = [heavy, light].map(|lump| lump.bodies[0]);
        let message = format!(
            "{} is {ratio} times as heavy as {}: roundings of the one are forces on the other",
            body_names(scene, &[heavy]),
            body_names(scene, &[light])
        );
        let remedy = "check the units of both; a body that light may be left out, or given no mass";
        let code = (Topic::Masses, "mass-ratio");
        let finding = Finding::new(Severity::Doubt, code, message, remedy);
        findings.push(finding.bodies(vec![heavy, light]));
    }
    let flat: Vec<usize> =
        lumps.iter().filter(|lump| is_flat(scene, lump)).map(|lump| lump.bodies[0]).collect();
    if !flat.is_empty() {
        let message = format!(
            "the inertia of {} is that of a thin plate: at the limit of the triangle inequality",
            body_names(scene, &flat)
        );
        let code = (Topic::Masses, "flat-body");
        findings.push(Finding::new(Severity::Note, code, message, "").bodies(flat));
    }
}

/// Notes bodies whose own inertia is not valid. Only the sum with the bodies that are welded to them must be valid.
fn odd_parts(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    for (body, fault) in scene.odd_parts() {
        let what = if fault == SceneFault::InertiaWithoutMass {
            "has inertia and no mass"
        } else {
            "has an inertia that no body can have"
        };
        let message = format!(
            "{} {what}: it counts in the sum of what it is welded to, which is checked instead",
            body_names(scene, &[body])
        );
        let code = (Topic::Masses, "part-inertia");
        let finding = Finding::new(Severity::Note, code, message, "").bodies(vec![body]);
        findings.push(finding.at(Entry::Body(body), "inertia"));
    }
}

fn direction(scene: &Scene<f64>, motion: &Massless) -> Finding {
    let names = body_names(scene, &motion.bodies);
    let bodies = motion.bodies.clone();
    if motion.is_idle_spin {
        let message =
            format!("rod {names} may spin about itself: that has no inertia and no effect");
        return Finding::new(Severity::Note, (Topic::Masses, "idle-spin"), message, "")
            .bodies(bodies);
    }
    let message = format!("{names} can move without moving any mass: no force determines how");
    let remedy = "give mass and inertia, or hold the motion by a joint";
    Finding::new(Severity::Doubt, (Topic::Masses, "massless-motion"), message, remedy)
        .bodies(bodies)
}

/// True if the largest principal moment of inertia is nearly the sum of the others.
fn is_flat(scene: &Scene<f64>, lump: &Cluster<f64>) -> bool {
    if scene.dimension == Dimension::Planar || lump.rod.is_some() {
        return false;
    }
    let matrix = Matrix::from_fn(3, 3, |i, j| lump.inertia[(i, j)]);
    let Some(moments) = singular_values(&matrix) else { return false };
    moments[0] > 0.0 && moments[1] + moments[2] - moments[0] < FLAT * moments[0]
}
