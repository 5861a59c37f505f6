//! Checks of point masses. Entries that need the orientation of a point mass, or a position other than its own, are refused.

use crate::Real;
use crate::actions::{Need, needs};
use crate::algebra::{Vector, norm};
use crate::cluster::{point_tolerance, scene_length};
use crate::effects::Value;
use crate::effects::action::Actions;
use crate::mechanism::Scene;
use crate::scene::place::Place;
use crate::scene::{BodyId, Entry, Joint, SceneError, SceneFault, SignalKind};

/// Checks the point masses of a scene. Cost: none without point masses, else one pass over the scene.
pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    if !scene.bodies.iter().any(|body| body.is_point()) {
        return Ok(());
    }
    let points = Points { scene, tolerance: scene_length(scene) * point_tolerance::<T>() };
    for (i, joint) in scene.joints.iter().enumerate() {
        points.check_joint(joint, scene.place(Entry::Joint(i)))?;
    }
    for (i, guide) in scene.guides.iter().enumerate() {
        points.check_coordinate(guide.joint.index(), ("joint", scene.place(Entry::Guide(i))))?;
    }
    for (i, signal) in scene.signals.iter().enumerate() {
        let SignalKind::Measure { of, .. } = &signal.kind else { continue };
        if let Some(joint) = of.joint() {
            points.check_coordinate(joint.index(), ("joint", scene.place(Entry::Signal(i))))?;
        }
    }
    for (i, effect) in scene.effects.iter().enumerate() {
        let place = scene.place(Entry::Effect(i));
        for value in effect.kind.values() {
            match value {
                Value::Joint(joint) => points.check_coordinate(joint.index(), ("joint", place))?,
                Value::Spin(Some(joint)) => {
                    points.check_coordinate(joint.index(), ("spin", place))?;
                }
                _ => {}
            }
        }
        for (key, body, at) in effect.kind.places() {
            points.check_place(body, &at, (key, place))?;
        }
    }
    // the build of the model reports these errors
    let Ok(actions) = Actions::new(scene) else { return Ok(()) };
    let mut first = Ok(());
    needs(scene, &actions, &mut |entry, need| {
        if first.is_ok() {
            first = points.check_need(entry, &need);
        }
    });
    first
}

/// A scene with point masses.
struct Points<'a, T: Real> {
    scene: &'a Scene<T>,
    /// Largest distance of two positions that count as equal [m].
    tolerance: T,
}

impl<T: Real> Points<'_, T> {
    /// Refuses a body that is a point mass.
    fn no_point(
        &self,
        body: BodyId,
        (key, place): (&'static str, Place),
    ) -> Result<(), SceneError> {
        match body {
            BodyId::Body(index) if self.scene.is_point(body) => {
                place.fault(key, SceneFault::PointTurns(index))
            }
            _ => Ok(()),
        }
    }

    /// Refuses a position on a point mass that differs from the mass's own position.
    fn check_place(
        &self,
        body: BodyId,
        at: &[T; 3],
        (key, place): (&'static str, Place),
    ) -> Result<(), SceneError> {
        let BodyId::Body(index) = body else { return Ok(()) };
        if !self.scene.is_point(body) {
            return Ok(());
        }
        let off =
            norm(&(Vector::<T, 3>::from(*at) - Vector::from(self.scene.bodies[index].center)));
        if off <= self.tolerance {
            return Ok(());
        }
        place.fault(key, SceneFault::OffPoint { body: index, by: off.to_f64() })
    }

    /// Checks a joint of a point mass: it must be a ball, a link without a hinge there, or a free joint.
    fn check_joint(&self, joint: &Joint<T>, place: Place) -> Result<(), SceneError> {
        let (kind, dimension) = (joint.kind, place.dimension);
        for (side, &body) in joint.bodies.iter().enumerate() {
            let holds = if kind.is_link() {
                joint.is_ball_at(side)
            } else {
                kind.is_ball(dimension) || kind.is_of_point() && side == 1
            };
            if !holds {
                let key = if kind.is_of_point() { "bodies" } else { "kind" };
                self.no_point(body, (key, place))?;
            }
            let key = if kind.is_link() { "points" } else { "at" };
            self.check_place(body, &joint.points[side], (key, place))?;
        }
        match joint.limits.first_key() {
            Some(key) if self.scene.turns_point(joint) => self.no_turn(joint, (key, place)),
            _ => Ok(()),
        }
    }

    fn no_turn(&self, joint: &Joint<T>, at: (&'static str, Place)) -> Result<(), SceneError> {
        joint.bodies.into_iter().try_for_each(|body| self.no_point(body, at))
    }

    /// Checks that a used coordinate is no rotation of a point mass.
    fn check_coordinate(&self, joint: usize, at: (&'static str, Place)) -> Result<(), SceneError> {
        let joint = &self.scene.joints[joint];
        if self.scene.turns_point(joint) { self.no_turn(joint, at) } else { Ok(()) }
    }

    fn check_need(&self, entry: Entry, need: &Need<T>) -> Result<(), SceneError> {
        let place = self.scene.place(entry);
        match need {
            Need::Point(body, at) => self.check_place(*body, at, (self.place_key(entry), place)),
            Need::Rotation(body) | Need::Orientation(body) => {
                self.no_point(*body, (self.body_key(entry, *body), place))
            }
            Need::Direction(joint, _) | Need::Coordinates(joint, _) => {
                let is_sum = matches!(entry, Entry::Coupling(_) | Entry::Effect(_));
                self.check_coordinate(*joint, (if is_sum { "terms" } else { "joint" }, place))
            }
        }
    }

    /// Key of the entry's position. Positions of effects are checked earlier, with their keys.
    fn place_key(&self, entry: Entry) -> &'static str {
        match entry {
            Entry::Coupling(_) => "terms",
            _ => "at",
        }
    }

    /// Key by which an entry names a body.
    fn body_key(&self, entry: Entry, body: BodyId) -> &'static str {
        match entry {
            Entry::Initial(_) => "angular_velocity",
            Entry::Rolling(i) if self.scene.rollings[i].body != body => "on",
            Entry::Output(i) => {
                if self.scene.outputs[i].frame == Some(body) {
                    return "frame";
                }
                let keys = self.scene.outputs[i].quantity.row().target.keys();
                let is_other = keys.contains(&"relative_to") && !self.is_owner(i, body);
                if is_other { "relative_to" } else { keys.first().copied().unwrap_or("body") }
            }
            Entry::Effect(i) => {
                let keys = self.scene.effects[i].kind.row().fields.iter().map(|field| field.key);
                let mut of_bodies = keys.filter(|key| ["body", "bodies", "points"].contains(key));
                of_bodies.next().unwrap_or("kind")
            }
            _ => "body",
        }
    }

    /// True if an output measures this body; false if the output is relative to the body.
    fn is_owner(&self, output: usize, body: BodyId) -> bool {
        use crate::scene::{RelativePoint, Target};
        match self.scene.outputs[output].quantity.target() {
            Target::RelativePoint(RelativePoint { relative_to, .. }) => relative_to != body,
            Target::RelativeBody(owner, _) => owner == body,
            Target::WheelCarrier(of) => of.body == body,
            _ => true,
        }
    }
}
