//! Properties of effects that other modules ask for: pictures, the check for wrong units, starts, roads, and steps that skip
//! friction.

use crate::scene::{BodyId, JointId};

/// Picture that represents an effect in drawings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EffectPicture<T> {
    /// No picture: the effect has no place of its own, or the moved body shows it.
    Nothing,
    /// Line through the [places](super::EffectKind::places) of the effect.
    Line(LineLook),
    /// Ring around a place of a body, in the reference configuration [m].
    Ring(BodyId, [T; 3]),
    /// Wheel that touches the road.
    Wheel(RoadWheel<T>),
}

/// Shape with which a line of an effect is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineLook {
    /// Coil of a spring.
    Coil,
    /// Cylinder of a damper.
    Damper,
    /// Coil around a damper.
    CoilDamper,
    /// Block with which a bumper pushes.
    Bumper,
    /// Rod of a drive, or of a law whose parts are unknown.
    Actuator,
}

impl LineLook {
    /// Shape of a line with a spring, a damper or both. Without either it is a coil.
    pub(super) const fn of([is_spring, is_damper]: [bool; 2]) -> Self {
        match (is_spring, is_damper) {
            (true, true) => Self::CoilDamper,
            (false, true) => Self::Damper,
            (true | false, false) => Self::Coil,
        }
    }
}

/// Wheel that touches the road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoadWheel<T> {
    /// Body that carries the wheel.
    pub body: BodyId,
    /// Centre of the wheel, reference configuration [m].
    pub center: [T; 3],
    /// Axis of the wheel. `None`: the axis of its joint, or the direction across the direction of travel.
    pub axis: Option<[T; 3]>,
    /// Radius of the unloaded wheel [m].
    pub radius: T,
    /// Joint about which the wheel rotates on the body that carries it; `None`: the wheel is fixed to this body.
    pub spin: Option<JointId>,
}

/// Inertia that an effect adds to a joint's coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotorInertia<T> {
    /// Joint that has the coordinate.
    pub joint: JointId,
    /// Number of the coordinate; `None`: the joint has one coordinate.
    pub coordinate: Option<usize>,
    /// Inertia at the coordinate [kg m^2; for a slide kg].
    pub inertia: T,
}

/// Number of an effect whose size may show that it was written in another unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnitHint<T> {
    /// Angle that is given by a key.
    Angle {
        /// Key of the number in scene files.
        key: &'static str,
        /// Number at the key [rad].
        value: T,
        /// Joint on which the effect acts. The number is an angle only if the joint rotates; `None`: it is always an angle.
        of: Option<JointId>,
    },
    /// Free length of a spring between two points.
    FreeLength {
        /// Key of the number in scene files.
        key: &'static str,
        /// Number at the key [m].
        value: T,
        /// Distance of the two points in the reference configuration [m].
        in_place: T,
    },
    /// Stiffness along a line between two bodies.
    Stiffness {
        /// Key of the number in scene files.
        key: &'static str,
        /// Number at the key [N/m].
        value: T,
        /// Bodies that oscillate on the stiffness.
        bodies: [BodyId; 2],
    },
}
