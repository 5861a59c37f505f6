//! Rows of guides: coordinates and rotation vectors that are prescribed over time.
//!
//! ```text
//! R = exp(f)     ω = f' + a f × f' + b f × (f × f')     a = (1 - cos θ)/θ²,  b = (θ - sin θ)/θ³,  θ = |f|
//! ```
//!
//! f is the prescribed rotation vector and ω the angular velocity of the second body against the first, in axes of the first.

use crate::loads::Now;
use crate::motion::Owner;
use crate::rows::Row;
use crate::scene::GuidedTurn;
use crate::vector::{
    Vector, add, compose, conjugate, cross, dot, exponential, logarithm, norm, scale,
};

/// Angle below which a and b are computed by series [rad]: the omitted terms are below 1e-16.
const SMALL: f64 = 1e-2;

impl Now<'_> {
    /// The rows of guides, each with its owner. The rotation vectors that guides prescribe are multiplied by `share`.
    pub(crate) fn guided(&self, share: f64) -> Vec<(Owner, Row)> {
        let mut rows = Vec::new();
        for guide in &self.scene.guides {
            let mut row = self.coordinates(guide.joint).swap_remove(guide.coordinate);
            let [value, rate, acceleration] = guide.law.at(self.t);
            row.value -= value;
            row.given = [rate, acceleration];
            rows.push((Owner::Guide(guide.joint, guide.coordinate), row));
        }
        for guide in &self.scene.guided_turns {
            rows.extend(self.guided_turn(guide, share));
        }
        rows
    }

    /// The rows of a prescribed rotation vector: rotations of the second body along axes of the first.
    fn guided_turn(&self, guide: &GuidedTurn, share: f64) -> [(Owner, Row); 3] {
        let bodies = self.scene.joints[guide.joint].bodies;
        let jets = guide.laws.each_ref().map(|law| law.at(self.t));
        let [f, f1, f2] = [0, 1, 2].map(|k| jets.map(|jet| jet[k]));
        let [q1, q2] = self.quaternions(bodies);
        let target = exponential(scale(-share, f));
        let off = logarithm(compose(compose(conjugate(q1), q2), target));
        let [w, w_rate] = turning(f, f1, f2);
        [0, 1, 2].map(|i| {
            let mut e = [0.0; 3];
            e[i] = 1.0;
            let along = self.places.direction(bodies[0], e);
            let mut row = self.places.about(bodies, along, bodies[0]).with_value(off[i]);
            row.given = [w[i], w_rate[i]];
            (Owner::Turn(guide.joint, along), row)
        })
    }
}

/// Angular velocity and angular acceleration of a rotation, from its rotation vector f with the first and the second derivative.
fn turning(f: Vector, f1: Vector, f2: Vector) -> [Vector; 2] {
    let t = norm(f);
    let s = t * t;
    // a, b and their derivatives divided by θ
    let (a, b, a1, b1) = if t < SMALL {
        let a = 0.5 - s / 24.0 + s * s / 720.0;
        let b = 1.0 / 6.0 - s / 120.0 + s * s / 5040.0;
        (a, b, -1.0 / 12.0 + s / 180.0 - s * s / 6720.0, -1.0 / 60.0 + s / 1260.0)
    } else {
        let (a, b) = ((1.0 - t.cos()) / s, (t - t.sin()) / (s * t));
        (a, b, (t.sin() / t - 2.0 * a) / s, (a - 3.0 * b) / s)
    };
    let grows = dot(f, f1);
    let once = cross(f, f1);
    let twice = cross(f, once);
    let sum = |x: Vector, y: f64, v: Vector| add(x, scale(y, v));
    let w = sum(sum(f1, a, once), b, twice);
    let bent = sum(sum(f2, a1 * grows, once), b1 * grows, twice);
    let turned = cross(f, f2);
    let inner = add(cross(f1, once), cross(f, turned));
    [w, sum(sum(bent, a, turned), b, inner)]
}
