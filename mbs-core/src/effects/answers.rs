//! Answers of effects to who asks what they are like: to pictures, to the doctor, to starts, to roads, and to steps that pass friction over.

use crate::scene::{BodyId, JointId};

/// Picture of an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EffectPicture<T> {
    /// Nothing is drawn: the effect has no place of its own, or is seen by what it moves.
    Nothing,
    /// A line over the [places](super::EffectKind::places) of the effect.
    Line(LineLook),
    /// A ring around a place of a body, reference configuration [m].
    Ring(BodyId, [T; 3]),
    /// A wheel on the road.
    Wheel(RoadWheel<T>),
}

/// Look of a line that stands for an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineLook {
    /// Coil of a spring.
    Coil,
    /// Cylinder of a damper.
    Damper,
    /// Coil around a damper.
    CoilDamper,
    /// Block that a bumper pushes with.
    Bumper,
    /// Rod of a drive, and of a law whose parts are not known.
    Actuator,
}

impl LineLook {
    /// Look of a spring, a damper or both; of neither it is a coil.
    pub(super) const fn of([is_spring, is_damper]: [bool; 2]) -> Self {
        match (is_spring, is_damper) {
            (true, true) => Self::CoilDamper,
            (false, true) => Self::Damper,
            (true | false, false) => Self::Coil,
        }
    }
}

/// A wheel that touches the road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoadWheel<T> {
    /// Body that carries the wheel.
    pub body: BodyId,
    /// Centre of the wheel, reference configuration [m].
    pub center: [T; 3],
    /// Axis of the wheel; `None`: that of its joint, or across the direction of travel.
    pub axis: Option<[T; 3]>,
    /// Radius without load [m].
    pub radius: T,
    /// Joint about which the wheel turns on the body that carries it; `None`: the wheel is fixed there.
    pub spin: Option<JointId>,
}

/// Inertia that an effect adds to a joint's coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotorInertia<T> {
    /// Joint that has the coordinate.
    pub joint: JointId,
    /// Number of the coordinate; `None`: the only one.
    pub coordinate: Option<usize>,
    /// Inertia about the coordinate [kg m^2, of a slide kg].
    pub inertia: T,
}

/// A number of an effect whose size may show that it was written in another unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnitHint<T> {
    /// Angle at a key.
    Angle {
        /// Key of the number in scene files.
        key: &'static str,
        /// Number at the key [rad].
        value: T,
        /// Joint of which the number is an angle only where that turns; `None`: it is always taken for one.
        of: Option<JointId>,
    },
    /// Length without tension of a spring between two points.
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
        /// Bodies that swing on it.
        bodies: [BodyId; 2],
    },
}
