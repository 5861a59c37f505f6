//! Masses and inertias that are unusual.

use super::finding::{Finding, Severity, Topic, body_names};
use crate::words::few;
use mbs_core::cluster::mass_properties;
use mbs_core::scene::{Dimension, Inertia, Scene};
use mbs_doctor::{Massless, Matrix, singular_values};

/// Share of the largest principal moment by which the others exceed it, below which a body is a plate.
const FLAT: f64 = 1e-3;
/// Ratio of masses beyond which roundings of the heavy body are forces on the light one.
const RATIO: f64 = 1e6;

pub(super) fn findings(
    scene: &Scene<f64>,
    massless: Option<&[Massless]>,
    findings: &mut Vec<Finding>,
) {
    match massless {
        Some(all) => all.iter().for_each(|m| findings.push(direction(scene, m))),
        None => {
            let told = (Topic::Masses, "masses-not-looked-at");
            let message = "too many bodies to look for massless motions".to_owned();
            findings.push(Finding::new(Severity::Note, told, message, ""));
        }
    }
    let of = |b: usize| mass_properties(scene, b);
    let all = || 0..scene.bodies.len();
    let empty: Vec<usize> = all().filter(|&b| !(of(b).0 > 0.0)).collect();
    if !empty.is_empty() {
        let names = body_names(scene, &empty);
        let message = format!("without mass: {names}; the other bodies determine how they move");
        let told = (Topic::Masses, "no-mass");
        findings.push(Finding::new(Severity::Note, told, message, "").bodies(empty));
    }
    let heavy = all().max_by(|&a, &b| of(a).0.total_cmp(&of(b).0));
    let light = all().filter(|&b| of(b).0 > 0.0).min_by(|&a, &b| of(a).0.total_cmp(&of(b).0));
    if let (Some(heavy), Some(light)) = (heavy, light)
        && of(heavy).0 > RATIO * of(light).0
    {
        let message = format!(
            "{} is {} times as heavy as {}: roundings of the one are forces on the other",
            body_names(scene, &[heavy]),
            few(of(heavy).0 / of(light).0),
            body_names(scene, &[light])
        );
        let remedy = "check the units of both; a body that light may be left out, or given no mass";
        let told = (Topic::Masses, "mass-ratio");
        let finding = Finding::new(Severity::Doubt, told, message, remedy);
        findings.push(finding.bodies(vec![heavy, light]));
    }
    let flat: Vec<usize> = all().filter(|&b| is_flat(scene, b)).collect();
    if !flat.is_empty() {
        let message = format!(
            "the inertia of {} is that of a thin plate: at the limit of the triangle inequality",
            body_names(scene, &flat)
        );
        let told = (Topic::Masses, "flat-body");
        findings.push(Finding::new(Severity::Note, told, message, "").bodies(flat));
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

/// Is the largest principal moment nearly the sum of the others?
fn is_flat(scene: &Scene<f64>, body: usize) -> bool {
    if scene.dimension == Dimension::Planar
        || matches!(scene.bodies[body].inertia, Inertia::Rod { .. })
    {
        return false;
    }
    let inertia = mass_properties(scene, body).2;
    let matrix = Matrix::from_fn(3, 3, |i, j| inertia[(i, j)]);
    let Some(moments) = singular_values(&matrix) else { return false };
    moments[0] > 0.0 && moments[1] + moments[2] - moments[0] < FLAT * moments[0]
}
