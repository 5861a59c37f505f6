//! A simulation put into a state of relative coordinates.

use super::failure::SimulationError;
use super::simulation::Simulation;
use super::tree::Tree;

impl Simulation {
    /// Puts the mechanism into a state of its coordinates and velocities in a tree of the same mechanism, at the present time. Loops are
    /// closed by the moves that are smallest in the masses' norm. Energies and work are counted anew, signals begin anew, and inputs keep
    /// their values. Returns the largest change of a coordinate [rad, m]; the tree is where the simulation is.
    ///
    /// Cost: that of building the simulation.
    ///
    /// # Errors
    /// A wrong number of numbers, one that is not finite, loops that do not close, or no accelerations there. The simulation is then as it
    /// was.
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
        // signals begin anew in both
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
