//! Doctor of a scene: it reports faults and doubts by the names of parts, each with a remedy.
//!
//! Rank, dependent sets, reactions and loops are examined on the joint level ([`redundancy`](crate::redundancy)), at the assembled start and
//! at positions of a run. The rank in natural coordinates is computed, and each formulation tries a step.

mod basis;
mod consistency;
mod couplings;
mod finding;
mod json;
mod masses;
mod methods;
pub(crate) mod motion;
mod places;
mod sets;
mod start;
mod units;

pub use basis::Effort;
pub use finding::{Finding, Severity, Topic};
pub use json::{Written, labels, to_json};
pub use methods::Attempt;
pub use motion::{LinearMotion, Motion, Nearest};
pub use start::Moved;

use crate::redundancy::{
    Diagnosis, Drive, Linkage, Loop, Massless, Rank, diagnose, drives, loops, reference,
};
use basis::{Begun, begin};
use mbs::ResolvedMethod;
use mbs::inside::rank;
use mbs::typed::Simulation;
use mbs_core::Cliques;
use mbs_core::model::Model;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Scene};

/// Result of the examination of a scene.
#[derive(Debug, Clone)]
pub struct Checkup {
    /// Name of the scene.
    pub scene: String,
    /// Dimension of the scene: 2 or 3.
    pub dimension: usize,
    /// Names of the joints, which indices of other fields refer to.
    pub joints: Vec<String>,
    /// Names of the bodies, which indices of other fields refer to.
    pub bodies: Vec<String>,
    /// Findings, sorted by severity, then by topic. The most severe comes first.
    pub findings: Vec<Finding>,
    /// Coordinates, constraints and their rank in natural coordinates. `None` if the scene has no start.
    pub natural: Option<[usize; 3]>,
    /// Diagnosis on the joint level: one set of velocities for each body, and the equations of each joint.
    pub joint_level: Diagnosis,
    /// True if the joint level is examined at the assembled start, false if in the reference configuration.
    pub is_at_start: bool,
    /// True for each component of each joint's reaction that is uniquely determined: [Fx, Fy, Mz] or all six, in global axes.
    pub unique: Vec<Vec<bool>>,
    /// Joints whose reactions do not contain the force of a coupling, with the name of the coupling.
    pub lacking: Vec<(usize, String)>,
    /// Closed loops with their corners.
    pub loops: Vec<Loop>,
    /// Joints of parts with one degree of freedom, each with its fraction of the motion.
    pub drives: Vec<Drive>,
    /// Motions of the scene that move no mass. `None` if the scene is too large.
    pub massless: Option<Vec<Massless>>,
    /// First step of each formulation. Steps are tried only if equations are dependent.
    pub methods: Vec<Attempt>,
    /// Observations along the motion.
    pub motion: Option<Motion>,
    /// Residual of the scene before assembly, and the displacement of each body by assembly.
    pub start: Option<Moved>,
}

impl Checkup {
    /// Highest severity among the findings.
    #[must_use]
    pub fn worst(&self) -> Option<Severity> {
        self.findings.iter().map(|f| f.severity).max()
    }

    /// Adds notes about parameters of the file that are not used.
    #[must_use]
    pub fn with_unused_parameters(mut self, names: &[String]) -> Self {
        let notes = names.iter().map(|name| {
            let message = format!("nothing needs the parameter `{name}`");
            let remedy = "write it in an expression, or leave it out";
            Finding::new(Severity::Note, (Topic::File, "unused-parameter"), message, remedy)
        });
        self.findings.extend(notes);
        self
    }

    /// Returns the degrees of freedom in natural coordinates, without rotations of thin rods about their own axis. Without a start it is the
    /// number on the joint level.
    #[must_use]
    pub fn dof(&self) -> usize {
        match self.natural {
            Some([coordinates, _, rank]) => coordinates - rank,
            None => self.joint_level.sizes[1] - self.joint_level.sizes[2],
        }
    }
}

fn lacking(scene: &Scene<f64>) -> Vec<(usize, String)> {
    let name = |coupling: usize| scene.couplings[coupling].name.clone();
    scene.lacking_forces().map(|(joint, of)| (joint.index(), name(of.index()))).collect()
}

/// Examines a checked scene.
///
/// Cost: two assemblies, and the run itself. Each part with loops also takes a singular value decomposition of its m equations in n
/// velocities at each position along the motion. A decomposition has about 20 m n² operations.
#[must_use]
pub fn examine(scene: &Scene<f64>, settings: &ResolvedMethod, effort: &Effort) -> Checkup {
    match scene.dimension {
        Dimension::Planar => in_space::<2>(scene, settings, effort),
        Dimension::Spatial => in_space::<3>(scene, settings, effort),
    }
}

/// Natural coordinates, constraints and their rank at the start.
fn sizes<const D: usize>(begun: &Begun<D>) -> [usize; 3] {
    let Begun { model, start, .. } = begun;
    [model.n_unknowns(), model.n_constraints(), rank(model, &start.state)]
}

fn in_space<const D: usize>(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    effort: &Effort,
) -> Checkup {
    let mut findings = Vec::new();
    let begun = begin::<D>(scene);
    let linkage = Linkage::new(scene);
    let rest = reference(scene);
    let poses = begun.as_ref().map_or(&rest, |b| &b.poses);
    let joint_level = diagnose(&linkage, poses);
    let massless = crate::redundancy::massless(scene, &linkage, poses);
    let natural = begun.as_ref().ok().map(sizes);
    sets::findings(scene, &joint_level, natural, &mut findings);
    let taken = begun
        .as_ref()
        .map_or(Some(0), |b| couplings::findings(scene, &b.model, &b.start.state, &mut findings));
    let freedoms = (&joint_level, natural, taken);
    consistency::findings(scene, freedoms, massless.as_deref(), &mut findings);
    masses::findings(scene, massless.as_deref(), &mut findings);
    units::findings(scene, &mut findings);
    places::findings(scene, &mut findings);
    start::axes(scene, &mut findings);
    let is_dependent = joint_level.sets.iter().any(|set| set.is_exact)
        || natural.is_some_and(|[_, constraints, rank]| rank < constraints);
    let (mut methods, mut motion, mut start) = (Vec::new(), None, None);
    match &begun {
        Err(error) => start::no_start(scene, error, &mut findings),
        Ok(begun) => {
            start = Some(start::findings(scene, begun, &mut findings));
            sets::left_behind(scene, (&linkage, &rest), &joint_level, &mut findings);
            if is_dependent {
                methods = methods::try_all::<D>(scene, settings);
                methods::findings(&methods, &mut findings);
            }
            if effort.positions > 0 {
                let seen = motion::watch::<D>(scene, settings, (&linkage, effort));
                motion::findings((scene, &linkage), &seen, &mut findings);
                motion = Some(seen);
            } else if let Err(error) = Simulation::<f64, D>::new(scene, settings) {
                // the formulation of the settings may refuse a scene that starts in natural coordinates
                start::no_start(scene, &error, &mut findings);
            }
        }
    }
    findings.sort_by(|a, b| b.severity.cmp(&a.severity).then(a.topic.cmp(&b.topic)));
    Checkup {
        scene: scene.name.clone(),
        dimension: D,
        joints: scene.joints.iter().map(|j| j.name.clone()).collect(),
        bodies: scene.bodies.iter().map(|b| b.name.clone()).collect(),
        findings,
        natural,
        unique: unique(&linkage, &joint_level),
        lacking: lacking(scene),
        loops: loops(&linkage, poses),
        drives: shares(&linkage, poses),
        joint_level,
        is_at_start: begun.is_ok(),
        massless,
        methods,
        motion,
        start,
    }
}

/// Finds the components of the joints' reactions that are determined: all except those of dependent sets.
fn unique(linkage: &Linkage, diagnosis: &Diagnosis) -> Vec<Vec<bool>> {
    let n = linkage.freedoms();
    let n_joints = linkage.parts.iter().flat_map(|p| &p.joints).max().map_or(0, |j| j + 1);
    let mut unique = vec![vec![true; n]; n_joints];
    for member in diagnosis.sets.iter().filter(|s| s.is_exact).flat_map(|s| &s.members) {
        for (all, here) in unique[member.joint].iter_mut().zip(&member.is_unique) {
            *all &= here;
        }
    }
    unique
}

fn shares(linkage: &Linkage, poses: &[RigidMotion<f64>]) -> Vec<Drive> {
    /// Largest number of joints of a part whose drives are compared: each joint takes a decomposition. Chosen, not tuned.
    const SMALL: usize = 60;
    let parts = linkage.parts.iter().filter(|p| p.has_loop() && p.joints.len() <= SMALL);
    let of = |part| {
        let rank = Rank::of(&linkage.jacobian(part, poses).matrix);
        rank.map_or(Vec::new(), |rank| drives(linkage, part, poses, &rank))
    };
    parts.flat_map(of).collect()
}
