//! Findings about rank and degrees of freedom: an uncertain rank, counts that differ, a scene that cannot move.

use super::finding::{Finding, Severity, Topic, body_names};
use crate::redundancy::{Diagnosis, Massless, UNCERTAIN};
use mbs_core::scene::Scene;
use mbs_scene::format::{counted, few};

pub(super) fn findings(
    scene: &Scene<f64>,
    (diagnosis, natural, taken): (&Diagnosis, Option<[usize; 3]>, Option<usize>),
    massless: Option<&[Massless]>,
    findings: &mut Vec<Finding>,
) {
    if diagnosis.gap < UNCERTAIN {
        let message = format!(
            "the rank is uncertain: between what counts and what does not lies a factor of {}",
            few(diagnosis.gap)
        );
        let remedy = "give places and axes with all their digits, or start in another position";
        let code = (Topic::Rank, "uncertain-rank");
        findings.push(Finding::new(Severity::Doubt, code, message, remedy));
    }
    for &joint in &diagnosis.too_large {
        let message = format!(
            "the loops that `{}` belongs to are too many for singular values: they were not looked at",
            scene.joints[joint].name
        );
        let code = (Topic::Rank, "too-large");
        findings.push(Finding::new(Severity::Note, code, message, "").joints(vec![joint]));
    }
    if let Some([coordinates, _, rank]) = natural {
        if let Some(taken) = taken {
            differs(diagnosis, coordinates - rank + taken, massless, findings);
        }
        if coordinates == rank && scene.guides.is_empty() && !scene.bodies.is_empty() {
            let [_, velocities, held] = diagnosis.sizes;
            let message = format!(
                "no degree of freedom is left and nothing is guided: nothing moves ({} of the bodies, of which the joints hold {held})",
                counted(velocities, "velocity")
            );
            let remedy = "if it is to move, leave a joint out, or take a kind that allows more";
            let code = (Topic::Rank, "no-freedom");
            findings.push(Finding::new(Severity::Note, code, message, remedy));
        }
    }
    let held = scene.held_bodies();
    let free: Vec<usize> = (0..held.len()).filter(|&b| !held[b]).collect();
    if !free.is_empty() {
        let message =
            format!("no joint holds {}: free in all directions", body_names(scene, &free));
        let code = (Topic::Rank, "free-body");
        findings.push(Finding::new(Severity::Note, code, message, "").bodies(free));
    }
}

/// Reports degrees of freedom that differ between natural coordinates and the joint level. Rotations of thin rods about their own axis do not
/// count.
fn differs(
    diagnosis: &Diagnosis,
    dof: usize,
    massless: Option<&[Massless]>,
    findings: &mut Vec<Finding>,
) {
    let [_, columns, rank] = diagnosis.sizes;
    let (Some(massless), true) = (massless, diagnosis.too_large.is_empty()) else { return };
    let idle = massless.iter().filter(|m| m.is_idle_spin).count();
    let joint_level = columns - rank;
    // a thin rod's rotation about its own axis is a natural coordinate if joints need axes of the rod
    if (joint_level - idle.min(joint_level)..=joint_level).contains(&dof) {
        return;
    }
    let message = format!(
        "whole bodies and joints have {}, natural coordinates {dof}: the position is singular for one of them, or a rank is uncertain",
        counted(joint_level, "degree of freedom")
    );
    let remedy = "start a little away from this position with an [[initial]] value";
    findings.push(Finding::new(Severity::Doubt, (Topic::Rank, "freedoms-differ"), message, remedy));
}
