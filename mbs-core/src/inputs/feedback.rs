//! Operations that give the signals that follow the motion, and the courses that name them: built once from a scene.

use crate::Real;
use crate::feedback::{CourseSlope, FeedbackOperation, FeedbackStep};
use crate::measure::{PreparedCurve, TermInput};
use alloc::vec::Vec;

/// Signals that follow the motion: the operations that give them, with what these refer to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Feedback<T> {
    /// The operations, in their order.
    pub steps: Vec<FeedbackStep<T>>,
    /// Numbers that are measured.
    pub measured: Vec<TermInput<T>>,
    /// Start value of each state.
    pub starts: Vec<T>,
    /// The signals that follow the motion, by their numbers.
    pub signals: Vec<u32>,
    /// Functions that the operations refer to.
    pub curves: Vec<PreparedCurve<T>>,
}

impl<T: Real> Feedback<T> {
    /// Is there no such signal?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Numbers that a state has of the signals: first their own states, then the signals, each with its rate. An evaluation gives rates and
    /// signals.
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

    /// The number of something that is measured.
    pub(super) fn measure(&mut self, of: TermInput<T>) -> u32 {
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

/// An index as operations have it.
pub(super) fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
