//! Parts of a scene that a quantity can measure.

use crate::scene::{BodyId, CouplingId, EffectId, JointId, RollingId, SignalId};

/// Target of a quantity: the part of the scene that is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target<T> {
    /// Material point of a body, given by its place in the reference configuration [m].
    Point(BodyId, [T; 3]),
    /// Material point of a body, relative to another body.
    RelativePoint(RelativePoint<T>),
    /// A body.
    Body(BodyId),
    /// A body, relative to another body.
    RelativeBody(BodyId, BodyId),
    /// Carrier of a wheel, relative to the vehicle body.
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
    /// Body of a target that is a body or a point of a body; `None` for other targets.
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

/// Material point of a body, relative to another body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativePoint<T> {
    /// Body that has the point.
    pub body: BodyId,
    /// Place of the point in the reference configuration [m].
    pub at: [T; 3],
    /// Reference body, whose axes are the global axes in the reference configuration, and rotate with it.
    pub relative_to: BodyId,
    /// Point of the reference body from which positions are measured, in the reference configuration [m].
    pub origin: [T; 3],
}

/// Carrier of a wheel, relative to the vehicle body. Directions are given in the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelCarrier<T> {
    /// Body that carries the wheel.
    pub body: BodyId,
    /// Vehicle body, with which the directions up and forward rotate.
    pub relative_to: BodyId,
    /// Side of the vehicle on which the wheel is.
    pub side: VehicleSide,
    /// Upward direction of the vehicle, of any length.
    pub up: [T; 3],
    /// Forward direction of the vehicle. Its component along `up` is ignored.
    pub forward: [T; 3],
    /// Direction fixed in the carrier, of either sense: the wheel's axis for camber and toe, the steering axis for caster. `None`:
    /// across the vehicle for camber and toe, up for caster.
    pub axis: Option<[T; 3]>,
}

/// Side of a vehicle, as seen by a driver who looks forward.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VehicleSide {
    /// The left.
    Left,
    /// The right.
    Right,
}

impl VehicleSide {
    /// All sides of a vehicle, with their names in scene files.
    pub const ALL: [(Self, &'static str); 2] = [(Self::Left, "left"), (Self::Right, "right")];
}
