//! Mechanism in relative coordinates, at any position and velocity: [`Tree`].

mod derivatives;
mod driven;
mod dynamics;
mod error;
mod fictitious;
mod follow;
mod frames;
mod inner;
mod inverse_kinematics;
mod layout;
mod manifold;
mod places;
mod rollout;
mod values;

pub use error::{TreeError, TreeErrorKind};
pub use fictitious::with_mass;
pub use inverse_kinematics::{FrameTarget, InverseKinematics, InverseKinematicsEnd};
pub use layout::TreeRange;
pub use places::{FrameMotion, TotalMomentum};
pub use rollout::{Rollout, RolloutEnd};
pub use values::{AccelerationDerivatives, EffortDerivatives, Matrix};

use crate::erased::inputs::{InputInfo, Inputs};
use crate::names::Names;
use crate::typed;
use inner::{Inner, with};
use layout::Layout;
use mbs_core::cluster::mass_properties;
use mbs_core::model::State;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, JointId, Scene};
use std::collections::HashSet;

/// Body, a point of it in the reference configuration [m], and the fraction of the total mass that the body has [-].
type Weighted = (BodyId, [f64; 3], f64);

/// Mechanism in relative coordinates, at any position and velocity.
///
/// ```text
/// M v̇ + c + g = τ + Jᵀ λ,   J v̇ + J̇ v = 0
/// ```
///
/// M is [`mass_matrix`](Self::mass_matrix), g is [`gravity_forces`](Self::gravity_forces), c + g is [`bias_forces`](Self::bias_forces). τ
/// are the efforts along the joints, λ the multipliers of closed loops, and J is [`loop_jacobian`](Self::loop_jacobian). The equation has
/// bodies, joints and gravity only. Springs, motors, friction and all other effects are not in it; their forces can be added to τ.
/// [`accelerations`](Self::accelerations) and [`rollout`](Self::rollout) include all effects.
///
/// **Coordinates.** Every joint has coordinates in q and v, unless it closes a loop or is guided. Their order is that of the scene, and
/// [`coordinates_of`](Self::coordinates_of) returns their index ranges. Bodies without a joint come last. Each of them has a free joint at
/// its centre of mass. All coordinates are measured from the reference configuration, as motion of the second body relative to the first.
///
/// | joint | q | v |
/// |---|---|---|
/// | all others | the joint's angles and displacements, as in its outputs | their rates |
/// | ball | unit quaternion (w, x, y, z) of the second body relative to the first | angular velocity, in axes of the second body |
/// | free, plane | x, y of the second body's point relative to the first body's point, in axes of the first body; angle | their rates |
/// | free, space | x, y, z as in the plane; quaternion as for a ball | rates of x, y, z; angular velocity, in axes of the second body |
///
/// A unit quaternion is (cos(φ/2), n sin(φ/2)) for a rotation by φ about the unit vector n; q and −q are the same rotation. Its time
/// derivative is ½ q (0, ω). Efforts are conjugate to v: τ·v is their power. A thin rod in space that has only ball joints has no spin
/// about its axis, and a small inertia about it.
///
/// **Time.** Only guided joints depend on time. They have the position and velocity of their guide at the time given by
/// [`set_time`](Self::set_time), which is initially zero.
///
/// Results are stored in buffers of the tree until the next call. After the first calls no function allocates memory. Exceptions are
/// [`follow`](Self::follow), and [`coordinates_of`](Self::coordinates_of) if it returns an error.
#[derive(Debug, Clone)]
pub struct Tree {
    inner: Inner,
    layout: Layout,
    /// Reason why efforts determine no accelerations at any position; `None` if they determine accelerations.
    lack: Option<TreeError>,
    /// Tree with fictitious masses by which loops are closed; `None` if the scene has enough inertia.
    closing: Option<Inner>,
    /// Centre of mass of each body, with its fraction of the total mass.
    shares: Vec<Weighted>,
    /// True for each body for which the scene has a frame with the body's name.
    has_frame: Vec<bool>,
    /// Mass of all bodies [kg].
    total: f64,
    scene: Scene<f64>,
    names: Names,
    q: Vec<f64>,
    v: Vec<f64>,
    answer: Vec<f64>,
    /// Vector in the coordinates of the links, for intermediate results.
    tree: Vec<f64>,
    /// Velocities that are all zero.
    zero: Vec<f64>,
    mass: Matrix,
    loops: Matrix,
    jacobian: Matrix,
    /// Mobility or inertia of a frame, 6 × 6.
    frame: Matrix,
    /// Columns of a Jacobian, for intermediate results.
    columns: Vec<f64>,
    by_effort: AccelerationDerivatives,
    of_effort: EffortDerivatives,
    input_list: Vec<InputInfo>,
    /// Indices of the inputs in a state.
    input_places: Vec<usize>,
}

impl Tree {
    /// Creates the tree of a checked scene, at rest in the reference configuration.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoTree`] if the scene has no model in relative coordinates.
    #[doc(hidden)]
    pub fn new(scene: &Scene<f64>) -> Result<Self, TreeError> {
        let names = Names::new(scene);
        let made = Inner::new(scene);
        let (mut inner, mut layout, lack) =
            made.map_err(|e| TreeError::of_model(TreeErrorKind::NoTree, (e, &names)))?;
        let lack = lack.map(|lack| TreeError::of_model(TreeErrorKind::NoInertia, (lack, &names)));
        let rows = with!(&inner, tree => tree.model.n_rows());
        let [n_q, n] = layout.n;
        let (mut q, zero) = (vec![0.0; n_q], vec![0.0; n]);
        layout.coordinates_outward(&inner.state().z, &mut q);
        let total: f64 = scene.bodies.iter().map(|body| body.mass).sum();
        let share = |b| {
            let (mass, center, _) = mass_properties(scene, b);
            (BodyId::new(b), center.into(), if total > 0.0 { mass / total } else { 0.0 })
        };
        // The first call that needs a square matrix allocates its rows, so it has no rows here.
        let square = || Matrix::zeros(0, n);
        let inputs = Inputs::new(scene);
        let prescribed = with!(&inner, tree => tree.model.prescribed());
        let needs_masses = lack.is_some() && rows > 0;
        Ok(Self {
            closing: if needs_masses { fictitious::tree(scene, &inner) } else { None },
            lack,
            input_places: inputs.places(prescribed),
            input_list: inputs.list().to_vec(),
            shares: (0..scene.bodies.len()).map(share).collect(),
            has_frame: has_frame(scene),
            total,
            scene: scene.clone(),
            v: zero.clone(),
            answer: zero.clone(),
            tree: zero.clone(),
            zero,
            mass: square(),
            loops: Matrix::zeros(rows, n),
            jacobian: Matrix::zeros(6, n),
            frame: Matrix::zeros(6, 6),
            columns: Vec::new(),
            by_effort: AccelerationDerivatives { q: square(), v: square(), effort: square() },
            of_effort: EffortDerivatives { q: square(), v: square(), acceleration: square() },
            inner,
            layout,
            names,
            q,
        })
    }

    /// Sets coordinates and velocities. Quaternions are normalised. Loops are not closed, so results hold for the given position even if
    /// its loops are open.
    ///
    /// # Errors
    /// [`TreeError`] for a wrong number of values, or a value that is not finite; the tree is unchanged then.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// use mbs::Error;
    /// tree.set(&[0.4, -1.1], &[1.3, -0.7])?;
    /// assert_eq!(tree.coordinates(), [0.4, -1.1]);
    /// assert_eq!(tree.set(&[0.4], &[1.3]).unwrap_err().code(), "wrong-length");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set(&mut self, q: &[f64], v: &[f64]) -> Result<(), TreeError> {
        checked("q", q, self.q.len())?;
        checked("v", v, self.v.len())?;
        self.layout.normalise(q, &mut self.q)?;
        self.v.copy_from_slice(v);
        let state = self.inner.state();
        self.layout.coordinates_inward(&self.q, &mut state.z);
        self.layout.velocities_inward(&self.v, &mut state.v);
        Ok(())
    }

    /// Returns the reason why efforts determine no accelerations at any position, for example a joint that moves no inertia. `None`:
    /// accelerations can be computed. Positions, velocities, Jacobians, inverse kinematics and inverse dynamics work without inertia.
    ///
    /// ```
    /// use mbs::{Body, Error, GROUND, Joint, Mechanism};
    /// let mut m = Mechanism::planar("arm");
    /// let arm = m.add(Body::planar([1.0, 0.0], 0.0, 0.0));
    /// m.add(Joint::revolute([GROUND, arm], [0.0, 0.0]));
    /// let mut tree = m.tree()?;
    /// assert_eq!(tree.inertia_fault().map(|fault| fault.code()), Some("no-inertia"));
    /// assert_eq!(tree.point_jacobian(arm, [2.0, 0.0, 0.0]).row(1), [2.0]);
    /// # Ok::<(), mbs::SimulationError>(())
    /// ```
    #[must_use]
    pub fn inertia_fault(&self) -> Option<&TreeError> {
        self.lack.as_ref()
    }

    /// Returns an error if accelerations cannot be computed because inertia is missing.
    fn needs_inertia(&self) -> Result<(), TreeError> {
        self.lack.clone().map_or(Ok(()), Err)
    }

    /// Sets the time [s] that determines the positions of guided joints.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/guided-four-bar.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// // its crank is guided
    /// let before = tree.gravity_forces().to_vec();
    /// tree.set_time(0.25);
    /// assert_ne!(tree.gravity_forces(), before);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_time(&mut self, t: f64) {
        self.inner.state().t = t;
    }

    /// Copies time, coordinates and velocities of a simulation with known scalar and dimension.
    ///
    /// # Errors
    /// As for [`follow`](Self::follow).
    pub fn follow_typed<const D: usize>(
        &mut self,
        simulation: &typed::Simulation<f64, D>,
    ) -> Result<(), TreeError> {
        let (model, state) = (simulation.model(), simulation.state());
        let motions: Vec<_> =
            (0..self.scene.bodies.len()).map(|b| model.motion(&self.scene, b, state)).collect();
        let State { t, applied, signals, .. } = state;
        self.follow_motions((*t, applied, signals), &motions)
    }

    /// Sets the state from the motions of the scene's bodies at time `t` [s], with the given inputs and signals.
    pub fn follow_motions(
        &mut self,
        (t, inputs, signals): (f64, &[f64], &[[f64; 2]]),
        motions: &[RigidMotion<f64>],
    ) -> Result<(), TreeError> {
        let state = self.inner.state();
        let sizes = [
            ("motions", self.scene.bodies.len(), motions.len()),
            ("inputs", state.applied.len(), inputs.len()),
            ("signals", state.signals.len(), signals.len()),
        ];
        if let Some((what, expected, found)) = sizes.into_iter().find(|size| size.1 != size.2) {
            return Err(TreeErrorKind::Length(what, expected, found).into());
        }
        with!(&mut self.inner, tree => {
            tree.state.applied.copy_from_slice(inputs);
            tree.state.inputs.copy_from_slice(inputs);
            tree.state.signals.copy_from_slice(signals);
            tree.state.t = t;
            tree.model.read_motions(&self.scene, motions, &mut tree.state);
        });
        let state = self.inner.state();
        self.layout.coordinates_outward(&state.z, &mut self.q);
        self.layout.velocities_outward(&state.v, &mut self.v);
        Ok(())
    }

    /// Returns the index ranges of a joint's coordinates in q and v. They are empty for a weld, and for a ball joint that attaches a point
    /// mass to a body.
    ///
    /// # Errors
    /// [`TreeErrorKind::Cut`], [`TreeErrorKind::Guided`] or [`TreeErrorKind::Idle`] with the joint's name.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/four-bar.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// use mbs::{Error, JointId};
    /// assert_eq!(tree.coordinates_of(JointId::new(0))?.v, 0..1);
    /// let cut = tree.coordinates_of(JointId::new(3)).unwrap_err();
    /// assert_eq!((cut.code(), cut.joint()), ("cut-joint", Some("end-0")));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn coordinates_of(&self, joint: JointId) -> Result<TreeRange, TreeError> {
        if let Some(range) = self.layout.range(joint.index()) {
            return Ok(range);
        }
        let data = &self.scene.joints[joint];
        let mut cuts =
            with!(&self.inner, tree => tree.model.cut_joints().collect::<Vec<_>>()).into_iter();
        let kind = if self.scene.guides.iter().any(|guide| guide.joint == joint) {
            TreeErrorKind::Guided
        } else if cuts.any(|cut| cut == joint.index()) {
            TreeErrorKind::Cut
        } else if data.kind.is_rigid() || self.scene.turns_point(data) {
            return Ok(TreeRange { q: 0..0, v: 0..0 });
        } else {
            TreeErrorKind::Idle
        };
        Err(TreeError::of_joint(kind, &data.name))
    }

    /// Returns the index ranges of the coordinates of a free body, with or without a free joint in the scene. If several bodies are welded
    /// together, the first one in the scene has the coordinates.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/free-body.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// use mbs::core::scene::BodyId;
    /// let at = tree.free_coordinates_of(BodyId::new(0)).expect("nothing holds it");
    /// assert_eq!((at.q, at.v), (0..7, 0..6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn free_coordinates_of(&self, body: BodyId) -> Option<TreeRange> {
        let BodyId::Body(body) = body else { return None };
        self.layout.range_of_free(body)
    }

    /// Returns q, the coordinates.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// assert_eq!(tree.coordinates(), [0.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn coordinates(&self) -> &[f64] {
        &self.q
    }

    /// Returns v, the velocities.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// # let file = mbs::scene_file::SceneFile::parse(&std::fs::read_to_string(path)?, path).unwrap();
    /// # let mut tree = mbs::Tree::new(&file.scene().unwrap())?;
    /// assert_eq!(tree.velocities(), [0.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn velocities(&self) -> &[f64] {
        &self.v
    }
}

/// Returns for each body whether the scene has a frame with its name.
fn has_frame(scene: &Scene<f64>) -> Vec<bool> {
    let frames: HashSet<&str> = scene.frames.iter().map(|frame| frame.name.as_str()).collect();
    scene.bodies.iter().map(|body| frames.contains(body.name.as_str())).collect()
}

/// Checks that an argument has the expected number of values.
fn sized(what: &'static str, x: &[f64], expected: usize) -> Result<(), TreeError> {
    match x.len() {
        n if n == expected => Ok(()),
        n => Err(TreeErrorKind::Length(what, expected, n).into()),
    }
}

/// # Errors
/// [`TreeErrorKind::Length`] or [`TreeErrorKind::NotFinite`].
fn checked(what: &'static str, x: &[f64], expected: usize) -> Result<(), TreeError> {
    sized(what, x, expected)?;
    // All values are first checked in one loop, because the compiler can vectorise this loop.
    if x.iter().fold(true, |all, x| all & x.is_finite()) {
        return Ok(());
    }
    let bad = x.iter().position(|x| !x.is_finite());
    bad.map_or(Ok(()), |place| Err(TreeErrorKind::NotFinite(what, place).into()))
}
