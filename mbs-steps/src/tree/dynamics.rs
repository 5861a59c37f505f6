//! Matrices, efforts and Jacobians of a [`Tree`].

use super::inner::{Inner, Typed, with};
use super::{Matrix, Tree, TreeError, TreeErrorKind, checked};
use crate::erased::values::PointMotion;
use mbs_core::algebra::Vector;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::BodyId;
use mbs_recursive::EffortTerms;

impl Tree {
    /// Mass matrix M of the open tree, n × n and symmetric. If no joint is guided, the kinetic energy is ½ vᵀ M v.
    ///
    /// Cost: proportional to the number of bodies times the depth of the tree, and n².
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// // rods of 1 m and 1 kg in a line
    /// assert!((tree.mass_matrix()[(0, 0)] - 8.0 / 3.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn mass_matrix(&mut self) -> &Matrix {
        self.mass.resize_rows(self.v.len());
        let mass = &mut self.mass.data;
        with!(&mut self.inner, t => {
            t.own.write_mass_matrix(&t.model, &t.state, &mut t.workspace, mass);
        });
        &self.mass
    }

    /// Constraint Jacobian J of the cut joints: one row for each equation, n columns.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/four-bar.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// let rows = tree.loop_jacobian();
    /// assert_eq!((rows.rows, rows.columns), (2, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn loop_jacobian(&mut self) -> &Matrix {
        let rows = &mut self.loops.data;
        with!(&mut self.inner, t => {
            t.own.write_loop_rows(&t.model, &t.state, &mut t.workspace, rows);
        });
        &self.loops
    }

    /// Returns g: the efforts that balance gravity at rest. Motors with these efforts compensate gravity.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// // two rods of 1 m and 1 kg, level
    /// assert!((tree.gravity_forces()[0] - 9.81 * (0.5 + 1.5)).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn gravity_forces(&mut self) -> &[f64] {
        self.efforts(EffortTerms::Gravity)
    }

    /// Returns c + g: the efforts that give zero accelerations v̇. They balance centrifugal and Coriolis forces, the motion of guided
    /// joints, and gravity.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// tree.set(&[0.0, 1.0], &[2.0, 0.0])?;
    /// let gravity = tree.gravity_forces().to_vec();
    /// assert!((tree.bias_forces()[1] - gravity[1] - 2.0 * 1.0_f64.sin()).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bias_forces(&mut self) -> &[f64] {
        self.place_accelerations(None);
        self.efforts(EffortTerms::WithoutEffects)
    }

    /// Accelerations v̇ under gravity and the efforts τ along v, with closed loops satisfied.
    ///
    /// # Errors
    /// [`TreeErrorKind::Length`], [`TreeErrorKind::NotFinite`]; [`TreeErrorKind::NoAccelerations`] at a singular position,
    /// [`TreeErrorKind::NoInertia`] if a joint moves no inertia.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// let hold = tree.gravity_forces().to_vec();
    /// assert!(tree.forward_dynamics(&hold)?.iter().all(|a| a.abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn forward_dynamics(&mut self, effort: &[f64]) -> Result<&[f64], TreeError> {
        checked("effort", effort, self.v.len())?;
        self.accelerate(Some(effort))?;
        let state = self.inner.state();
        let velocities = [&self.v[..], &state.v];
        self.layout.accelerations_outward(velocities, (&state.a, &mut self.answer));
        Ok(&self.answer)
    }

    /// Efforts τ that cause given accelerations v̇: τ = M v̇ + c + g.
    ///
    /// With closed loops the efforts are not unique. The efforts that are smallest in the norm of M⁻¹ are returned: τ = M (v̇ − v̇₀). Here
    /// v̇₀ are the accelerations that [`forward_dynamics`](Self::forward_dynamics) gives without efforts, so the efforts of a free motion
    /// are zero. Accelerations that violate the loop constraints are projected in the norm of M. Other solutions are τ + Jᵀ λ for any λ.
    /// For example, λ can be chosen such that only the motor of a four-bar linkage has an effort.
    ///
    /// # Errors
    /// As for [`forward_dynamics`](Self::forward_dynamics).
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// let falling = tree.forward_dynamics(&[0.0, 0.0])?.to_vec();
    /// assert!(tree.inverse_dynamics(&falling)?.iter().all(|effort| effort.abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse_dynamics(&mut self, accelerations: &[f64]) -> Result<&[f64], TreeError> {
        checked("accelerations", accelerations, self.v.len())?;
        if self.loops.rows == 0 {
            self.place_accelerations(Some(accelerations));
            return Ok(self.efforts(EffortTerms::WithoutEffects));
        }
        self.accelerate(None)?;
        let state = self.inner.state();
        let velocities = [&self.v[..], &state.v];
        self.layout.accelerations_inward(velocities, (accelerations, &mut self.tree));
        state.a.iter_mut().zip(&self.tree).for_each(|(a, x)| *a = x - *a);
        Ok(self.efforts(EffortTerms::Inertia))
    }

    /// Returns the Jacobian of the velocity of a point of a body: 3 × n, in global axes. `at` is the position of the point in the reference
    /// configuration [m]. In the plane the third row is zero.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// use mbs::core::scene::BodyId;
    /// let tip = tree.point_jacobian(BodyId::new(1), [2.0, 0.0, 0.0]);
    /// assert_eq!(tip.row(1), [2.0, 1.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn point_jacobian(&mut self, body: BodyId, at: [f64; 3]) -> &Matrix {
        self.jacobian(3, body, at)
    }

    /// Returns the Jacobian of a body's centre of mass: 6 × n, in global axes. Rows 0 to 2 belong to its velocity, rows 3 to 5 to the
    /// body's angular velocity.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// use mbs::core::scene::BodyId;
    /// let frame = tree.frame_jacobian(BodyId::new(1));
    /// assert_eq!((frame.row(1), frame.row(5)), (&[1.5, 0.5][..], &[1.0, 1.0][..]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn frame_jacobian(&mut self, body: BodyId) -> &Matrix {
        let center = body.index().map_or([0.0; 3], |b| self.shares[b].1);
        self.jacobian(6, body, center)
    }

    /// Returns the Jacobian of the velocity of the centre of mass of all bodies: 3 × n, in global axes.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// assert_eq!(tree.center_of_mass_jacobian().row(1), [1.0, 0.25]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn center_of_mass_jacobian(&mut self) -> &Matrix {
        self.jacobian.resize_rows(3);
        let (to, total) = (&mut self.jacobian.data, self.total);
        with!(&mut self.inner, t => {
            t.own.write_center_jacobian(&t.model, (&t.state, total), &mut t.workspace, to);
        });
        &self.jacobian
    }

    /// Motion of a point of a body. `at` is the position of the point in the reference configuration [m]. The acceleration is J̇ v, the
    /// part for v̇ = 0. The full acceleration is J̇ v plus the Jacobian times v̇.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// use mbs::core::scene::BodyId;
    /// tree.set(&[0.0, 0.0], &[1.0, 0.0])?;
    /// let tip = tree.point(BodyId::new(1), [2.0, 0.0, 0.0]);
    /// assert_eq!((tip.velocity, tip.acceleration), ([0.0, 2.0, 0.0], [-2.0, 0.0, 0.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn point(&mut self, body: BodyId, at: [f64; 3]) -> PointMotion {
        let at_rest = RigidMotion::at_rest(at.into());
        let motion = body.index().map_or(at_rest, |b| self.motions()[b]);
        PointMotion::of(motion.point(&at.into()))
    }

    /// Motion of the centre of mass of all bodies. Its acceleration is the part for v̇ = 0, as in [`point`](Self::point).
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// assert_eq!(tree.center_of_mass().position, [1.0, 0.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn center_of_mass(&mut self) -> PointMotion {
        self.motions();
        let motions = with!(&self.inner, tree => &tree.motions);
        let mut sum = [Vector::<f64, 3>::zeros(); 3];
        for (motion, &(_, center, share)) in motions.iter().zip(&self.shares) {
            let point = motion.point(&center.into());
            sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += x * share);
        }
        PointMotion::of(sum)
    }

    /// Computes the motions of the bodies for v̇ = 0.
    pub fn motions(&mut self) -> &[RigidMotion<f64>] {
        self.place_accelerations(None);
        with!(&mut self.inner, tree => {
            tree.model.write_motions(&tree.state, &mut tree.workspace, &mut tree.motions);
            &tree.motions
        })
    }

    /// Computes the Jacobian of a point of a body, with 3 or 6 rows.
    pub fn jacobian(&mut self, rows: usize, body: BodyId, at: [f64; 3]) -> &Matrix {
        self.jacobian.resize_rows(rows);
        let to = &mut self.jacobian.data;
        with!(&mut self.inner, t => {
            t.own.write_jacobian(&t.model, (&t.state, body, at), &mut t.workspace, to);
        });
        &self.jacobian
    }

    /// Sets the accelerations of the state to the given v̇; `None` stands for v̇ = 0.
    pub fn place_accelerations(&mut self, own: Option<&[f64]>) {
        let state = self.inner.state();
        let (own, velocities) = (own.unwrap_or(&self.zero), [&self.v[..], &state.v]);
        self.layout.accelerations_inward(velocities, (own, &mut state.a));
    }

    /// Computes the efforts that the accelerations of the state need.
    fn efforts(&mut self, terms: EffortTerms) -> &[f64] {
        let out = &mut self.tree;
        with!(&mut self.inner, t => t.model.write_efforts((&t.state, terms), &mut t.workspace, out));
        self.layout.efforts_outward(&self.tree, &mut self.answer);
        &self.answer
    }

    /// Computes the accelerations under given efforts, and stores them in the state.
    pub fn accelerate(&mut self, effort: Option<&[f64]>) -> Result<(), TreeError> {
        self.needs_inertia()?;
        self.layout.efforts_inward(effort.unwrap_or(&self.zero), &mut self.tree);
        let (efforts, names) = (&self.tree, &self.names);
        with!(&mut self.inner, tree => {
            let Typed { model, state, workspace, .. } = &mut **tree;
            model.accelerate_under(efforts, state, workspace).map_err(|error| {
                let reason = (Typed::reason(model, error), names);
                TreeError::of_model(TreeErrorKind::NoAccelerations, reason)
            })
        })
    }
}
