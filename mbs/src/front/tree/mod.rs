//! [`Tree`]: a mechanism in relative coordinates, at any position and velocity.

mod error;
mod inner;
mod layout;
mod values;

pub use error::TreeError;
pub use values::{Matrix, PointMotion, TreeRange};

use crate::names::Names;
use crate::simulation::Simulation;
use crate::tree::{InSpace, Plane};
use inner::Inner;
use layout::Layout;
use mbs_core::algebra::Vector;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Dimension, JointId, JointKind, Scene};
use mbs_recursive::{EffortTerms, Planar, Spatial};

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
    inner: Box<dyn Inner>,
    layout: Layout,
    scene: Scene<f64>,
    names: Names,
    cuts: Vec<usize>,
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
    /// [`TreeError::NoTree`].
    #[doc(hidden)]
    pub fn new(scene: &Scene<f64>) -> Result<Self, TreeError> {
        let names = Names::new(scene);
        let inner = match scene.dimension {
            Dimension::Planar => inner::of_scene::<Planar>(scene),
            Dimension::Spatial => inner::of_scene::<Spatial>(scene),
        };
        let mut inner = inner.map_err(|reason| TreeError::no_tree(reason, &names))?;
        let mut layout = inner.layout(scene);
        let ([n_q, n], rows) = (layout.n, inner.n_rows());
        let mut q = vec![0.0; n_q];
        layout.coordinates_outward(&inner.state().z, &mut q);
        Ok(Self {
            cuts: inner.cut_joints(),
            scene: scene.clone(),
            v: vec![0.0; n],
            answer: vec![0.0; n],
            tree: vec![0.0; n],
            zero: vec![0.0; n],
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
        self.layout.check_rotations(q)?;
        self.q.copy_from_slice(q);
        self.layout.normalise(&mut self.q);
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
    /// [`TreeError::Length`] for a simulation of another number of bodies.
    pub fn follow<const D: usize>(
        &mut self,
        simulation: &Simulation<f64, D>,
    ) -> Result<(), TreeError>
    where
        Plane<D>: InSpace<f64>,
    {
        let (model, state) = (simulation.model(), simulation.state());
        let guides = model.prescribed().guides().iter().map(|guide| guide.at(state.t));
        let motions: Vec<_> =
            (0..self.scene.bodies.len()).map(|b| model.motion(&self.scene, b, state)).collect();
        self.follow_motions((state.t, guides), &motions)
    }

    /// The same of the motions of the scene's bodies and guides.
    pub(crate) fn follow_motions(
        &mut self,
        (t, guides): (f64, impl Iterator<Item = [f64; 3]>),
        motions: &[RigidMotion<f64>],
    ) -> Result<(), TreeError> {
        let (expected, found) = (self.scene.bodies.len(), motions.len());
        if expected != found {
            return Err(TreeError::Length { what: "motions", expected, found });
        }
        guides.enumerate().for_each(|(g, motion)| self.inner.set_guide(g, motion));
        self.inner.state().t = t;
        self.inner.read(&self.scene, motions);
        let state = self.inner.state();
        self.layout.coordinates_outward(&state.z, &mut self.q);
        self.layout.velocities_outward(&state.v, &mut self.v);
        self.layout.set_velocities(&self.v, &state.v);
        Ok(())
    }

    /// Where the numbers of a joint stand in q and v. A weld has none.
    ///
    /// # Errors
    /// [`TreeError::Cut`], [`TreeError::Guided`] or [`TreeError::NoCoordinates`] with the joint's name.
    pub fn coordinates_of(&self, joint: JointId) -> Result<TreeRange, TreeError> {
        if let Some(range) = self.layout.range(joint.index()) {
            return Ok(range);
        }
        let data = &self.scene.joints[joint];
        let name = data.name.clone();
        if self.scene.guides.iter().any(|guide| guide.joint == joint) {
            Err(TreeError::Guided { joint: name })
        } else if self.cuts.contains(&joint.index()) {
            Err(TreeError::Cut { joint: name })
        } else if data.kind == JointKind::Weld {
            Ok(TreeRange { q: 0..0, v: 0..0 })
        } else {
            Err(TreeError::NoCoordinates { joint: name })
        }
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
        self.inner.write_mass(&mut self.rows[..n * n]);
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
        self.inner.write_loop_rows(&mut self.rows[..self.loops.data.len()]);
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
        self.efforts(EffortTerms::All)
    }

    /// v̇ under efforts τ along v and gravity, loops closed.
    ///
    /// # Errors
    /// [`TreeError::Length`], [`TreeError::NotFinite`]; [`TreeError::NoAccelerations`] at a singular position.
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
            return Ok(self.efforts(EffortTerms::All));
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
        self.jacobian(3, Some((body, at)))
    }

    /// Of the velocity of a body's centre of mass (rows 0 to 2) and of its angular velocity (3 to 5): 6 × n, global axes.
    pub fn frame_jacobian(&mut self, body: BodyId) -> &Matrix {
        let center = match body {
            BodyId::Ground => [0.0; 3],
            BodyId::Body(b) => mbs_core::cluster::mass_properties(&self.scene, b).1.into(),
        };
        self.jacobian(6, Some((body, center)))
    }

    /// Of the velocity of the centre of mass of all bodies that move: 3 × n, global axes.
    pub fn center_of_mass_jacobian(&mut self) -> &Matrix {
        self.jacobian(3, None)
    }

    /// Motion of a body's point, which was at `at` in the reference configuration [m]. The acceleration is that of v̇ = 0, J̇ v: add the
    /// Jacobian times v̇.
    pub fn point(&mut self, body: BodyId, at: [f64; 3]) -> PointMotion {
        let BodyId::Body(b) = body else {
            return PointMotion { position: at, ..PointMotion::default() };
        };
        self.accelerations(None);
        let motion = self.inner.motions()[b].point(&Vector::from(at));
        PointMotion::of(motion.map(Into::into))
    }

    /// Motion of the centre of mass of all bodies that move; the acceleration as that of a [`point`](Self::point). Zero where they have no
    /// mass.
    pub fn center_of_mass(&mut self) -> PointMotion {
        self.accelerations(None);
        PointMotion::of(self.inner.center_of_mass())
    }

    fn jacobian(&mut self, rows: usize, of: Option<(BodyId, [f64; 3])>) -> &Matrix {
        let size = rows * self.v.len();
        self.inner.write_jacobian(of, &mut self.rows[..size]);
        self.jacobian.resize_rows(rows);
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
        self.inner.write_efforts(terms, &mut self.tree);
        self.layout.efforts_outward(&self.tree, &mut self.answer);
        &self.answer
    }

    /// Accelerations under efforts, into the state.
    fn accelerate(&mut self, effort: Option<&[f64]>) -> Result<(), TreeError> {
        self.layout.efforts_inward(effort.unwrap_or(&self.zero), &mut self.tree);
        let done = self.inner.accelerate(&self.tree);
        done.map_err(|reason| TreeError::no_accelerations(reason, &self.names))
    }
}

/// # Errors
/// [`TreeError::Length`] or [`TreeError::NotFinite`].
fn checked(what: &'static str, x: &[f64], expected: usize) -> Result<(), TreeError> {
    if x.len() != expected {
        return Err(TreeError::Length { what, expected, found: x.len() });
    }
    let bad = x.iter().position(|x| !x.is_finite());
    bad.map_or(Ok(()), |index| Err(TreeError::NotFinite { what, index }))
}
