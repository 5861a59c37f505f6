//! Steps along the velocities, and the difference of two positions of a [`Tree`].

use super::{Tree, TreeError, checked, sized};

impl Tree {
    /// Computes the position `to` = q ⊕ δ after a step δ along the velocities v [rad, m]. For angles and displacements ⊕ is the sum. For a
    /// quaternion δ is a rotation vector in body axes; the quaternion is rotated by it and remains a unit quaternion. With δ = h v, `to` is
    /// the position after time h at constant v.
    ///
    /// # Errors
    /// As for [`set`](Self::set); `to` is unchanged then.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/free-body.toml");
    /// let tree = mbs::Mechanism::read(path)?.tree()?;
    /// // half a turn about z, and a metre along x
    /// let mut q = [0.0; 7];
    /// tree.integrate(tree.coordinates(), &[1.0, 0.0, 0.0, 0.0, 0.0, std::f64::consts::PI], &mut q)?;
    /// assert!((q[6] - 1.0).abs() < 1e-15 && (q[0] - tree.coordinates()[0] - 1.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrate(&self, q: &[f64], step: &[f64], to: &mut [f64]) -> Result<(), TreeError> {
        checked("q", q, self.q.len())?;
        checked("step", step, self.v.len())?;
        sized("q", to, self.q.len())?;
        self.layout.normalise(q, to)?;
        self.layout.integrate(step, to);
        Ok(())
    }

    /// Computes the step δ along the velocities from one position to another: `to` = `from` ⊕ δ, with ⊕ as in
    /// [`integrate`](Self::integrate). Rotations take the shorter way of at most half a turn. Differences of angles include full turns.
    ///
    /// # Errors
    /// As for [`set`](Self::set); `step` is unchanged then.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let tree = mbs::Mechanism::read(path)?.tree()?;
    /// let mut step = [0.0; 2];
    /// tree.difference(&[0.5, 7.0], &[0.75, 8.0], &mut step)?;
    /// assert_eq!(step, [0.25, 1.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]) -> Result<(), TreeError> {
        checked("q", from, self.q.len())?;
        checked("q", to, self.q.len())?;
        sized("step", step, self.v.len())?;
        self.layout.rotations(from)?;
        self.layout.rotations(to)?;
        self.layout.difference(from, to, step);
        Ok(())
    }
}
