//! Parts of a scene that a quantity is of.

use crate::scene::{BodyId, CouplingId, EffectId, JointId, RollingId, SignalId};

/// What a quantity is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target<T> {
    /// The material point of a body that is at this place in the reference configuration [m].
    Point(BodyId, [T; 3]),
    /// The same, seen from another body.
    RelativePoint(RelativePoint<T>),
    /// A body.
    Body(BodyId),
    /// A body, seen from another one.
    RelativeBody(BodyId, BodyId),
    /// The carrier of a wheel, seen from the vehicle body.
    WheelCarrier(WheelCarrier<T>),
    /// A joint.
    Joint(JointId),
    /// A coupling.
    Coupling(CouplingId),
    /// A rolling.
    Rolling(RollingId),
    /// An effect.
    Effect(EffectId),
    /// A signal.
    Signal(SignalId),
    /// The whole scene.
    Scene,
}

impl<T> Target<T> {
    /// The body of what is of a body or its point.
    #[must_use]
    pub const fn own_body(&self) -> Option<BodyId> {
        match self {
            Self::Point(body, _)
            | Self::RelativePoint(RelativePoint { body, .. })
            | Self::Body(body)
            | Self::WheelCarrier(WheelCarrier { body, .. })
            | Self::RelativeBody(body, _) => Some(*body),
            Self::Joint(_)
            | Self::Coupling(_)
            | Self::Rolling(_)
            | Self::Effect(_)
            | Self::Signal(_)
            | Self::Scene => None,
        }
    }
}

/// A material point of a body, seen from another body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativePoint<T> {
    /// The body.
    pub body: BodyId,
    /// Its point in the reference configuration [m].
    pub at: [T; 3],
    /// The other body: its axes are the global ones of the reference configuration, and turn with it.
    pub relative_to: BodyId,
    /// The point of the other body that positions are counted from, in the reference configuration [m].
    pub origin: [T; 3],
}

/// The carrier of a wheel, seen from the vehicle body. Directions are those of the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelCarrier<T> {
    /// The carrier.
    pub body: BodyId,
    /// The vehicle body, with which up and forward turn.
    pub relative_to: BodyId,
    /// Where the wheel is.
    pub side: VehicleSide,
    /// Upwards in the vehicle; its length does not matter.
    pub up: [T; 3],
    /// Forward in the vehicle; what of it is along `up` does not count.
    pub forward: [T; 3],
    /// A direction of the carrier, in either sense: of camber and toe the wheel's axis, of caster the steering axis; `None`: across the
    /// vehicle, and up.
    pub axis: Option<[T; 3]>,
}

/// A side of a vehicle, as seen by who looks forward with the head up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VehicleSide {
    /// The left.
    Left,
    /// The right.
    Right,
}

impl VehicleSide {
    /// Both, with their names in scene files.
    pub const ALL: [(Self, &'static str); 2] = [(Self::Left, "left"), (Self::Right, "right")];
}
