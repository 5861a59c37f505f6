//! What gives the signals that follow the motion, and the courses that name them: built once from a scene.

use super::Prescribed;
use crate::Real;
use crate::feedback::{CourseSlope, FeedbackOperation, FeedbackStep};
use crate::measure::PreparedCurve;
use crate::scene::{Signal, SignalId};
use alloc::vec::Vec;

/// Signals that follow the motion: the operations that give them, with what these refer to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Feedback<T> {
    /// The operations, in their order.
    pub steps: Vec<FeedbackStep<T>>,
    /// Joint and number of each coordinate that is measured.
    pub measured: Vec<(usize, usize)>,
    /// What each state begins with.
    pub starts: Vec<T>,
    /// The signals that follow the motion, by their numbers.
    pub signals: Vec<u32>,
    /// The functions.
    pub curves: Vec<PreparedCurve<T>>,
}

impl<T: Real> Feedback<T> {
    /// Is there no such signal?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// What a state has of them: first their own states, then the signals, each with its rate. An evaluation gives rates and signals.
    #[must_use]
    pub fn states(&self) -> Vec<[T; 2]> {
        let mut states: Vec<_> = self.starts.iter().map(|&start| [start, T::ZERO]).collect();
        states.resize(self.starts.len() + self.signals.len(), [T::ZERO; 2]);
        states
    }

    /// Room for how each of `n` courses answers to what is measured; none where nothing follows the motion.
    #[must_use]
    pub fn slopes(&self, n: usize) -> Vec<CourseSlope<T>> {
        alloc::vec![CourseSlope::none(); if self.is_empty() { 0 } else { n }]
    }

    pub(super) fn push(&mut self, to: u32, operation: FeedbackOperation<T>) {
        self.steps.push(FeedbackStep { to, operation });
    }

    /// The number of a measured coordinate.
    pub(super) fn measure(&mut self, of: (usize, usize)) -> u32 {
        let known = self.measured.iter().position(|measured| *measured == of);
        number(known.unwrap_or_else(|| {
            self.measured.push(of);
            self.measured.len() - 1
        }))
    }

    /// The number of a state that is added.
    pub(super) fn state(&mut self, start: T) -> u32 {
        self.starts.push(start);
        number(self.starts.len() - 1)
    }

    /// The number of a function that is added.
    pub(super) fn curve(&mut self, curve: &PreparedCurve<T>) -> u32 {
        self.curves.push(curve.clone());
        number(self.curves.len() - 1)
    }
}

impl<T: Real> Prescribed<T> {
    /// Writes the signals that follow the motion, as a [state](crate::model::State::signals) has them, among the courses:
    /// [`write`](Self::write) keeps them, and gives them to the courses that name them.
    pub fn write_followed(&self, signals: &[[T; 2]], courses: &mut [[T; 3]]) {
        let following = self.signals.following();
        let values = signals.iter().rev().take(following.clone().count()).rev();
        for (signal, &[value, rate]) in following.zip(values) {
            if let Some(to) = courses.get_mut(signal) {
                *to = [value, rate, T::ZERO];
            }
        }
    }

    /// Does a course name a signal that follows the motion?
    #[must_use]
    pub fn follows_motion(&self, course: &Signal<T>) -> bool {
        let Signal::Named(of) = course else { return false };
        of.iter().flatten().any(|signal| self.signals.follows_motion(*signal))
    }

    /// What gives the signals that follow the motion, and the courses that name them.
    ///
    /// Cost: one pass over signals and courses; allocates.
    #[must_use]
    pub fn feedback(&self) -> Feedback<T> {
        let follows = |signal| self.signals.follows_motion(signal);
        self.operations(follows, follows)
    }

    /// What gives all signals that are made of others or follow the motion, and are not constant. The courses that name those or other
    /// signals that are not constant follow. For steps on tables, where functions of time and inputs are courses by themselves.
    ///
    /// States and measured coordinates have the numbers that they have in [`feedback`](Self::feedback).
    ///
    /// Cost: one pass over signals and courses; allocates.
    #[must_use]
    pub fn program(&self) -> Feedback<T> {
        let moves = |signal| !self.signals.is_constant(signal);
        let is_made = |signal: SignalId| {
            let kind = self.signals.kinds().nth(signal.index());
            kind.is_some_and(|(kind, _)| !kind.operands().is_empty() || kind.is_feedback())
        };
        self.operations(|signal| moves(signal) && is_made(signal), moves)
    }

    /// The operations that give the signals that are taken, and the components of courses by those that are named.
    fn operations(
        &self,
        is_taken: impl Fn(SignalId) -> bool,
        is_named: impl Fn(SignalId) -> bool,
    ) -> Feedback<T> {
        let mut feedback = Feedback {
            steps: Vec::new(),
            measured: Vec::new(),
            starts: Vec::new(),
            signals: self.signals.following().map(number).collect(),
            curves: Vec::new(),
        };
        self.signals.add_feedback(is_taken, &mut feedback);
        for (i, (_, course)) in self.courses.iter().enumerate() {
            let Signal::Named(of) = course.course() else { continue };
            for (component, signal) in of.iter().enumerate() {
                let Some(signal) = signal.filter(|of| is_named(*of)) else { continue };
                let (from, component) = (number(signal.index()), number(component));
                let to = number(self.signals.len() + i);
                let operation = match course.on {
                    Some(on) if self.signals.follows_motion(signal) => {
                        FeedbackOperation::Force { from, on: feedback.measure(on) }
                    }
                    _ => FeedbackOperation::Component { from, component },
                };
                feedback.push(to, operation);
            }
        }
        feedback
    }
}

fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
