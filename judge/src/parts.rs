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
    /// A cubic spline, its ends held.
    Spline(Spline),
    /// A cubic spline that repeats.
    Periodic(Spline),
    /// Straight between its rows, the ends held; does it repeat?
    Linear(Vec<[f64; 2]>, bool),
    /// The value of the row before, the ends held; does it repeat?
    Hold(Vec<[f64; 2]>, bool),
    /// Polynomial with the coefficients c0, c1, ... of increasing power.
    Polynomial(Vec<f64>),
}

/// A value over time.
#[derive(Debug, Clone)]
pub enum Law {
    /// Through the rows of a table.
    Curve(Curve),
    /// amplitude sin(2π f t + phase).
    Sine([f64; 3]),
    /// Ramp: rate t.
    Ramp(f64),
    /// A signal that follows time alone.
    Signal(Box<Source>),
}

/// Measure of a term of a sum, zero in the reference configuration.
#[derive(Debug, Clone)]
pub enum Measure {
    /// A coordinate of a joint.
    Coordinate(usize, usize),
    /// The length of a line over points of bodies, less that in the reference configuration.
    Length(Vec<(Carrier, Vector)>),
    /// A turn of a body against another, by its number in the scene.
    Wheel(usize),
    /// The way of a point of the second body along an axis of the first.
    Way([Carrier; 2], Vector, Vector),
    /// The swing about an axis of a ball, or its twist.
    Ball(usize, Vector, bool),
}

/// A term of a sum.
#[derive(Debug, Clone)]
pub struct Term {
    /// Measure of the term.
    pub measure: Measure,
    /// Factor of the term.
    pub factor: f64,
    /// A function of what is measured.
    pub curve: Option<Curve>,
}

/// A turn of a body against another about an axis that stands in both.
#[derive(Debug, Clone)]
pub struct Wheel {
    /// The carrier, and the body that turns.
    pub bodies: [Carrier; 2],
    /// The unit axis in the reference configuration.
    pub axis: Vector,
}

/// Seat of a coupling: where its force acts, if the scene says so.
#[derive(Debug, Clone)]
pub enum Seat {
    /// No seat: the torques of its coordinates alone.
    Nowhere,
    /// A thread between two bodies, along an axis of the carrier through a point: carrier, screw, nut.
    Thread([Carrier; 3], Vector, Vector),
    /// Teeth that touch at a point of the carrier: carrier and wheels, axis, places of the axes, pitch point, tangent of the pressure
    /// angle, and whether the first wheel is the smaller one.
    Teeth([Carrier; 3], Vector, [Vector; 2], Vector, f64, bool),
    /// Strands between two wheels: carrier and wheels, axis, places of the axes, radii with their signs, pretension.
    Strands([Carrier; 3], Vector, [Vector; 2], [f64; 2], f64),
    /// The end of a rope on the carrier of a drum, whose axis is about a joint: the joint's carrier, the drum, a point of the axis.
    Drum([Carrier; 2], Vector, Vector, bool),
}

/// A sum that is zero.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// Name of the coupling.
    pub name: String,
    /// Kind of the coupling in scene files.
    pub kind: String,
    /// The terms of the sum.
    pub terms: Vec<Term>,
    /// Value of the sum, beside the law.
    pub value: f64,
    /// Law that is added to the value over time.
    pub law: Option<Law>,
    /// Ratio of the effort that is shown to the multiplier.
    pub gain: f64,
    /// The coordinate that the effort is given to: joint, number, and its ratio to the way of the effort.
    pub passed: Option<(usize, usize, f64)>,
    /// Seat of the coupling's force.
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

/// Contact of a body that rolls on a plane, or of a blade that cuts it.
#[derive(Debug, Clone)]
pub struct Rolling {
    /// Name of the contact.
    pub name: String,
    /// The body, and the one that the plane is fixed in.
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

/// A number over time and of the motion.
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
    /// Step: from, to, when it begins, how long it takes.
    Step([f64; 4]),
    /// Sum of factors times numbers.
    Sum(Vec<(f64, Self)>),
    /// Product of numbers.
    Product(Vec<Self>),
    /// A function of a number.
    Of(Curve, Box<Self>),
    /// Number within limits.
    Clamp(Box<Self>, [f64; 2]),
    /// Within limits, by itself; one where that is zero.
    LimitRatio(Box<Self>, [f64; 2]),
    /// A measure, or its rate.
    Measure(Measure, bool),
    /// The state of a signal, which follows another one with a time constant.
    Lag(usize, Box<Self>, f64),
    /// The state of a signal, the integral of another one within limits.
    Integral(usize, Box<Self>, [f64; 2]),
    /// The state of a signal, target and measured, gains of difference, integral and rate, and the limit.
    Pid(usize, [Box<Self>; 2], [f64; 3], f64),
}

/// Signal: its name, what it is, and its state at the start.
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
    /// Rows of time and vector, linear between them, held outside; one row is a constant.
    Rows(Vec<(f64, Vector)>),
    /// A signal for each component.
    Named([Option<Box<Source>>; 3]),
}

/// The length of a line in the reference configuration.
pub(crate) fn reference_length(points: &[(Carrier, Vector)]) -> f64 {
    points.windows(2).map(|ends| norm(sub(ends[1].1, ends[0].1))).sum()
}
