//! Jacobians of named frames of a [`Tree`], their time derivatives, and the operational-space inertia of a frame.

use super::inner::{Inner, with};
use super::{Matrix, Tree, TreeError, TreeErrorKind};
use crate::erased::error::UnknownName;
use mbs_core::algebra::Matrix as Square;
use mbs_core::scene::{BodyId, Dimension};
use mbs_recursive::own::MovingColumns;

/// Smallest pivot of a mobility matrix with unit diagonal, in units of machine precision [-]. A smaller pivot means that a direction of
/// motion is locked. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

impl Tree {
    /// Returns the body that carries a `[[frame]]` of the scene, and the origin of the frame in the reference configuration [m]. If there
    /// is no such frame, but a body has the name, it returns this body and its centre of mass. The functions for points and Jacobians take
    /// both values as arguments.
    ///
    /// # Errors
    /// [`UnknownName`], which suggests the most similar name.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let tree = mbs::Mechanism::read(path)?.tree()?;
    /// assert_eq!(tree.frame_place("lower")?, (mbs::BodyId::new(1), [1.5, 0.0, 0.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn frame_place(&self, name: &str) -> Result<(BodyId, [f64; 3]), UnknownName> {
        self.named(name).map(|frame| (frame.body, frame.at))
    }

    /// Returns the Jacobian of a point fixed to a body: 6 × n, in global axes. `at` is the position of the point in the reference
    /// configuration [m]. Rows 0 to 2 belong to the point's velocity, rows 3 to 5 to the body's angular velocity.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// let (body, at) = tree.frame_place("lower")?;
    /// let frame = tree.jacobian_at(body, at);
    /// assert_eq!((frame.row(1), frame.row(5)), (&[1.5, 0.5][..], &[1.0, 1.0][..]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn jacobian_at(&mut self, body: BodyId, at: [f64; 3]) -> &Matrix {
        self.jacobian(6, body, at)
    }

    /// Returns J̇, the time derivative of [`jacobian_at`](Self::jacobian_at) at the current velocities. J̇ v is the acceleration of the
    /// point and the body for v̇ = 0.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.0, 0.0], &[1.0, 0.0])?;
    /// let rate = tree.jacobian_rate_at(mbs::BodyId::new(1), [2.0, 0.0, 0.0]);
    /// // the tip moves on a circle of 2 m
    /// assert_eq!(rate.row(0), [-2.0, -1.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn jacobian_rate_at(&mut self, body: BodyId, at: [f64; 3]) -> &Matrix {
        self.place_accelerations(None);
        self.jacobian.resize_rows(6);
        let to = &mut self.jacobian.data;
        with!(&mut self.inner, t => {
            let moving = t.moving.get_or_insert_with(|| MovingColumns::new(&t.model));
            let scratch = (&mut t.workspace, moving);
            t.own.write_jacobian_rate(&t.model, (&t.state, body, at), scratch, to);
        });
        &self.jacobian
    }

    /// Mobility J M⁻¹ Jᵀ of a point that is fixed to a body, without motor efforts. The mobility gives the accelerations caused by a force
    /// at the point and a moment on the body. The matrix is 6 × 6 and symmetric. Order and axes are those of
    /// [`jacobian_at`](Self::jacobian_at). The matrix is zero in directions in which the joints cannot move the point.
    ///
    /// # Errors
    /// [`TreeErrorKind::Loops`] with the joint that closes a loop; [`TreeErrorKind::NoAccelerations`] if a joint moves no inertia.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/simple-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// let (body, at) = tree.frame_place("bob")?;
    /// let mobility = tree.mobility_at(body, at)?.clone();
    /// // one joint: a moment about its axis meets its inertia
    /// let mass = tree.mass_matrix()[(0, 0)];
    /// assert!((mobility[(5, 5)] - 1.0 / mass).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn mobility_at(&mut self, body: BodyId, at: [f64; 3]) -> Result<&Matrix, TreeError> {
        self.open("mobilities")?;
        self.mass_matrix();
        self.factor()?;
        self.jacobian(6, body, at);
        self.columns.resize(self.jacobian.data.len(), 0.0);
        let (rows, columns) = (&self.jacobian.data, &mut self.columns);
        let to = &mut self.frame.data;
        with!(&mut self.inner, t => t.own.write_mobility(&self.mass.data, 6, (rows, columns), to));
        Ok(&self.frame)
    }

    /// Operational-space inertia Λ = (J M⁻¹ Jᵀ)⁻¹ of a point that is fixed to a body. It gives the force and the moment that cause given
    /// accelerations. The matrix is 6 × 6 and symmetric. Order and axes are those of [`jacobian_at`](Self::jacobian_at). In the plane only
    /// rows and columns 0, 1 and 5 are not zero.
    ///
    /// # Errors
    /// [`TreeErrorKind::Held`] if the joints cannot move the point in every direction, because there are fewer than six joints or the
    /// position is singular. Further errors are those of [`mobility_at`](Self::mobility_at).
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/free-body.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// // of a body that nothing holds its own mass at its centre
    /// let (body, at) = tree.frame_place("body")?;
    /// let inertia = tree.operational_space_inertia_at(body, at)?.clone();
    /// assert!((inertia[(0, 0)] - tree.mass_matrix()[(0, 0)]).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn operational_space_inertia_at(
        &mut self,
        body: BodyId,
        at: [f64; 3],
    ) -> Result<&Matrix, TreeError> {
        let moves: &[usize] = match self.scene.dimension {
            Dimension::Planar => &[0, 1, 5],
            Dimension::Spatial => &[0, 1, 2, 3, 4, 5],
        };
        self.mobility_at(body, at)?;
        let inertia = inverse(&self.frame, moves).ok_or(TreeErrorKind::Held)?;
        // The matrix is symmetric, so its columns are its rows.
        self.frame.data.copy_from_slice(inertia.as_slice());
        Ok(&self.frame)
    }
}

/// Inverse of a mobility in the directions `moves`; `None` if a direction is locked. The matrix is scaled such that lengths and angles have
/// equal weight.
fn inverse(mobility: &Matrix, moves: &[usize]) -> Option<Square<f64, 6>> {
    let mut scale = [0.0; 6];
    for &i in moves {
        scale[i] = 1.0 / mobility[(i, i)].sqrt();
    }
    if !scale.iter().all(|x| x.is_finite()) {
        return None;
    }
    // All other directions get a unit diagonal, so that they are not coupled to the directions `moves`.
    let scaled = Square::<f64, 6>::from_fn(|i, j| match (scale[i] * scale[j], i == j) {
        (0.0, true) => 1.0,
        (scale, _) => mobility[(i, j)] * scale,
    });
    let factors = scaled.cholesky()?;
    let least = ROUNDINGS * f64::EPSILON;
    if !(0..6).all(|i| factors.l_dirty()[(i, i)].powi(2) > least) {
        return None;
    }
    let inverse = factors.inverse();
    Some(Square::<f64, 6>::from_fn(|i, j| inverse[(i, j)] * scale[i] * scale[j]))
}
