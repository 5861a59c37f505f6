//! Outputs that channels show.

use crate::motion::{Mechanism, State};
use crate::scene::{Coupled, Measure, Quantity};
use crate::vector::{Vector, add, cross, followed, rotation, sub};

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

    /// Names of those of a signal.
    pub const OF_SIGNALS: &[&str] = &["value", "rate"];
    /// Names of those of what rolls.
    pub const OF_ROLLINGS: &[&str] = &["force"];
    /// Names of those of a coupling.
    pub const OF_COUPLINGS: &[&str] = &["effort", "value", "length", "rate", "power"];

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
            Quantity::RelativeAngularVelocity(body, other) => {
                let [w, of_other] = [body, other].map(|b| places.of(Some(b)).w);
                sub(w, of_other)[if planar { 2 } else { 0 }..].to_vec()
            }
            Quantity::Energy => vec![self.evaluate(state).energy.iter().sum()],
            Quantity::AngularAcceleration(body) => {
                self.evaluate(state).accelerations[body][if planar { 5 } else { 3 }..].to_vec()
            }
            Quantity::Orientation(body) if planar => vec![state.frames[body].angle],
            Quantity::Orientation(body) => state.frames[body].q.to_vec(),
            Quantity::RotationVector(body) if planar => vec![state.frames[body].angle],
            Quantity::RotationVector(body) => followed(state.frames[body].q).to_vec(),
            Quantity::RotationMatrix(body) if planar => planar_matrix(state.frames[body].angle),
            Quantity::RotationMatrix(body) => rotation(state.frames[body].q).concat(),
            Quantity::KineticEnergy(body) => vec![self.kinetic_energy(body, state, &places)],
            Quantity::Signal(number, is_rate) => {
                let jet = self.now(state, &places).source(&self.scene.signals[number].source);
                vec![jet[usize::from(is_rate)]]
            }
            Quantity::Contact(number) => vector(self.evaluate(state).contacts[number]),
            Quantity::Coupling(number, what) => vec![self.coupled(state, number, what)],
            of_joint => self.of_joint(state, of_joint),
        }
    }

    /// Components of a quantity of a joint.
    fn of_joint(&self, state: &State, quantity: Quantity) -> Vec<f64> {
        let places = self.places(state);
        let coordinates = |joint: usize| self.now(state, &places).coordinates(joint);
        match quantity {
            Quantity::JointAcceleration(joint) => {
                let moved = self.evaluate(state).accelerations;
                let of = |(body, part): &(Option<usize>, [f64; 6])| {
                    let gain = |b: usize| part.iter().zip(&moved[b]).map(|(x, a)| x * a).sum();
                    body.map_or(0.0, gain)
                };
                let rows = coordinates(joint);
                rows.iter().map(|row| row.parts.iter().map(of).sum::<f64>() + row.bias).collect()
            }
            Quantity::Effort(joint) => {
                let n = coordinates(joint).len();
                self.evaluate(state).efforts[joint][..n].to_vec()
            }
            Quantity::Power(joint) => {
                let rates = self.show(state, Quantity::Rate(joint));
                let efforts = self.evaluate(state).efforts[joint];
                vec![rates.iter().zip(efforts).map(|(rate, effort)| rate * effort).sum()]
            }
            Quantity::Value(joint) => coordinates(joint).iter().map(|row| row.value).collect(),
            Quantity::Rate(joint) => {
                coordinates(joint).iter().map(|row| row.rate(&places)).collect()
            }
            Quantity::Reaction(joint) => {
                let r = self.evaluate(state).reactions[joint];
                if self.scene.planar { vec![r[0], r[1], r[5]] } else { r.to_vec() }
            }
            _ => Vec::new(),
        }
    }

    /// A number of a coupling.
    fn coupled(&self, state: &State, number: usize, what: Coupled) -> f64 {
        let places = self.places(state);
        let now = self.now(state, &places);
        let coupling = &self.scene.couplings[number];
        match what {
            Coupled::Value => now.sum(&coupling.terms).value,
            Coupled::Rate => now.sum(&coupling.terms).rate(&places),
            Coupled::Length => {
                let lines = coupling.terms.iter().map(|term| match &term.measure {
                    Measure::Length(points) => now.length(points).value,
                    _ => 0.0,
                });
                lines.sum()
            }
            Coupled::Effort => coupling.gain * self.evaluate(state).couplings[number],
            Coupled::Power => {
                let multiplier = self.evaluate(state).couplings[number];
                match coupling.passed {
                    Some((joint, coordinate, arm)) => {
                        let rate = now.coordinates(joint)[coordinate].rate(&places);
                        coupling.gain * multiplier * arm * rate
                    }
                    None => multiplier * now.coupling(coupling).given[0],
                }
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

/// The rotation matrix in the plane, row by row.
fn planar_matrix(angle: f64) -> Vec<f64> {
    let (sine, cosine) = angle.sin_cos();
    vec![cosine, -sine, sine, cosine]
}
