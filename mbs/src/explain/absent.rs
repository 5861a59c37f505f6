//! What a scene could have and has not; and what no scene has.

use super::kinds::{damps, follows_time, springs};
use mbs_core::Real;
use mbs_core::scene::{Dimension, EffectKind, Scene};
use mbs_scene::MissingEffect;

/// One line for each thing that is not simulated.
pub(super) fn absent<T: Real>(scene: &Scene<T>) -> Vec<MissingEffect> {
    let any = |is: &dyn Fn(&EffectKind<T>) -> bool| {
        scene.effects.iter().any(|effect| effect.enabled && is(&effect.kind))
    };
    let lines = [
        (scene.gravity.is_some(), "gravity", "no gravity"),
        (
            scene.dimension == Dimension::Spatial,
            "third-dimension",
            "no third dimension: a body has two translations and one rotation",
        ),
        (!scene.guides.is_empty(), "guides", "no guided joints: no constraint depends on time"),
        (any(&springs), "springs", "no springs: nothing but gravity stores energy"),
        (any(&damps), "damping", "no damping: nothing takes energy out"),
        (
            any(&|kind| matches!(kind, EffectKind::Friction { .. })),
            "friction",
            "no friction in joints",
        ),
        (
            any(&|kind| matches!(kind, EffectKind::Limit { .. })),
            "limits",
            "no limits: joints turn and slide without stops",
        ),
        (any(&|kind| matches!(kind, EffectKind::Bumper { .. })), "bumpers", "no bumpers"),
        (
            any(&|kind| matches!(kind, EffectKind::Tire { .. })),
            "tires",
            "no tires and no road under them",
        ),
        (any(&follows_time), "driving-forces", "no force or torque that follows time or an input"),
        (any(&|kind| matches!(kind, EffectKind::AeroDrag { .. })), "air", "no drag of air"),
        (false, "contact", "no contact of bodies: they pass through each other"),
        (false, "flexible-bodies", "no flexible bodies: every body is rigid"),
    ];
    let missing = lines.into_iter().filter(|(is_there, ..)| !is_there);
    missing
        .map(|(_, what, text)| MissingEffect { what: what.to_owned(), text: text.to_owned() })
        .collect()
}
