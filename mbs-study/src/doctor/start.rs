//! Examination of the start: residuals before assembly, and the displacement of each body by assembly.

use super::basis::{Begun, stopped};
use super::finding::{Finding, Severity, Topic};
use crate::redundancy::reference;
use mbs::StopError;
use mbs::inside::rank;
use mbs_core::Cliques;
use mbs_core::algebra::rotation_vector;
use mbs_core::scene::{BodyId, Entry, InitialTarget, Motion, Scene, TableNote};
use mbs_scene::format::{counted, few};

/// Changes by assembly: residuals before and after it, and the displacement and speed of each body.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// Largest residual of joints, guides and prescribed initial values in the reference configuration [m or rad].
    pub residual_before: f64,
    /// Largest residuals of position, velocity and acceleration equations after assembly.
    pub residual: [f64; 3],
    /// Displacement of the centre [m] and rotation [rad] of each body from the reference configuration.
    pub bodies: Vec<[f64; 2]>,
    /// Speed of the centre [m/s] and angular speed [rad/s] of each body.
    pub speeds: Vec<[f64; 2]>,
}

/// Adds the finding for a scene that cannot start.
pub(super) fn no_start(scene: &Scene<f64>, error: &StopError, findings: &mut Vec<Finding>) {
    let (message, hint) = stopped(scene, error, 0.0);
    let mut finding = Finding::new(Severity::Fault, (Topic::Start, error.code()), message, hint);
    match error.entry() {
        Some(Entry::Joint(j)) => finding.joints.push(j),
        Some(Entry::Body(b)) => finding.bodies.push(b),
        _ => {}
    }
    if let Some(entry) = error.entry() {
        finding = finding.at(entry, error.fields()[0]);
    }
    findings.push(finding);
}

/// Adds notes about axes, couplings and splines. Axes are noted if they are only nearly parallel or perpendicular. A coupling is noted if it
/// has another sense than in version 0.1, an unclear sense, or wheels that do not touch. A spline is noted if it leaves the range of the values
/// in its table.
pub(super) fn axes(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    for (joint, message) in mbs::inside::notes(scene) {
        let finding = Finding::new(Severity::Note, (Topic::Start, "axis-off"), message, "");
        findings.push(finding.joints(vec![joint]));
    }
    for (coupling, message) in scene.sense_notes() {
        let finding = Finding::new(Severity::Note, (Topic::Places, "coupling-sense"), message, "");
        findings.push(finding.at(Entry::Coupling(coupling.index()), "kind"));
    }
    for (coupling, message) in scene.radii_notes() {
        let finding = Finding::new(Severity::Note, (Topic::Places, "coupling-radii"), message, "");
        findings.push(finding.at(Entry::Coupling(coupling.index()), "radii"));
    }
    for TableNote { entry, key, text } in scene.table_notes() {
        let finding = Finding::new(Severity::Note, (Topic::Places, "table-leaves-rows"), text, "");
        findings.push(finding.at(entry, key));
    }
}

/// Largest displacement that the rounding of the file's numbers explains, relative to the scene's length [-]. The numbers have six digits or
/// more.
const ROUNDING: f64 = 1e-6;

pub(super) fn findings<const D: usize>(
    scene: &Scene<f64>,
    begun: &Begun<D>,
    findings: &mut Vec<Finding>,
) -> Moved {
    let rest = reference(scene);
    let both = rest.iter().zip(&begun.poses);
    let way =
        |(from, to): (&mbs_core::rigid::RigidMotion<f64>, &mbs_core::rigid::RigidMotion<f64>)| {
            [(to.position - from.position).norm(), rotation_vector(&to.rotation).norm()]
        };
    let bodies: Vec<[f64; 2]> = both.map(way).collect();
    let speeds: Vec<[f64; 2]> =
        begun.poses.iter().map(|p| [p.velocity.norm(), p.omega.norm()]).collect();
    let length = begun.model.length();
    let far: Vec<usize> = (0..bodies.len())
        .filter(|&b| bodies[b][0] > ROUNDING * length || bodies[b][1] > ROUNDING)
        .collect();
    if !far.is_empty() {
        let [way, turn] = [0, 1].map(|i| bodies.iter().map(|x| x[i]).fold(0.0, f64::max));
        let why = if asks(scene) {
            "as held values, guides or the equilibrium ask for"
        } else {
            "though nothing asks for it: places in the file do not fit"
        };
        let severity = if asks(scene) { Severity::Note } else { Severity::Doubt };
        let message = format!(
            "assembly moves {} of {} from the reference configuration, by up to {} m and {} rad, {why}",
            far.len(),
            counted(bodies.len(), "body"),
            few(way),
            few(turn)
        );
        findings.push(Finding::new(severity, (Topic::Start, "moved"), message, "").bodies(far));
    }
    follow(scene, (begun, &speeds), findings);
    Moved {
        residual_before: begun.start.residual_before,
        residual: begun.start.residual,
        bodies,
        speeds,
    }
}

/// True if the scene prescribes positions other than those of the reference configuration.
fn asks(scene: &Scene<f64>) -> bool {
    let holds = |i: &mbs_core::scene::InitialCondition<f64>| matches!(&i.target, InitialTarget::Joint { value: Some(v), .. } if v.iter().any(|x| x.abs() > 0.0));
    let drives = |guide: &mbs_core::scene::Guide<f64>| !matches!(guide.law, Motion::Ramp { .. });
    scene.start != mbs_core::scene::Start::Initial
        || scene.initials.iter().any(holds)
        || scene.guides.iter().any(drives)
}

/// Reports bodies that move at the start although the file gives no velocity for them. This happens if fewer velocities are given than there
/// are degrees of freedom.
fn follow<const D: usize>(
    scene: &Scene<f64>,
    (begun, speeds): (&Begun<D>, &[[f64; 2]]),
    findings: &mut Vec<Finding>,
) {
    let dof = begun.model.n_unknowns() - rank(&begun.model, &begun.start.state);
    let (mut is_written, mut n) = (vec![false; scene.bodies.len()], 0);
    for initial in &scene.initials {
        match &initial.target {
            InitialTarget::Joint { joint, rate: Some(rates), .. } => {
                n += rates.len();
                for body in scene.joints[*joint].bodies {
                    if let BodyId::Body(b) = body {
                        is_written[b] = true;
                    }
                }
            }
            InitialTarget::Body { body, velocity, angular_velocity } => {
                n += if velocity.is_some() { D } else { 0 };
                n += if angular_velocity.is_some() { 2 * D - 3 } else { 0 };
                if let BodyId::Body(b) = body {
                    is_written[*b] = true;
                }
            }
            InitialTarget::Joint { .. } => {}
        }
    }
    let size = |s: &[f64; 2]| s[0].max(s[1] * begun.model.length());
    let fastest = speeds.iter().map(size).fold(0.0, f64::max);
    let moves = |b: &usize| !is_written[*b] && size(&speeds[*b]) > ROUNDING * fastest;
    let others: Vec<usize> = (0..scene.bodies.len()).filter(moves).collect();
    if n == 0 || n >= dof || others.is_empty() {
        return;
    }
    let message = format!(
        "{} for {}: {} without a written velocity move{} by the smallest motion in the measure of mass that fits",
        counted(n, "initial velocity"),
        counted(dof, "degree of freedom"),
        counted(others.len(), "body"),
        if others.len() == 1 { "s" } else { "" }
    );
    let code = (Topic::Start, "velocities-follow");
    findings.push(Finding::new(Severity::Note, code, message, "").bodies(others));
}
