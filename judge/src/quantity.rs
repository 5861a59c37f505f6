//! Quantities that channels show, by their names in scene files.

use crate::parts::Carrier;
use crate::vector::Vector;

/// Channel of the outputs, with its quantity.
#[derive(Debug, Clone)]
pub struct Output {
    /// Name of the channel.
    pub name: String,
    /// Quantity that the channel shows.
    pub quantity: Quantity,
    /// True if the channel is in degrees. Then all of its components are angles.
    pub degrees: bool,
}

/// A point of a body, seen from another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relative {
    /// The body that has the point.
    pub body: usize,
    /// The point of the body.
    pub at: Vector,
    /// The body from which the point is seen.
    pub other: Carrier,
    /// The point of the other body from which positions and distances are measured.
    pub origin: Vector,
}

/// Quantities of a point, seen from another body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seen {
    /// Position of the point.
    Position,
    /// Velocity of the point.
    Velocity,
    /// Acceleration of the point.
    Acceleration,
    /// Distance of the two points.
    Distance,
}

/// Carrier of a wheel, seen from the vehicle body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaning {
    /// The carrier of the wheel.
    pub body: usize,
    /// The vehicle body, or the ground.
    pub vehicle: Carrier,
    /// Axes of the vehicle body: forwards, inwards, upwards.
    pub axes: [Vector; 3],
    /// Direction of the carrier: the axis of the wheel, or the steering axis.
    pub direction: Vector,
    /// Number of the angle: 0 for camber, 1 for toe, 2 for caster.
    pub angle: usize,
}

/// Quantities of an effect, as a channel shows them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exerts {
    /// Tension of the effect, or its force and moment on a body.
    Force,
    /// Number that the effect measures.
    Value,
    /// Rate of the measured number.
    Rate,
    /// Measured number less its free value, or the depth of a contact.
    Deflection,
    /// Energy that the effect stores.
    Energy,
    /// Power that the effect gives to bodies.
    Power,
    /// One during contact, otherwise zero.
    Contact,
    /// Normal load of a tire.
    Load,
    /// Side force of a tire.
    SideForce,
    /// Force of a tire along the wheel's plane and the road.
    LongitudinalForce,
    /// Slip angle of a tire.
    SlipAngle,
    /// Aligning torque of a tire.
    AligningTorque,
    /// Lowest point of a tire.
    ContactPoint,
}

/// Quantities of the whole scene, as a channel shows them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Whole {
    /// Kinetic energy, rotors included.
    Kinetic,
    /// Potential energy of gravity and of effects.
    Potential,
    /// Sum of kinetic and potential energy.
    Energy,
    /// Centre of mass of all bodies.
    CenterOfMass,
    /// Momentum of all bodies.
    Momentum,
    /// Angular momentum of all bodies about their centre of mass.
    AngularMomentum,
    /// Error of the energy balance: the change of energy since the start, less the work done since then.
    InvariantError,
}

/// Quantity of a coupling that a channel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coupled {
    /// Effort on the part after which the coupling is named.
    Effort,
    /// Value of the coupling's sum.
    Value,
    /// Length of the coupling's lines.
    Length,
    /// Rate of the coupling's sum.
    Rate,
    /// Power that the coupling gives or transmits.
    Power,
}

/// Quantity that a channel shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Position of a body's point.
    Position(usize, Vector),
    /// Velocity of a body's point.
    Velocity(usize, Vector),
    /// Acceleration of a body's point.
    Acceleration(usize, Vector),
    /// Acceleration of a body's point without gravity.
    ProperAcceleration(usize, Vector),
    /// Quantity of a body's point, seen from another body.
    Seen(Relative, Seen),
    /// Angular velocity of a body.
    AngularVelocity(usize),
    /// Angular acceleration of a body.
    AngularAcceleration(usize),
    /// Orientation of a body: the angle in the plane, a quaternion in space.
    Orientation(usize),
    /// Rotation vector of a body; in the plane, the angle.
    RotationVector(usize),
    /// Rotation matrix of a body, row by row.
    RotationMatrix(usize),
    /// Kinetic energy of a body.
    KineticEnergy(usize),
    /// Camber, toe or caster.
    Leaning(Leaning),
    /// Coordinates of a joint.
    Value(usize),
    /// Rates of a joint's coordinates.
    Rate(usize),
    /// Second derivatives of a joint's coordinates.
    JointAcceleration(usize),
    /// Effort of a joint's guide on its coordinate.
    Effort(usize),
    /// Power that the guide of a joint gives to the mechanism.
    Power(usize),
    /// Reaction of a joint.
    Reaction(usize),
    /// Quantity of a coupling.
    Coupling(usize, Coupled),
    /// Quantity of an effect.
    Effect(usize, Exerts),
    /// Value of a signal, by its index; its rate if the Boolean is true.
    Signal(usize, bool),
    /// Force at the contact on a body that rolls, or on a blade.
    Contact(usize),
    /// Angular velocity of a body against another one: in global axes if the Boolean is true, otherwise in axes of the other one.
    RelativeAngularVelocity(usize, Carrier, bool),
    /// Quantity of the whole scene.
    Whole(Whole),
}

impl Quantity {
    /// Names of the quantities of a body's point.
    pub const OF_POINTS: &[&str] = &["position", "velocity", "acceleration", "proper-acceleration"];
    /// Names of the quantities of a body's point, seen from another body.
    pub const OF_SEEN_POINTS: &[&str] = &["position", "velocity", "acceleration", "distance"];
    /// Names of the quantities of a body, seen from another body.
    pub const OF_SEEN_BODIES: &[&str] = &["angular-velocity"];
    /// Names of the quantities of a wheel carrier.
    pub const OF_CARRIERS: &[&str] = &["camber", "toe", "caster"];
    /// Names of the quantities of a body.
    pub const OF_BODIES: &[&str] = &[
        "angular-velocity",
        "angular-acceleration",
        "orientation",
        "rotation-vector",
        "rotation-matrix",
        "kinetic-energy",
    ];
    /// Names of the quantities of a joint.
    pub const OF_JOINTS: &[&str] =
        &["value", "rate", "acceleration", "effort", "power", "reaction"];
    /// Names of the quantities of a signal.
    pub const OF_SIGNALS: &[&str] = &["value", "rate"];
    /// Names of the quantities of a rolling contact.
    pub const OF_ROLLINGS: &[&str] = &["force"];
    /// Names of the quantities of a coupling.
    pub const OF_COUPLINGS: &[&str] = &["effort", "value", "length", "rate", "power"];
    /// Names of the quantities of an effect.
    pub const OF_EFFECTS: &[&str] = &[
        "force",
        "value",
        "rate",
        "deflection",
        "energy",
        "power",
        "contact",
        "load",
        "side-force",
        "longitudinal-force",
        "slip-angle",
        "aligning-torque",
        "contact-point",
    ];
    /// Names of the quantities of the whole scene.
    pub const OF_SCENES: &[&str] = &[
        "kinetic-energy",
        "potential-energy",
        "energy",
        "center-of-mass",
        "momentum",
        "angular-momentum",
        "invariant-error",
    ];

    /// Returns the quantity of a coupling by its name.
    pub(crate) fn of_coupling(name: &str, number: usize) -> Option<Self> {
        let what = match name {
            "effort" | "force" => Coupled::Effort,
            "value" => Coupled::Value,
            "length" => Coupled::Length,
            "rate" => Coupled::Rate,
            "power" => Coupled::Power,
            _ => return None,
        };
        Some(Self::Coupling(number, what))
    }

    /// Returns the quantity of an effect by its name.
    pub(crate) fn of_effect(name: &str, number: usize) -> Option<Self> {
        let all = [
            Exerts::Force,
            Exerts::Value,
            Exerts::Rate,
            Exerts::Deflection,
            Exerts::Energy,
            Exerts::Power,
            Exerts::Contact,
            Exerts::Load,
            Exerts::SideForce,
            Exerts::LongitudinalForce,
            Exerts::SlipAngle,
            Exerts::AligningTorque,
            Exerts::ContactPoint,
        ];
        let name = if name == "length" { "value" } else { name };
        let place = Self::OF_EFFECTS.iter().position(|known| *known == name)?;
        Some(Self::Effect(number, all[place]))
    }

    /// Returns the quantity of the whole scene by its name.
    pub(crate) fn of_scene(name: &str) -> Option<Self> {
        let all = [
            Whole::Kinetic,
            Whole::Potential,
            Whole::Energy,
            Whole::CenterOfMass,
            Whole::Momentum,
            Whole::AngularMomentum,
            Whole::InvariantError,
        ];
        let place = Self::OF_SCENES.iter().position(|known| *known == name)?;
        Some(Self::Whole(all[place]))
    }

    /// Returns the quantity of a point, seen from another body, by its name.
    pub(crate) fn of_seen(name: &str, relative: Relative) -> Option<Self> {
        let all = [Seen::Position, Seen::Velocity, Seen::Acceleration, Seen::Distance];
        let place = Self::OF_SEEN_POINTS.iter().position(|known| *known == name)?;
        Some(Self::Seen(relative, all[place]))
    }

    /// Returns the quantity of a body, or of its point, by its name.
    pub(crate) fn of_body(name: &str, body: usize, at: Option<Vector>) -> Option<Self> {
        Some(match (name, at) {
            ("position", Some(at)) => Self::Position(body, at),
            ("velocity", Some(at)) => Self::Velocity(body, at),
            ("acceleration", Some(at)) => Self::Acceleration(body, at),
            ("proper-acceleration", Some(at)) => Self::ProperAcceleration(body, at),
            ("angular-velocity", None) => Self::AngularVelocity(body),
            ("angular-acceleration", None) => Self::AngularAcceleration(body),
            ("orientation", None) => Self::Orientation(body),
            ("rotation-vector", None) => Self::RotationVector(body),
            ("rotation-matrix", None) => Self::RotationMatrix(body),
            ("kinetic-energy", None) => Self::KineticEnergy(body),
            _ => return None,
        })
    }

    /// Returns the quantity of a joint by its name.
    pub(crate) fn of_joint(name: &str, joint: usize) -> Option<Self> {
        Some(match name {
            "value" => Self::Value(joint),
            "rate" => Self::Rate(joint),
            "acceleration" => Self::JointAcceleration(joint),
            "effort" => Self::Effort(joint),
            "power" => Self::Power(joint),
            "reaction" => Self::Reaction(joint),
            _ => return None,
        })
    }
}
