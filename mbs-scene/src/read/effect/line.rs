//! Effects between two bodies: along the line of two points, or at a place.

use super::course::course;
use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use crate::read::tree::Item;
use mbs_core::scene::{EffectKind, Number, PolynomialPiece};

pub(super) fn spring_damper(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    let stiffness: Number = fields.number_or_zero("stiffness")?;
    let free_length = match fields.get("free_length") {
        // a pure damper has no free length
        None if stiffness.is_zero() => Number::ZERO,
        _ => fields.number("free_length")?,
    };
    Ok(EffectKind::SpringDamper {
        bodies: fields.pair()?,
        points: fields.two_vectors("points")?,
        stiffness,
        damping: fields.number_or_zero("damping")?,
        free_length,
    })
}

pub(super) fn bumper(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::Bumper {
        bodies: fields.pair()?,
        points: fields.two_vectors("points")?,
        stiffness: fields.number("stiffness")?,
        damping: fields.number_or_zero("damping")?,
        clearance: fields.number("clearance")?,
    })
}

pub(super) fn actuator(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::Actuator {
        bodies: fields.pair()?,
        points: fields.two_vectors("points")?,
        course: course(fields, true)?,
    })
}

pub(super) fn polynomial(fields: &Fields<'_>, of_rate: bool) -> Read<EffectKind<Number>> {
    let context = fields.context;
    let form = "a list of pieces [lower, upper, c0, c1, ...]";
    let pieces = context.list(fields.need("coefficients")?, form)?;
    Ok(EffectKind::Polynomial {
        bodies: fields.pair()?,
        points: fields.two_vectors("points")?,
        direction: fields.get("direction").map(|item| context.vector(item)).transpose()?,
        of_rate,
        pieces: pieces.iter().map(|item| piece(fields, item)).collect::<Read<_>>()?,
    })
}

/// `[lower, upper, c0, c1, ...]`.
fn piece(fields: &Fields<'_>, item: &Item) -> Read<PolynomialPiece<Number>> {
    let context = fields.context;
    let numbers = context.list(item, "a piece [lower, upper, c0, c1, ...]")?;
    let [lower, upper, rest @ ..] = numbers else {
        let fault = ReadFault::WrongCount { needed: 3, found: numbers.len() };
        return context.fault(&item.span, fault);
    };
    Ok(PolynomialPiece {
        lower: context.number(lower)?,
        upper: context.number(upper)?,
        coefficients: rest.iter().map(|item| context.number(item)).collect::<Read<_>>()?,
    })
}

pub(super) fn bushing(fields: &Fields<'_>) -> Read<EffectKind<Number>> {
    Ok(EffectKind::Bushing {
        bodies: fields.pair()?,
        at: fields.vector("at")?,
        stiffness: six(fields, fields.need("stiffness")?)?,
        damping: match fields.get("damping") {
            Some(item) => six(fields, item)?,
            None => [const { Number::ZERO }; 6],
        },
    })
}

/// Along and about x, y, z; in the plane along x, y and about z.
fn six(fields: &Fields<'_>, item: &Item) -> Read<[Number; 6]> {
    let context = fields.context;
    if context.is_planar() {
        let [x, y, about] = context.numbers_of(item, "a list of three numbers: [x, y, theta]")?;
        const ZERO: Number = Number::ZERO;
        return Ok([x, y, ZERO, ZERO, ZERO, about]);
    }
    context.numbers_of(item, "a list of six numbers: along x, y, z, then about x, y, z")
}
