//! Stops whose stiffness or damping follows from the mass that their coordinate moves.
//!
//! ```text
//! k = m/τ²,   c = 2 m/τ        m: twice the kinetic energy of the reference configuration where the coordinate has the rate 1
//! ```

use crate::motion::Mechanism;
use crate::scene::{Effect, Term};

/// Time τ in which a stop brings a motion to rest [s]: given by the contract.
const STOPPING_TIME: f64 = 0.02;

impl Mechanism {
    /// Computes stiffness and damping of the limits that leave them open.
    pub(crate) fn fill_limits(&mut self) {
        for (number, [open_stiffness, open_damping]) in self.scene.open_limits.clone() {
            let Effect::Limit(sum, _) = &self.scene.effects[number] else { continue };
            let mass = self.moved_mass(sum);
            let Effect::Limit(_, [.., k, c]) = &mut self.scene.effects[number] else { continue };
            if open_stiffness {
                *k = mass / (STOPPING_TIME * STOPPING_TIME);
            }
            if open_damping {
                *c = 2.0 * mass / STOPPING_TIME;
            }
        }
    }

    /// The mass that a sum moves while guides are fixed and all other coordinates are free. It is λ of M a = g λ + Jᵀ μ with g a = 1, where
    /// g is the gradient of the sum. M, J and a are masses, gradients of the rows and accelerations; μ are multipliers.
    fn moved_mass(&self, sum: &[Term]) -> f64 {
        let state = self.reference();
        let places = self.places(&state);
        let now = self.now(&state, &places);
        let mut rows: Vec<_> = self.rows(&now).into_iter().map(|(_, row)| row).collect();
        rows.push(now.sum(sum));
        let saddle = self.saddle(&places, &rows, &self.rotors(&now));
        let mut right = vec![0.0; rows.len()];
        right[rows.len() - 1] = 1.0;
        let (_, multipliers, _) = self.solve(&saddle, &vec![[0.0; 6]; state.frames.len()], &right);
        multipliers.last().copied().unwrap_or(0.0)
    }
}
