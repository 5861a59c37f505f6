//! Mechanism as a formulation sees it: [`Model`], with the numbers of one instant in [`Terms`].
//!
//! ```text
//! M q'' + phi_q^T lambda = Q(q, q', t),   phi(q, t) = 0
//! ```
//!
//! Vectors over coordinates have [`Model::n_extended`] places: the n unknowns, then constants (zero in velocities and
//! accelerations). Vectors over constraints have [`Model::n_constraints`] places.

use crate::Real;
use crate::blocks::{BlockSource, Cliques};
use crate::feedback::CourseSlope;
use crate::inputs::Prescribed;
pub use crate::laws::scalar::ScalarForce;
use crate::step::StepError;
use crate::team::{Alone, Team};
use alloc::vec::Vec;
use core::ops::Range;

/// Everything a model evaluates at one instant. Allocated once by [`Model::terms`].
#[derive(Debug, Clone, PartialEq)]
pub struct Terms<T> {
    /// Constraint values phi [m or -], m.
    pub phi: Vec<T>,
    /// Partial time derivative of phi; zero where no guide acts, m.
    pub phi_t: Vec<T>,
    /// phi'' without accelerations, so that phi'' = phi_q q'' + bias, m.
    pub phi_bias: Vec<T>,
    /// Jacobian rows, element by element (the model's own layout).
    pub jacobian: Vec<T>,
    /// Applied forces, element by element (the model's own layout).
    pub force: Vec<T>,
    /// Scalar laws with tangents, one record for each scalar measure (spring length, joint angle).
    pub measures: Vec<ScalarForce<T>>,
    /// Inputs at this instant: value, rate and acceleration of each guide.
    pub guides: Vec<[T; 3]>,
    /// Inputs at this instant: the vector of each force or torque course.
    pub courses: Vec<[T; 3]>,
    /// Measured angles of the last step, with their turns: those of [`State::memory`].
    pub angles: Vec<T>,
    /// States of signals at this instant, each with its rate.
    pub signals: Vec<[T; 2]>,
    /// States of signals at the start of the step, each with its rate: those of [`State::signals`].
    pub signal_starts: Vec<[T; 2]>,
    /// How long that is ago [s].
    pub signal_dt: T,
    /// How each course answers to what signals measure; none where no signal does.
    pub course_slopes: Vec<CourseSlope<T>>,
}

impl<T: Real> Terms<T> {
    /// States of signals start from those of `state`, `dt` [s] before the instant that is evaluated.
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
    /// Weight of each row in mass units, m; empty: no constraint term.
    pub penalty: &'a [T],
    /// Multipliers (already times the weight of K) of the geometric stiffness; `None`: left out.
    pub geometric: Option<&'a [T]>,
}

impl<T: Real> Tangent<'_, T> {
    /// Weight of the square of a scalar law's gradient in the tangent.
    #[inline(always)]
    pub(crate) fn weight(&self, law: &ScalarForce<T>) -> T {
        self.stiffness * (law.stiffness - law.transverse) + self.damping * law.damping
    }

    /// Has a scalar law a part in it?
    #[inline(always)]
    pub(crate) fn has(&self, law: &ScalarForce<T>) -> bool {
        self.weight(law) != T::ZERO || self.stiffness * law.transverse != T::ZERO
    }
}

/// A residual f = M x + J^T mu - force Q.
#[derive(Debug, Clone, Copy)]
pub struct Load<'a, T> {
    /// Vector x that the mass matrix multiplies, extended; `None`: no mass term.
    pub mass: Option<&'a [T]>,
    /// Multipliers mu of the constraints, m; `None`: no constraint term.
    pub multipliers: Option<&'a [T]>,
    /// Factor of the applied forces.
    pub force: T,
}

/// A mechanism in dependent coordinates with constant mass matrix.
pub trait Model<T: Real>: Cliques + Sync {
    /// Who shares the work of a step in this model: its evaluation does, and a formulation's vectors.
    fn team(&self) -> &impl Team {
        &Alone
    }
    /// Unknowns and constants together.
    fn n_extended(&self) -> usize;
    /// Number of constraint rows m.
    fn n_constraints(&self) -> usize;
    /// Numbers a state must remember besides coordinates (turns of measured angles).
    fn n_memory(&self) -> usize;
    /// Does any element apply forces that change with state or time?
    fn has_forces(&self) -> bool;
    /// Is any row driven by time?
    fn has_guides(&self) -> bool;
    /// A store for the evaluated terms, with all constant parts filled in.
    fn terms(&self) -> Terms<T>;
    /// Writes the unknowns' reference values and all constants.
    fn write_reference(&self, q: &mut [T]);
    /// Number of states of signals.
    fn n_signal_states(&self) -> usize {
        0
    }
    /// Signals of a [state](State::signals) as they begin.
    fn signal_states(&self) -> SignalValues<T> {
        Vec::new()
    }
    /// Guides and courses, which say where the inputs of a state stand; `None`: it has none.
    fn inputs(&self) -> Option<&Prescribed<T>> {
        None
    }
    /// Writes the size of each unknown in the scene: the scene's length for a point's [m], one for a direction's. Measured in these,
    /// nothing depends on the unit of length.
    fn write_sizes(&self, sizes: &mut [T]);
    /// Gives the fractions of the straight path from `q` to `to` at which two points that a law may push apart come close, where they
    /// pass each other. One is just before they are closest; the others are before that, where the force is not across the path.
    fn approaches(&self, q: &[T], to: &[T], take: impl FnMut(T));
    /// Writes the scene's guides and courses at time `t`, and the inputs and remembered angles of `state`, into `terms`: once a step.
    fn set_inputs(&self, t: T, state: &State<T>, terms: &mut Terms<T>);
    /// phi and J at `q`.
    fn evaluate(&self, q: &[T], terms: &mut Terms<T>);
    /// phi and J at `q + dq`, from `phi_n` at `q`: free of the cancellation in phi.
    fn advance(&self, q: &[T], dq: &[T], phi_n: &[T], terms: &mut Terms<T>);
    /// Applied forces and their tangents at (`q`, `v`).
    fn evaluate_forces(&self, q: &[T], v: &[T], terms: &mut Terms<T>);
    /// Writes the measured angles of `terms`, and those of couplings at `q`, into `memory`, at the end of a step.
    fn remember(&self, q: &[T], terms: &Terms<T>, memory: &mut [T]);
    /// Evaluates phi_t at `q`. Does nothing without guides.
    fn evaluate_phi_t(&self, q: &[T], terms: &mut Terms<T>);
    /// Are there rows of velocities, as of bodies that roll? They restrict J v, and no position: their phi is zero.
    fn has_velocity_rows(&self) -> bool {
        false
    }
    /// Is `row` one of them?
    fn is_velocity_row(&self, _row: usize) -> bool {
        false
    }
    /// phi = `unit` J v of the rows of velocities, with J as last evaluated: what a step of `unit` = dq/dv leaves of them.
    fn evaluate_rates(&self, _v: &[T], _unit: T, _terms: &mut Terms<T>) {}
    /// Bias of phi'' at (`q`, `v`).
    fn evaluate_bias(&self, q: &[T], v: &[T], terms: &mut Terms<T>);
    /// rates = J x, over the constraints.
    fn multiply_jacobian(&self, terms: &Terms<T>, x: &[T], rates: &mut [T]);
    /// The effective mass of each row, 1 / (J_k M^-1 J_k^T) with the diagonal of M [kg]: the scale of its penalty.
    fn effective_masses(&self, terms: &Terms<T>, masses: &mut [T]);
    /// The constraint rows of one element; every row belongs to exactly one.
    fn rows(&self, element: usize) -> Range<usize>;
    /// The Jacobian rows of one element, one after the other, each as long as the element's clique and in its order.
    fn write_jacobian(&self, terms: &Terms<T>, element: usize, rows: &mut [T]);
    /// Can a row lose entries over whole ranges of motions, as where the curve of a coupling is level?
    fn may_be_level(&self, _row: usize) -> bool {
        false
    }
    /// The block of one element in the tangent, packed lower triangle.
    fn write_block(
        &self,
        terms: &Terms<T>,
        tangent: &Tangent<'_, T>,
        element: usize,
        block: &mut [T],
    );
    /// The second derivatives of one element that [`write_block`](Self::write_block) leaves out, and a search needs: those of couplings at
    /// `q` with multipliers `lambda`, and of sums under tension times `stiffness`, packed as a block; empty: none.
    fn row_curvature(
        &self,
        _q: &[T],
        _terms: &Terms<T>,
        (_lambda, _stiffness): (&[T], T),
        _element: usize,
    ) -> RowCurvature<T> {
        Vec::new()
    }
    /// Whether an element has a block: see [`BlockSource::has_block`].
    #[inline]
    fn has_block(&self, _terms: &Terms<T>, _tangent: &Tangent<'_, T>, _element: usize) -> bool {
        true
    }
    /// The residual of one element.
    fn write_residual(
        &self,
        terms: &Terms<T>,
        load: &Load<'_, T>,
        element: usize,
        residual: &mut [T],
    );
    /// The residual of all elements: see [`BlockSource::sum_residuals`].
    #[inline]
    fn sum_residuals(&self, _terms: &Terms<T>, _load: &Load<'_, T>, _f: &mut [T]) -> bool {
        false
    }
    /// Kinetic energy at the velocities `v` [J].
    fn kinetic_energy(&self, v: &[T]) -> T;
    /// Potential energy of gravity, constant forces and springs [J]; springs as last evaluated in `terms`.
    fn potential_energy(&self, q: &[T], terms: &Terms<T>) -> T;
    /// Power that enters through dampers, courses and guides (multipliers `lambda`) [W], terms as last evaluated.
    fn power(&self, q: &[T], v: &[T], lambda: &[T], terms: &Terms<T>) -> T;
    /// The row of a guided angle that sits at the false root, half a turn from its guide, if there is one.
    fn opposite_guide(&self, q: &[T], terms: &Terms<T>) -> Option<usize>;
    /// An effect that has turned by a whole turn or more in space, where its law ends; terms as last evaluated.
    fn overturned(&self, _terms: &Terms<T>) -> Option<Owner> {
        None
    }
    /// Error for what has no direction after a step `dq`: a part of a line without length, a twist, a disc that lies flat.
    fn without_direction(&self, _state: &State<T>, _dq: &[T]) -> Option<StepError> {
        None
    }
    /// Part of the scene that an unknown belongs to, for messages.
    fn owner_of_unknown(&self, unknown: usize) -> Owner;
    /// Part of the scene that a constraint row belongs to, for messages.
    fn owner_of_row(&self, row: usize) -> Owner;
}

/// A body or joint of the scene, for messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// `scene.bodies[i]`.
    Body(usize),
    /// `scene.joints[i]`.
    Joint(usize),
    /// `scene.effects[i]`.
    Effect(usize),
    /// `scene.couplings[i]`.
    Coupling(usize),
    /// `scene.rollings[i]`.
    Rolling(usize),
}

/// A model at one instant with the weights of a linear system: what a solver takes.
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

/// A block of second derivatives, packed; empty where there are none.
pub type RowCurvature<T> = Vec<T>;

/// Signals of a state: states of those that have one, then the signals that follow the motion, each with its rate.
pub type SignalValues<T> = Vec<[T; 2]>;

/// Position, velocity and acceleration of a mechanism at a time, with what a step must remember.
#[derive(Debug, Clone, PartialEq)]
pub struct State<T> {
    /// Time of the state [s].
    pub t: T,
    /// Length of the last step [s]; zero where there was none that multipliers may be extrapolated from.
    pub dt: T,
    /// Coordinates, extended [m or -].
    pub q: Vec<T>,
    /// Part of `q` that was lost to rounding, extended: the position is q + q_low.
    pub q_low: Vec<T>,
    /// Velocities of the coordinates, extended; zero in the constants.
    pub v: Vec<T>,
    /// Accelerations of the coordinates, extended; zero in the constants.
    pub a: Vec<T>,
    /// Auxiliary accelerations of the generalised-alpha family, extended; equal to `a` in the Newmark family.
    pub a_aux: Vec<T>,
    /// Multipliers of the last step [N or N m], m.
    pub lambda: Vec<T>,
    /// Multipliers of the step before, m.
    pub lambda_previous: Vec<T>,
    /// Multipliers of dynamic equilibrium with the projected accelerations, m. Power and the most loaded row follow from them; measured
    /// reactions come from the balance of bodies.
    pub reaction: Vec<T>,
    /// phi carried along without rounding, m.
    pub phi: Vec<T>,
    /// Measured angles with their turns.
    pub memory: Vec<T>,
    /// Inputs set from outside for the next step, three numbers each: guides, then effects, in the places that
    /// [`Prescribed::input`] and [`Prescribed::guide_input`] name.
    pub inputs: Vec<T>,
    /// The inputs that accelerations, multipliers and power were made with.
    pub applied: Vec<T>,
    /// States of signals that have one, then the signals that follow the motion, each with its rate.
    pub signals: SignalValues<T>,
    /// Work done on the mechanism by dampers, courses and guides since the start [J].
    pub work: T,
    /// Their power at this instant [W].
    pub power: T,
}

impl<T: Real> State<T> {
    /// A state at rest in the reference configuration at time zero. Not yet consistent: assemble it.
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

    /// Multipliers at the end of the next step of `dt` [s], extrapolated by their last change, at most by twice of it.
    ///
    /// ```text
    /// lambda_k = lambda_n + (dt / dt_n) (lambda_n - lambda_(n-1))
    /// ```
    pub fn extrapolated(&self, dt: T) -> impl Fn(usize) -> T + '_ {
        let share = if self.dt > T::ZERO { (dt / self.dt).min(T::TWO) } else { T::ZERO };
        move |k| {
            let (last, previous) = (self.lambda[k], self.lambda_previous[k]);
            // Equal steps: as printed, to the last digit.
            if share == T::ONE { last + last - previous } else { last + (last - previous) * share }
        }
    }

    /// Overwrites the `n` unknowns, the multipliers and everything else but constants and inputs with another state, of a
    /// model with the same unknowns and rows, without allocating.
    ///
    /// # Panics
    /// If the models have other numbers of them.
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

    /// Overwrites this state with another of the same model, without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.copy_unknowns(other, other.q.len());
        self.inputs.copy_from_slice(&other.inputs);
        self.applied.copy_from_slice(&other.applied);
    }
}
