//! Laws, curves, sums and couplings of a scene, as the judge reads them.

use crate::vector::{Vector, norm, sub};

/// A body, or the ground.
pub type Carrier = Option<usize>;

/// Spline of cubic pieces: abscissae, values and second derivatives.
#[derive(Debug, Clone, Default)]
pub struct Spline {
    /// Abscissae, values, second derivatives.
    pub knots: Vec<[f64; 3]>,
}

/// A function of one number.
#[derive(Debug, Clone)]
pub enum Curve {
    /// A cubic spline, constant beyond its ends.
    Spline(Spline),
    /// A cubic spline that is periodic.
    Periodic(Spline),
    /// Linear interpolation between rows, constant beyond the ends. The Boolean is true if the curve is periodic.
    Linear(Vec<[f64; 2]>, bool),
    /// The value of the preceding row, constant beyond the ends. The Boolean is true if the curve is periodic.
    Hold(Vec<[f64; 2]>, bool),
    /// Polynomial with the coefficients c0, c1, ... of increasing power.
    Polynomial(Vec<f64>),
}

/// A value over time.
#[derive(Debug, Clone)]
pub enum Law {
    /// A curve through the rows of a table, over time.
    Curve(Curve),
    /// Sine over time: amplitude sin(2π f t + phase).
    Sine([f64; 3]),
    /// Ramp: rate t.
    Ramp(f64),
    /// A signal that depends on time alone.
    Signal(Box<Source>),
}

/// Measure of a term of a sum, zero in the reference configuration.
#[derive(Debug, Clone)]
pub enum Measure {
    /// A coordinate of a joint.
    Coordinate(usize, usize),
    /// The length of a line over points of bodies, less its length in the reference configuration.
    Length(Vec<(Carrier, Vector)>),
    /// Rotation angle of one body against another, by its index in the list `wheels` of the scene.
    Wheel(usize),
    /// The displacement of a point of the second body along an axis of the first.
    Way([Carrier; 2], Vector, Vector),
    /// The angle of a ball joint: its swing about an axis, or its twist.
    Ball(usize, Vector, bool),
}

/// A term of a sum.
#[derive(Debug, Clone)]
pub struct Term {
    /// Measure of the term.
    pub measure: Measure,
    /// Factor of the term.
    pub factor: f64,
    /// Function of the measured number, if there is one. The term is then the factor times the function's value.
    pub curve: Option<Curve>,
}

/// A rotation of a body against another, about an axis that is fixed in both.
#[derive(Debug, Clone)]
pub struct Wheel {
    /// The carrier, and the body that turns.
    pub bodies: [Carrier; 2],
    /// The unit axis in the reference configuration.
    pub axis: Vector,
}

/// Attachment of a coupling: where its force acts, if the scene says so.
#[derive(Debug, Clone)]
pub enum Seat {
    /// No attachment points: the effort acts on the coordinates alone.
    Nowhere,
    /// A thread between two bodies: carrier, screw and nut; the direction of the axis, which is fixed in the carrier; a point of the axis.
    Thread([Carrier; 3], Vector, Vector),
    /// Teeth in mesh at a point of the carrier: carrier and wheels, axis, points on the axes of the wheels, pitch point, tangent of the
    /// pressure angle, and whether the first wheel is the smaller one.
    Teeth([Carrier; 3], Vector, [Vector; 2], Vector, f64, bool),
    /// Strands between two wheels: carrier and wheels, axis, points on the axes of the wheels, signed radii, pretension.
    Strands([Carrier; 3], Vector, [Vector; 2], [f64; 2], f64),
    /// Drum on which a rope ends: the drum's carrier and the drum, a point of the axis, the unit axis, and whether the drum is at the
    /// rope's last point.
    Drum([Carrier; 2], Vector, Vector, bool),
}

/// A constraint: a sum of terms that equals a given value.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// Name of the coupling.
    pub name: String,
    /// Kind of the coupling in scene files.
    pub kind: String,
    /// The terms of the sum.
    pub terms: Vec<Term>,
    /// Constant part of the sum's given value.
    pub value: f64,
    /// Law over time that is added to the constant value.
    pub law: Option<Law>,
    /// Ratio of the effort that a channel shows to the multiplier.
    pub gain: f64,
    /// The coordinate on which the effort is measured: joint, number, and the ratio of this coordinate to the displacement of the effort.
    pub passed: Option<(usize, usize, f64)>,
    /// Attachment of the coupling's force.
    pub seat: Seat,
}

/// Shape of a body's part that touches a plane.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// Thin disc: radius, unit axis.
    Disc(f64, Vector),
    /// Sphere: its radius.
    Ball(f64),
    /// A blade along a unit direction.
    Blade(Vector),
}

/// Contact of a body that rolls on a plane, or of a blade that slides on it along one direction.
#[derive(Debug, Clone)]
pub struct Rolling {
    /// Name of the contact.
    pub name: String,
    /// The rolling body, and the body in which the plane is fixed.
    pub bodies: [Carrier; 2],
    /// Shape that touches the plane.
    pub shape: Shape,
    /// Centre of the disc or ball, or the point of the blade.
    pub center: Vector,
    /// A point of the plane.
    pub point: Vector,
    /// The unit normal of the plane.
    pub normal: Vector,
}

/// A number that depends on time or on the motion.
#[derive(Debug, Clone)]
pub enum Source {
    /// Number that is the same at all times.
    Constant(f64),
    /// A table over time.
    Table(Curve),
    /// Sine: amplitude, frequency, phase, offset.
    Sine([f64; 4]),
    /// Chirp: amplitude, frequency, phase, offset, last frequency, duration.
    Chirp([f64; 6]),
    /// Ramp: rate, start, end, rounding.
    Ramp([f64; 4]),
    /// Step: first value, last value, time of the beginning, duration.
    Step([f64; 4]),
    /// Sum of factors times numbers.
    Sum(Vec<(f64, Self)>),
    /// Product of numbers.
    Product(Vec<Self>),
    /// A function of a number.
    Of(Curve, Box<Self>),
    /// Number within limits.
    Clamp(Box<Self>, [f64; 2]),
    /// The number limited to a range, divided by the number itself; one where the number is zero.
    LimitRatio(Box<Self>, [f64; 2]),
    /// A measure, or its rate.
    Measure(Measure, bool),
    /// Lag of first order: number of its state, the signal that it follows, and the time constant.
    Lag(usize, Box<Self>, f64),
    /// Integral of a signal, limited to a range: number of its state, the signal, the range.
    Integral(usize, Box<Self>, [f64; 2]),
    /// PID controller: number of its state, target and measured signal, gains of difference, integral and rate, and the limit of its
    /// output.
    Pid(usize, [Box<Self>; 2], [f64; 3], f64),
}

/// Signal: its name, its source, and its state at the start.
#[derive(Debug, Clone)]
pub struct Signal {
    /// Name of the signal.
    pub name: String,
    /// Source of the signal's number.
    pub source: Source,
    /// State of the signal at the start.
    pub start: f64,
}

/// A vector over time.
#[derive(Debug, Clone)]
pub enum Given {
    /// Vector that is the same at all times.
    Constant(Vector),
    /// Rows of time and vector, linear between rows and constant outside. One row is a constant.
    Rows(Vec<(f64, Vector)>),
    /// A signal for each component.
    Named([Option<Box<Source>>; 3]),
}

/// The length of a line in the reference configuration.
pub(crate) fn reference_length(points: &[(Carrier, Vector)]) -> f64 {
    points.windows(2).map(|ends| norm(sub(ends[1].1, ends[0].1))).sum()
}
