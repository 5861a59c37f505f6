//! Effects on the coordinate of a joint.

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{EffectKind, Number};

/// Rate below which friction falls with the rate, where none is written [rad/s or m/s].
const REGULARISATION: &str = "1e-3";
/// Stribeck rate in regularisations, where none is written: the static level is reached between the two.
const STRIBECK: &str = "10";

pub(super) fn torsion_spring(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::TorsionSpring {
        joint: fields.context.joint(fields.need("joint")?)?,
        stiffness: fields.number_or_zero("stiffness")?,
        damping: fields.number_or_zero("damping")?,
        free_value: fields.number_or_zero("free_value")?,
    })
}

pub(super) fn limit(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::Limit {
        joint: fields.context.joint(fields.need("joint")?)?,
        lower: fields.number("lower")?,
        upper: fields.number("upper")?,
        stiffness: fields.number("stiffness")?,
        damping: fields.number_or_zero("damping")?,
    })
}

/// `static` is `coulomb` where it is left out: no Stribeck effect.
pub(super) fn friction(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    let joint = fields.context.joint(fields.need("joint")?)?;
    let coulomb: Number = fields.number("coulomb")?;
    let regularisation: Number = fields.number_or("regularisation", REGULARISATION)?;
    let stribeck = match fields.optional("stribeck")? {
        Some(stribeck) => stribeck,
        None => regularisation.clone() * fields.number_or("stribeck", STRIBECK)?,
    };
    Ok(EffectKind::Friction {
        joint,
        r#static: fields.optional("static")?.unwrap_or_else(|| coulomb.clone()),
        coulomb,
        stribeck,
        viscous: fields.number_or_zero("viscous")?,
        regularisation,
    })
}
