//! A mechanism and its scratch as slices, so that every step runs on memory of the caller's choice.

use crate::link::plan::Span;
use crate::link::{ArticulatedInertia, Link, LinkMotion, LinkRotor};
use crate::loads::{Instant, Load};
use crate::loops::{LoopStore, Loops};
use crate::rows::coupled::SumMeasure;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::feedback::{FeedbackStep, SignalStates};
use mbs_core::laws::LawInputs;

/// A mechanism in relative coordinates: constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeSlices<'a, T: Real, S: Space<T>> {
    /// The links, parents first; the first is the ground.
    pub links: &'a [Link<T, S>],
    /// Closed loops: cut joints and couplings.
    pub loops: Loops<'a, T, S>,
    /// Effects on links and joints.
    pub loads: &'a [Load<T, S>],
    /// The rotors, one a link.
    pub rotors: &'a [LinkRotor<T>],
    /// Tables of their laws, without courses: these are of an instant.
    pub tables: LawInputs<'a, T>,
    /// Signals that follow the motion.
    pub feedback: FeedbackSlices<'a, T>,
    /// Acceleration of gravity [m/s^2].
    pub gravity: S::Point,
    /// The point that positions are counted from, global axes [m].
    pub base: S::Point,
    /// The scene's length [m].
    pub length: T,
    /// Number of coordinates in z.
    pub n_coordinates: usize,
    /// Number of velocities in v.
    pub n_freedoms: usize,
}

/// A length or an angle of a ball that signals measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackMeasure<T> {
    /// Number of the measure among all that is measured.
    pub number: u32,
    /// Length, or angle of a ball, that is measured.
    pub of: SumMeasure<T>,
    /// The links on which it has points.
    pub starts: Span,
}

/// The operations that give signals which follow the motion, with the links whose coordinates they measure. Functions are those of
/// [`Couplings`](crate::rows::coupled::Couplings).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackSlices<'a, T> {
    /// Operations that give the signals.
    pub steps: &'a [FeedbackStep<T>],
    /// The link of each measured coordinate; [`NONE`](crate::rows::coupled::NONE): what is measured is no coordinate.
    pub links: &'a [u32],
    /// Lengths, and angles of balls, that are measured and are no coordinates.
    pub measures: &'a [FeedbackMeasure<T>],
    /// Number of states of signals.
    pub n_states: usize,
    /// The signals that follow the motion, by their numbers among the courses.
    pub signals: &'a [u32],
}

impl<T> FeedbackSlices<'_, T> {
    /// Feedback of a mechanism without signals that follow the motion.
    #[must_use]
    pub const fn none() -> Self {
        Self { steps: &[], links: &[], measures: &[], n_states: 0, signals: &[] }
    }
}

/// Guides and courses as functions of time.
pub trait Inputs<T> {
    /// Writes value, rate and acceleration of each guide, and the vector of each course.
    fn evaluate(&self, t: T, guides: &mut [[T; 3]], courses: &mut [[T; 3]]);
}

/// Scratch of a step.
#[derive(Debug)]
pub struct Store<'a, T: Real, S: Space<T>> {
    /// Links where the inertias were factored; as many as links.
    pub placed: &'a mut [LinkMotion<T, S>],
    /// Links at a trial state; as many as links.
    pub trial: &'a mut [LinkMotion<T, S>],
    /// Articulated bodies, one a link.
    pub condensed: &'a mut [ArticulatedInertia<T, S>],
    /// Accelerations of the links, gravity's taken off.
    pub a: &'a mut [S::Motion],
    /// Responses of the links.
    pub a_response: &'a mut [S::Motion],
    /// Responses of the freedoms.
    pub v_response: &'a mut [T],
    /// Scratch of the loops.
    pub loops: LoopStore<'a, T, S>,
    /// K of the rows on both bodies: first sides, then second ones.
    pub gradient: &'a mut [S::Motion],
    /// Φ, Φ̇ and the bias of Φ̈, one of each for each row.
    pub rows: &'a mut [[T; 3]],
    /// Multipliers, summed over the sweeps.
    pub lambda: &'a mut [T],
    /// Guides at the instant.
    pub guides: &'a mut [[T; 3]],
    /// Courses at the instant.
    pub courses: &'a mut [[T; 3]],
    /// States of signals in a step.
    pub signals: SignalStates<'a, T>,
    /// Coordinates of the step being made.
    pub z: &'a mut [T],
    /// Velocities of the step being made.
    pub v: &'a mut [T],
    /// Accelerations of the step being made.
    pub zdd: &'a mut [T],
    /// Increments of the step being made, or accelerations of the last iteration.
    pub scratch: &'a mut [T],
    /// Memory of the iteration of a step with effects: [`history`](crate::passes::anderson::history) numbers, or none, and the iteration is a plain
    /// one.
    pub history: &'a mut [T],
    /// The most rows that had an effect so far.
    pub rank: &'a mut usize,
    /// Counts of the work that was done.
    pub counts: Counts,
}

/// Work done in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Evaluations with a condensation of inertias.
    pub condensations: u32,
    /// Condensations of forces with the inertias as they were.
    pub responses: u32,
}

impl<'a, T: Real, S: Space<T>> Store<'a, T, S> {
    /// Returns the mechanism as loads see it at the place where inertias were factored.
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
