//! [`Tree`]: a mechanism in relative coordinates, at any position and velocity.

mod error;
mod inner;
mod layout;
mod values;

pub use error::{TreeError, TreeErrorKind};
pub use values::{Matrix, PointMotion, TreeRange};

use crate::names::Names;
use crate::simulation::Simulation;
use crate::stop::StopError;
use crate::tree::{InSpace, Plane};
use inner::{Inner, Typed, with};
use layout::Layout;
use mbs_core::algebra::Vector;
use mbs_core::cluster::mass_properties;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, JointId, JointKind, Scene};
use mbs_recursive::EffortTerms;

/// A point of a body, in the reference configuration, and what it counts.
type Weighted = (BodyId, [f64; 3], f64);

/// A mechanism in relative coordinates, at any position and velocity.
///
/// ```text
/// M v̇ + c + g = τ + Jᵀ λ,   J v̇ + J̇ v = 0
/// ```
///
/// M is [`mass_matrix`](Self::mass_matrix), g [`gravity_forces`](Self::gravity_forces), c + g [`bias_forces`](Self::bias_forces),
/// τ the efforts along the joints, J [`loop_jacobian`](Self::loop_jacobian). These are the bodies, the joints and gravity alone:
/// springs, motors, friction and all other effects are left out. What they do is a part of τ.
///
/// **Coordinates.** Every joint that closes no loop and is not guided has numbers in q and v, in the order of the scene; where they
/// stand is [`coordinates_of`](Self::coordinates_of). Bodies that no joint holds come last, each as a free joint of its centre of
/// mass. All count from the reference configuration, and are positive as the second body moves against the first.
///
/// | joint | q | v |
/// |---|---|---|
/// | all but those below | the joint's angles and slides, as its outputs | their rates |
/// | ball | unit quaternion (w, x, y, z) of the second body against the first | angular velocity, in axes of the second body |
/// | free, plane | x, y of the second point from the first, in axes of the first body; angle | their rates |
/// | free, space | x, y, z likewise; quaternion | rates of x, y, z; angular velocity, in axes of the second body |
///
/// A unit quaternion is (cos(φ/2), n sin(φ/2)) for a turn φ about n; q and −q are one rotation. Its rate is ½ q (0, ω). Efforts are
/// conjugate to v: τ·v is power. A thin rod in space that balls alone hold has no spin about its line, and some inertia about it.
///
/// **Time.** Only guided joints depend on it: they stand and move as their guides have them at [`time`](Self::set_time), zero at first.
///
/// Answers stand in the tree's own buffers until the next call. After the first calls nothing allocates but
/// [`follow`](Self::follow).
#[derive(Debug, Clone)]
pub struct Tree {
    inner: Inner,
    layout: Layout,
    /// Centres of mass, each with its part of all mass.
    shares: Vec<Weighted>,
    scene: Scene<f64>,
    names: Names,
    q: Vec<f64>,
    v: Vec<f64>,
    answer: Vec<f64>,
    /// In the tree's order.
    tree: Vec<f64>,
    /// No velocities.
    zero: Vec<f64>,
    mass: Matrix,
    loops: Matrix,
    jacobian: Matrix,
    rows: Vec<f64>,
}

impl Tree {
    /// The tree of a scene that passed its check, at rest in the reference configuration.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoTree`].
    #[doc(hidden)]
    pub fn new(scene: &Scene<f64>) -> Result<Self, TreeError> {
        let names = Names::new(scene);
        let made = Inner::new(scene);
        let mut inner =
            made.map_err(|e| TreeError::of_model(TreeErrorKind::NoTree, (e, &names)))?;
        let (mut layout, rows) =
            with!(&inner, tree => (Layout::new(scene, &tree.model), tree.model.n_rows()));
        let [n_q, n] = layout.n;
        let (mut q, zero) = (vec![0.0; n_q], vec![0.0; n]);
        layout.coordinates_outward(&inner.state().z, &mut q);
        let total: f64 = scene.bodies.iter().map(|body| body.mass).sum();
        let share = |b| {
            let (mass, center, _) = mass_properties(scene, b);
            (BodyId::new(b), center.into(), if total > 0.0 { mass / total } else { 0.0 })
        };
        Ok(Self {
            shares: (0..scene.bodies.len()).map(share).collect(),
            scene: scene.clone(),
            v: zero.clone(),
            answer: zero.clone(),
            tree: zero.clone(),
            zero,
            mass: Matrix::zeros(n, n),
            loops: Matrix::zeros(rows, n),
            jacobian: Matrix::zeros(6, n),
            rows: vec![0.0; n * n.max(6).max(rows)],
            inner,
            layout,
            names,
            q,
        })
    }

    /// Sets coordinates and velocities. Quaternions are made unit. Loops are not closed: what is asked then holds for the open ones.
    ///
    /// # Errors
    /// [`TreeError`] for a wrong number of numbers, or one that is not finite; the tree is then unchanged.
    pub fn set(&mut self, q: &[f64], v: &[f64]) -> Result<(), TreeError> {
        checked("q", q, self.q.len())?;
        checked("v", v, self.v.len())?;
        self.layout.normalise(q, &mut self.q)?;
        self.v.copy_from_slice(v);
        let state = self.inner.state();
        self.layout.coordinates_inward(&self.q, &mut state.z);
        self.layout.velocities_inward(&self.v, &mut state.v);
        self.layout.set_velocities(&self.v, &state.v);
        Ok(())
    }

    /// Sets the time [s] at which guided joints stand.
    pub fn set_time(&mut self, t: f64) {
        self.inner.state().t = t;
    }

    /// Takes time, coordinates and velocities of a simulation of the same mechanism, whatever its formulation. Angles are those
    /// within half a turn of the tree's own, so that turns are counted from call to call.
    ///
    /// # Errors
    /// [`TreeErrorKind::Length`] for a simulation of another number of bodies.
    pub fn follow<const D: usize>(
        &mut self,
        simulation: &Simulation<f64, D>,
    ) -> Result<(), TreeError>
    where
        Plane<D>: InSpace<f64>,
    {
        let (model, state) = (simulation.model(), simulation.state());
        let motions: Vec<_> =
            (0..self.scene.bodies.len()).map(|b| model.motion(&self.scene, b, state)).collect();
        self.follow_motions((state.t, &state.applied), &motions)
    }

    /// The same of the motions of the scene's bodies, at a time with these inputs applied.
    pub(crate) fn follow_motions(
        &mut self,
        (t, inputs): (f64, &[f64]),
        motions: &[RigidMotion<f64>],
    ) -> Result<(), TreeError> {
        let n_inputs = self.inner.state().applied.len();
        let sizes = [
            ("motions", self.scene.bodies.len(), motions.len()),
            ("inputs", n_inputs, inputs.len()),
        ];
        if let Some((what, expected, found)) = sizes.into_iter().find(|size| size.1 != size.2) {
            return Err(TreeErrorKind::Length(what, expected, found).into());
        }
        with!(&mut self.inner, tree => {
            // Inputs of guides: those of effects act nowhere here.
            tree.state.applied.copy_from_slice(inputs);
            tree.state.t = t;
            tree.model.read_motions(&self.scene, motions, &mut tree.state);
        });
        let state = self.inner.state();
        self.layout.coordinates_outward(&state.z, &mut self.q);
        self.layout.velocities_outward(&state.v, &mut self.v);
        self.layout.set_velocities(&self.v, &state.v);
        Ok(())
    }

    /// Where the numbers of a joint stand in q and v. A weld has none.
    ///
    /// # Errors
    /// [`TreeErrorKind::Cut`], [`TreeErrorKind::Guided`] or [`TreeErrorKind::Idle`] with the joint's name.
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
        } else if data.kind == JointKind::Weld {
            return Ok(TreeRange { q: 0..0, v: 0..0 });
        } else {
            TreeErrorKind::Idle
        };
        Err(TreeError::of_joint(kind, &data.name))
    }

    /// Where the numbers of a free body stand, whether a free joint names it or none. Of bodies that are welded the first one in the
    /// scene has them.
    #[must_use]
    pub fn free_coordinates_of(&self, body: BodyId) -> Option<TreeRange> {
        let BodyId::Body(body) = body else { return None };
        self.layout.range_of_free(body)
    }

    /// q: the coordinates.
    #[must_use]
    pub fn coordinates(&self) -> &[f64] {
        &self.q
    }

    /// v: the velocities.
    #[must_use]
    pub fn velocities(&self) -> &[f64] {
        &self.v
    }

    /// M, n × n and symmetric; loops are open. ½ vᵀ M v is the kinetic energy where no joint is guided.
    ///
    /// Cost: bodies times depth, and n².
    pub fn mass_matrix(&mut self) -> &Matrix {
        let n = self.v.len();
        let rows = &mut self.rows[..n * n];
        with!(&mut self.inner, t => t.model.write_mass_matrix(&t.state, &mut t.workspace, rows));
        self.mass.take_rows(&self.layout, &self.rows);
        for i in 0..n {
            for j in 0..n {
                self.rows[j * n + i] = self.mass.data[i * n + j];
            }
        }
        self.mass.take_rows(&self.layout, &self.rows);
        &self.mass
    }

    /// J, one row for each equation of the joints that close loops, n columns.
    pub fn loop_jacobian(&mut self) -> &Matrix {
        let rows = &mut self.rows[..self.loops.data.len()];
        with!(&mut self.inner, t => t.model.write_loop_rows(&t.state, &mut t.workspace, rows));
        self.loops.take_rows(&self.layout, &self.rows);
        &self.loops
    }

    /// g: the efforts that hold the mechanism at rest against gravity. A motor that gives them compensates gravity.
    pub fn gravity_forces(&mut self) -> &[f64] {
        self.efforts(EffortTerms::Gravity)
    }

    /// c + g: the efforts that keep all velocities as they are, against centrifugal and Coriolis forces, the motion of guided
    /// joints, and gravity.
    pub fn bias_forces(&mut self) -> &[f64] {
        self.accelerations(None);
        self.efforts(EffortTerms::WithoutEffects)
    }

    /// v̇ under efforts τ along v and gravity, loops closed.
    ///
    /// # Errors
    /// [`TreeErrorKind::Length`], [`TreeErrorKind::NotFinite`]; [`TreeErrorKind::NoAccelerations`] at a singular position.
    pub fn forward_dynamics(&mut self, effort: &[f64]) -> Result<&[f64], TreeError> {
        checked("effort", effort, self.v.len())?;
        self.accelerate(Some(effort))?;
        self.layout.accelerations_outward(&self.inner.state().a, &mut self.answer);
        Ok(&self.answer)
    }

    /// The efforts τ that make accelerations v̇: M v̇ + c + g.
    ///
    /// With loops many efforts make the same motion. Those returned are smallest in the norm of M⁻¹: τ = M (v̇ − v̇₀), with v̇₀ what
    /// [`forward_dynamics`](Self::forward_dynamics) gives without efforts. They are zero for free motion. Accelerations that
    /// open the loops are changed as little as the masses allow. Others are τ + Jᵀ λ for any λ: the motor of a four-bar
    /// carries all where λ takes the efforts from the other joints.
    ///
    /// # Errors
    /// As for [`forward_dynamics`](Self::forward_dynamics).
    pub fn inverse_dynamics(&mut self, accelerations: &[f64]) -> Result<&[f64], TreeError> {
        checked("accelerations", accelerations, self.v.len())?;
        if self.loops.rows == 0 {
            self.accelerations(Some(accelerations));
            return Ok(self.efforts(EffortTerms::WithoutEffects));
        }
        self.accelerate(None)?;
        self.layout.accelerations_inward(accelerations, &mut self.tree);
        let free = &mut self.inner.state().a;
        free.iter_mut().zip(&self.tree).for_each(|(a, x)| *a = x - *a);
        Ok(self.efforts(EffortTerms::Inertia))
    }

    /// Of the velocity of a body's point, which was at `at` in the reference configuration [m]: 3 × n, global axes. In the plane the third
    /// row is zero.
    pub fn point_jacobian(&mut self, body: BodyId, at: [f64; 3]) -> &Matrix {
        self.jacobian(3, Some((body, at, 1.0)))
    }

    /// Of the velocity of a body's centre of mass (rows 0 to 2) and of its angular velocity (3 to 5): 6 × n, global axes.
    pub fn frame_jacobian(&mut self, body: BodyId) -> &Matrix {
        let center = body.index().map_or([0.0; 3], |b| self.shares[b].1);
        self.jacobian(6, Some((body, center, 1.0)))
    }

    /// Of the velocity of the centre of mass of all bodies: 3 × n, global axes.
    pub fn center_of_mass_jacobian(&mut self) -> &Matrix {
        self.jacobian(3, None)
    }

    /// Motion of a body's point, which was at `at` in the reference configuration [m]. The acceleration is that of v̇ = 0, J̇ v: add the
    /// Jacobian times v̇.
    pub fn point(&mut self, body: BodyId, at: [f64; 3]) -> PointMotion {
        let at_rest = RigidMotion::at_rest(at.into());
        let motion = body.index().map_or(at_rest, |b| self.motions()[b]);
        PointMotion::of(motion.point(&at.into()))
    }

    /// Motion of the centre of mass of all bodies; the acceleration as that of a [`point`](Self::point).
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

    /// The motions of the bodies at v̇ = 0.
    fn motions(&mut self) -> &[RigidMotion<f64>] {
        self.accelerations(None);
        with!(&mut self.inner, tree => {
            tree.model.write_motions(&tree.state, &mut tree.workspace, &mut tree.motions);
            &tree.motions
        })
    }

    /// Of a point, or of the centre of mass.
    fn jacobian(&mut self, rows: usize, point: Option<Weighted>) -> &Matrix {
        self.jacobian.resize_rows(rows);
        let to = &mut self.rows[..rows * self.v.len()];
        to.fill(0.0);
        with!(&mut self.inner, tree => {
            tree.model.place(&tree.state, &mut tree.workspace);
            for &point in point.as_ref().map_or(&self.shares[..], std::slice::from_ref) {
                tree.model.add_jacobian(point, &mut tree.workspace, to);
            }
        });
        self.jacobian.take_rows(&self.layout, &self.rows);
        &self.jacobian
    }

    /// Sets the accelerations of the state: those given, or v̇ = 0.
    fn accelerations(&mut self, own: Option<&[f64]>) {
        let state = self.inner.state();
        match own {
            Some(own) => self.layout.accelerations_inward(own, &mut state.a),
            None => self.layout.accelerations_inward(&self.zero, &mut state.a),
        }
    }

    /// Efforts of the state's accelerations.
    fn efforts(&mut self, terms: EffortTerms) -> &[f64] {
        let out = &mut self.tree;
        with!(&mut self.inner, t => t.model.write_efforts((&t.state, terms), &mut t.workspace, out));
        self.layout.efforts_outward(&self.tree, &mut self.answer);
        &self.answer
    }

    /// Accelerations under efforts, into the state.
    fn accelerate(&mut self, effort: Option<&[f64]>) -> Result<(), TreeError> {
        self.layout.efforts_inward(effort.unwrap_or(&self.zero), &mut self.tree);
        let (efforts, names) = (&self.tree, &self.names);
        with!(&mut self.inner, tree => {
            let Typed { model, state, workspace, .. } = &mut **tree;
            model.accelerate_under(efforts, state, workspace).map_err(|error| {
                let freedom = |u| model.owner_of_unknown(u);
                let reason = StopError::step(error, freedom, |row| model.owner_of_row(row));
                TreeError::of_model(TreeErrorKind::NoAccelerations, (reason, names))
            })
        })
    }
}

/// # Errors
/// [`TreeErrorKind::Length`] or [`TreeErrorKind::NotFinite`].
fn checked(what: &'static str, x: &[f64], expected: usize) -> Result<(), TreeError> {
    if x.len() != expected {
        return Err(TreeErrorKind::Length(what, expected, x.len()).into());
    }
    let bad = x.iter().position(|x| !x.is_finite());
    bad.map_or(Ok(()), |place| Err(TreeErrorKind::NotFinite(what, place).into()))
}
