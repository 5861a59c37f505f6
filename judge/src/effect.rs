//! Effects of a scene, as the judge reads them.

use crate::parts::{Carrier, Given, Term, reference_length};
use crate::vector::{Vector, norm, sub};

/// Two points, each of one body.
#[derive(Debug, Clone)]
pub struct Line {
    /// First and second body.
    pub bodies: [Carrier; 2],
    /// Points of the line on the two bodies.
    pub points: [Vector; 2],
    /// Direction, fixed in the first body, along which the line is measured; `None` if the distance is measured.
    pub direction: Option<Vector>,
}

/// Path of an effect: the number that the effect measures and along which its force acts.
#[derive(Debug, Clone)]
pub enum Path {
    /// The distance of two points.
    Ends(Line),
    /// The length of a line over points of bodies.
    Points(Vec<(Carrier, Vector)>),
    /// A sum of coordinates and lengths.
    Sum(Vec<Term>),
}

impl Path {
    /// The length of a line in the reference configuration; zero for a sum.
    pub(crate) fn reference(&self) -> f64 {
        match self {
            Self::Ends(line) => norm(sub(line.points[1], line.points[0])),
            Self::Points(points) => reference_length(points),
            Self::Sum(_) => 0.0,
        }
    }
}

/// Coefficients of a tire's side force by the Calspan model.
#[derive(Debug, Clone)]
pub struct Calspan {
    /// Coefficients A0 to A4.
    pub a: [f64; 5],
    /// Factor W of A2.
    pub omega: f64,
    /// Coefficients B1, B3, B4 of the friction.
    pub b: [f64; 3],
    /// Factor k of the friction.
    pub skid: f64,
    /// Coefficients AF1, AF2 of the trail.
    pub trail: [f64; 2],
}

/// A wheel on the road.
#[derive(Debug, Clone)]
pub struct Tire {
    /// Body that the tire acts on: the wheel, where the scene names the joint of its rotation; otherwise the carrier.
    pub body: usize,
    /// Centre of the wheel.
    pub center: Vector,
    /// Axis of the wheel.
    pub axis: Option<Vector>,
    /// Radius, stiffness, damping, rolling resistance.
    pub numbers: [f64; 4],
    /// Side force of the tire.
    pub side: Option<Calspan>,
    /// Longitudinal force by slip: stiffness, and friction relative to the load.
    pub slip: Option<[f64; 2]>,
}

/// Effect that is enabled, with its numbers.
#[derive(Debug, Clone)]
pub enum Effect {
    /// Spring and damper: stiffness, damping, free value. The Boolean is true if the spring only pulls.
    Spring(Path, [f64; 3], bool),
    /// Polynomial pieces [lower, upper, c0, ...] of the measured number, or of its rate if the Boolean is true.
    Polynomial(Path, Vec<Vec<f64>>, bool),
    /// Bumper: stiffness, damping, clearance.
    Bumper(Line, [f64; 3]),
    /// A force along a line, or the torque of a joint's first body on its second.
    Push(Path, Given),
    /// Stiffness and damping along and about the axes of the first body.
    Bushing([Carrier; 2], Vector, [[f64; 6]; 2]),
    /// Torque on a body.
    BodyTorque(usize, Given),
    /// Limit of a sum: lower, upper, stiffness, damping.
    Limit(Vec<Term>, [f64; 4]),
    /// Friction along a sum: coulomb, static, stribeck, viscous, regularisation; then a factor over time, which multiplies the first two.
    Friction(Vec<Term>, [f64; 5], Given),
    /// Force on a body: body, point, force. The Boolean is true if the force rotates with the body.
    Force(usize, Vector, Given, bool),
    /// Drag on a body: body, point; area times coefficient, density.
    Drag(usize, Vector, [f64; 2]),
    /// Force that controls a body's speed: body, direction; speed, gain, limit.
    SpeedHold(usize, Vector, [f64; 3]),
    /// Wheel on the road.
    Tire(Tire),
    /// Rotor on a coordinate of a joint: joint, number; moment of inertia of the rotor times the square of its ratio.
    Rotor(usize, usize, f64),
}

impl Effect {
    /// Returns the kind of the effect in scene files, with the kind of its path.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Spring(Path::Ends(_), _, false) => "spring-damper",
            Self::Spring(Path::Sum(_), ..) => "torsion-spring",
            Self::Spring(..) => "spring-damper over points",
            Self::Polynomial(Path::Points(_), ..) => "polynomial over points",
            Self::Polynomial(Path::Sum(_), ..) => "polynomial on a sum",
            Self::Polynomial(_, _, false) => "polynomial-spring",
            Self::Polynomial(_, _, true) => "polynomial-damper",
            Self::Bumper(..) => "bumper",
            Self::Push(Path::Ends(_), _) => "actuator",
            Self::Push(Path::Points(_), _) => "actuator over points",
            Self::Push(Path::Sum(_), _) => "torque on a joint",
            Self::Bushing(..) => "bushing",
            Self::BodyTorque(..) => "torque on a body",
            Self::Rotor(..) => "rotor",
            Self::Limit(..) => "limit",
            Self::Friction(..) => "friction",
            Self::Force(..) => "force",
            Self::Drag(..) => "aero-drag",
            Self::SpeedHold(..) => "speed-hold",
            Self::Tire(tire) if tire.slip.is_some() => "tire with slip",
            Self::Tire(tire) if tire.side.is_some() => "tire with side force",
            Self::Tire(..) => "tire",
        }
    }
}
