//! Effects that a scene could have and does not have, and effects that no scene can have.

use super::explanation::MissingEffect;
use mbs_core::Real;
use mbs_core::effects::EFFECTS;
use mbs_core::scene::{Dimension, EffectKind, Scene};

/// Lists the effects that are not simulated, one line each.
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
        (!scene.couplings.is_empty(), "couplings", "no couplings: no gears, racks, cams or ropes"),
        (!scene.rollings.is_empty(), "rolling", "no rolling without slipping, and no blades"),
        (!scene.guides.is_empty(), "guides", "no guided joints: no constraint depends on time"),
        (
            any(&EffectKind::stores_energy),
            "springs",
            "no springs: nothing but gravity stores energy",
        ),
        (any(&EffectKind::dissipates), "damping", "no damping: nothing takes energy out"),
        (
            any(&EffectKind::follows_time),
            "driving-forces",
            "no force or torque that follows time or an input",
        ),
        (false, "contact", "no contact of bodies: they pass through each other"),
        (false, "flexible-bodies", "no flexible bodies: every body is rigid"),
    ];
    let missing = lines.into_iter().filter(|(is_there, ..)| !is_there);
    let of_kinds = EFFECTS.iter().filter_map(|row| {
        let [what, text] = row.absent?;
        let is_there = any(&|kind| kind.row().names.first() == row.names.first());
        (!is_there).then_some((what, text))
    });
    missing
        .map(|(_, what, text)| (what, text))
        .chain(of_kinds)
        .map(|(what, text)| MissingEffect { what: what.to_owned(), text: text.to_owned() })
        .collect()
}
