//! What channels show.

use crate::motion::{Mechanism, State};
use crate::scene::Quantity;
use crate::vector::{Vector, add, cross};

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
