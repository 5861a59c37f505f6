//! Operations that compute the signals that depend on the motion, and the force signals that use them. They are built once from a
//! scene.

use crate::Real;
use crate::feedback::{CourseSlope, FeedbackOperation, FeedbackStep};
use crate::measure::{PreparedCurve, TermInput};
use alloc::vec::Vec;

/// Signals that depend on the motion: operations, and the data that operations refer to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Feedback<T> {
    /// Operations in the order of evaluation.
    pub steps: Vec<FeedbackStep<T>>,
    /// Quantities of the motion that are measured.
    pub measured: Vec<TermInput<T>>,
    /// Start value of each state.
    pub starts: Vec<T>,
    /// Numbers of the signals that depend on the motion.
    pub signals: Vec<u32>,
    /// Functions that the operations refer to.
    pub curves: Vec<PreparedCurve<T>>,
}

impl<T: Real> Feedback<T> {
    /// True if no signal depends on the motion.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Returns the numbers that a state has for the signals, each with its rate. The states of signals come first, and the signals
    /// follow. An evaluation sets the rates and the signals.
    #[must_use]
    pub fn states(&self) -> Vec<[T; 2]> {
        let mut states: Vec<_> = self.starts.iter().map(|&start| [start, T::ZERO]).collect();
        states.resize(self.starts.len() + self.signals.len(), [T::ZERO; 2]);
        states
    }

    /// Creates the derivatives of `n` force signals by the measured numbers; empty if no signal depends on the motion.
    #[must_use]
    pub fn slopes(&self, n: usize) -> Vec<CourseSlope<T>> {
        alloc::vec![CourseSlope::none(); if self.is_empty() { 0 } else { n }]
    }

    pub(super) fn push(&mut self, to: u32, operation: FeedbackOperation<T>) {
        self.steps.push(FeedbackStep { to, operation });
    }

    /// Returns the number of a measured quantity. A new quantity is added.
    pub(super) fn measure(&mut self, of: TermInput<T>) -> u32 {
        let known = self.measured.iter().position(|measured| *measured == of);
        number(known.unwrap_or_else(|| {
            self.measured.push(of);
            self.measured.len() - 1
        }))
    }

    /// Adds a state with this start value, and returns its number.
    pub(super) fn state(&mut self, start: T) -> u32 {
        self.starts.push(start);
        number(self.starts.len() - 1)
    }

    /// Adds a function, and returns its number.
    pub(super) fn curve(&mut self, curve: &PreparedCurve<T>) -> u32 {
        self.curves.push(curve.clone());
        number(self.curves.len() - 1)
    }
}

/// Index in the form that operations use.
pub(super) fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
