//! Points of a scene in the coordinates of the picture.

use crate::record::{BodyPlace, DrawnForce, DrawnPoint};
use mbs_core::Real;
use mbs_core::effects::ActsOn;
use mbs_core::outputs::{OutputPicture, Target};
use mbs_core::scene::{BodyId, Dimension, Quantity, Scene};

/// Scene that is drawn, and its length.
pub(super) struct Drawing<'a, T> {
    pub(super) scene: &'a Scene<T>,
    /// The scene's length [m].
    pub(super) length: f64,
}

impl<T: Real> Drawing<'_, T> {
    /// Converts a point of a body, which is given in the reference configuration.
    pub(super) fn place(&self, body: BodyId, at: [T; 3]) -> BodyPlace {
        place(self.scene, body, at)
    }

    pub(super) fn is_planar(&self) -> bool {
        self.scene.dimension == Dimension::Planar
    }

    pub(super) fn traces(&self) -> Vec<DrawnPoint> {
        let outputs = self.scene.outputs.iter();
        let trace = |output: &mbs_core::scene::Output<T>| {
            let (body, at) = output.quantity.traced()?;
            Some(DrawnPoint { name: output.name.clone(), place: self.place(body, at) })
        };
        outputs.filter_map(trace).collect()
    }

    /// Lists the points at which measured forces act. A reaction acts on the second body of its joint, and an effect on its last body.
    /// Effects along a line are omitted, because they have no vector.
    pub(super) fn forces(&self) -> Vec<DrawnForce> {
        let acts = |quantity: &Quantity<T>| match quantity.target() {
            Target::Joint(joint) => {
                let joint = &self.scene.joints[joint.index()];
                Some((joint.bodies[1], joint.points[1]))
            }
            Target::Effect(effect) => {
                let kind = &self.scene.effects[effect.index()].kind;
                let is_vector = kind.acts_on() != ActsOn::Line;
                let places = kind.places().into_iter().filter(|_| is_vector);
                places.last().map(|(_, body, at)| (body, at))
            }
            Target::Point(..)
            | Target::RelativePoint(_)
            | Target::Body(_)
            | Target::RelativeBody(..)
            | Target::WheelCarrier(_)
            | Target::Coupling(_)
            | Target::Rolling(_)
            | Target::Signal(_)
            | Target::Scene => None,
        };
        let is_force = |output: &&mbs_core::scene::Output<T>| {
            output.quantity.row().picture == OutputPicture::Force
        };
        let outputs = self.scene.outputs.iter().filter(is_force);
        let force = |output: &mbs_core::scene::Output<T>| {
            let (body, at) = acts(&output.quantity)?;
            let point = DrawnPoint { name: output.name.clone(), place: self.place(body, at) };
            Some(DrawnForce { point, axes: output.frame.and_then(BodyId::index) })
        };
        outputs.filter_map(force).collect()
    }
}

/// Converts a point of a body, which is given in the reference configuration.
pub(super) fn place<T: Real>(scene: &Scene<T>, body: BodyId, at: [T; 3]) -> BodyPlace {
    let body = body.index();
    let center = body.map_or([T::ZERO; 3], |body| scene.bodies[body].center);
    BodyPlace { body, at: [0, 1, 2].map(|i| (at[i] - center[i]).to_f64()) }
}
