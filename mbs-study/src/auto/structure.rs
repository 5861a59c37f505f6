//! Structure of a scene, known before any run: methods that it excludes, and features that cost time.

use crate::compare::method::MethodCase;
use mbs::inside::AssembledScene;
use mbs::{Names, StopError};
use mbs_core::Real;
use mbs_core::effects::Value;
use mbs_core::scene::{BodyId, Effect, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial, TreeError, TreeModel};

/// Structure of a scene, known without a step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Structure {
    pub(crate) dimension: usize,
    pub(crate) bodies: usize,
    /// Number of natural coordinates, number of constraints, and rank of the constraints.
    pub(crate) natural: Option<[usize; 3]>,
    /// Number of cut joints of the spanning tree, or the reason why there is no tree.
    pub(crate) loops: Result<usize, String>,
    pub(crate) guides: usize,
    /// Number of bumpers, limits and tires.
    pub(crate) contacts: usize,
    /// Highest angular frequency of a spring between its two bodies, estimated [rad/s].
    pub(crate) frequency: f64,
    pub(crate) duration: f64,
}

/// Determines the structure of a scene that runs for `duration` [s].
pub(crate) fn structure<T: Real, const D: usize>(
    scene: &Scene<T>,
    duration: f64,
    ready: Option<&mut AssembledScene<T, D>>,
) -> Structure {
    let natural = ready.map(AssembledScene::sizes);
    let loops =
        if const { D == 2 } { loops::<T, Planar>(scene) } else { loops::<T, Spatial>(scene) };
    let enabled = || scene.effects.iter().filter(|effect| effect.enabled);
    let is_contact = |effect: &&Effect<T>| effect.kind.is_one_sided();
    Structure {
        dimension: D,
        bodies: scene.bodies.len(),
        natural,
        loops: loops.map_err(|e| StopError::tree(e).report(0.0, &Names::new(scene)).message),
        guides: scene.guides.len(),
        contacts: enabled().filter(is_contact).count(),
        frequency: enabled().map(|effect| frequency(scene, effect)).fold(0.0, f64::max),
        duration,
    }
}

/// Number of cut joints of a scene's spanning tree.
fn loops<T: Real, S: Space<T>>(scene: &Scene<T>) -> Result<usize, TreeError> {
    Ok(TreeModel::<T, S>::new(scene)?.cut_joints().count())
}

/// Angular frequency of a spring along a line, omega = sqrt(k (1/m1 + 1/m2)), with stiffness k and the masses of its bodies [rad/s].
fn frequency<T: Real>(scene: &Scene<T>, effect: &Effect<T>) -> f64 {
    let of = |body: &BodyId| match body {
        BodyId::Body(i) => scene.bodies.get(*i).map_or(0.0, |body| 1.0 / body.mass.to_f64()),
        BodyId::Ground => 0.0,
    };
    let (mut mobility, mut stiffness) = (0.0, 0.0_f64);
    for (field, value) in effect.kind.row().fields.iter().zip(effect.kind.values()) {
        match value {
            Value::Bodies(bodies) => mobility = bodies.iter().map(of).sum::<f64>(),
            Value::Line(points) => mobility = points.iter().map(|(body, _)| of(body)).sum::<f64>(),
            Value::Number(k) if field.key == "stiffness" => stiffness = k.to_f64(),
            Value::Six(k) if field.key == "stiffness" => {
                stiffness = k.iter().take(k.len() / 2).map(|k| k.to_f64()).fold(0.0, f64::max);
            }
            _ => {}
        }
    }
    let square = stiffness * mobility;
    if square.is_finite() { square.max(0.0).sqrt() } else { 0.0 }
}

impl Structure {
    /// Returns the reason why a method cannot run the scene.
    pub(crate) fn refuses(&self, method: &MethodCase) -> Option<String> {
        let formulation = method.formulation.row();
        match (&self.loops, self.natural) {
            (Err(why), _) if formulation.relative => Some(why.clone()),
            (_, Some([_, rows, rank])) if !formulation.redundant && rank < rows => Some(format!(
                "{} of {rows} constraints are redundant: their multipliers are not unique",
                rows - rank
            )),
            _ => None,
        }
    }

    /// Describes the structure in short sentences.
    pub(crate) fn words(&self) -> Vec<String> {
        let mut words = vec![format!(
            "{} in {} dimensions",
            if self.bodies == 1 { "1 body".to_owned() } else { format!("{} bodies", self.bodies) },
            self.dimension
        )];
        if let Some([n, rows, rank]) = self.natural {
            let redundant = match rows - rank {
                0 => "none redundant".to_owned(),
                k => format!("{k} redundant"),
            };
            words.push(format!(
                "{} freedoms: {n} natural coordinates, {rows} constraints, {redundant}",
                n - rank
            ));
        }
        words.push(match &self.loops {
            Ok(0) => "a tree: relative coordinates need no constraints".to_owned(),
            Ok(1) => "one loop is cut in relative coordinates".to_owned(),
            Ok(n) => format!("{n} loops are cut in relative coordinates"),
            Err(why) => format!("no relative coordinates: {why}"),
        });
        if self.guides > 0 {
            words.push(format!("{} guided", self.guides));
        }
        if self.contacts > 0 {
            words.push(format!(
                "{} bumpers, limits or tires: contact comes and goes",
                self.contacts
            ));
        }
        if self.frequency > 0.0 {
            // a stable explicit method makes about two steps or more in a period
            let steps = 2.0 * self.frequency * self.duration / core::f64::consts::TAU;
            words.push(format!(
                "its stiffest spring turns at about {} rad/s: explicit integrators need {} steps or more",
                mbs_scene::format::few(self.frequency),
                mbs_scene::format::few(steps.ceil().max(1.0))
            ));
        }
        words
    }
}
