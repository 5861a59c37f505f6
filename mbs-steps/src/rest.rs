//! A scene at rest, and the parts of the scene that are omitted for it.

use mbs_core::Real;
use mbs_core::inputs::{GuideInput, SignalGraph};
use mbs_core::scene::{BodyId, InitialTarget, Motion, Scene};
use serde_json::{Value, json};

/// Part of a scene that an analysis at rest omits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Kind of the owner of the part: `effect`, `joint` or `body`.
    pub of: &'static str,
    /// Name of the owner.
    pub name: String,
    /// Name of the omitted part.
    pub part: &'static str,
}

/// Returns the scene at rest in its initial configuration. Guides hold their initial values, and there are no initial velocities. Effects
/// that act only in motion are omitted: dry friction, drives, and the forces of a rolling tire. Drag is omitted too, because it is of
/// second order in the speed. Viscous friction remains, because it damps small motions.
pub fn at_rest<T: Real>(scene: &Scene<T>) -> Scene<T> {
    let mut still = scene.clone();
    for effect in &mut still.effects {
        effect.enabled &= effect.kind.rest(&mut |_| {});
    }
    let signals = SignalGraph::new(&scene.signals).values(T::ZERO);
    for guide in &mut still.guides {
        let [value, ..] = GuideInput::new(&guide.law).at(T::ZERO, &signals);
        guide.law = Motion::Input([value, T::ZERO, T::ZERO]);
    }
    without_rates(still)
}

/// Returns the scene without initial velocities. Initial velocities need not be consistent with the positions at which a search for an
/// equilibrium begins.
pub fn without_rates<T: Real>(mut scene: Scene<T>) -> Scene<T> {
    for initial in &mut scene.initials {
        match &mut initial.target {
            InitialTarget::Joint { rate, .. } => *rate = None,
            InitialTarget::Body { velocity, angular_velocity, .. } => {
                (*velocity, *angular_velocity) = (None, None);
            }
        }
    }
    scene
}

/// Parts that [`at_rest`] omits, although they could act at rest or on small motions. Parts of effects come first, then rates.
pub fn left_out<T: Real>(scene: &Scene<T>) -> Vec<LeftOut> {
    let mut all = effects_left_out(scene);
    let mut leave = |of, name: &String, part| {
        let one = LeftOut { of, name: name.clone(), part };
        if !all.contains(&one) {
            all.push(one);
        }
    };
    let signals = SignalGraph::new(&scene.signals).values(T::ZERO);
    for guide in &scene.guides {
        let [_, rate, acceleration] = GuideInput::new(&guide.law).at(T::ZERO, &signals);
        if !rate.is_zero() || !acceleration.is_zero() {
            leave("joint", &scene.joints[guide.joint.index()].name, "motion of the guide");
        }
    }
    let moves = |rates: Option<&[T]>| rates.is_some_and(|all| all.iter().any(|x| !x.is_zero()));
    for initial in &scene.initials {
        match &initial.target {
            InitialTarget::Joint { joint, rate, .. } if moves(rate.as_deref()) => {
                leave("joint", &scene.joints[joint.index()].name, "initial rate");
            }
            InitialTarget::Body { body: BodyId::Body(body), velocity, angular_velocity } => {
                let velocity = velocity.as_ref().map(|(_, velocity)| &velocity[..]);
                if moves(velocity) || moves(angular_velocity.as_ref().map(|w| &w[..])) {
                    leave("body", &scene.bodies[*body].name, "initial velocity");
                }
            }
            InitialTarget::Joint { .. } | InitialTarget::Body { .. } => {}
        }
    }
    all
}

/// Omitted parts that belong to effects.
pub fn effects_left_out<T: Real>(scene: &Scene<T>) -> Vec<LeftOut> {
    let mut all = Vec::new();
    for effect in scene.effects.iter().filter(|effect| effect.enabled) {
        let mut leave = |part| all.push(LeftOut { of: "effect", name: effect.name.clone(), part });
        effect.kind.clone().rest(&mut leave);
    }
    all
}

/// Returns the omitted parts in their JSON form.
pub fn left_out_json(left_out: &[LeftOut]) -> Value {
    left_out.iter().map(|l| json!({ l.of: l.name, "part": l.part })).collect()
}
