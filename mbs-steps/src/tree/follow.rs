//! Copy of the state of a simulation into a tree.

use super::{Tree, TreeError};
use crate::erased::View;
use crate::erased::values::Coordinates;
use core::f64::consts::TAU;
use core::ops::Range;
use mbs_core::scene::JointId;

impl Tree {
    /// Copies time, coordinates, velocities, inputs and signals from a simulation of the same mechanism. The simulation may use any
    /// formulation. The number of full turns of joints is copied too.
    ///
    /// # Errors
    /// [`TreeErrorKind::Length`](super::TreeErrorKind::Length) if the simulation has another number of bodies.
    ///
    /// ```
    /// use mbs::{Mechanism, Method};
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let m = Mechanism::read(path)?;
    /// let (mut sim, mut tree) = (m.simulate(&Method::default())?, m.tree()?);
    /// sim.step(1e-3)?;
    /// tree.follow(&sim)?;
    /// assert!(tree.velocities()[0] < 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn follow<'a>(&mut self, at: impl Into<View<'a>>) -> Result<(), TreeError> {
        let at = at.into();
        at.seen().follow(self)?;
        self.count_turns(|joint| at.values(joint));
        Ok(())
    }

    /// Adds full turns to the tree's angles, so that they differ by at most half a turn from the values of the simulation.
    fn count_turns(&mut self, values: impl Fn(JointId) -> Coordinates) {
        for (joint, at) in self.layout.numbers() {
            for (q, value) in self.q[at].iter_mut().zip(values(joint).iter()) {
                // Displacements differ by rounding errors only, so this adds zero to them.
                *q += TAU * ((value - *q) / TAU).round();
            }
        }
        self.layout.coordinates_inward(&self.q, &mut self.inner.state().z);
    }

    /// Lists the joints whose coordinates are angles or displacements, each with its coordinates and rates.
    pub fn joint_states(&self) -> Vec<(JointId, Coordinates, Coordinates)> {
        let state = |(joint, at): (JointId, Range<usize>)| {
            let values = Coordinates::new(self.q[at].iter().copied());
            (joint, values, Coordinates::default())
        };
        self.layout.numbers().map(state).collect()
    }
}
