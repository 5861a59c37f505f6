//! What channels show.

use crate::motion::{Mechanism, State};
use crate::scene::Quantity;
use crate::vector::{Quaternion, Vector, add, cross, norm, rotation};

impl Quantity {
    /// Names of those of a body's point.
    pub const OF_POINTS: &[&str] = &["position", "velocity", "acceleration", "proper-acceleration"];
    /// Names of those of a body.
    pub const OF_BODIES: &[&str] = &[
        "angular-velocity",
        "angular-acceleration",
        "orientation",
        "rotation-vector",
        "rotation-matrix",
        "kinetic-energy",
    ];
    /// Names of those of a joint.
    pub const OF_JOINTS: &[&str] =
        &["value", "rate", "acceleration", "effort", "power", "reaction"];

    /// That of a body, or of its point.
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

    /// That of a joint.
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

impl Mechanism {
    /// Components of a quantity.
    #[must_use]
    pub fn show(&self, state: &State, quantity: Quantity) -> Vec<f64> {
        let places = self.places(state);
        let planar = self.scene.planar;
        let vector = |v: Vector| v[..if planar { 2 } else { 3 }].to_vec();
        match quantity {
            Quantity::Position(body, at) => vector(places.seat(Some(body), at).p),
            Quantity::Velocity(body, at) => vector(places.seat(Some(body), at).v),
            Quantity::Acceleration(body, at) => {
                let seat = places.seat(Some(body), at);
                let a = self.evaluate(state).accelerations[body];
                let turning = add(cross([a[3], a[4], a[5]], seat.arm), seat.bias);
                vector(add([a[0], a[1], a[2]], turning))
            }
            Quantity::ProperAcceleration(body, at) => {
                let moved = self.show(state, Quantity::Acceleration(body, at)).into_iter();
                moved.zip(self.scene.gravity).map(|(a, g)| a - g).collect()
            }
            Quantity::AngularVelocity(body) => {
                places.of(Some(body)).w[if planar { 2 } else { 0 }..].to_vec()
            }
            Quantity::AngularAcceleration(body) => {
                self.evaluate(state).accelerations[body][if planar { 5 } else { 3 }..].to_vec()
            }
            Quantity::Orientation(body) if planar => vec![state.frames[body].angle],
            Quantity::Orientation(body) => state.frames[body].q.to_vec(),
            Quantity::RotationVector(body) if planar => vec![state.frames[body].angle],
            Quantity::RotationVector(body) => rotation_vector(state.frames[body].q).to_vec(),
            Quantity::RotationMatrix(body) if planar => planar_matrix(state.frames[body].angle),
            Quantity::RotationMatrix(body) => rotation(state.frames[body].q).concat(),
            Quantity::KineticEnergy(body) => vec![self.kinetic_energy(body, state, &places)],
            Quantity::JointAcceleration(joint) => {
                let moved = self.evaluate(state).accelerations;
                let of = |(body, part): &(Option<usize>, [f64; 6])| {
                    let gain = |b: usize| part.iter().zip(&moved[b]).map(|(x, a)| x * a).sum();
                    body.map_or(0.0, gain)
                };
                let rows = self.now(state, &places).coordinates(joint);
                rows.iter().map(|row| row.parts.iter().map(of).sum::<f64>() + row.bias).collect()
            }
            Quantity::Effort(joint) => {
                let n = self.now(state, &places).coordinates(joint).len();
                vec![self.evaluate(state).efforts[joint]; n]
            }
            Quantity::Power(joint) => {
                let rates = self.show(state, Quantity::Rate(joint));
                vec![self.evaluate(state).efforts[joint] * rates.iter().sum::<f64>()]
            }
            Quantity::Value(joint) => {
                self.now(state, &places).coordinates(joint).iter().map(|row| row.value).collect()
            }
            Quantity::Rate(joint) => self
                .now(state, &places)
                .coordinates(joint)
                .iter()
                .map(|row| row.rate(&places))
                .collect(),
            Quantity::Reaction(joint) => {
                let r = self.evaluate(state).reactions[joint];
                if planar { vec![r[0], r[1], r[5]] } else { r.to_vec() }
            }
        }
    }

    /// Kinetic and stored energy, less the work of what is not stored: constant [J].
    #[must_use]
    pub fn invariant(&self, state: &State) -> f64 {
        let [kinetic, stored] = self.evaluate(state).energy;
        kinetic + stored - state.work
    }
}

/// The rotation vector of a quaternion that has followed a turn, below a whole one.
fn rotation_vector([w, v @ ..]: Quaternion) -> Vector {
    let sine = norm(v);
    // at no turn 2 v
    let share = if sine > 0.0 { 2.0 * sine.atan2(w) / sine } else { 2.0 };
    v.map(|x| share * x)
}

/// The rotation matrix in the plane, row by row.
fn planar_matrix(angle: f64) -> Vec<f64> {
    let (sine, cosine) = angle.sin_cos();
    vec![cosine, -sine, sine, cosine]
}
