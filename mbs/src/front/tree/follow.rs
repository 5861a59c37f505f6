//! A tree at the state of a simulation.

use super::{Tree, TreeError};
use crate::front::View;

impl Tree {
    /// Takes time, coordinates and velocities of a simulation of the same mechanism, whatever its formulation. Angles are those
    /// within half a turn of the tree's own, so that turns are counted from call to call.
    ///
    /// # Errors
    /// [`TreeErrorKind::Length`](super::TreeErrorKind::Length) for a simulation of another number of bodies.
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
        at.into().seen().follow(self)
    }
}
