//! Names of what errors are about.

use mbs_core::model::Owner;
use mbs_core::scene::{BodyId, Scene};

/// Names of bodies and joints, and which joint holds which body: what errors need to speak.
#[derive(Debug, Clone)]
pub struct Names {
    bodies: Vec<String>,
    joints: Vec<String>,
    couplings: Vec<String>,
    pub(crate) effects: Vec<String>,
    pub(crate) outputs: Vec<String>,
    /// First joint in the file that touches each body.
    joint_of_body: Vec<Option<usize>>,
}

impl Names {
    /// Takes the names of a scene.
    pub fn new<T>(scene: &Scene<T>) -> Self {
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
            effects: scene.effects.iter().map(|e| e.name.clone()).collect(),
            outputs: scene.outputs.iter().map(|o| o.name.clone()).collect(),
            joint_of_body,
        }
    }

    /// Joint and body names of an owner.
    pub(crate) fn of(&self, owner: Owner) -> (Option<String>, Option<String>) {
        match owner {
            Owner::Joint(j) => (self.joints.get(j).cloned(), None),
            Owner::Body(b) => {
                let joint = self.joint_of_body.get(b).copied().flatten();
                (joint.and_then(|j| self.joints.get(j).cloned()), self.bodies.get(b).cloned())
            }
            Owner::Effect(e) => (None, self.effects.get(e).cloned()),
            Owner::Coupling(c) => (self.couplings.get(c).cloned(), None),
        }
    }
}
