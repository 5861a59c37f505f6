//! Mechanisms as plain numbers, which can be rotated, scaled and written as text of a scene.

use crate::gauntlet::vector::{Point, Turn, distance, plus};
use mbs::core::effects::Value;
use mbs::{BodyId, Effect, GROUND as FIXED, Vector3};

/// Number of the ground; bodies count from 1.
pub const GROUND: usize = 0;

/// Mass and shape of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Mass of the body [kg].
    pub mass: f64,
    /// Shape of the mass.
    pub shape: Shape,
}

/// Shape of the mass of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Mass on a line between two points.
    Rod([Point; 2]),
    /// Mass about a centre, with moments of inertia [xx, yy, zz, xy, yz, zx] about it [kg m^2]; for a planar body only zz is used.
    Solid(Point, [f64; 6]),
}

/// A joint: the second body moves relative to the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Kind of the joint in scenes.
    pub kind: &'static str,
    /// Numbers of the first and the second body.
    pub bodies: [usize; 2],
    /// Place of the joint; for a distance joint a point on each body.
    pub at: Vec<Point>,
    /// Axes of the joint: none, one or two.
    pub axes: Vec<Point>,
}

/// A mechanism with the start of its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// Dimension: 2 or 3.
    pub dimension: usize,
    /// Acceleration of gravity [m/s^2].
    pub gravity: Point,
    /// Bodies, numbered from 1.
    pub bodies: Vec<Body>,
    /// Joints of the mechanism.
    pub joints: Vec<Joint>,
    /// Joints with their rates at the start [rad/s or m/s].
    pub rates: Vec<(usize, f64)>,
    /// Effects on the bodies.
    pub effects: Vec<Effect>,
    /// Points of bodies whose positions are outputs.
    pub outputs: Vec<(usize, Point)>,
}

impl Draft {
    /// An empty mechanism in the plane, with gravity along -y.
    #[must_use]
    pub fn planar() -> Self {
        Self {
            dimension: 2,
            gravity: [0.0, -9.81, 0.0],
            bodies: Vec::new(),
            joints: Vec::new(),
            rates: Vec::new(),
            effects: Vec::new(),
            outputs: Vec::new(),
        }
    }

    /// An empty mechanism in space, with gravity along -z.
    #[must_use]
    pub fn spatial() -> Self {
        Self { dimension: 3, gravity: [0.0, 0.0, -9.81], ..Self::planar() }
    }

    /// Adds a thin rod. In space its thickness is a twentieth of its length.
    pub fn rod(&mut self, from: Point, to: Point, mass: f64) -> usize {
        let shape = if self.dimension == 2 { Shape::Rod([from, to]) } else { bar(from, to, mass) };
        self.bodies.push(Body { mass, shape });
        self.bodies.len()
    }

    /// Adds a body with moments of inertia about its centre.
    pub fn solid(&mut self, center: Point, mass: f64, moments: [f64; 3]) -> usize {
        let [a, b, c] = moments;
        self.bodies.push(Body { mass, shape: Shape::Solid(center, [a, b, c, 0.0, 0.0, 0.0]) });
        self.bodies.len()
    }

    /// Adds a joint; returns its number.
    pub fn joint(
        &mut self,
        kind: &'static str,
        bodies: [usize; 2],
        at: Point,
        axes: &[Point],
    ) -> usize {
        self.joints.push(Joint { kind, bodies, at: vec![at], axes: axes.to_vec() });
        self.joints.len() - 1
    }

    /// Adds a revolute joint about z, in plane or space.
    pub fn pin(&mut self, bodies: [usize; 2], at: Point) -> usize {
        let axes: &[Point] = if self.dimension == 2 { &[] } else { &[[0.0, 0.0, 1.0]] };
        self.joint("revolute", bodies, at, axes)
    }

    /// Sets the rate of a joint at the start [rad/s or m/s]. Other joints start with rate zero.
    pub fn rate(&mut self, joint: usize, rate: f64) {
        self.rates.push((joint, rate));
    }

    /// A point with as many coordinates as the scene has dimensions.
    #[must_use]
    pub fn vector(&self, x: Point) -> Vector3 {
        if self.dimension == 2 { [x[0], x[1]].into() } else { x.into() }
    }

    /// The two attachment points of an effect.
    #[must_use]
    pub fn ends(&self, bodies: [usize; 2], points: [Point; 2]) -> [(BodyId, Vector3); 2] {
        [0, 1].map(|i| (id(bodies[i]), self.vector(points[i])))
    }

    /// Adds the position of a body's point to the outputs.
    pub fn watch(&mut self, body: usize, at: Point) {
        self.outputs.push((body, at));
    }

    /// Largest distance between places of bodies, joints and effects [m].
    #[must_use]
    pub fn size(&self) -> f64 {
        let of_body = |body: &Body| match &body.shape {
            Shape::Rod(ends) => ends.to_vec(),
            Shape::Solid(center, _) => vec![*center],
        };
        let of_joints = self.joints.iter().flat_map(|joint| joint.at.clone());
        let watched = self.outputs.iter().map(|(_, at)| *at);
        let values = self.effects.iter().flat_map(|effect| effect.kind.values());
        let held = values.flat_map(|value| match value {
            Value::Points(points) => points.map(|p| p.map(|x| x.to_f64())).to_vec(),
            Value::Line(points) => {
                points.iter().map(|(_, p)| p.clone().map(|x| x.to_f64())).collect()
            }
            _ => Vec::new(),
        });
        let places = self.bodies.iter().flat_map(of_body).chain(of_joints).chain(watched);
        let places: Vec<Point> = places.chain(held).collect();
        let apart = |a: &Point| places.iter().map(|b| distance(*a, *b)).fold(0.0, f64::max);
        places.iter().map(apart).fold(0.0, f64::max)
    }

    /// Returns the planar mechanism as one in space: its plane is the x-y plane, and each joint has an axis.
    #[must_use]
    pub fn raised(&self) -> Self {
        let mut draft = self.clone();
        draft.dimension = 3;
        for body in &mut draft.bodies {
            body.shape = match body.shape {
                Shape::Rod([from, to]) => bar(from, to, body.mass),
                Shape::Solid(at, j) => Shape::Solid(at, [j[2], j[2], j[2], 0.0, 0.0, 0.0]),
            };
        }
        for joint in &mut draft.joints {
            if joint.kind == "revolute" {
                joint.axes = vec![[0.0, 0.0, 1.0]];
            }
        }
        draft
    }

    /// Returns the mechanism rotated about the origin, without effects.
    #[must_use]
    pub fn turned(&self, turn: &Turn) -> Self {
        let mut draft = self.clone();
        draft.gravity = turn.of(self.gravity);
        for body in &mut draft.bodies {
            body.shape = match body.shape {
                Shape::Rod(ends) => Shape::Rod(ends.map(|p| turn.of(p))),
                Shape::Solid(at, j) => Shape::Solid(turn.of(at), turn.of_inertia(j)),
            };
        }
        for joint in &mut draft.joints {
            joint.at.iter_mut().chain(&mut joint.axes).for_each(|x| *x = turn.of(*x));
        }
        draft.outputs.iter_mut().for_each(|(_, at)| *at = turn.of(*at));
        draft
    }

    /// Returns the mechanism in other units of length and mass, without effects. 1 m is `length` units and 1 kg is `mass` units. The unit
    /// of time is the second.
    #[must_use]
    pub fn in_units(&self, length: f64, mass: f64) -> Self {
        let mut draft = self.clone();
        let scaled = |p: Point| p.map(|x| x * length);
        draft.gravity = scaled(self.gravity);
        for body in &mut draft.bodies {
            body.mass *= mass;
            body.shape = match body.shape {
                Shape::Rod(ends) => Shape::Rod(ends.map(scaled)),
                Shape::Solid(at, j) => {
                    Shape::Solid(scaled(at), j.map(|x| x * mass * length * length))
                }
            };
        }
        draft.joints.iter_mut().flat_map(|joint| &mut joint.at).for_each(|p| *p = scaled(*p));
        draft.outputs.iter_mut().for_each(|(_, at)| *at = scaled(*at));
        draft
    }
}

/// Body of a number: 0 is the ground, bodies count from 1.
pub(super) fn id(k: usize) -> BodyId {
    k.checked_sub(1).map_or(FIXED, BodyId::Body)
}

/// A bar between two points, whose thickness is a twentieth of its length.
fn bar(from: Point, to: Point, mass: f64) -> Shape {
    let (length, d) = (distance(from, to), plus(to, -1.0, from));
    let (across, along) = (mass * length * length / 12.0, mass * length * length / 3200.0);
    let unit = d.map(|x| x / length);
    let entry = |i: usize, j: usize| {
        let one = if i == j { across } else { 0.0 };
        one - (across - along) * unit[i] * unit[j]
    };
    let inertia = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)];
    Shape::Solid(plus(from, 0.5, d), inertia)
}
