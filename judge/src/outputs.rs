//! Values of output channels.

use crate::motion::{Mechanism, State};
use crate::scene::{Coupled, Measure, Output, Quantity};
use crate::vector::{add, cross, followed, rotation, sub, transposed_times};

impl Mechanism {
    /// Components of a channel.
    #[must_use]
    pub fn channel(&self, state: &State, output: &Output) -> Vec<f64> {
        let unit = if output.degrees { 1.0_f64.to_degrees() } else { 1.0 };
        self.show(state, output.quantity).into_iter().map(|x| unit * x).collect()
    }

    /// Components of a quantity.
    #[must_use]
    pub fn show(&self, state: &State, quantity: Quantity) -> Vec<f64> {
        let places = self.places(state);
        let planar = self.scene.planar;
        match quantity {
            Quantity::Position(body, at) => self.components(places.seat(Some(body), at).p),
            Quantity::Velocity(body, at) => self.components(places.seat(Some(body), at).v),
            Quantity::Acceleration(body, at) => {
                let seat = places.seat(Some(body), at);
                let a = self.evaluate(state).accelerations[body];
                let turning = add(cross([a[3], a[4], a[5]], seat.arm), seat.bias);
                self.components(add([a[0], a[1], a[2]], turning))
            }
            Quantity::ProperAcceleration(body, at) => {
                let moved = self.show(state, Quantity::Acceleration(body, at)).into_iter();
                moved.zip(self.scene.gravity).map(|(a, g)| a - g).collect()
            }
            Quantity::AngularVelocity(body) => self.turning(places.of(Some(body)).w),
            Quantity::RelativeAngularVelocity(body, other, is_global) => {
                let [w, of_other] = [Some(body), other].map(|b| *places.of(b));
                let w = sub(w.w, of_other.w);
                self.turning(if is_global { w } else { transposed_times(&of_other.turn, w) })
            }
            Quantity::Seen(point, what) => self.seen(state, &point, what),
            Quantity::Leaning(leaning) => vec![self.leaning(state, &leaning)],
            Quantity::Effect(number, what) => self.exerted(state, number, what),
            Quantity::Whole(what) => self.whole(state, what),
            Quantity::AngularAcceleration(body) => {
                let [.., x, y, z] = self.evaluate(state).accelerations[body];
                self.turning([x, y, z])
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
            Quantity::Contact(number) => self.components(self.evaluate(state).contacts[number]),
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
                coordinates(joint).iter().map(|row| self.accelerated(state, row)).collect()
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

    /// Value of a quantity of a coupling.
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

    /// Kinetic and potential energy, less the work of forces without potential: constant along the motion [J].
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
