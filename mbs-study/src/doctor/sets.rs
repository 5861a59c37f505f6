//! Findings about dependent sets of constraints, and their remedies in words.

use super::finding::{Finding, Severity, Topic, body_names, joint_names};
use crate::redundancy::{Diagnosis, JointChange, Linkage, Nature, Remedy, Set, diagnose};
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{InitialTarget, Scene};
use mbs_scene::format::{counted, few};

/// Adds one finding for each dependent set.
pub(super) fn findings(
    scene: &Scene<f64>,
    diagnosis: &Diagnosis,
    natural: Option<[usize; 3]>,
    findings: &mut Vec<Finding>,
) {
    for set in &diagnosis.sets {
        let joints: Vec<usize> = set.members.iter().map(|m| m.joint).collect();
        let (severity, code) = match (set.is_exact, set.nature) {
            (false, _) => (Severity::Doubt, "almost-dependent"),
            (true, Nature::Singular) => (Severity::Doubt, "singular-start"),
            (true, _) => (Severity::Doubt, "dependent-set"),
        };
        let finding = Finding::new(
            severity,
            (Topic::Dependence, code),
            message(scene, set),
            remedy(scene, set),
        );
        findings.push(finding.joints(joints));
    }
    let exact: usize = diagnosis.sets.iter().filter(|s| s.is_exact).map(|s| s.redundant).sum();
    if let Some([_, constraints, rank]) = natural
        && exact > constraints - rank
    {
        let hidden = exact - (constraints - rank);
        let message = format!(
            "shared points and axes hide {} of {exact}: the natural coordinates have {} left",
            counted(hidden, "redundant equation"),
            constraints - rank
        );
        let code = (Topic::Dependence, "hidden-by-sharing");
        findings.push(Finding::new(Severity::Note, code, message, ""));
    }
}

/// Reports sets that are dependent only in the reference configuration, if less than two of their joints have a prescribed value. Several
/// branches of the motion meet there. Prescribed values lead away from this configuration along one of the branches, which the file does not
/// determine.
pub(super) fn left_behind(
    scene: &Scene<f64>,
    (linkage, rest): (&Linkage, &[RigidMotion<f64>]),
    start: &Diagnosis,
    findings: &mut Vec<Finding>,
) {
    if !findings.iter().any(|finding| finding.code == "moved") {
        return;
    }
    let is_held = |joint: usize| {
        let is_guided = scene.guides.iter().any(|guide| guide.joint.index() == joint);
        is_guided || scene.initials.iter().any(|initial| {
            matches!(&initial.target, InitialTarget::Joint { joint: held, value: Some(_), .. } if held.index() == joint)
        })
    };
    for set in diagnose(linkage, rest).sets.iter().filter(|set| set.is_exact) {
        let joints: Vec<usize> = set.members.iter().map(|m| m.joint).collect();
        let is_of_it = |other: &&Set| {
            other.is_exact && other.members.iter().any(|member| joints.contains(&member.joint))
        };
        let now: usize = start.sets.iter().filter(is_of_it).map(|other| other.redundant).sum();
        if now >= set.redundant || joints.iter().filter(|joint| is_held(**joint)).count() > 1 {
            continue;
        }
        let message = format!(
            "{} stand in a singular position in the reference configuration, where branches of their motion meet; nothing in the file says on which one the start is",
            joint_names(scene, &joints)
        );
        let remedy = "hold a second of these joints by an [[initial]] value, or draw the mechanism away from this position";
        let code = (Topic::Start, "singular-reference");
        findings.push(Finding::new(Severity::Doubt, code, message, remedy).joints(joints));
    }
}

fn message(scene: &Scene<f64>, set: &Set) -> String {
    let joints: Vec<usize> = set.members.iter().map(|m| m.joint).collect();
    let names = joint_names(scene, &joints);
    let follows = if set.redundant == 1 { "follows" } else { "follow" };
    let equations = counted(set.redundant, "equation");
    let guides: Vec<usize> = set.members.iter().filter(|m| m.guide).map(|m| m.joint).collect();
    let guided = if guides.is_empty() {
        String::new()
    } else {
        format!(" The guides of {} are among them.", joint_names(scene, &guides))
    };
    if !set.is_exact {
        return format!(
            "the equations of {names} almost depend on each other ({equations}, to {}): forces within the set may grow {}-fold{guided}",
            few(set.sigma),
            few(1.0 / set.sigma)
        );
    }
    let nature = match set.nature {
        Nature::Structural => "in every position near by: the mechanism is built so",
        Nature::Singular => {
            "at the start only: it is a singular position, where branches of the motion may meet"
        }
        Nature::Both => "at the start; fewer in other positions",
        Nature::Rigid => "and nothing in the set can move, so that no other position decides",
        Nature::Untried => "at the start; no other position was reached to compare with",
    };
    format!("{equations} of {names} {follows} from the others of the set, {nature}.{guided}")
}

fn remedy(scene: &Scene<f64>, set: &Set) -> String {
    match (&set.remedy, set.nature, set.is_exact) {
        (Some(remedy), _, true) => words(scene, remedy),
        (Some(remedy), _, false) => {
            format!("give places and axes with all their digits; or {}", words(scene, remedy))
        }
        (None, Nature::Singular, _) => {
            "start a little away from this position with an [[initial]] value".to_owned()
        }
        (None, _, false) => "give places and axes with all their digits".to_owned(),
        (None, ..) if of_one_pair(scene, set) => {
            "replace these joints, all between the same two bodies, by one that allows what they allow together: two balls by a revolute joint through both".to_owned()
        }
        (None, ..) if set.members.iter().any(|m| m.guide) => {
            "leave one of the guides out, or a joint that repeats another".to_owned()
        }
        (None, ..) => "leave a joint or a body out that repeats another".to_owned(),
    }
}

/// True if all joints of a set are between the same two bodies.
fn of_one_pair(scene: &Scene<f64>, set: &Set) -> bool {
    let pair = |m: &crate::redundancy::Member| {
        let mut bodies = scene.joints[m.joint].bodies;
        bodies.sort_unstable();
        bodies
    };
    set.members.iter().all(|m| pair(m) == pair(&set.members[0]))
}

/// Describes the changes of a remedy in one sentence.
pub(super) fn words(scene: &Scene<f64>, remedy: &Remedy) -> String {
    let joint = |change: &JointChange| {
        let name = &scene.joints[change.joint].name;
        let was = scene.joints[change.joint].kind.name();
        match (change.kind, change.axis) {
            (kind, _) if kind.is_free() => format!("leave `{name}` out"),
            (kind, Some(axis)) => {
                let [x, y, z] = axis.map(few);
                format!(
                    "make `{name}` {} instead of {was}, with its second axis along [{x}, {y}, {z}]",
                    kind.name()
                )
            }
            (kind, None) => format!("make `{name}` {} instead of {was}", kind.name()),
        }
    };
    if let Some(body) = remedy.body {
        let joints: Vec<usize> = remedy.changes.iter().map(|c| c.joint).collect();
        return format!(
            "leave body {} out with {}; all else moves as before",
            body_names(scene, &[body]),
            joint_names(scene, &joints)
        );
    }
    let changes: Vec<String> = remedy.changes.iter().map(joint).collect();
    let least = if remedy.is_smallest { "; fewer joints do not suffice" } else { "" };
    format!("{}: the motion stays, and every reaction is determined{least}", changes.join(" and "))
}
