//! The state of a mechanism in relative coordinates, and the scratch of a step.

use crate::build::TreeModel;
use crate::link::{ArticulatedInertia, LinkMotion};
use crate::loops::LoopStore;
use crate::passes::anderson::history;
use crate::passes::slices::{Counts, Start, Store};
use crate::space::{Numbers, Space};
use crate::step::explicit::n_components;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::feedback::{CourseSlope, SignalStates};
use mbs_core::inputs::Prescribed;
use mbs_core::ode::{Adaptive, Extrapolation, Radau, Tableau, rk4_scratch};

/// Position, velocity and acceleration of a tree at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct TreeState<T> {
    /// Time of the state [s].
    pub t: T,
    /// Coordinates: angles [rad], slides [m], quaternions of balls. A free body has its rotation (an angle [rad] in the plane, a quaternion
    /// in space), then its position [m].
    pub z: Vec<T>,
    /// Velocities: rates of angles and slides, and angular velocities in the link's own axes. A free body has its angular velocity, then
    /// the velocity of its origin in global axes.
    pub v: Vec<T>,
    /// Accelerations: rates of the velocities.
    pub a: Vec<T>,
    /// Auxiliary accelerations of the generalised-alpha family. They equal `a` in the Newmark family.
    pub a_aux: Vec<T>,
    /// Multipliers of the cut joints' equations [N, N m].
    pub lambda: Vec<T>,
    /// Inputs for the next step, set by the caller. The functions [`Prescribed::input`](mbs_core::inputs::Prescribed::input) and
    /// [`Prescribed::guide_input`](mbs_core::inputs::Prescribed::guide_input) return the indices of inputs.
    pub inputs: Vec<T>,
    /// Inputs for which accelerations, multipliers and power were evaluated.
    pub applied: Vec<T>,
    /// Values and rates of signals: first the states of signals that have a state, then the signals that depend on the motion.
    pub signals: Vec<[T; 2]>,
    /// Work of dampers, signals and guides since the start [J].
    pub work: T,
    /// Rate of `work` at this instant [W].
    pub power: T,
}

impl<T: Real> TreeState<T> {
    /// Returns a state at rest in the reference configuration at time zero. Accelerations and multipliers are not yet evaluated and zero.
    #[must_use]
    pub fn at_rest<S: Space<T>>(model: &TreeModel<T, S>) -> Self {
        let mut z = vec![T::ZERO; model.n_coordinates];
        model.write_reference(&mut z);
        Self {
            t: T::ZERO,
            z,
            v: vec![T::ZERO; model.n_freedoms],
            a: vec![T::ZERO; model.n_freedoms],
            a_aux: vec![T::ZERO; model.n_freedoms],
            lambda: vec![T::ZERO; model.rows.len()],
            inputs: model.prescribed.inputs(),
            applied: model.prescribed.inputs(),
            signals: model.feedback.states(),
            work: T::ZERO,
            power: T::ZERO,
        }
    }

    /// Returns the numbers of the state from which a step starts.
    pub(crate) fn start(&self) -> Start<'_, T> {
        Start { t: self.t, z: &self.z, v: &self.v, a: &self.a, signals: &self.signals }
    }

    /// Sets accelerations that were evaluated without a step; the auxiliary accelerations are set equal to them.
    pub(crate) fn set_accelerations(&mut self, a: &[T]) {
        self.a.copy_from_slice(a);
        self.a_aux.copy_from_slice(a);
    }

    /// Copies another state of the same model into this state, without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.copy_coordinates(other);
        self.inputs.copy_from_slice(&other.inputs);
        self.applied.copy_from_slice(&other.applied);
    }

    /// Copies everything except inputs from a state of a model with the same coordinates, without allocating.
    pub fn copy_coordinates(&mut self, other: &Self) {
        self.t = other.t;
        self.z.copy_from_slice(&other.z);
        self.v.copy_from_slice(&other.v);
        self.a.copy_from_slice(&other.a);
        self.a_aux.copy_from_slice(&other.a_aux);
        self.lambda.copy_from_slice(&other.lambda);
        if self.signals.len() == other.signals.len() {
            self.signals.copy_from_slice(&other.signals);
        }
        self.work = other.work;
        self.power = other.power;
    }
}

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the functions of time, with the inputs that are set in a state.
    pub(crate) fn inputs<'a>(&'a self, state: &'a TreeState<T>) -> (&'a Prescribed<T>, &'a [T]) {
        (&self.prescribed, &state.inputs)
    }
}

/// Scratch memory of the steps of one model. [`Workspace::new`] allocates the scratch. The first step by
/// [`Radau5`](crate::TreeMethod::Radau5) allocates its matrices. No other step allocates.
#[derive(Debug, Clone)]
pub struct Workspace<T: Real, S: Space<T>> {
    placed: Vec<LinkMotion<T, S>>,
    trial: Vec<LinkMotion<T, S>>,
    condensed: Vec<ArticulatedInertia<T, S>>,
    motions: Vec<S::Motion>,
    /// Gradients K of the loop rows, in two copies: as evaluated at the bodies, and as carried inward.
    gradients: Vec<S::Motion>,
    slopes: Vec<T>,
    rows: Vec<[T; 3]>,
    /// Numbers of each loop row, in this order: right-hand side l, multiplier λ, scale, pivot, sum of the multipliers λ.
    multipliers: Vec<T>,
    blocks: Vec<T>,
    gains: Vec<T>,
    inputs: Vec<[T; 3]>,
    /// States of signals at the start of a step, and at the instant.
    signals: [Vec<[T; 2]>; 2],
    course_slopes: Vec<CourseSlope<T>>,
    z: Vec<T>,
    /// Numbers of each freedom, in this order: velocity v, acceleration z̈, response to multipliers, scratch.
    freedoms: Vec<T>,
    history: Vec<T>,
    n_guides: usize,
    rank: usize,
    pub(crate) explicit: Explicit<T>,
}

/// Scratch of explicit steps.
#[derive(Debug, Clone)]
pub(crate) struct Explicit<T> {
    /// Vector y of the method: z, v, states of signals, work.
    pub(crate) y: Vec<T>,
    /// Scratch of the method, including its stages.
    pub(crate) scratch: Vec<T>,
    /// Error control of the pair 5(4); made by the first step that uses it.
    pub(crate) pair: Option<Adaptive<T, Tableau<T, 7>>>,
    /// Error control of the method 8(5,3); made by the first step that uses it.
    pub(crate) eighth: Option<Adaptive<T, Tableau<T, 12>>>,
    /// Error control of extrapolation; made by the first step that uses it.
    pub(crate) extrapolation: Option<Adaptive<T, Extrapolation>>,
    /// Error control of Radau collocation with its matrices; made by the first step that uses it.
    pub(crate) radau: Option<Adaptive<T, Radau<T>>>,
}

impl<T: Real, S: Space<T>> Workspace<T, S> {
    /// Makes the scratch for `model`.
    #[must_use]
    pub fn new(model: &TreeModel<T, S>) -> Self {
        let (links, rows) = (model.links.len(), model.rows.len());
        let n_guides = model.prescribed.n_guides();
        let n = n_components(&model.mechanism());
        let n_scratch = rk4_scratch(n).max(Tableau::<T, 12>::scratch(n));
        let n_scratch = n_scratch.max(Extrapolation::most_scratch(n));
        Self {
            placed: vec![LinkMotion::ground(); links],
            trial: vec![LinkMotion::ground(); links],
            condensed: vec![ArticulatedInertia::empty(); links],
            motions: vec![S::Motion::zero(); 2 * links],
            gradients: vec![S::Motion::zero(); 2 * model.order.n_sides * rows],
            slopes: vec![T::ZERO; model.mechanism().loops.couplings.n_slopes()],
            rows: vec![[T::ZERO; 3]; rows],
            multipliers: vec![T::ZERO; 5 * rows],
            blocks: vec![T::ZERO; model.order.n_blocks],
            gains: vec![T::ZERO; 2 * model.order.n_gains],
            inputs: vec![[T::ZERO; 3]; n_guides + model.prescribed.n_courses()],
            signals: [model.feedback.states(), model.feedback.states()],
            course_slopes: model.feedback.slopes(model.prescribed.n_courses()),
            z: vec![T::ZERO; model.n_coordinates],
            freedoms: vec![T::ZERO; 4 * model.n_freedoms],
            history: vec![
                T::ZERO;
                if model.loads.is_empty() { 0 } else { history(model.n_freedoms) }
            ],
            n_guides,
            rank: 0,
            explicit: Explicit {
                y: vec![T::ZERO; n],
                scratch: vec![T::ZERO; n_scratch],
                pair: None,
                eighth: None,
                extrapolation: None,
                radau: None,
            },
        }
    }

    /// Returns the largest number of independent rows so far, and the pivots of the rows in the last factorisation.
    pub(crate) fn last(&self) -> (usize, &[T]) {
        let rows = self.rows.len();
        (self.rank, &self.multipliers[3 * rows..4 * rows])
    }

    /// Returns the scratch as slices.
    #[inline]
    pub fn store(&mut self) -> Store<'_, T, S> {
        self.parts().0
    }

    /// Returns the scratch as slices, and the scratch of explicit steps.
    #[inline]
    pub(crate) fn parts(&mut self) -> (Store<'_, T, S>, &mut Explicit<T>) {
        let (links, rows) = (self.placed.len(), self.rows.len());
        let (a, a_response) = self.motions.split_at_mut(links);
        let (k, gradient) = {
            let half = self.gradients.len() / 2;
            self.gradients.split_at_mut(half)
        };
        let (l, rest) = self.multipliers.split_at_mut(rows);
        let (lambda_response, rest) = rest.split_at_mut(rows);
        let (scales, rest) = rest.split_at_mut(rows);
        let (pivots, lambda) = rest.split_at_mut(rows);
        let half = self.gains.len() / 2;
        let (gains, heads) = self.gains.split_at_mut(half);
        let (guides, courses) = self.inputs.split_at_mut(self.n_guides);
        let [starts, ends] = &mut self.signals;
        let n = self.freedoms.len() / 4;
        let (v, rest) = self.freedoms.split_at_mut(n);
        let (zdd, rest) = rest.split_at_mut(n);
        let (v_response, scratch) = rest.split_at_mut(n);
        let store = Store {
            placed: &mut self.placed,
            trial: &mut self.trial,
            condensed: &mut self.condensed,
            a,
            a_response,
            v_response,
            loops: LoopStore {
                k,
                slopes: &mut self.slopes,
                l,
                lambda: lambda_response,
                blocks: &mut self.blocks,
                gains,
                heads,
                scales,
                pivots,
            },
            gradient,
            rows: &mut self.rows,
            lambda,
            guides,
            courses,
            signals: SignalStates { dt: T::ZERO, starts, ends, slopes: &mut self.course_slopes },
            z: &mut self.z,
            v,
            zdd,
            scratch,
            history: &mut self.history,
            rank: &mut self.rank,
            counts: Counts::default(),
        };
        (store, &mut self.explicit)
    }
}
