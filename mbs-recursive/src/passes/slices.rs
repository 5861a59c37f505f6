//! A mechanism and its scratch memory as slices, so that every step uses memory that the caller provides.

use crate::link::plan::Span;
use crate::link::{ArticulatedInertia, Link, LinkMotion, LinkRotor};
use crate::loads::{Instant, Load};
use crate::loops::{LoopStore, Loops};
use crate::rows::coupled::SumMeasure;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::feedback::{FeedbackStep, SignalStates};
use mbs_core::laws::LawInputs;

/// A mechanism in relative coordinates; its data are constant during a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeSlices<'a, T: Real, S: Space<T>> {
    /// Links, parents before children; the first link is the ground.
    pub links: &'a [Link<T, S>],
    /// Closed loops: cut joints and couplings.
    pub loops: Loops<'a, T, S>,
    /// Effects on links and joints.
    pub loads: &'a [Load<T, S>],
    /// Rotors of joints, with the links whose coordinates they follow.
    pub rotors: &'a [LinkRotor<T>],
    /// Tables of the laws of effects. The signals are not included, because their values belong to an instant.
    pub tables: LawInputs<'a, T>,
    /// Signals that depend on the motion.
    pub feedback: FeedbackSlices<'a, T>,
    /// Acceleration of gravity [m/s^2].
    pub gravity: S::Point,
    /// Point from which the positions of links are measured, in global axes [m].
    pub base: S::Point,
    /// Characteristic length of the scene [m].
    pub length: T,
    /// Number of coordinates in z.
    pub n_coordinates: usize,
    /// Number of velocities in v.
    pub n_freedoms: usize,
}

/// Length or angle of a ball joint that is measured for signals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackMeasure<T> {
    /// Index of the measured number among all measured numbers.
    pub number: u32,
    /// The measured length, or the measured angle of a ball joint.
    pub of: SumMeasure<T>,
    /// Links that carry points of the measured line or axes of the ball joint.
    pub starts: Span,
}

/// Operations that compute signals which depend on the motion, with the links whose coordinates they measure. The operations use the curves
/// of [`Couplings`](crate::rows::coupled::Couplings).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackSlices<'a, T> {
    /// Operations that compute the signals.
    pub steps: &'a [FeedbackStep<T>],
    /// Link of each measured number; [`NONE`](crate::rows::coupled::NONE) if the measured number is not a coordinate.
    pub links: &'a [u32],
    /// Measured numbers that are not coordinates: lengths and angles of ball joints.
    pub measures: &'a [FeedbackMeasure<T>],
    /// Number of states of signals.
    pub n_states: usize,
    /// Indices of the signals that depend on the motion.
    pub signals: &'a [u32],
}

impl<T> FeedbackSlices<'_, T> {
    /// Returns the feedback of a mechanism without signals that depend on the motion.
    #[must_use]
    pub const fn none() -> Self {
        Self { steps: &[], links: &[], measures: &[], n_states: 0, signals: &[] }
    }
}

/// Guides and signals as functions of time.
pub trait Inputs<T> {
    /// Writes value, rate and acceleration of each guide, and the vector of each signal, at time `t` [s].
    fn evaluate(&self, t: T, guides: &mut [[T; 3]], courses: &mut [[T; 3]]);
}

/// Scratch memory of a step.
#[derive(Debug)]
pub struct Store<'a, T: Real, S: Space<T>> {
    /// Place and motion of each link at the state for which inertias were factored.
    pub placed: &'a mut [LinkMotion<T, S>],
    /// Place and motion of each link at a trial state.
    pub trial: &'a mut [LinkMotion<T, S>],
    /// Articulated inertias, one for each link.
    pub condensed: &'a mut [ArticulatedInertia<T, S>],
    /// Accelerations of the links, minus the acceleration of gravity.
    pub a: &'a mut [S::Motion],
    /// Response of each link's motion to the right-hand side of a sweep.
    pub a_response: &'a mut [S::Motion],
    /// Response of each freedom to the right-hand side of a sweep.
    pub v_response: &'a mut [T],
    /// Scratch of the loops.
    pub loops: LoopStore<'a, T, S>,
    /// Gradients K of the rows: first the gradients for the first bodies of all rows, then those for the second bodies.
    pub gradient: &'a mut [S::Motion],
    /// Violation Φ, its rate Φ̇ and the bias of Φ̈ for each row.
    pub rows: &'a mut [[T; 3]],
    /// Multipliers, summed over the sweeps.
    pub lambda: &'a mut [T],
    /// Value, rate and acceleration of each guide at the instant.
    pub guides: &'a mut [[T; 3]],
    /// Vector of each signal at the instant.
    pub courses: &'a mut [[T; 3]],
    /// States of signals in a step.
    pub signals: SignalStates<'a, T>,
    /// Coordinates of the step being made.
    pub z: &'a mut [T],
    /// Velocities of the step being made.
    pub v: &'a mut [T],
    /// Accelerations of the step being made.
    pub zdd: &'a mut [T],
    /// Increments of the coordinates in the step being made, or accelerations of the last iteration.
    pub scratch: &'a mut [T],
    /// Memory of the iteration of a step with effects: [`history`](crate::passes::anderson::history) numbers. If it is empty, iterates are
    /// not mixed.
    pub history: &'a mut [T],
    /// Largest number of independent rows so far.
    pub rank: &'a mut usize,
    /// Counts of the work done.
    pub counts: Counts,
}

/// Work done in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of evaluations that condense inertias and forces.
    pub condensations: u32,
    /// Number of responses, which condense forces only, with the inertias that were factored before.
    pub responses: u32,
}

impl<'a, T: Real, S: Space<T>> Store<'a, T, S> {
    /// Returns the data from which loads are evaluated, at the state for which inertias were factored.
    #[allow(clippy::needless_update, reason = "with effects compiled there are tables")]
    pub(crate) fn instant<'b>(&'b self, m: &'b TreeSlices<'_, T, S>) -> Instant<'b, T, S> {
        Instant {
            links: m.links,
            placed: self.placed,
            coordinates: (self.z, self.v, self.guides),
            couplings: &m.loops.couplings,
            law_inputs: LawInputs { courses: self.courses, ..m.tables },
            base: m.base,
        }
    }
}

/// The state that a step starts from.
#[derive(Debug, Clone, Copy)]
pub struct Start<'a, T> {
    /// Time of the start [s].
    pub t: T,
    /// Coordinates at the start.
    pub z: &'a [T],
    /// Velocities at the start.
    pub v: &'a [T],
    /// Accelerations at the start.
    pub a: &'a [T],
    /// States of signals, each with its rate.
    pub signals: &'a [[T; 2]],
}
