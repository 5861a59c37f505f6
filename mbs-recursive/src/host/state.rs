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
    /// Coordinates: angles [rad], slides [m], quaternions of balls; of free bodies rotation, then position [m].
    pub z: Vec<T>,
    /// Velocities: rates of angles and slides; angular velocities in the link's own axes; of free bodies then the velocity of
    /// their centre in global axes.
    pub v: Vec<T>,
    /// Rates of the velocities.
    pub a: Vec<T>,
    /// Auxiliary accelerations of the generalised-alpha family; equal to `a` in the Newmark family.
    pub a_aux: Vec<T>,
    /// Multipliers of the cut joints' equations [N, N m].
    pub lambda: Vec<T>,
    /// Values set from outside for the next step, in the places that [`Prescribed::input`](mbs_core::inputs::Prescribed::input) and
    /// [`Prescribed::guide_input`](mbs_core::inputs::Prescribed::guide_input) name.
    pub inputs: Vec<T>,
    /// The inputs that accelerations, multipliers and power were made with.
    pub applied: Vec<T>,
    /// States of signals that have one, then the signals that follow the motion, each with its rate.
    pub signals: Vec<[T; 2]>,
    /// Work done by dampers, courses and guides since the start [J].
    pub work: T,
    /// Rate at which `work` grows at this instant [W].
    pub power: T,
}

impl<T: Real> TreeState<T> {
    /// A state at rest in the reference configuration at time zero; accelerations and multipliers are zero yet.
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

    /// Returns the state as the start of a step.
    pub(crate) fn start(&self) -> Start<'_, T> {
        Start { t: self.t, z: &self.z, v: &self.v, a: &self.a, signals: &self.signals }
    }

    /// Accelerations that are known anew: auxiliary ones follow.
    pub(crate) fn set_accelerations(&mut self, a: &[T]) {
        self.a.copy_from_slice(a);
        self.a_aux.copy_from_slice(a);
    }

    /// Overwrites this state with another of the same model, without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.copy_coordinates(other);
        self.inputs.copy_from_slice(&other.inputs);
        self.applied.copy_from_slice(&other.applied);
    }

    /// Overwrites everything but inputs with the state of a model of the same coordinates, without allocating.
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
    /// The inputs that are set in a state, with the functions of time.
    pub(crate) fn inputs<'a>(&'a self, state: &'a TreeState<T>) -> (&'a Prescribed<T>, &'a [T]) {
        (&self.prescribed, &state.inputs)
    }
}

/// Scratch of the steps of one model. Nothing is allocated after [`Workspace::new`], but for the matrices of
/// [`Radau5`](crate::TreeMethod::Radau5) by the first step of it.
#[derive(Debug, Clone)]
pub struct Workspace<T: Real, S: Space<T>> {
    placed: Vec<LinkMotion<T, S>>,
    trial: Vec<LinkMotion<T, S>>,
    condensed: Vec<ArticulatedInertia<T, S>>,
    motions: Vec<S::Motion>,
    /// K as they are, and as they travel.
    gradients: Vec<S::Motion>,
    slopes: Vec<T>,
    rows: Vec<[T; 3]>,
    /// l, λ, scales, pivots, summed λ.
    multipliers: Vec<T>,
    blocks: Vec<T>,
    gains: Vec<T>,
    inputs: Vec<[T; 3]>,
    /// States of signals: at the start of a step, and at the instant.
    signals: [Vec<[T; 2]>; 2],
    course_slopes: Vec<CourseSlope<T>>,
    z: Vec<T>,
    /// v, z̈, response, scratch.
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
    /// Scratch of the method, its stages among it.
    pub(crate) scratch: Vec<T>,
    /// Error control, from the first step that asks for it.
    pub(crate) pair: Option<Adaptive<T, Tableau<T, 7>>>,
    /// Error control of the method 8(5,3), from the first step that asks for it.
    pub(crate) eighth: Option<Adaptive<T, Tableau<T, 12>>>,
    /// Error control of extrapolation, from the first step that asks for it.
    pub(crate) extrapolation: Option<Adaptive<T, Extrapolation>>,
    /// Error control of the collocation at Radau points, with its matrices, from the first step that asks for it.
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

    /// Returns what stands of the last factorisation: most rows that had an effect so far, and the pivots of the rows.
    pub(crate) fn last(&self) -> (usize, &[T]) {
        let rows = self.rows.len();
        (self.rank, &self.multipliers[3 * rows..4 * rows])
    }

    /// The scratch as slices.
    #[inline]
    pub fn store(&mut self) -> Store<'_, T, S> {
        self.parts().0
    }

    /// The scratch as slices, and that of explicit steps.
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
