//! Setting the state of a simulation by the relative coordinates of a tree.

use super::failure::SimulationError;
use super::simulation::Simulation;
use super::tree::Tree;

impl Simulation {
    /// Sets the state of the simulation from coordinates and velocities of a tree of the same mechanism. The time does not change. Loops are
    /// closed by the smallest mass-weighted change of the coordinates. Energy and work are counted from zero again, signals start anew, and
    /// inputs keep their values. Returns the largest change of a coordinate [rad, m]. The tree is then in the same state as the simulation.
    ///
    /// Cost: as much as building the simulation.
    ///
    /// # Errors
    /// A wrong number of values, a value that is not finite, loops that cannot be closed, or accelerations that cannot be solved for. The
    /// simulation keeps its state then.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// use mbs::{JointId, Mechanism, Method};
    /// let m = Mechanism::read(path)?;
    /// let (mut sim, mut tree) = (m.simulate(&Method::default())?, m.tree()?);
    /// assert_eq!(sim.set_coordinates(&mut tree, &[0.5, 7.0], &[1.0, 2.0])?, 0.0);
    /// let elbow = JointId::new(1);
    /// assert!((sim.value(elbow) - 7.0).abs() < 1e-12 && (sim.rate(elbow) - 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_coordinates(
        &mut self,
        tree: &mut Tree,
        q: &[f64],
        v: &[f64],
    ) -> Result<f64, SimulationError> {
        // the tree and the simulation both start their signals anew
        tree.reset();
        tree.set_time(self.time());
        tree.set_inputs(self.input_values())?;
        tree.set(q, v)?;
        let moved = tree.make_consistent()?;
        let states = tree.joint_states();
        let placed = self.inner.place(&states, tree.motions());
        placed.map_err(|error| self.stopped(error))?;
        self.renew_inputs()?;
        Ok(moved)
    }
}
