//! Deflection of an effect from its free value, or its depth in contact.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::algebra::{Vector, norm};
use crate::effects::{EffectKind, Value};
use crate::scene::{BodyId, EffectId};

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "deflection",
    TargetKind::Effect,
    ComponentForm::Deflection,
    QuantityDefinition {
        formula: "m - free; of stops and tires the depth",
        axes: "none: a number",
        sign: "positive: longer than free; in contact",
        contents: "Depth is zero out of contact. Of stops on both sides it is that of the \
            deeper one. Zero of an effect that is switched off.",
    },
)
.of_effects();

/// Keys of free values in scene files.
const FREE: [&str; 2] = ["free_length", "free_value"];

/// Index of the measured effect, with its free value if it has one.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectDeflection<T: Real, const D: usize>(usize, Option<T>);

/// True if a kind of effect has a free value.
pub(super) fn has_free_value<T>(kind: &EffectKind<T>) -> bool {
    kind.row().fields.iter().any(|field| FREE.contains(&field.key))
}

/// Free value of an effect. A length that the scene leaves out is the length in the reference configuration.
fn free_value<T: Real>(kind: &EffectKind<T>) -> Option<T> {
    let values = kind.values();
    let place = kind.row().fields.iter().position(|field| FREE.contains(&field.key))?;
    match values.get(place)? {
        Value::Number(free) | Value::Length(Some(free)) => Some(*free),
        Value::Length(None) => values.iter().find_map(|value| match value {
            Value::Line(points) => Some(length(points)),
            _ => None,
        }),
        _ => None,
    }
}

/// Length of a line over points in the reference configuration.
fn length<T: Real>(points: &[(BodyId, [T; 3])]) -> T {
    let part = |pair: &[(BodyId, [T; 3])]| {
        norm(&(Vector::<T, 3>::from(pair[1].1) - Vector::from(pair[0].1)))
    };
    points.windows(2).fold(T::ZERO, |sum, pair| sum + part(pair))
}

impl<T: Real, const D: usize> Measured<T, D> for EffectDeflection<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, from: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), free_value(&from.scene.effects[of.index()].kind))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| match self.1 {
            Some(free) if all.is_there(self.0) => all.scalar(self.0, now.state).value - free,
            Some(_) => T::ZERO,
            None => all.depth(self.0, now.state),
        });
    }
}
