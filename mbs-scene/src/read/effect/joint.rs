//! Effects on the coordinate of a joint.

use crate::read::fields::{Fields, Read};
use mbs_core::Real;
use mbs_core::scene::EffectKind;

/// Rate below which friction falls with the rate, where none is written [rad/s or m/s].
const REGULARISATION: &str = "1e-3";
/// Stribeck rate in regularisations, where none is written: the static level is reached between the two.
const STRIBECK: &str = "10";

pub(super) fn torsion_spring<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    Ok(EffectKind::TorsionSpring {
        joint: fields.context.joint(fields.need("joint")?)?,
        stiffness: fields.number_or_zero("stiffness")?,
        damping: fields.number_or_zero("damping")?,
        free_value: fields.number_or_zero("free_value")?,
    })
}

pub(super) fn limit<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    Ok(EffectKind::Limit {
        joint: fields.context.joint(fields.need("joint")?)?,
        lower: fields.number("lower")?,
        upper: fields.number("upper")?,
        stiffness: fields.number("stiffness")?,
        damping: fields.number_or_zero("damping")?,
    })
}

/// `static` is `coulomb` where it is left out: no Stribeck effect.
pub(super) fn friction<T: Real>(fields: &Fields<'_>) -> Read<EffectKind<T>> {
    let joint = fields.context.joint(fields.need("joint")?)?;
    let coulomb: T = fields.number("coulomb")?;
    let regularisation: T = fields.number_or("regularisation", REGULARISATION)?;
    let stribeck = match fields.optional("stribeck")? {
        Some(stribeck) => stribeck,
        None => regularisation * fields.number_or::<T>("stribeck", STRIBECK)?,
    };
    Ok(EffectKind::Friction {
        joint,
        coulomb,
        r#static: fields.optional("static")?.unwrap_or(coulomb),
        stribeck,
        viscous: fields.number_or_zero("viscous")?,
        regularisation,
    })
}
