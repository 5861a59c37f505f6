//! Mechanism as a formulation reads it: the trait [`Model`], and the numbers of one instant in [`Terms`].
//!
//! ```text
//! M q'' + phi_q^T lambda = Q(q, q', t),   phi(q, t) = 0
//! ```
//!
//! A vector over coordinates has [`Model::n_extended`] places: the n unknowns, then the constants. The constants are coordinates of points
//! and directions that do not move, so their velocities and accelerations are zero. A vector over constraints has [`Model::n_constraints`]
//! places.

use crate::Real;
use crate::blocks::{BlockSource, Cliques};
use crate::feedback::CourseSlope;
use crate::inputs::Prescribed;
pub use crate::laws::scalar::ScalarForce;
use crate::step::StepError;
use crate::team::{Alone, Team};
use alloc::vec::Vec;
use core::ops::Range;

/// All quantities that a model evaluates at one instant. [`Model::terms`] allocates them once.
#[derive(Debug, Clone, PartialEq)]
pub struct Terms<T> {
    /// Constraint values phi [m or -], a vector of length m.
    pub phi: Vec<T>,
    /// Partial time derivative of phi, a vector of length m. It is zero in rows without a guide.
    pub phi_t: Vec<T>,
    /// Part of phi'' without accelerations: phi'' = phi_q q'' + bias. A vector of length m.
    pub phi_bias: Vec<T>,
    /// Jacobian rows, element by element, in the model's internal layout.
    pub jacobian: Vec<T>,
    /// Applied forces, element by element, in the model's internal layout.
    pub force: Vec<T>,
    /// Values of the scalar force laws with their tangents: one record for each scalar measure (spring length, joint angle).
    pub measures: Vec<ScalarForce<T>>,
    /// Inputs at this instant: value, rate and acceleration of each guide.
    pub guides: Vec<[T; 3]>,
    /// Signals at this instant: value, rate and acceleration of each named signal, then the vector of each effect's signal.
    pub courses: Vec<[T; 3]>,
    /// Measured angles at the end of the last step, whole turns included: a copy of [`State::memory`].
    pub angles: Vec<T>,
    /// Signals at this instant, each with its rate, in the order of [`State::signals`].
    pub signals: Vec<[T; 2]>,
    /// Signals at the start of the step, each with its rate: a copy of [`State::signals`].
    pub signal_starts: Vec<[T; 2]>,
    /// Time from `signal_starts` to this instant [s].
    pub signal_dt: T,
    /// Derivatives of each signal by a measured coordinate and its rate. Empty if no signal measures the motion.
    pub course_slopes: Vec<CourseSlope<T>>,
}

impl<T: Real> Terms<T> {
    /// Sets the start of the step: the states of signals begin as in `state`, `dt` [s] before the instant to be evaluated.
    #[inline(always)]
    pub fn begin_signals(&mut self, dt: T, state: &State<T>) {
        self.signal_dt = dt;
        self.signal_starts.copy_from_slice(&state.signals);
    }
}

/// Weights of the tangent matrix T = M + damping C + stiffness (K + K_geo(lambda)) + J^T diag(penalty) J.
#[derive(Debug, Clone, Copy)]
pub struct Tangent<'a, T> {
    /// Weight of K = -dQ/dq.
    pub stiffness: T,
    /// Weight of C = -dQ/dq'.
    pub damping: T,
    /// Weight of each constraint row in mass units, a vector of length m. Empty: the tangent has no constraint term.
    pub penalty: &'a [T],
    /// Multipliers of the geometric stiffness, already times the weight of K. `None`: the tangent leaves the geometric stiffness out.
    pub geometric: Option<&'a [T]>,
}

impl<T: Real> Tangent<'_, T> {
    /// Weight of the square of a scalar law's gradient in the tangent.
    #[inline(always)]
    pub(crate) fn weight(&self, law: &ScalarForce<T>) -> T {
        self.stiffness * (law.stiffness - law.transverse) + self.damping * law.damping
    }

    /// True if a scalar law contributes to the tangent.
    #[inline(always)]
    pub(crate) fn has(&self, law: &ScalarForce<T>) -> bool {
        self.weight(law) != T::ZERO || self.stiffness * law.transverse != T::ZERO
    }
}

/// A residual f = M x + J^T mu - force Q.
#[derive(Debug, Clone, Copy)]
pub struct Load<'a, T> {
    /// Vector x that the mass matrix multiplies, over all coordinates. `None`: no mass term.
    pub mass: Option<&'a [T]>,
    /// Multipliers mu of the constraints, a vector of length m. `None`: no constraint term.
    pub multipliers: Option<&'a [T]>,
    /// Factor of the applied forces.
    pub force: T,
}

/// A mechanism in dependent coordinates with constant mass matrix.
pub trait Model<T: Real>: Cliques + Sync {
    /// Thread team that shares the work of a step: the evaluation of the model and the vectors of a formulation.
    fn team(&self) -> &impl Team {
        &Alone
    }
    /// Number of coordinates: unknowns and constants together.
    fn n_extended(&self) -> usize;
    /// Number of constraint rows m.
    fn n_constraints(&self) -> usize;
    /// Number of values that a state remembers besides coordinates: measured angles, whole turns included.
    fn n_memory(&self) -> usize;
    /// True if any element applies forces that change with state or time.
    fn has_forces(&self) -> bool;
    /// True if any row is driven by time.
    fn has_guides(&self) -> bool;
    /// Allocates the evaluated terms and fills in all constant parts.
    fn terms(&self) -> Terms<T>;
    /// Writes the unknowns' reference values and all constants.
    fn write_reference(&self, q: &mut [T]);
    /// Number of states of signals.
    fn n_signal_states(&self) -> usize {
        0
    }
    /// Signals of a [state](State::signals) at the start of the simulation.
    fn signal_states(&self) -> SignalValues<T> {
        Vec::new()
    }
    /// Guides and signals of the model. They give the place of each input in a state. `None`: the model has no inputs.
    fn inputs(&self) -> Option<&Prescribed<T>> {
        None
    }
    /// Writes a typical size of each unknown: the scene's length [m] for a coordinate of a point, one for a component of a direction.
    /// Unknowns divided by their sizes do not depend on the unit of length.
    fn write_sizes(&self, sizes: &mut [T]);
    /// Passes to `take` the fractions of the straight path from `q` to `to` at which two points that repel each other come close. One
    /// fraction is just before the smallest distance. The others are smaller: the force is not yet perpendicular to the path there.
    fn approaches(&self, q: &[T], to: &[T], take: impl FnMut(T));
    /// Writes guides and signals at time `t` into `terms`, with the inputs and remembered angles of `state`. A step calls this once.
    fn set_inputs(&self, t: T, state: &State<T>, terms: &mut Terms<T>);
    /// Evaluates phi and its Jacobian J at `q`.
    fn evaluate(&self, q: &[T], terms: &mut Terms<T>);
    /// Evaluates phi and its Jacobian J at `q + dq`, from `phi_n`, the value of phi at `q`. The increment of phi is evaluated directly, so
    /// no digits cancel.
    fn advance(&self, q: &[T], dq: &[T], phi_n: &[T], terms: &mut Terms<T>);
    /// Evaluates applied forces and their tangents at positions `q` and velocities `v`.
    fn evaluate_forces(&self, q: &[T], v: &[T], terms: &mut Terms<T>);
    /// Writes measured angles into `memory` at the end of a step: the angles of `terms`, and the angles of couplings at `q`.
    fn remember(&self, q: &[T], terms: &Terms<T>, memory: &mut [T]);
    /// Evaluates phi_t at `q`. Does nothing without guides.
    fn evaluate_phi_t(&self, q: &[T], terms: &mut Terms<T>);
    /// True if the model has velocity rows, as for rolling bodies. Such rows restrict velocities, J v, but no position: their phi is zero.
    fn has_velocity_rows(&self) -> bool {
        false
    }
    /// True if `row` is a velocity row.
    fn is_velocity_row(&self, _row: usize) -> bool {
        false
    }
    /// Sets phi = `unit` J v in the velocity rows, with J as last evaluated. This is the residual of these rows in a step with `unit` =
    /// dq/dv.
    fn evaluate_rates(&self, _v: &[T], _unit: T, _terms: &mut Terms<T>) {}
    /// Evaluates the bias of phi'' at positions `q` and velocities `v`.
    fn evaluate_bias(&self, q: &[T], v: &[T], terms: &mut Terms<T>);
    /// Multiplies the Jacobian by `x`: rates = J x, one value for each constraint.
    fn multiply_jacobian(&self, terms: &Terms<T>, x: &[T], rates: &mut [T]);
    /// Writes the effective mass [kg] of each row, 1 / (J_k M^-1 J_k^T), with the diagonal of M. It scales the penalty of the row.
    fn effective_masses(&self, terms: &Terms<T>, masses: &mut [T]);
    /// Constraint rows of one element. Every row belongs to exactly one element.
    fn rows(&self, element: usize) -> Range<usize>;
    /// Writes the Jacobian rows of one element, one after the other. Each row has the length and the order of the element's clique.
    fn write_jacobian(&self, terms: &Terms<T>, element: usize, rows: &mut [T]);
    /// True if the entries of a row can vanish over whole ranges of a motion, for example where the curve of a coupling is level.
    fn may_be_level(&self, _row: usize) -> bool {
        false
    }
    /// Writes the block of one element in the tangent, as a packed lower triangle.
    fn write_block(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        element: usize,
        block: &mut [T],
    );
    /// Second derivatives of one element that [`write_block`](Self::write_block) leaves out, for a search for equilibrium. They belong to
    /// couplings at `q` with multipliers `lambda`, and to sums under tension, times `stiffness`. The result is packed as a block. It is
    /// empty if the element has no such derivatives.
    fn row_curvature(
        &self,
        _q: &[T],
        _terms: &Terms<T>,
        (_lambda, _stiffness): (&[T], T),
        _element: usize,
    ) -> RowCurvature<T> {
        Vec::new()
    }
    /// True if an element has a block. See [`BlockSource::has_block`].
    #[inline]
    fn has_block(&self, _terms: &Terms<T>, _tangent: &Tangent<'_, T>, _element: usize) -> bool {
        true
    }
    /// Writes the residual of one element.
    fn write_residual(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        element: usize,
        residual: &mut [T],
    );
    /// Sums the residuals of all elements: see [`BlockSource::sum_residuals`].
    #[inline]
    fn sum_residuals(&self, _terms: &Terms<T>, _load: &Load<'_, T>, _f: &mut [T]) -> bool {
        false
    }
    /// Kinetic energy at the velocities `v` [J].
    fn kinetic_energy(&self, v: &[T]) -> T;
    /// Potential energy of gravity, constant forces and springs [J]. Springs count as last evaluated in `terms`.
    fn potential_energy(&self, q: &[T], terms: &Terms<T>) -> T;
    /// Power that dampers, signals and guides supply [W]: guides through the multipliers `lambda`, laws as last evaluated in `terms`.
    fn power(&self, q: &[T], v: &[T], lambda: &[T], terms: &Terms<T>) -> T;
    /// Row of a guided angle that is half a turn from its guide, at the false root of the constraint. `None`: there is no such row.
    fn opposite_guide(&self, q: &[T], terms: &Terms<T>) -> Option<usize>;
    /// Effect that has turned by a whole turn or more in space, where its law is not defined; terms as last evaluated.
    fn overturned(&self, _terms: &Terms<T>) -> Option<Owner> {
        None
    }
    /// Returns an error if a step `dq` makes a direction undefined: a part of a line has zero length, a twist has no axis, or a disc lies
    /// flat.
    fn without_direction(&self, _state: &State<T>, _dq: &[T]) -> Option<StepError> {
        None
    }
    /// Part of the scene that an unknown belongs to, for messages.
    fn owner_of_unknown(&self, unknown: usize) -> Owner;
    /// Part of the scene that a constraint row belongs to, for messages.
    fn owner_of_row(&self, row: usize) -> Owner;
}

/// An entry of the scene, for messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// Body of the scene: `scene.bodies[i]`.
    Body(usize),
    /// Joint of the scene: `scene.joints[i]`.
    Joint(usize),
    /// Effect of the scene: `scene.effects[i]`.
    Effect(usize),
    /// Coupling of the scene: `scene.couplings[i]`.
    Coupling(usize),
    /// Rolling contact of the scene: `scene.rollings[i]`.
    Rolling(usize),
}

/// A model at one instant with the weights of a linear system: the input of a solver.
#[derive(Debug, Clone, Copy)]
pub struct System<'a, T, M> {
    /// Model of the mechanism.
    pub model: &'a M,
    /// Evaluated terms of the model.
    pub terms: &'a Terms<T>,
    /// Weights of the matrix.
    pub tangent: Tangent<'a, T>,
    /// Parts of the right-hand side.
    pub load: Load<'a, T>,
}

impl<T: Real, M: Model<T>> BlockSource<T> for System<'_, T, M> {
    #[inline]
    fn write_block(&self, element: usize, block: &mut [T]) {
        self.model.write_block(self.terms, &self.tangent, element, block);
    }
    #[inline]
    fn has_block(&self, element: usize) -> bool {
        self.model.has_block(self.terms, &self.tangent, element)
    }
    #[inline]
    fn write_residual(&self, element: usize, residual: &mut [T]) {
        self.model.write_residual(self.terms, &self.load, element, residual);
    }
    #[inline]
    fn sum_residuals(&self, f: &mut [T]) -> bool {
        self.model.sum_residuals(self.terms, &self.load, f)
    }
}

/// A block of second derivatives, as a packed lower triangle. Empty: there are none.
pub type RowCurvature<T> = Vec<T>;

/// Signals of a state, each with its rate. First the states of lags, integrals and controllers, then the signals that depend on the motion.
pub type SignalValues<T> = Vec<[T; 2]>;

/// Position, velocity and acceleration of a mechanism at one time, and all else that a step must remember.
#[derive(Debug, Clone, PartialEq)]
pub struct State<T> {
    /// Time of the state [s].
    pub t: T,
    /// Length of the last step [s]. Zero if there is no last step from which multipliers can be extrapolated.
    pub dt: T,
    /// Coordinates [m or -], unknowns and constants.
    pub q: Vec<T>,
    /// Compensation of the rounding error of `q`, for all coordinates: the position is q + q_low.
    pub q_low: Vec<T>,
    /// Velocities of all coordinates; zero in the constants.
    pub v: Vec<T>,
    /// Accelerations of all coordinates; zero in the constants.
    pub a: Vec<T>,
    /// Auxiliary accelerations of the generalised-alpha family, for all coordinates. They equal `a` in the Newmark family.
    pub a_aux: Vec<T>,
    /// Multipliers of the last step [N or N m], a vector of length m.
    pub lambda: Vec<T>,
    /// Multipliers of the step before the last one, a vector of length m.
    pub lambda_previous: Vec<T>,
    /// Multipliers of dynamic equilibrium with the projected accelerations, a vector of length m. Power and the most loaded row follow from
    /// them. Measured reactions do not: they follow from the equilibrium of bodies.
    pub reaction: Vec<T>,
    /// Constraint values phi, a vector of length m. Each step adds their increment, so that no digits cancel.
    pub phi: Vec<T>,
    /// Measured angles [rad], whole turns included.
    pub memory: Vec<T>,
    /// Inputs that the program sets for the next step, three numbers each: guides, then effects. Then signals follow, one number each.
    /// [`Prescribed::input`] and [`Prescribed::guide_input`] give the places.
    pub inputs: Vec<T>,
    /// Inputs with which the present accelerations, multipliers and power were computed.
    pub applied: Vec<T>,
    /// Signals, each with its rate. First the states of lags, integrals and controllers, then the signals that depend on the motion.
    pub signals: SignalValues<T>,
    /// Work that dampers, signals and guides have done on the mechanism since the start [J].
    pub work: T,
    /// Power of dampers, signals and guides at this instant [W].
    pub power: T,
}

impl<T: Real> State<T> {
    /// State without velocity in the reference configuration at time zero. It is not yet consistent: assemble it.
    pub fn at_rest(model: &impl Model<T>) -> Self {
        let (n, m) = (model.n_extended(), model.n_constraints());
        let zeros = |k| alloc::vec![T::ZERO; k];
        let mut q = zeros(n);
        model.write_reference(&mut q);
        let inputs = model.inputs().map(Prescribed::inputs).unwrap_or_default();
        Self {
            t: T::ZERO,
            dt: T::ZERO,
            q,
            q_low: zeros(n),
            v: zeros(n),
            a: zeros(n),
            a_aux: zeros(n),
            lambda: zeros(m),
            lambda_previous: zeros(m),
            reaction: zeros(m),
            phi: zeros(m),
            memory: zeros(model.n_memory()),
            applied: inputs.clone(),
            inputs,
            signals: model.signal_states(),
            work: T::ZERO,
            power: T::ZERO,
        }
    }

    /// Multipliers at the end of the next step of `dt` [s], extrapolated linearly from the last two. The factor dt / dt_n below is limited
    /// to 2.
    ///
    /// ```text
    /// lambda_k = lambda_n + (dt / dt_n) (lambda_n - lambda_(n-1))
    /// ```
    pub fn extrapolated(&self, dt: T) -> impl Fn(usize) -> T + '_ {
        let share = if self.dt > T::ZERO { (dt / self.dt).min(T::TWO) } else { T::ZERO };
        move |k| {
            let (last, previous) = (self.lambda[k], self.lambda_previous[k]);
            // Steps of equal length use the published form, so that the last digit agrees with it.
            if share == T::ONE { last + last - previous } else { last + (last - previous) * share }
        }
    }

    /// Overwrites this state with another state, except for constants and inputs. It does not allocate. `n` is the number of unknowns. Both
    /// states must be of models with the same unknowns and rows.
    ///
    /// # Panics
    /// If the models differ in the number of unknowns, rows or remembered angles.
    pub fn copy_unknowns(&mut self, other: &Self, n: usize) {
        (self.t, self.dt) = (other.t, other.dt);
        self.q[..n].copy_from_slice(&other.q[..n]);
        self.q_low[..n].copy_from_slice(&other.q_low[..n]);
        self.v[..n].copy_from_slice(&other.v[..n]);
        self.a[..n].copy_from_slice(&other.a[..n]);
        self.a_aux[..n].copy_from_slice(&other.a_aux[..n]);
        self.lambda.copy_from_slice(&other.lambda);
        self.lambda_previous.copy_from_slice(&other.lambda_previous);
        self.reaction.copy_from_slice(&other.reaction);
        self.phi.copy_from_slice(&other.phi);
        self.memory.copy_from_slice(&other.memory);
        if self.signals.len() == other.signals.len() {
            self.signals.copy_from_slice(&other.signals);
        }
        (self.work, self.power) = (other.work, other.power);
    }

    /// Overwrites this state with another state of the same model, without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.copy_unknowns(other, other.q.len());
        self.inputs.copy_from_slice(&other.inputs);
        self.applied.copy_from_slice(&other.applied);
    }
}
