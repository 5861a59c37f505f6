//! Names of the parts of a scene, for error messages.

use core::fmt::Display;
use mbs_core::effects::Value;
use mbs_core::model::Owner;
use mbs_core::once::found;
use mbs_core::scene::{BodyId, CouplingMeasure, CouplingTerm, Effect, Scene};
use mbs_core::step::StepError;
use mbs_core::{Real, instances};

/// Names of bodies and joints, and one joint of each body, for error messages.
#[derive(Debug, Clone)]
pub struct Names {
    bodies: Vec<String>,
    joints: Vec<String>,
    pub couplings: Vec<String>,
    rollings: Vec<String>,
    /// Bodies at both ends of each line segment, for each coupling; `None`: the ground.
    parts: Vec<Vec<[Option<usize>; 2]>>,
    pub effects: Vec<String>,
    /// Bodies at both ends of each line segment, for each effect; `None`: the ground.
    effect_parts: Vec<Vec<[Option<usize>; 2]>>,
    pub outputs: Vec<String>,
    /// First joint in the file that connects the body, for each body.
    joint_of_body: Vec<Option<usize>>,
}

type New<T> = fn(&Scene<T>) -> Names;
instances!(NEW: New<T> = Names::of_scene::<T>, {});

impl Names {
    /// Copies the names of a scene.
    pub fn new<T: Real>(scene: &Scene<T>) -> Self {
        if T::HAS_INSTANCES {
            return found::<New<T>>(NEW)(scene);
        }
        Self::of_scene(scene)
    }

    fn of_scene<T: Real>(scene: &Scene<T>) -> Self {
        let mut joint_of_body = vec![None; scene.bodies.len()];
        for (j, joint) in scene.joints.iter().enumerate() {
            for body in joint.bodies {
                if let BodyId::Body(b) = body {
                    joint_of_body[b].get_or_insert(j);
                }
            }
        }
        Self {
            bodies: scene.bodies.iter().map(|b| b.name.clone()).collect(),
            joints: scene.joints.iter().map(|j| j.name.clone()).collect(),
            couplings: scene.couplings.iter().map(|c| c.name.clone()).collect(),
            rollings: scene.rollings.iter().map(|r| r.name.clone()).collect(),
            parts: scene.couplings.iter().map(|c| parts(&c.terms)).collect(),
            effects: scene.effects.iter().map(|e| e.name.clone()).collect(),
            effect_parts: scene.effects.iter().map(parts_of_effect).collect(),
            outputs: scene.outputs.iter().map(|o| o.name.clone()).collect(),
            joint_of_body,
        }
    }

    /// Formats an error about a segment of a line, with the name of the coupling or effect and of the bodies at the segment's ends.
    pub fn part_of(&self, error: &StepError, what: &impl Display) -> Option<String> {
        let (names, parts, of, part) = match *error {
            StepError::RopeCollapsed { coupling, part } => {
                (&self.couplings, &self.parts, coupling, part)
            }
            StepError::LineCollapsed { effect, part } => {
                (&self.effects, &self.effect_parts, effect, part)
            }
            _ => return None,
        };
        let name = names.get(of as usize).map_or("", String::as_str);
        Some(self.part((name, parts.get(of as usize)), part as usize, what))
    }

    fn part(
        &self,
        (name, parts): (&str, Option<&Vec<[Option<usize>; 2]>>),
        part: usize,
        what: &impl Display,
    ) -> String {
        let ends = parts.and_then(|parts| parts.get(part));
        let body =
            |b: Option<usize>| b.and_then(|b| self.bodies.get(b)).map_or("ground", String::as_str);
        let [from, to] = ends.map_or(["", ""], |ends| ends.map(body));
        format!("`{name}`: from `{from}` to `{to}`, part {}, {what}", part + 1)
    }

    /// Names of the joint and of the body that an owner refers to.
    pub fn of(&self, owner: Owner) -> (Option<String>, Option<String>) {
        match owner {
            Owner::Joint(j) => (self.joints.get(j).cloned(), None),
            Owner::Body(b) => {
                let joint = self.joint_of_body.get(b).copied().flatten();
                (joint.and_then(|j| self.joints.get(j).cloned()), self.bodies.get(b).cloned())
            }
            Owner::Effect(e) => (None, self.effects.get(e).cloned()),
            Owner::Coupling(c) => (self.couplings.get(c).cloned(), None),
            Owner::Rolling(r) => (self.rollings.get(r).cloned(), None),
        }
    }
}

/// Bodies at both ends of each line segment in a sum, in the order of the sum.
fn parts<T: Real>(terms: &[CouplingTerm<T>]) -> Vec<[Option<usize>; 2]> {
    let terms = terms.iter().filter(|term| !term.factor.is_zero());
    let lines = terms.filter_map(|term| match &term.of {
        CouplingMeasure::Length { points } => Some(points),
        CouplingMeasure::Coordinate { .. } | CouplingMeasure::Ball { .. } => None,
    });
    lines.flat_map(|points| parts_of_line(points)).collect()
}

/// The bodies at both ends of each segment of a line.
fn parts_of_line<T>(points: &[(BodyId, [T; 3])]) -> Vec<[Option<usize>; 2]> {
    points.windows(2).map(|pair| [pair[0].0, pair[1].0].map(BodyId::index)).collect()
}

/// The bodies at both ends of each line segment of an effect.
fn parts_of_effect<T: Real>(effect: &Effect<T>) -> Vec<[Option<usize>; 2]> {
    let values = effect.kind.values();
    let found = values.iter().find_map(|value| match value {
        Value::Terms(terms) => Some(parts(terms)),
        Value::Line(points) => Some(parts_of_line(points)),
        _ => None,
    });
    found.unwrap_or_default()
}
